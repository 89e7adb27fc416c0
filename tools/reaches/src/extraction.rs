use coact_joint_task::Task;
use coact_perception::{
    CLASSES, FEATURES, Level, Perception, PreshapeModel, READ, ReachRecord, SingularModel, WHOLE_LENGTH,
};
use coact_recordings::Reach;
use coact_robot::Robot;
use coact_world::Replay;

/// Tempo that is assumed of people whom nobody has seen yet, s.
const USUAL_TEMPO: f64 = 0.33;

/// What perception kept of one reach, and what it was for.
#[derive(Debug, Clone)]
pub(crate) struct Labelled {
    pub participant: u32,
    /// Size class.
    pub class: usize,
    pub record: ReachRecord,
}

/// Replays one person's reaches through perception and keeps what it reads from the hand. Reaches in which it found no
/// onset, no slow phase or no grasp are left out.
pub(crate) fn extract(task: &Task, robot: &Robot, person: &[&Reach]) -> Result<Vec<Labelled>, SingularModel> {
    let replay = Replay::new(task, robot, person, |_| true);
    let mut perception = Perception::new(task, &blank())?.with_robot(robot.clone());
    let (mut sample, mut truth) = (bytemuck::zeroed_box(), bytemuck::zeroed_box());
    let mut percept = bytemuck::zeroed_box();
    let mut kept = Vec::new();
    for (reach, span) in replay.reaches().iter().zip(replay.spans()) {
        for tick in span.begin..span.end {
            replay.step(tick, &mut sample, &mut truth);
            sample.header.cycle = tick;
            perception.step(tick, Some(&sample), &mut percept);
        }
        let record = *perception.reach();
        if record.is_complete() && record.tempo > 0.0 {
            kept.push(Labelled { participant: reach.participant, class: reach.size.index(), record });
        }
    }
    Ok(kept)
}

/// A model that knows nothing: features are read alike under every model.
fn blank() -> PreshapeModel {
    let level = |length: usize| Level {
        direction: vec![0.0; length],
        mean: [0.0; CLASSES],
        within: 1.0,
        contrast: 1.0,
        person: 1.0,
    };
    PreshapeModel {
        sizes: [0.025, 0.055, 0.075],
        tempo: USUAL_TEMPO,
        phase: vec![level(FEATURES); READ],
        whole: level(WHOLE_LENGTH),
    }
}

use crate::SeenPart;
use coact_joint_task::Task;
use coact_messages::{SceneView, Sighting};

/// The parts that the recogniser has seen lately.
///
/// It misses one now and then: of each kind the fullest of the newest frames counts.
#[derive(Debug, Default)]
pub(crate) struct Sightings {
    /// Capture of the newest frame, cycle.
    captured: Option<u64>,
    /// For each kind of part.
    kept: Vec<Kept>,
}

/// What one frame showed of one kind.
#[derive(Debug, Clone, Default)]
struct Kept {
    captured: u64,
    parts: Vec<Sighting>,
}

/// For so long a frame may count that is fuller than those after it, cycles.
const RECENT: u64 = 200;

impl Sightings {
    /// Takes down a frame, unless it was taken down before.
    pub fn see(&mut self, view: &SceneView, task: &Task) {
        if self.captured == Some(view.captured_cycle) {
            return;
        }
        self.captured = Some(view.captured_cycle);
        self.kept.resize(task.kinds.len(), Kept::default());
        let seen = &view.sighting[..(view.sightings as usize).min(view.sighting.len())];
        for (kind, kept) in self.kept.iter_mut().enumerate() {
            let parts: Vec<_> = seen.iter().filter(|part| part.kind as usize == kind).copied().collect();
            if parts.len() >= kept.parts.len() || view.captured_cycle > kept.captured + RECENT {
                *kept = Kept { captured: view.captured_cycle, parts };
            }
        }
    }

    /// All of them.
    pub fn parts(&self, task: &Task) -> Vec<SeenPart> {
        let named = |(kind, kept): (&coact_joint_task::Kind, &Kept)| {
            let part = |part: &Sighting| SeenPart {
                kind: kind.name.clone(),
                position: part.position,
                orientation: part.orientation,
            };
            kept.parts.iter().map(part).collect::<Vec<_>>()
        };
        task.kinds.iter().zip(&self.kept).flat_map(named).collect()
    }
}

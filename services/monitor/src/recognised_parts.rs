use coact_joint_task::Task;
use coact_messages::{SceneView, Sighting};
use coact_period::cycles;
use coact_run_records::SeenPart;
use std::time::Duration;

/// The parts that were recognised in the newest camera frames.
///
/// The recogniser misses a part now and then. So of each kind that frame of late counts that showed the most parts.
#[derive(Debug, Default)]
pub(crate) struct RecognisedParts {
    /// Cycle at which the newest frame was captured.
    captured: Option<u64>,
    /// For each kind of part.
    kinds: Vec<KindSightings>,
}

/// The parts of one kind in one frame.
#[derive(Debug, Clone, Default)]
struct KindSightings {
    captured: u64,
    parts: Vec<Sighting>,
}

/// For so many cycles a frame may count that showed more parts than those after it. A dozen frames of a slow camera (60 Hz):
/// the recogniser does not miss a part in all of them. A part that left the table disappears from the pictures that late.
const RECENT: u64 = cycles(Duration::from_millis(200));

impl RecognisedParts {
    /// Adds a frame, unless it was added before.
    pub fn add_frame(&mut self, view: &SceneView, task: &Task) {
        if self.captured == Some(view.captured_cycle) {
            return;
        }
        self.captured = Some(view.captured_cycle);
        self.kinds.resize(task.kinds.len(), KindSightings::default());
        let seen = view.sightings();
        for (kind, newest) in self.kinds.iter_mut().enumerate() {
            let parts: Vec<_> = seen.iter().filter(|part| part.kind as usize == kind).copied().collect();
            if parts.len() >= newest.parts.len() || view.captured_cycle > newest.captured + RECENT {
                *newest = KindSightings { captured: view.captured_cycle, parts };
            }
        }
    }

    /// All of them.
    pub fn parts(&self, task: &Task) -> Vec<SeenPart> {
        let named = |(kind, seen): (&coact_joint_task::Kind, &KindSightings)| {
            let part = |part: &Sighting| SeenPart {
                kind: kind.name.clone(),
                position: part.position,
                orientation: part.orientation,
            };
            seen.parts.iter().map(part).collect::<Vec<_>>()
        };
        task.kinds.iter().zip(&self.kinds).flat_map(named).collect()
    }
}

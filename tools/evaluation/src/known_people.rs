use crate::statistics::{Proportion, Spread};
use crate::{Inference, PartnerAction};
use serde::Serialize;

/// So many reaches of a person to their end, and the robot is taken to know how that hand moves.
const KNOWN_AFTER: u32 = 10;

/// What was understood of people whom the robot knows: of valid actions in full view before which the person had completed ten
/// reaches for a part.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct KnownPeople {
    /// Their goal stood rightly in IL at grasp completion.
    pub right: Proportion,
    /// ... another one.
    pub wrong: Proportion,
    /// The first goal that stood for 50 ms on the way, which nothing corrects, was right.
    pub first_right: Proportion,
    /// ... another one.
    pub first_wrong: Proportion,
    /// Decision lead of those that were answered rightly, and not predicted, ms.
    pub lead_ms: Option<Spread>,
}

impl KnownPeople {
    /// Counts those among these valid actions; none without any.
    pub(crate) fn new(valid: &[&PartnerAction]) -> Option<Self> {
        let known: Vec<_> = valid.iter().filter(|action| action.earlier_reaches >= KNOWN_AFTER).collect();
        if known.is_empty() {
            return None;
        }
        let share = |is_so: &dyn Fn(&PartnerAction) -> bool| {
            Proportion::new(known.iter().filter(|action| is_so(action)).count(), known.len())
        };
        let at_grasp = |what| share(&|action| action.inference == Some(what));
        let first = |what| share(&|action| action.first_inference == Some(what));
        let leads = known.iter().filter(|action| !action.is_predicted()).filter_map(|action| action.lead_ms);
        Some(Self {
            right: at_grasp(Inference::Right),
            wrong: at_grasp(Inference::Wrong),
            first_right: first(Inference::Right),
            first_wrong: first(Inference::Wrong),
            lead_ms: Spread::new(leads.map(|lead| lead as f64).collect()),
        })
    }
}

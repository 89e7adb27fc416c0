use crate::statistics::Proportion;
use crate::{HesitantReach, Inference, PartnerAction};
use serde::Serialize;

/// How the robot bore people who hesitated in mid-reach. Reaches count whose grasp was completed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Hesitations {
    /// Of all such reaches, those whose goal stood in IL as the hand began to stop.
    pub inferred_before: Proportion,
    /// ... or later, before the grasp.
    pub inferred: Proportion,
    /// Of these, those in which it then stood there until grasp completion without a break.
    pub kept: Proportion,
    /// Of all, those whose goal stood in IL at grasp completion.
    pub right: Proportion,
    /// Those in which another one did.
    pub wrong: Proportion,
}

impl Hesitations {
    /// Counts the hesitant reaches among `actions`; none without any.
    pub fn new<'a>(actions: impl Iterator<Item = &'a PartnerAction>) -> Option<Self> {
        let grasped = actions.filter(|action| action.grasp_ms.is_some());
        let hesitant: Vec<(&PartnerAction, &HesitantReach)> =
            grasped.filter_map(|action| Some((action, action.hesitation.as_ref()?))).collect();
        if hesitant.is_empty() {
            return None;
        }
        let count = |is_so: &dyn Fn(&PartnerAction, &HesitantReach) -> bool| {
            hesitant.iter().filter(|(action, reach)| is_so(action, reach)).count()
        };
        let inferred = |inference| count(&|action, _| action.inference == Some(inference));
        let before = count(&|_, reach| reach.is_inferred_before());
        let stood = count(&|_, reach| reach.inferred_ms.is_some());
        Some(Self {
            inferred_before: Proportion::new(before, hesitant.len()),
            inferred: Proportion::new(stood, hesitant.len()),
            kept: Proportion::new(count(&|_, reach| reach.inferred_ms.is_some() && reach.kept), stood),
            right: Proportion::new(inferred(Inference::Right), hesitant.len()),
            wrong: Proportion::new(inferred(Inference::Wrong), hesitant.len()),
        })
    }
}

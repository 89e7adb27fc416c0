use crate::statistics::{Proportion, Spread};
use crate::{Inference, PartnerAction, TurnedReach};
use serde::Serialize;

/// Within how long the robot is to follow, ms: the project's goal for 95 of 100 changes of mind.
const IN_TIME: i64 = 150;

/// How often and how soon the robot followed people who changed their minds in mid-reach. Reaches count whose grasp was completed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ChangesOfMind {
    /// Of all such reaches, those in which the first goal stood in IL as the hand turned: else there was nothing to follow.
    pub inferred_before: Proportion,
    /// ... in which its complementary action was decided.
    pub decided_before: Proportion,
    /// The new goal stood in IL for good within 150 ms of the hand's turn.
    pub followed_in_time: Proportion,
    /// From the turn until it stood for good, of those in which it did before the grasp, ms.
    pub delay_ms: Option<Spread>,
    /// The same of those reaches alone in which the first goal stood as the hand turned.
    pub followed_in_time_of_inferred: Proportion,
    /// See `delay_ms`.
    pub delay_of_inferred_ms: Option<Spread>,
    /// The new goal did not stand in IL at grasp completion.
    pub never_followed: Proportion,
    /// Another one did.
    pub wrong: Proportion,
    /// From the turn until the hand moved more in the new direction than in the old one, ms.
    pub heading_ms: Option<Spread>,
    /// The new goal stood for good within 150 ms of that; of the reaches in which the hand did.
    pub followed_heading_in_time: Proportion,
    /// From then until it stood for good, of those in which it did, ms; negative where it had before.
    pub delay_after_heading_ms: Option<Spread>,
    /// Of valid new goals, those whose complementary action was decided within 150 ms of the turn.
    pub answered_in_time: Proportion,
    /// From the turn until it was decided, of those that were answered rightly, ms; 0 where it had been decided before.
    pub answer_delay_ms: Option<Spread>,
}

impl ChangesOfMind {
    /// Counts the turned reaches among `actions`; none without any.
    pub fn new<'a>(actions: impl Iterator<Item = &'a PartnerAction>) -> Option<Self> {
        let grasped = actions.filter(|action| action.grasp_ms.is_some());
        let turned: Vec<(&PartnerAction, &TurnedReach)> =
            grasped.filter_map(|action| Some((action, action.turn.as_ref()?))).collect();
        if turned.is_empty() {
            return None;
        }
        let of_all = |is_so: &dyn Fn(&PartnerAction, &TurnedReach) -> bool| {
            Proportion::new(turned.iter().filter(|(action, turn)| is_so(action, turn)).count(), turned.len())
        };
        let delays = |delay: fn(&TurnedReach) -> Option<i64>| -> Vec<f64> {
            turned.iter().filter_map(|(_, turn)| delay(turn)).map(|delay| delay as f64).collect()
        };
        let inferred_before = of_all(&|_, turn| turn.inferred_before);
        let of_inferred = delays(|turn| turn.delay_ms().filter(|_| turn.inferred_before));
        let in_time = |delays: &[f64], of: usize| {
            Proportion::new(delays.iter().filter(|delay| **delay <= IN_TIME as f64).count(), of)
        };
        let (delay, after_heading) =
            (delays(TurnedReach::delay_ms), delays(TurnedReach::delay_after_heading_ms));
        let heading = delays(|turn| Some(turn.headed_ms? as i64 - turn.turned_ms as i64));
        let answers: Vec<f64> =
            turned.iter().filter_map(|(action, turn)| answer_delay(action, turn)).collect();
        let valid = turned.iter().filter(|(action, _)| action.error.is_none()).count();
        Some(Self {
            inferred_before,
            decided_before: of_all(&|_, turn| turn.decided_before),
            followed_in_time: in_time(&delay, turned.len()),
            delay_ms: Spread::new(delay),
            followed_in_time_of_inferred: in_time(&of_inferred, inferred_before.count),
            delay_of_inferred_ms: Spread::new(of_inferred),
            never_followed: of_all(&|_, turn| turn.followed_ms.is_none()),
            wrong: of_all(&|action, _| action.inference == Some(Inference::Wrong)),
            followed_heading_in_time: in_time(&after_heading, heading.len()),
            heading_ms: Spread::new(heading),
            delay_after_heading_ms: Spread::new(after_heading),
            answered_in_time: in_time(&answers, valid),
            answer_delay_ms: Spread::new(answers),
        })
    }
}

/// From the turn until the complementary action was decided, ms; none without a right one.
fn answer_delay(action: &PartnerAction, turn: &TurnedReach) -> Option<f64> {
    let decided = action.grasp_ms? as i64 - action.lead_ms?;
    Some((decided - turn.turned_ms as i64).max(0) as f64)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;

    /// A reach that turned at 1000 ms, headed at 1100 ms and grasped at 1600 ms.
    fn action(followed_ms: Option<u64>, inference: Inference, lead_ms: Option<i64>) -> PartnerAction {
        let turn = TurnedReach {
            turned_ms: 1000,
            headed_ms: Some(1100),
            chain_before: "insert: nut".into(),
            subgoal_before: "nut".into(),
            inferred_before: true,
            decided_before: false,
            followed_ms,
        };
        PartnerAction {
            number: 1,
            chain: "insert: wheel".into(),
            subgoal: "wheel".into(),
            error: None,
            hidden: false,
            left_hand: false,
            hidden_goals: None,
            onset_ms: 800,
            grasp_ms: Some(1600),
            inferred: None,
            inference: Some(inference),
            first_inferred: None,
            first_inference: Some(inference),
            nearest_deg: None,
            lead_ms,
            decided: None,
            answered: lead_ms.is_some(),
            detected_ms: None,
            detection: None,
            fields: Vec::new(),
            turn: Some(turn),
            hesitation: None,
            earlier_reaches: 0,
        }
    }

    #[test]
    fn who_follows_late_or_never_does_not_count_as_in_time() {
        let actions = [
            action(Some(1150), Inference::Right, Some(700)),
            action(Some(1151), Inference::Right, Some(400)),
            action(Some(1251), Inference::Right, None),
            action(None, Inference::Wrong, None),
        ];
        let straight = PartnerAction { turn: None, ..actions[0].clone() };
        let broken_off = PartnerAction { grasp_ms: None, ..actions[0].clone() };
        let counts = ChangesOfMind::new(actions.iter().chain([&straight, &broken_off])).unwrap();
        let of_four = |proportion: Proportion| {
            assert_eq!(proportion.of, 4);
            proportion.count
        };
        assert_eq!(of_four(counts.inferred_before), 4);
        assert_eq!(of_four(counts.decided_before), 0);
        assert_eq!(of_four(counts.followed_in_time), 1);
        assert_eq!(of_four(counts.never_followed), 1);
        assert_eq!(of_four(counts.wrong), 1);
        assert_eq!(of_four(counts.followed_heading_in_time), 2);
        assert_eq!(of_four(counts.answered_in_time), 1);
        assert_eq!(counts.delay_ms.unwrap().p95, 251.0);
        assert_eq!(counts.heading_ms.unwrap().p50, 100.0);
        // What was decided before the turn needs not follow it.
        assert_eq!(counts.answer_delay_ms.unwrap(), Spread { p5: 0.0, p50: 0.0, p95: 200.0 });
        assert_eq!(ChangesOfMind::new([straight].iter()), None);
    }
}

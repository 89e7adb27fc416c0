//! Which of the person's hands is the one that acts.

use crate::acts::Acts;
use crate::objects::TaskPlaces;
use crate::occlusion::{has_vanished, leads_behind};
use crate::perception_state::PerceptionState;
use coact_messages::{Percept, SensorSample};

/// Takes in the newest frames of both hands, and turns to the other one when that sets out while the one that acts is free. `None`: there is
/// no new frame of the one that acts; true: a movement of it has begun with this frame.
///
/// One hand acts at a time: what the other does while this one reaches, holds or shows something is followed, and told of where it is
/// ([`Percept::arms`]), but not understood.
pub(crate) fn attend(
    tick: u64,
    sample: &SensorSample,
    acts: &Acts,
    places: &TaskPlaces,
    percept: &Percept,
    state: &mut PerceptionState,
) -> Option<bool> {
    let scene = &sample.scene;
    let acting = state.acting();
    let view = |side| &sample.hands[side as usize];
    let own = state.hand.observe(tick, view(acting), |hand| leads_behind(scene, hand, places));
    let other = state.other.observe(tick, view(acting.other()), |hand| leads_behind(scene, hand, places));
    if let Some(onset) = other {
        state.other_path.observe(&state.other, onset);
    }
    if is_free(state)
        && !acts.are_shown(percept)
        && (sets_out(state)
            || sets_out_unseen(tick, sample, acts, places, state)
            || is_alone_to_act(tick, acts, state))
    {
        state.change_hands();
        return other;
    }
    let onset = own?;
    state.path.observe(&state.hand, onset);
    Some(onset)
}

/// Whether the hand that acts does nothing that is to be followed to its end.
fn is_free(state: &PerceptionState) -> bool {
    let movement = &state.hand.movement;
    let reaches = movement.is_moving() && state.preshape.reach.is_of(movement);
    !reaches && !state.occlusion.is_hidden() && !state.parts.is_any_with_the_person()
}

/// Whether the other hand moves, and has begun to since the one that acts did, if that does.
fn sets_out(state: &PerceptionState) -> bool {
    let (movement, other) = (&state.hand.movement, &state.other.movement);
    other.is_moving() && !(movement.is_moving() && movement.onset >= other.onset)
}

/// Whether the other hand is seen away from where it rests, while nothing is seen of the one that acts.
fn is_alone_to_act(tick: u64, acts: &Acts, state: &PerceptionState) -> bool {
    let wrist = state.other.shape().wrist;
    let away = state.other.is_followed(tick) && !acts.is_from_rest(state.acting().other(), wrist);
    away && !state.hand.is_tracked(tick)
}

/// Whether the other hand has gone out of sight as it set out, while the one that acts is seen at rest.
fn sets_out_unseen(
    tick: u64,
    sample: &SensorSample,
    acts: &Acts,
    places: &TaskPlaces,
    state: &PerceptionState,
) -> bool {
    let other = &state.other;
    let [view, other_view] =
        [state.acting(), state.acting().other()].map(|side| &sample.hands[side as usize]);
    let lay = acts.is_from_rest(state.acting().other(), other.movement.place_of_stillness());
    let rests = state.hand.is_followed(tick)
        && !has_vanished(tick, &state.hand, view)
        && !state.hand.movement.is_moving();
    lay && rests && has_vanished(tick, other, other_view) && leads_behind(&sample.scene, other, places)
}

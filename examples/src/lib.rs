//! A stage of one's own, for the examples: how fast the person's hand moves.
//!
//! [`HandSpeed`] is its message and, as with every stage, its whole state; [`HandSpeed::step`] is the stage. The example
//! `stage_in_lockstep` runs it beside coact's stages in one process, `stage_as_process` as a process of a running set.
//!
//! ```
//! use coact_examples::HandSpeed;
//! use coact_messages::Percept;
//!
//! let mut percept: Box<Percept> = bytemuck::zeroed_box();
//! percept.arms[0].tracked = 1;
//! percept.arms[0].wrist.velocity = [0.3, 0.0, 0.4];
//! let (mut previous, mut speed): (HandSpeed, HandSpeed) = Default::default();
//! for _ in 0..500 {
//!     speed.step(Some(&percept), &previous);
//!     previous = speed;
//! }
//! assert!((speed.now - 0.5).abs() < 1e-3);
//! ```

mod hand_speed;

pub use hand_speed::HandSpeed;

//! The state of a stage as words of its own message.
//!
//! A stage keeps nothing that its last message does not hold, so that its replacement can resume from that message.
//! What no other field of the message says stands in opaque words behind them: the stage's state. This crate is the one
//! place where such words are written and read:
//!
//! - A state is a `repr(C)` struct of numbers, enums ([`repr(u64)`](bytemuck::CheckedBitPattern)), [`Flag`]s, [`Slot`]s
//!   and further such structs. It derives `CheckedBitPattern` and `NoUninit` (or `Pod`, if it holds no enum and no
//!   flag), so its layout is fixed and has no gaps.
//! - [`StageState::store`] writes it behind a mark, which names the stage and the layout of its state.
//! - [`StageState::load`] refuses words with another mark, words that are no value of an enum or a flag, and numbers that
//!   [`StageState::check`] finds implausible; the error says which. A checksum behind the state tells what else was changed.
//!   What was loaded needs no further checks.
//!
//! ```
//! use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
//! use coact_stage_state::{Flag, Implausible, Slot, StageState, finite};
//!
//! #[repr(u64)]
//! #[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
//! enum Phase {
//!     Idle = 0,
//!     Move = 1,
//! }
//!
//! #[repr(C)]
//! #[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
//! struct DoorState {
//!     phase: Phase,
//!     locked: Flag,
//!     /// Who opened it last, if anybody did.
//!     opened_by: Slot,
//!     angle: f64,
//! }
//!
//! impl StageState for DoorState {
//!     const STAGE: &'static str = "door";
//!     const LAYOUT: u32 = 1;
//!
//!     fn check(&self) -> Result<(), Implausible> {
//!         finite("angle", &[self.angle])
//!     }
//! }
//!
//! let mut message = [0.0; 16];
//! let state = DoorState { phase: Phase::Move, opened_by: Slot::of(2), angle: 0.3, ..DoorState::zeroed() };
//! state.store(&mut message);
//! assert_eq!(DoorState::load(&message)?, state);
//!
//! // A message that no door has sent, and one that was damaged on its way.
//! assert!(DoorState::load(&[0.0; 16]).is_err());
//! message[4] = f64::NAN;
//! let refused = DoorState::load(&message).unwrap_err().to_string();
//! assert!(refused.contains("angle"), "{refused}");
//! # Ok::<(), coact_stage_state::StateError>(())
//! ```
//!
//! How the stages use it: control's `ControlState` stands in `Command`, world's in `WorldState`, perception's in
//! `Percept`. Each stage works on its own copy, stores it in every message that it sends, and loads it when it resumes. A
//! stage whose state is refused starts as if it had no predecessor.
//!
//! An enum with fields works as well, if all its variants have the same size: [`Blank`] fills up the shorter ones.

mod blank;
mod flag;
mod slot;
mod stage_state;
mod state_error;

pub use blank::Blank;
pub use flag::Flag;
pub use slot::Slot;
pub use stage_state::{StageState, bounded, checksum, ensure, finite, seal_words};
pub use state_error::{Implausible, StateError};

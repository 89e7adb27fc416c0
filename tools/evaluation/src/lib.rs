//! Whole assemblies with random partners, in lockstep and in parallel: how often and how soon the robot understood, what
//! it noticed of the person's errors, and how fluently the two worked; with intervals, and against other minds.
//!
//! A [`Trial`] is what one assembly was like. [`run`] makes many of them, a [`Report`] counts them, and a
//! [`Comparison`] sets two minds side by side that met the same partners.

mod activity;
mod campaign;
mod comparison;
mod fluency;
mod mind;
mod observer;
mod plots;
mod report;
mod statistics;
mod trial;

pub use campaign::{Campaign, run};
pub use comparison::Comparison;
pub use fluency::Fluency;
pub use mind::{Ablation, Mind};
pub use plots::{PlotError, draw_fluency, draw_leads};
pub use report::{ErrorTally, Report};
pub use statistics::{Interval, Share, Spread};
pub use trial::{Alarm, Detection, DoublePeak, ErrorKind, Inference, PartnerAction, Trial};

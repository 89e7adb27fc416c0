//! Whole assemblies with random partners, in lockstep and in parallel: how often and how soon the robot understood, what
//! it noticed of the person's errors, and how fluently the two worked; with intervals, and against ablations.
//!
//! A [`Trial`] is what one assembly was like, or several of one person. [`run`] makes many of them, an [`EvaluationReport`] counts them, and a
//! [`Comparison`] sets two [`NetworkVariant`]s side by side that had the same partners.
//!
//! An [`Encounter`] is the working robot beside a recorded person's arm, to measure how near they come.

mod campaign;
mod changes_of_mind;
mod comparison;
mod encounter;
mod encounters;
mod evaluation_report;
mod first_goal;
mod fluency;
mod hesitant_reach;
mod hesitations;
mod hidden_goals;
mod known_people;
mod movement_times;
mod nearest_angle;
mod network_variant;
mod open_action;
mod parallel;
mod plots;
mod recorded_person;
mod skill_times;
mod statistics;
mod time_report;
mod trial;
mod trial_recorder;
mod turned_reach;

pub use campaign::{Campaign, run};
pub use changes_of_mind::ChangesOfMind;
pub use comparison::Comparison;
pub use encounter::Encounter;
pub use encounters::{Encounters, encounter};
pub use evaluation_report::{AngleCounts, ErrorCounts, EvaluationReport};
pub use fluency::Fluency;
pub use hesitant_reach::HesitantReach;
pub use hesitations::Hesitations;
pub use known_people::KnownPeople;
pub use movement_times::MovementTime;
pub use network_variant::{Ablation, NetworkVariant};
pub use plots::{draw_fluency, draw_leads, draw_timeline};
pub use recorded_person::RecordedPerson;
pub use skill_times::{SkillKind, SkillTime};
pub use statistics::{Estimate, Proportion, Spread};
pub use time_report::{OccupationTime, SkillDuration, TimeReport};
pub use trial::{Alarm, Detection, DoublePeak, ErrorKind, Inference, PartnerAction, Trial};
pub use turned_reach::TurnedReach;

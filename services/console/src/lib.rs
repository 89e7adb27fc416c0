//! A run in the browser: what the robot sees and thinks, why, and what the machine does; and a hand for whoever sits there.
//!
//! ```text
//! messages of all stages --> PictureMaker, Timeline, Machine --> Board --> Server --> pages
//! pages --> PointerHand --> coact/hand,  coact/heard;   operators --> supervisor
//! ```
//!
//! The console is no part of what the robot does: it is an ordinary process off the chain's core, reads what others say, and a run
//! goes on without it. What a page sends is a place on the table, a button, a sentence: neither a part nor an intention.
//!
//! A page loads its files and opens a WebSocket, `/live?token=...`. The server tells it events, durations and explanations as JSON
//! ([`Greeting`] is the first), and pictures as [`Picture`]s; what it asks for is a [`Request`].

mod assets;
mod board;
mod cadence;
mod console_settings;
mod glimpse;
mod greeting;
mod history;
mod live_topics;
mod machine;
mod message_rate;
mod numbers;
mod picture;
mod picture_maker;
mod pointer;
mod pointer_hand;
mod recorded_run;
mod report;
mod request;
mod seen;
mod server;
mod session;
mod supervisor_link;
mod surroundings;
mod ticket;
mod timeline;
mod why;
mod wish;

pub use board::Board;
pub use cadence::Cadence;
pub use console_settings::{ConsoleSettings, SettingsError};
pub use glimpse::Glimpse;
pub use greeting::Greeting;
pub use history::History;
pub use live_topics::LiveTopics;
pub use machine::Machine;
pub use picture::Picture;
pub use picture_maker::PictureMaker;
pub use pointer::Pointer;
pub use pointer_hand::PointerHand;
pub use recorded_run::RecordedRun;
pub use report::report;
pub use request::Request;
pub use seen::Seen;
pub use server::Server;
pub use supervisor_link::SupervisorLink;
pub use surroundings::{Socket, Surroundings, Thing};
pub use ticket::Ticket;
pub use timeline::Timeline;
pub use wish::Wish;

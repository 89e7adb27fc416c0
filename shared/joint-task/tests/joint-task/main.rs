//! Task files: the shipped ones, and what is refused.

mod any_text;
mod check;
mod mistakes;
mod shipped_tasks;

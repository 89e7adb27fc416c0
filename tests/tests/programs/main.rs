//! What the programs say and refuse, and what the documents name: nothing here needs the machine for itself.

mod bad_input;
mod documents;
mod help;

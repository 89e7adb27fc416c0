//! Runs, and the table of their processes.

mod run;
mod table;

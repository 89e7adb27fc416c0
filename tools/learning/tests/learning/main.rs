//! What is learned from demonstrations, and how it is written.

mod demonstrations;
mod serial_order;
mod task_text;

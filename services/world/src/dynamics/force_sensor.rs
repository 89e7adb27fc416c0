use super::contacts::Contacts;
use coact_period::cycles;
use std::time::Duration;

/// Steps over which forces are averaged: 30 ms, the time constant of real force sensors with their filters.
const STEPS: usize = cycles(Duration::from_millis(30)) as usize;

/// Force sensors of finger tips and wrist: the mean of the last steps.
///
/// The solver's contact forces alternate between nothing and twice their mean from step to step.
#[derive(Debug, Clone)]
pub(super) struct ForceSensor {
    steps: Box<[Contacts; STEPS]>,
    next: usize,
}

impl ForceSensor {
    pub fn new() -> Self {
        Self { steps: Box::new([Contacts::NONE; STEPS]), next: 0 }
    }

    /// Takes in one step.
    pub fn feel(&mut self, contacts: Contacts) {
        self.steps[self.next] = contacts;
        self.next = (self.next + 1) % STEPS;
    }

    /// What it reads.
    pub fn read(&self) -> Contacts {
        let mut mean = Contacts::NONE;
        for step in self.steps.iter() {
            mean.outside += step.outside / STEPS as f64;
            let fingers = mean.pushes.iter_mut().flatten().zip(step.pushes.iter().flatten());
            fingers.for_each(|(mean, push)| *mean += *push / STEPS as f64);
        }
        mean
    }
}

use coact_messages::{StopState, topic};
use coact_period::cycles;
use coact_realtime::{Bus, Input, PortError};
use std::time::Duration;

/// Whether the robot must stand, as the supervisor says it again and again.
pub struct StopInput {
    state: Input<StopState>,
    /// So many cycles ago is too long ago.
    unheard: u64,
}

impl StopInput {
    /// Begins to listen; without hearing anything `unheard_after` this time, the robot must stand.
    ///
    /// # Errors
    /// The topic cannot be joined.
    pub fn open(bus: &Bus, unheard_after: Duration) -> Result<Self, PortError> {
        Ok(Self { state: bus.input(topic::STOP)?, unheard: cycles(unheard_after) })
    }

    /// Whether it must stand in this cycle: somebody says so, or nobody says that it need not.
    ///
    /// # Errors
    /// The port fails.
    pub fn stops(&mut self, cycle: u64) -> Result<bool, PortError> {
        self.state.refresh()?;
        let heard =
            self.state.latest().filter(|state| cycle.saturating_sub(state.header.cycle) <= self.unheard);
        Ok(heard.is_none_or(|state| state.stopped != 0))
    }
}

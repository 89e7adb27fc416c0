//! Amari fields: the mathematics of one layer of a dynamic neural field architecture, and nothing else.
//!
//! A [`Field`] is a row of sites that represents several populations side by side. Its activity obeys the chapter's
//! equation 1, with the kernel of equation 2 and the threshold function of equation 3; [`Field::spread`] makes the
//! Gaussian input of equation 4, and [`forget`] moves a resting level, so that memories can be given up.
//! The crate knows no task, no process and no clock: the caller owns all activity, and steps it from one buffer
//! into another.
//!
//! ```
//! use coact_neural_field::{Field, Kernel, Parameters};
//!
//! let kernel = Kernel { amplitude: 3.0, sigma: 2.0, inhibition: 0.6, range: None };
//! let mut field = Field::new(
//!     Parameters { tau: 20.0, slope: 5.0, threshold: 0.0, spacing: 0.5, input_sigma: 2.0, kernel },
//!     4,  // populations
//!     32, // sites of each
//! )?;
//! let (mut now, mut next) = (vec![-2.0; field.sites()], vec![0.0; field.sites()]);
//! let mut input = vec![0.0; field.sites()];
//! for step in 0..300 {
//!     // A transient input to the second population ...
//!     field.spread(&[0.0, if step < 100 { 4.0 } else { 0.0 }, 0.0, 0.0], &mut input);
//!     field.step(1.0, &now, &input, &[-2.0; 4], &mut next);
//!     std::mem::swap(&mut now, &mut next);
//! }
//! // ... leaves a peak that sustains itself.
//! let mut signal = [0.0; 4];
//! field.signals(&now, &mut signal);
//! assert!(signal[1] > 0.9 && signal[0] == 0.0);
//! # Ok::<(), coact_neural_field::ParameterError>(())
//! ```

mod existence;
mod field;
mod forgetting;
mod kernel;
mod parameters;
mod sigmoid;

pub use existence::Existence;
pub use field::Field;
pub use forgetting::{Forgetting, forget};
pub use kernel::Kernel;
pub use parameters::{ParameterError, Parameters};
pub use sigmoid::sigmoid;

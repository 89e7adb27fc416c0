//! Amari fields: the mathematics of one layer of a dynamic neural field architecture, and nothing else.
//!
//! A [`Field`] is a row of sites that represents several populations side by side. Its activity obeys the chapter's
//! equation 1, with the kernel of equation 2 and the sigmoid of equation 3; [`Field::spread`] makes the
//! Gaussian input of equation 4, and [`forget`] moves a resting level, so that memories can be given up.
//! A [`MetricField`] has places instead of populations: one to three continuous dimensions on a [`Lattice`], with an [`Interaction`] of any
//! form. A [`Projection`] carries one field's output into another one's input, and a [`MemoryTrace`] remembers where peaks stood.
//! The crate knows no task, no process and no clock: the caller owns all activity, and steps it from one buffer
//! into another.
//!
//! A field that decides between two inputs: the stronger one makes a peak, which suppresses the other
//! population and stays when the two inputs have become weak and equal.
//!
//! ```
//! use coact_neural_field::{Field, Kernel, Parameters};
//!
//! // Excitation among near sites, inhibition of all: one peak stands. tau is in the unit of the step, here ms.
//! let kernel = Kernel { amplitude: 3.0, sigma: 2.0, inhibition: 1.5, range: None };
//! let constants =
//!     Parameters { tau: 20.0, slope: 5.0, threshold: 0.0, spacing: 1.0, input_sigma: 2.0, kernel };
//! let (populations, sites_of_each, resting_level) = (2, 10, -3.0);
//! let mut field = Field::new(constants, populations, sites_of_each)?;
//!
//! let mut now = vec![resting_level; field.sites()];
//! let (mut next, mut input) = (now.clone(), vec![0.0; field.sites()]);
//! for millisecond in 0..500 {
//!     // For 0.2 s the first is driven by a third more than the second; then both alike, too weakly to ignite anything.
//!     let strength = if millisecond < 200 { [4.0, 3.0] } else { [1.1, 1.1] };
//!     field.spread(&strength, &mut input);
//!     field.step(1.0, &now, &input, &[resting_level; 2], &mut next);
//!     std::mem::swap(&mut now, &mut next);
//! }
//!
//! let mut signal = [0.0; 2];
//! field.signals(&now, &mut signal);
//! assert!(signal[0] > 0.9, "the first has won, and stands");
//! assert_eq!(signal[1], 0.0, "the second is suppressed");
//! # Ok::<(), coact_neural_field::ParameterError>(())
//! ```

mod axis;
mod convolution;
mod existence;
mod field;
mod forgetting;
mod gaussian;
mod interaction;
mod kernel;
mod lattice;
mod memory_trace;
mod metric_constants;
mod metric_field;
mod parameters;
mod projection;
mod separable;
mod sigmoid;
mod taps;

pub use axis::Axis;
pub use existence::Existence;
pub use field::Field;
pub use forgetting::{Forgetting, forget};
pub use gaussian::Gaussian;
pub use interaction::Interaction;
pub use kernel::Kernel;
pub use lattice::Lattice;
pub use memory_trace::MemoryTrace;
pub use metric_constants::MetricConstants;
pub use metric_field::MetricField;
pub use parameters::{ParameterError, Parameters};
pub use projection::Projection;
pub use sigmoid::sigmoid;

//! Pictures that look the same on every machine, as SVG and as PNG.
//!
//! What is to be seen is put on a [`Sheet`] once; the two formats are made of it by plotters' backends. Letters in a PNG
//! are those of a font that is compiled in ([`Lettering`]).
//!
//! ```
//! use coact_drawing::{Anchor, DISTINCT, Lettering, Sheet};
//!
//! let mut sheet = Sheet::new(200);
//! sheet.path([[20, 40], [180, 40]], DISTINCT[0], 3);
//! sheet.text("from here to there", [100, 20], 14, Anchor::Middle);
//! sheet.height = 60;
//! assert!(sheet.svg()?.contains("from here to there"));
//! assert!(sheet.png(&Lettering::new()?)?.starts_with(b"\x89PNG"));
//! # Ok::<(), coact_drawing::DrawingError>(())
//! ```

mod colours;
mod drawing_error;
mod lettering;
mod sheet;

pub use colours::{DISTINCT, FAINT, diverging};
pub use drawing_error::DrawingError;
pub use lettering::Lettering;
pub use plotters::prelude::{BLACK, RGBColor};
pub use sheet::{Anchor, Mark, Place, Sheet, Text};

//! Pictures of an evaluation, as SVG.

mod fluency_plot;
mod lead_plot;
mod timeline_plot;

pub use fluency_plot::draw_fluency;
pub use lead_plot::draw_leads;
pub use timeline_plot::draw_timeline;

use plotters::prelude::RGBColor;

/// Pixels.
const SIZE: (u32, u32) = (900, 480);
/// Right answers in time; the first of two variants.
const BLUE: RGBColor = RGBColor(0x1f, 0x5f, 0xa8);
/// Answers that came too late; the second variant.
const ORANGE: RGBColor = RGBColor(0xd0, 0x6a, 0x1c);

use crate::DrawingError;
use ab_glyph::{Font, FontRef, PxScale, ScaleFont, point};

/// The font of the pictures: compiled in, so that a picture is the same on every machine.
#[derive(Clone)]
pub struct Lettering {
    font: FontRef<'static>,
}

impl Lettering {
    /// Names of the font, best first, for pictures that leave the lettering to their viewer.
    pub const FAMILY: &'static str = "Ubuntu, DejaVu Sans, sans-serif";

    /// Reads the font.
    ///
    /// # Errors
    /// The compiled-in font is no font.
    pub fn new() -> Result<Self, DrawingError> {
        let font = FontRef::try_from_slice(epaint_default_fonts::UBUNTU_LIGHT).map_err(DrawingError::new)?;
        Ok(Self { font })
    }

    /// Width of `text` when an em has `size` pixels.
    pub fn width(&self, text: &str, size: u32) -> i32 {
        let font = self.font.as_scaled(self.scale(size));
        let advance = |letter: char| font.h_advance(font.glyph_id(letter));
        text.chars().map(advance).sum::<f32>().ceil() as i32
    }

    /// Calls `put` with each pixel that `text` covers, from the start of its base line, and with the fraction of it that
    /// is covered.
    ///
    /// # Errors
    /// The first error of `put`.
    pub fn cover<E>(
        &self,
        text: &str,
        size: u32,
        mut put: impl FnMut(i32, i32, f32) -> Result<(), E>,
    ) -> Result<(), E> {
        let scale = self.scale(size);
        let font = self.font.as_scaled(scale);
        let mut x = 0.0;
        for letter in text.chars() {
            let id = font.glyph_id(letter);
            let glyph = id.with_scale_and_position(scale, point(x, 0.0));
            x += font.h_advance(id);
            let Some(outline) = font.outline_glyph(glyph) else { continue };
            let corner = outline.px_bounds().min;
            let mut pixels = Vec::new();
            outline.draw(|x, y, coverage| pixels.push((x as i32, y as i32, coverage)));
            for (x, y, coverage) in pixels {
                put(corner.x as i32 + x, corner.y as i32 + y, coverage.min(1.0))?;
            }
        }
        Ok(())
    }

    /// The font measures by the height of its lines, pictures by the em.
    fn scale(&self, size: u32) -> PxScale {
        let em = self.font.units_per_em().unwrap_or(1000.0);
        PxScale::from(size as f32 * self.font.height_unscaled() / em)
    }
}

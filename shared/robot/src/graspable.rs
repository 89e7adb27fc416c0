use std::f64::consts::FRAC_PI_2;

/// Something that a hand can grip, standing on its underside: what matters of its form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Graspable {
    /// How far the fingers close on it, m.
    pub width: f64,
    /// Height, m.
    pub height: f64,
    /// Its flat sides; none for something round, which can be gripped from everywhere.
    pub flat: Option<Flat>,
}

/// Flat sides of a [`Graspable`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flat {
    /// Extent across the direction in which the fingers close, m.
    pub length: f64,
    /// Turn of that direction from the form's own x about its z axis, rad.
    pub turn: f64,
}

impl Graspable {
    /// Something round: `width` m wide where the fingers close on it.
    pub fn round(width: f64, height: f64) -> Self {
        Self { width, height, flat: None }
    }

    /// A box, gripped across the side that is nearer to `width` m.
    pub fn brick([x, y, height]: [f64; 3], width: f64) -> Self {
        let across_y = (y - width).abs() < (x - width).abs();
        let (length, turn) = if across_y { (x, FRAC_PI_2) } else { (y, 0.0) };
        Self { width, height, flat: Some(Flat { length, turn }) }
    }

    /// Half its largest extent across its axis, m.
    pub fn half_width(&self) -> f64 {
        0.5 * self.flat.map_or(self.width, |flat| flat.length.hypot(self.width))
    }

    /// Half its extent across the direction in which the fingers close, m.
    pub(crate) fn half_length(&self) -> f64 {
        0.5 * self.flat.map_or(self.width, |flat| flat.length)
    }

    /// Distance from its sides, m, of a point of its section: `across` m from its middle in the direction in which the
    /// fingers close, `along` m across that direction. Negative within.
    pub(crate) fn distance(&self, across: f64, along: f64) -> f64 {
        let half = 0.5 * self.width;
        if self.flat.is_none() {
            return across.hypot(along) - half;
        }
        let (out, on) = (across.abs() - half, along.abs() - self.half_length());
        out.max(0.0).hypot(on.max(0.0)) + out.max(on).min(0.0)
    }
}

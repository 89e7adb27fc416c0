use crate::line_style::LineStyle;
use crate::page::{LETTERS, number};
use coact_drawing::{Anchor, BLACK, FAINT, Sheet};

/// FieldCurves of activity over field position.
#[derive(Debug, Clone)]
pub struct FieldCurves {
    /// What is shown.
    pub title: String,
    /// The curves: name, values at all sites, how they are drawn.
    pub curves: Vec<(String, Vec<f64>, LineStyle)>,
    /// Names of the populations side by side in the field.
    pub populations: Vec<String>,
}

impl FieldCurves {
    /// Draws them between two corners.
    pub fn draw(&self, sheet: &mut Sheet, [left, top]: [i32; 2], [right, bottom]: [i32; 2]) {
        sheet.text(&self.title, [left, top + 10], LETTERS + 2, Anchor::Start);
        let (top, bottom) = (top + 30, bottom - 36);
        let all = || self.curves.iter().flat_map(|(_, values, _)| values.iter().copied());
        let low = (all().fold(0.0, f64::min) - 0.3).floor();
        let high = (all().fold(0.0, f64::max) + 0.3).ceil();
        let y = |value: f64| bottom - ((value - low) / (high - low) * f64::from(bottom - top)).round() as i32;
        let step = if high - low > 12.0 { 4.0 } else { 2.0 };
        let mut tick = (low / step).ceil() * step;
        while tick <= high {
            sheet.path([[left - 6, y(tick)], [left, y(tick)]], BLACK, 1);
            sheet.text(number(tick), [left - 10, y(tick)], LETTERS - 2, Anchor::End);
            tick += step;
        }
        sheet.path([[left, y(0.0)], [right, y(0.0)]], FAINT, 1);
        sheet.text("threshold", [right + 8, y(0.0)], LETTERS - 3, Anchor::Start);
        let room = f64::from(right - left) / self.populations.len().max(1) as f64;
        for (index, name) in self.populations.iter().enumerate() {
            let x = |place: f64| left + (room * place).round() as i32;
            if index > 0 {
                sheet.path([[x(index as f64), top], [x(index as f64), bottom]], FAINT, 1);
            }
            sheet.text(name, [x(index as f64 + 0.5), bottom + 18], LETTERS - 1, Anchor::Middle);
        }
        for (_, values, stroke) in &self.curves {
            let x = |site: usize| {
                left + ((site as f64 + 0.5) / values.len() as f64 * f64::from(right - left)).round() as i32
            };
            let places: Vec<[i32; 2]> = values.iter().enumerate().map(|(site, &u)| [x(site), y(u)]).collect();
            stroke.draw(sheet, &places);
        }
        sheet.frame([left, top], [right, bottom], BLACK);
    }

    /// Draws the names of the curves from `at` on, one below the other.
    pub fn legend(&self, sheet: &mut Sheet, [x, y]: [i32; 2]) {
        for (index, (name, _, stroke)) in (0..).zip(&self.curves) {
            let y = y + 28 * index;
            stroke.draw(sheet, &[[x, y], [x + 70, y]]);
            sheet.text(name, [x + 82, y], LETTERS, Anchor::Start);
        }
    }
}

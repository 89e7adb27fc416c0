/// Curves over time.
pub(crate) struct Chart<'a> {
    /// What is shown, with its unit.
    pub title: &'a str,
    /// Names and values at equal steps of time.
    pub curves: Vec<(String, Vec<f64>)>,
    /// Time of the last value, s.
    pub duration: f64,
    /// Where a new segment begins, s.
    pub marks: Vec<f64>,
}

use coact_drawing::{Anchor, BLACK, DISTINCT, RGBColor, Sheet};

const FAINT: RGBColor = RGBColor(170, 170, 170);

impl Chart<'_> {
    /// Draws the chart between two corners.
    pub fn draw(&self, sheet: &mut Sheet, [left, top]: [i32; 2], [right, bottom]: [i32; 2]) {
        sheet.text(self.title, [left, top + 8], 18, Anchor::Start);
        let (left, right, top, bottom) = (left + 50, right - 90, top + 28, bottom - 30);
        let all = || self.curves.iter().flat_map(|(_, values)| values.iter().copied());
        let (low, high) = (all().fold(0.0, f64::min), all().fold(1e-6, f64::max));
        let step = step(high - low);
        let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
        let y = |value: f64| bottom - ((value - low) / (high - low) * f64::from(bottom - top)).round() as i32;
        let x = |t: f64| left + (t / self.duration * f64::from(right - left)).round() as i32;
        for tick in 0..=((high - low) / step).round() as i32 {
            let value = low + f64::from(tick) * step;
            sheet.path([[left, y(value)], [right, y(value)]], FAINT, 1);
            sheet.text(number(value), [left - 8, y(value)], 14, Anchor::End);
        }
        for mark in &self.marks {
            sheet.path([[x(*mark), top], [x(*mark), bottom]], FAINT, 2);
        }
        let seconds = self::step(self.duration);
        for tick in 0..=(self.duration / seconds).floor() as i32 {
            let t = f64::from(tick) * seconds;
            sheet.path([[x(t), bottom], [x(t), bottom + 5]], BLACK, 1);
            sheet.text(format!("{} s", number(t)), [x(t), bottom + 16], 14, Anchor::Middle);
        }
        for (index, (name, values)) in self.curves.iter().enumerate() {
            let colour = DISTINCT[index % DISTINCT.len()];
            let last = (values.len() - 1).max(1) as f64;
            let points = values.iter().enumerate();
            let places: Vec<_> =
                points.map(|(at, value)| [x(self.duration * at as f64 / last), y(*value)]).collect();
            sheet.path(places, colour, 2);
            if self.curves.len() > 1 {
                let at = top + 8 + 17 * index as i32;
                sheet.path([[right + 6, at], [right + 20, at]], colour, 3);
                sheet.text(name.as_str(), [right + 24, at], 14, Anchor::Start);
            }
        }
        sheet.frame([left, top], [right, bottom], BLACK);
    }
}

/// A round step that divides a range into four to ten.
fn step(range: f64) -> f64 {
    let power = 10f64.powf((range / 4.0).log10().floor());
    [5.0, 2.0, 1.0].map(|factor| factor * power).into_iter().find(|step| range / step >= 3.0).unwrap_or(power)
}

/// A number with the digits that it needs.
fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.replace('-', "\u{2212}") }
}

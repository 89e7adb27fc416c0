use crate::page::{LEFT, LETTERS, MARGIN, RIGHT, number};
use crate::{Quantity, Surface};
use coact_drawing::{Anchor, BLACK, FAINT, Sheet, diverging};
use coact_messages::LayerKind;

/// How far a value may depart from the first one of its rectangle of equal colour, as a fraction of the scale. Chosen by
/// hand: with less, noise breaks rectangles up and the file grows; with more, steps can be seen.
const TOLERANCE: f32 = 1.0 / 40.0;

/// Activity or input over field position (downwards) and time (to the right), one or more runs side by side.
#[derive(Debug, Clone)]
pub struct HeatMap {
    /// What it shows.
    pub title: String,
    /// One for each column of the page; all of the same populations.
    pub surfaces: Vec<Surface>,
    /// The values that have the strongest blue (below 0) and the strongest red (above 0); 0 is white.
    pub limits: [f32; 2],
    /// Values that the colour bar names, besides the ends.
    pub ticks: Vec<(f32, String)>,
}

/// From where to where a run's time reaches, pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Span {
    /// Where it begins.
    pub left: i32,
    /// Where it ends.
    pub right: i32,
}

impl HeatMap {
    /// A quantity of a layer; `ignition` is the input that ignites a population at rest, `resting` its resting level.
    pub fn of(
        letter: &str,
        layer: LayerKind,
        quantity: Quantity,
        surfaces: Vec<Surface>,
        (ignition, resting): (f32, f32),
    ) -> Self {
        let (what, least, ticks) = match quantity {
            Quantity::Input => ("input S(x, t)", [-1.0, ignition], vec![(ignition, "ignites".into())]),
            Quantity::Activity => ("activity u(x, t)", [resting, 1.0], Vec::new()),
        };
        let limits = surfaces.iter().map(Surface::extremes).fold(least, |[low, high], extremes| {
            [low.min(extremes[0].floor()), high.max(extremes[1].ceil())]
        });
        let title = format!("{letter}  {}: {what}", layer.name());
        Self { title: title.trim().to_owned(), surfaces, limits, ticks }
    }

    /// Draws it from `top` on, and returns where it ends.
    pub fn draw(&self, sheet: &mut Sheet, top: i32, spans: &[Span]) -> i32 {
        sheet.text(&self.title, [MARGIN, top + 12], LETTERS + 2, Anchor::Start);
        let top = top + 28;
        let Some(first) = self.surfaces.first() else { return top };
        let rows = first.labels.len() as i32;
        // Fewer populations have more room each.
        let site = match first.width() {
            ..=20 => 8,
            21..=180 => 3,
            _ => 2,
        };
        let row = site * first.sites as i32;
        let bottom = top + rows * row;
        for (surface, span) in self.surfaces.iter().zip(spans) {
            self.cells(sheet, surface, *span, (top, site));
            for index in 1..rows {
                let y = top + index * row;
                sheet.path([[span.left, y], [span.right, y]], FAINT, 1);
            }
            sheet.frame([span.left, top], [span.right, bottom], BLACK);
        }
        for (index, label) in (0..).zip(&first.labels) {
            sheet.text(label, [LEFT - 10, top + index * row + row / 2], LETTERS - 1, Anchor::End);
        }
        self.colour_bar(sheet, top, bottom);
        bottom.max(top + 90)
    }

    /// Place of a value on the scale, -1 to 1.
    fn shade(&self, value: f32) -> f32 {
        let [low, high] = self.limits;
        if value < 0.0 { -value / low } else { value / high }
    }

    fn cells(
        &self,
        sheet: &mut Sheet,
        surface: &Surface,
        Span { left, right }: Span,
        (top, site): (i32, i32),
    ) {
        let columns = right - left;
        let time = |x: i32| surface.start_ms + surface.duration_ms() * f64::from(x) / f64::from(columns);
        let samples: Vec<&[f32]> = (0..columns).map(|x| surface.at(time(x))).collect();
        for place in 0..surface.width() {
            let y = top + site * place as i32;
            let mut begin = 0;
            for x in 1..=columns {
                let value = samples[begin as usize][place];
                let same = samples
                    .get(x as usize)
                    .is_some_and(|sample| (self.shade(sample[place]) - self.shade(value)).abs() < TOLERANCE);
                if !same {
                    // One pixel more to the right and downwards: what comes next covers it, and no gap shows.
                    let (from, to) = ([left + begin, y], [left + x + 1, y + site + 1]);
                    sheet.block(from, [to[0].min(right), to[1]], diverging(self.shade(value)));
                    begin = x;
                }
            }
        }
    }

    fn colour_bar(&self, sheet: &mut Sheet, top: i32, bottom: i32) {
        let (left, right) = (RIGHT + 20, RIGHT + 38);
        let height = (bottom - top).clamp(90, 220);
        let y = |value: f32| top + ((1.0 - self.shade(value)) / 2.0 * height as f32).round() as i32;
        for step in 0..height {
            let value = 1.0 - 2.0 * step as f32 / (height - 1) as f32;
            sheet.block([left, top + step], [right, top + (step + 2).min(height)], diverging(value));
        }
        sheet.frame([left, top], [right, top + height], BLACK);
        let [low, high] = self.limits.map(|limit| (limit, number(f64::from(limit))));
        let ends = [high, (0.0, "0".into()), low];
        let apart = |end: &&(f32, String)| self.ticks.iter().all(|tick| (y(tick.0) - y(end.0)).abs() > 14);
        for (value, label) in ends.iter().filter(apart).chain(&self.ticks) {
            sheet.path([[right, y(*value)], [right + 5, y(*value)]], BLACK, 1);
            sheet.text(label, [right + 9, y(*value)], LETTERS - 3, Anchor::Start);
        }
    }
}

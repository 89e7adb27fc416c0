use crate::heat_map::{HeatMap, Span};
use crate::page::{Caption, LEFT, LETTERS, MARGIN, RIGHT, axis, rows};
use crate::{Interval, RunTrace};
use coact_drawing::{Anchor, BLACK, DISTINCT, Lettering, Mark, RGBColor, Sheet};

/// Room between two runs, pixels.
const GAP: i32 = 24;
/// What is marked below the maps, and its colour.
const EVENTS: [(&str, RGBColor); 2] =
    [("hand closed, or gesture shown", DISTINCT[1]), ("part in its place", DISTINCT[2])];

/// Layers of one or more runs over time: heat maps one above the other, intervals marked across all of them.
#[derive(Debug, Clone)]
pub struct LayerPage {
    /// Of the figure.
    pub caption: Caption,
    /// The runs, side by side.
    pub columns: Vec<Column>,
    /// From top to bottom.
    pub maps: Vec<HeatMap>,
}

/// The time axis of a run.
#[derive(Debug, Clone)]
pub struct Column {
    /// Begin, ms.
    pub from_ms: f64,
    /// End, ms.
    pub to_ms: f64,
    intervals: Vec<Interval>,
    end_label: String,
    events_ms: [Vec<f64>; 2],
}

impl Column {
    /// The time of a run between two instants.
    pub fn of(trace: &RunTrace, from_ms: f64, to_ms: f64) -> Self {
        let inside = |ms: &f64| (from_ms..to_ms).contains(ms);
        let within = |times: &[f64]| times.iter().copied().filter(inside).collect();
        let next = trace.scenario.first_interval() + trace.intervals.len();
        Self {
            from_ms,
            to_ms,
            intervals: trace.intervals.iter().filter(|interval| inside(&interval.from_ms)).cloned().collect(),
            end_label: if to_ms >= trace.end_ms() { format!("T{next}") } else { String::new() },
            events_ms: [within(&trace.grasps_ms), within(&trace.achievements_ms)],
        }
    }

    /// A time axis with these intervals.
    pub fn marked(from_ms: f64, to_ms: f64, intervals: Vec<Interval>) -> Self {
        Self { from_ms, to_ms, intervals, end_label: String::new(), events_ms: Default::default() }
    }

    fn x(&self, Span { left, right }: Span, ms: f64) -> i32 {
        left + ((ms - self.from_ms) / (self.to_ms - self.from_ms) * f64::from(right - left)).round() as i32
    }
}

impl LayerPage {
    /// The picture.
    pub fn draw(&self, letters: &Lettering) -> Sheet {
        let (mut sheet, y) = self.caption.sheet(letters);
        let spans = self.spans();
        let marks = y + 10;
        let y = marks + self.name_intervals(&mut sheet, marks, &spans, letters) * (LETTERS as i32 + 6);
        let mut bottom = y;
        for map in &self.maps {
            bottom = map.draw(&mut sheet, bottom + 6, &spans) + 8;
        }
        for (column, span) in self.columns.iter().zip(&spans) {
            for interval in &column.intervals {
                let x = column.x(*span, interval.from_ms);
                sheet.path([[x, y - 6], [x, bottom]], BLACK, 1);
            }
            let (from, to) = (column.from_ms / 1000.0, column.to_ms / 1000.0);
            axis(&mut sheet, (span.left, span.right), bottom + 16, (from, to));
            for (times, (_, colour)) in column.events_ms.iter().zip(EVENTS) {
                for ms in times {
                    sheet.marks.push(Mark::Disc([column.x(*span, *ms), bottom + 6], 6, colour));
                }
            }
        }
        self.explain_events(&mut sheet, bottom + 8);
        sheet.text("time (s)", [(LEFT + RIGHT) / 2, bottom + 58], LETTERS, Anchor::Middle);
        sheet.height = (bottom + 58 + MARGIN) as u32;
        sheet
    }

    /// Says what the discs below the maps mean, if there are any.
    fn explain_events(&self, sheet: &mut Sheet, y: i32) {
        for (index, (meaning, colour)) in EVENTS.into_iter().enumerate() {
            if self.columns.iter().any(|column| !column.events_ms[index].is_empty()) {
                let at = [MARGIN + 8, y + 24 * index as i32];
                sheet.marks.push(Mark::Disc(at, 6, colour));
                sheet.text(meaning, [at[0] + 14, at[1]], LETTERS - 2, Anchor::Start);
            }
        }
    }

    /// Each run gets the same fraction of the width as it has of the time.
    fn spans(&self) -> Vec<Span> {
        let all: f64 = self.columns.iter().map(|column| column.to_ms - column.from_ms).sum();
        let room = f64::from(RIGHT - LEFT - GAP * (self.columns.len() as i32 - 1));
        let mut left = LEFT;
        let span = |column: &Column| {
            let right = left + ((column.to_ms - column.from_ms) / all * room).round() as i32;
            let span = Span { left, right };
            left = right + GAP;
            span
        };
        self.columns.iter().map(span).collect()
    }

    /// Writes what the person does above the maps, and returns how many rows it took.
    fn name_intervals(&self, sheet: &mut Sheet, y: i32, spans: &[Span], letters: &Lettering) -> i32 {
        let names = |(column, span): (&Column, &Span)| {
            let name = |interval: &Interval| {
                (column.x(*span, interval.from_ms), format!("{} {}", interval.name, interval.doing))
            };
            let mut names: Vec<_> = column.intervals.iter().map(name).collect();
            names.push((span.right, column.end_label.clone()));
            names
        };
        let names: Vec<_> = self.columns.iter().zip(spans).flat_map(names).collect();
        rows(sheet, &names, y, LETTERS, letters)
    }
}

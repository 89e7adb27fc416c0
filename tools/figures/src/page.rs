/// Width of every picture, pixels.
pub const WIDTH: i32 = 1500;
/// Left edge of what is drawn; the names of populations stand before it.
pub const LEFT: i32 = 400;
/// Right edge of what is drawn; the colour bar stands behind it.
pub const RIGHT: i32 = WIDTH - 120;
/// Room around everything.
pub const MARGIN: i32 = 24;
/// Ordinary letters, pixels of an em.
pub const LETTERS: u32 = 18;

use coact_drawing::{Anchor, BLACK, Lettering, Sheet};

/// What stands above every picture.
#[derive(Debug, Clone)]
pub struct Caption {
    /// Number in the chapter.
    pub number: u32,
    /// What it shows.
    pub title: String,
    /// Task, seed, script and what else must be known, one line each.
    pub notes: Vec<String>,
}

impl Caption {
    /// A sheet with this caption on it, and where the free room begins.
    pub fn sheet(&self, letters: &Lettering) -> (Sheet, i32) {
        let mut sheet = Sheet::new(WIDTH as u32);
        let mut y = MARGIN + 12;
        let title = format!("Figure {}: {}", self.number, self.title);
        let lines = lines(&title, 24, letters).into_iter().map(|line| (line, 24));
        let notes = self.notes.iter().flat_map(|note| self::lines(note, LETTERS, letters));
        for (line, size) in lines.chain(notes.map(|line| (line, LETTERS))) {
            sheet.text(line, [MARGIN, y], size, Anchor::Start);
            y += size as i32 + 8;
        }
        (sheet, y + 4)
    }
}

/// Breaks a text into lines that fit the width of a picture.
fn lines(text: &str, size: u32, letters: &Lettering) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let line = &lines[lines.len() - 1];
        let longer = if line.is_empty() { word.to_owned() } else { format!("{line} {word}") };
        if letters.width(&longer, size) <= WIDTH - 2 * MARGIN {
            lines.pop();
            lines.push(longer);
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

/// Draws an axis of numbers from `left` to `right` at height `y`, labels below it.
pub fn axis(sheet: &mut Sheet, (left, right): (i32, i32), y: i32, (from, to): (f64, f64)) {
    let most = f64::from(right - left) / 60.0;
    let step = [0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
    let step = step.into_iter().find(|step| (to - from) / step <= most).unwrap_or(200.0);
    let mut tick = (from / step).ceil();
    while tick * step <= to + 1e-9 {
        let fraction = (tick * step - from) / (to - from);
        let x = left + (fraction * f64::from(right - left)).round() as i32;
        sheet.path([[x, y], [x, y + 6]], BLACK, 1);
        // No minus before a zero.
        sheet.text(number(tick * step + 0.0), [x, y + 18], LETTERS - 2, Anchor::Middle);
        tick += 1.0;
    }
}

/// A number with the digits that it needs, two after the point at most.
pub fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.replace('-', "\u{2212}") }
}

/// Puts texts at `at` (from left to right) into as few rows as they need without touching each other, the first row at
/// height `y`, and returns how many rows those are.
pub fn rows(sheet: &mut Sheet, texts: &[(i32, String)], y: i32, size: u32, letters: &Lettering) -> i32 {
    let mut ends: Vec<i32> = Vec::new();
    for (x, text) in texts {
        let width = letters.width(text, size);
        // What begins near the right edge ends there.
        let x = (*x).min(WIDTH - MARGIN - width);
        let row = ends.iter().position(|end| *end < x).unwrap_or_else(|| {
            ends.push(0);
            ends.len() - 1
        });
        ends[row] = x + width + 10;
        let at = [x, y + row as i32 * (size as i32 + 6)];
        sheet.text(text, at, size, Anchor::Start);
    }
    ends.len() as i32
}

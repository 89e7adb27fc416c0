//! Curves in the terminal, drawn in braille: each character holds four rows of two dots.

use owo_colors::{AnsiColors, OwoColorize, Stream};

/// Size in characters, with the axes and their labels: for a terminal of 100 columns.
const COLUMNS: usize = 100;
const ROWS: usize = 16;
/// Of these the lowest two are the horizontal axis and its labels.
const CURVE_ROWS: usize = ROWS - 2;

/// Braille patterns begin with the empty one.
const BRAILLE: u32 = 0x2800;
/// The bit of each dot, by row and column.
const DOTS: [[u32; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];

/// Two axes, with what is drawn between them.
#[derive(Debug)]
pub(super) struct Chart {
    /// Rows from above, columns from the left.
    cells: Vec<Vec<Cell>>,
    /// Column of the vertical axis.
    axis: usize,
}

#[derive(Debug, Clone, Copy)]
struct Cell {
    symbol: char,
    colour: Option<AnsiColors>,
}

impl Chart {
    /// Axes with these labels, evenly spread: from left to right, and from below upwards.
    pub fn new(right: &[String], upwards: &[String]) -> Self {
        let axis = upwards.iter().map(|label| label.chars().count()).max().unwrap_or(0);
        let mut chart = Self { cells: vec![vec![Cell { symbol: ' ', colour: None }; COLUMNS]; ROWS], axis };
        chart.cells[..CURVE_ROWS].iter_mut().for_each(|row| row[axis].symbol = '│');
        chart.cells[CURVE_ROWS][axis].symbol = '└';
        chart.cells[CURVE_ROWS][axis + 1..].iter_mut().for_each(|cell| cell.symbol = '─');
        for (index, label) in upwards.iter().enumerate() {
            let row = spread(index, upwards.len(), CURVE_ROWS);
            chart.write(CURVE_ROWS - 1 - row, axis - label.chars().count(), label, None);
        }
        for (index, label) in right.iter().enumerate() {
            let (column, width) =
                (axis + 1 + spread(index, right.len(), COLUMNS - axis - 1), label.chars().count());
            let left = column.saturating_sub(width / 2).clamp(axis + 1, COLUMNS - width);
            chart.write(ROWS - 1, left, label, None);
        }
        chart
    }

    /// A line through `points`, in fractions of the axes.
    pub fn curve(&mut self, points: &[(f64, f64)], colour: AnsiColors) {
        let dots = |fraction: f64, count: usize| fraction.clamp(0.0, 1.0) * (count - 1) as f64;
        let (width, height) = (2 * (COLUMNS - self.axis - 1), 4 * CURVE_ROWS);
        let points: Vec<_> = points.iter().map(|&(x, y)| (dots(x, width), dots(1.0 - y, height))).collect();
        for pair in points.windows(2) {
            let ((x, y), (to_x, to_y)) = (pair[0], pair[1]);
            let steps = (to_x - x).abs().max((to_y - y).abs()).ceil().max(1.0);
            for step in 0..=steps as usize {
                let fraction = step as f64 / steps;
                let (x, y) = (x + fraction * (to_x - x), y + fraction * (to_y - y));
                self.dot(x.round() as usize, y.round() as usize, colour);
            }
        }
    }

    /// The names of the curves, in the upper left, where a rising curve leaves room.
    pub fn legend<'a>(&mut self, names: impl Iterator<Item = (&'a str, AnsiColors)>) {
        for (row, (name, colour)) in names.filter(|(name, _)| !name.is_empty()).take(CURVE_ROWS).enumerate() {
            self.write(row, self.axis + 2, name, Some(colour));
        }
    }

    /// Lines of text, in colour where standard output shows it.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for row in &self.cells {
            let blank = |cell: &Cell| matches!(cell.symbol, ' ');
            let end = row.iter().rposition(|cell| !blank(cell)).map_or(0, |last| last + 1);
            for cell in &row[..end] {
                match cell.colour {
                    None => text.push(cell.symbol),
                    Some(colour) => {
                        let symbol =
                            cell.symbol.if_supports_color(Stream::Stdout, |symbol| symbol.color(colour));
                        text.push_str(&symbol.to_string());
                    }
                }
            }
            text.push('\n');
        }
        text
    }

    fn write(&mut self, row: usize, column: usize, text: &str, colour: Option<AnsiColors>) {
        let cells = self.cells[row][column..].iter_mut();
        cells.zip(text.chars()).for_each(|(cell, symbol)| *cell = Cell { symbol, colour });
    }

    fn dot(&mut self, x: usize, y: usize, colour: AnsiColors) {
        let cell = &mut self.cells[y / 4][self.axis + 1 + x / 2];
        let others = (cell.symbol as u32).checked_sub(BRAILLE).filter(|dots| *dots <= 0xFF).unwrap_or(0);
        let symbol = char::from_u32(BRAILLE | others | DOTS[y % 4][x % 2]).unwrap_or(' ');
        *cell = Cell { symbol, colour: Some(colour) };
    }
}

/// Where the `index`-th of `count` is, evenly spread over `places`.
fn spread(index: usize, count: usize, places: usize) -> usize {
    (index * (places - 1)).checked_div(count - 1).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn drawn(points: &[(f64, f64)]) -> Vec<String> {
        let mut chart = Chart::new(&["0 %".into(), "90 %".into()], &["1 µs".into(), "10 µs".into()]);
        chart.curve(points, AnsiColors::Cyan);
        chart.text().lines().map(str::to_owned).collect()
    }

    #[test]
    fn a_rising_line_goes_from_corner_to_corner() {
        let lines = drawn(&[(0.0, 0.0), (1.0, 1.0)]);
        assert_eq!(lines.len(), ROWS);
        assert!(lines[0].starts_with("10 µs│") && lines[0].ends_with('⠉'), "{lines:#?}");
        assert!(lines[CURVE_ROWS - 1].starts_with(" 1 µs│⣀"), "{lines:#?}");
        assert!(lines[CURVE_ROWS..].concat().contains("90 %"));
        let wide = lines.iter().map(|line| line.chars().count()).max();
        assert_eq!(wide, Some(COLUMNS));
    }

    #[test]
    fn lines_that_cross_share_the_character() {
        let lines = drawn(&[(0.0, 0.0), (0.0, 1.0), (0.005, 1.0), (0.005, 0.0)]);
        assert!(lines[..CURVE_ROWS].iter().all(|line| line.chars().nth(6) == Some('⣿')), "{lines:#?}");
    }

    #[test]
    fn what_lies_outside_is_drawn_at_the_border() {
        assert_eq!(drawn(&[(-1.0, 0.5), (2.0, 0.5)]), drawn(&[(0.0, 0.5), (1.0, 0.5)]));
    }
}

use coact_drawing::{RGBColor, Sheet};

/// Colour and dashes of a curve.
#[derive(Debug, Clone, Copy)]
pub struct LineStyle {
    /// Its colour.
    pub colour: RGBColor,
    /// Pixels drawn and left out in turn; empty for a solid line.
    pub dashes: &'static [f64],
}

impl LineStyle {
    /// Draws a line through these places.
    pub fn draw(self, sheet: &mut Sheet, places: &[[i32; 2]]) {
        if self.dashes.is_empty() {
            sheet.path(places, self.colour, 3);
            return;
        }
        let (mut dash, mut rest, mut piece) = (0, self.dashes[0], Vec::new());
        for pair in places.windows(2) {
            let [from, to] = [pair[0], pair[1]].map(|place| place.map(f64::from));
            let length = (to[0] - from[0]).hypot(to[1] - from[1]);
            let point =
                |along: f64| [0, 1].map(|i| (from[i] + (to[i] - from[i]) * along / length).round() as i32);
            let mut done = 0.0;
            piece.push(pair[0]);
            while done + rest < length {
                done += rest;
                piece.push(point(done));
                self.draw_piece(sheet, dash, &mut piece);
                dash = (dash + 1) % self.dashes.len();
                rest = self.dashes[dash];
                piece.push(point(done));
            }
            rest -= length - done;
        }
        piece.extend(places.last());
        self.draw_piece(sheet, dash, &mut piece);
    }

    /// Draws a piece if it is one of those that are drawn.
    fn draw_piece(self, sheet: &mut Sheet, dash: usize, piece: &mut Vec<[i32; 2]>) {
        piece.dedup();
        let drawn = std::mem::take(piece);
        if dash.is_multiple_of(2) && drawn.len() > 1 {
            sheet.path(drawn, self.colour, 3);
        }
    }
}

use crate::{DrawingError, Lettering};
use plotters::prelude::{BLACK, BitMapBackend, Color, DrawingBackend, IntoFont, RGBColor, SVGBackend, WHITE};
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// A place on a sheet, pixels from its upper left corner.
pub type Place = [i32; 2];

/// A picture: what is on it, in the order in which it is painted. It becomes an SVG or a PNG.
#[derive(Debug, Clone)]
pub struct Sheet {
    /// Width, pixels.
    pub width: u32,
    /// Height, pixels.
    pub height: u32,
    /// What is on it.
    pub marks: Vec<Mark>,
}

/// One thing on a sheet.
#[derive(Debug, Clone)]
pub enum Mark {
    /// A filled rectangle between two corners.
    Block(Place, Place, RGBColor),
    /// A line through places, and how wide it is.
    Path(Vec<Place>, RGBColor, u32),
    /// A filled area within places.
    Area(Vec<Place>, RGBColor),
    /// A disc of a radius.
    Disc(Place, u32, RGBColor),
    /// A line of text.
    Text(Text),
}

/// A line of text.
#[derive(Debug, Clone)]
pub struct Text {
    /// Half way up its letters.
    pub at: Place,
    /// What it says.
    pub text: String,
    /// Pixels of an em.
    pub size: u32,
    /// Which part of it stands at its place.
    pub anchor: Anchor,
}

/// Which part of a text stands at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Anchor {
    Start,
    Middle,
    End,
}

impl Sheet {
    /// An empty sheet of this width; its height is known when all is on it.
    pub fn new(width: u32) -> Self {
        Self { width, height: 0, marks: Vec::new() }
    }

    /// Puts a filled rectangle on it.
    pub fn block(&mut self, from: Place, to: Place, colour: RGBColor) {
        self.marks.push(Mark::Block(from, to, colour));
    }

    /// Puts a line on it.
    pub fn path(&mut self, places: impl Into<Vec<Place>>, colour: RGBColor, width: u32) {
        self.marks.push(Mark::Path(places.into(), colour, width));
    }

    /// Puts a filled area on it.
    pub fn area(&mut self, places: impl Into<Vec<Place>>, colour: RGBColor) {
        self.marks.push(Mark::Area(places.into(), colour));
    }

    /// Puts the outline of a rectangle on it.
    pub fn frame(&mut self, [left, top]: Place, [right, bottom]: Place, colour: RGBColor) {
        self.path([[left, top], [right, top], [right, bottom], [left, bottom], [left, top]], colour, 1);
    }

    /// Puts text on it.
    pub fn text(&mut self, text: impl Into<String>, at: Place, size: u32, anchor: Anchor) {
        self.marks.push(Mark::Text(Text { at, text: text.into(), size, anchor }));
    }

    /// The picture as SVG; its letters stay letters.
    ///
    /// # Errors
    /// The drawing library's.
    pub fn svg(&self) -> Result<String, DrawingError> {
        let mut picture = String::new();
        let mut canvas = SVGBackend::with_string(&mut picture, (self.width, self.height));
        self.paint(&mut canvas, |canvas, Text { at, text, size, anchor }| {
            let side = match anchor {
                Anchor::Start => HPos::Left,
                Anchor::Middle => HPos::Center,
                Anchor::End => HPos::Right,
            };
            // plotters' SVG backend divides the size by 1.24, for it takes it for the height of a line.
            let font = (Lettering::FAMILY, 1.24 * f64::from(*size)).into_font().color(&BLACK);
            let style = font.pos(Pos::new(side, VPos::Center));
            canvas.draw_text(text, &style, pair(at)).map_err(DrawingError::new)
        })?;
        drop(canvas);
        Ok(picture)
    }

    /// The picture as PNG.
    ///
    /// # Errors
    /// The drawing library's.
    pub fn png(&self, letters: &Lettering) -> Result<Vec<u8>, DrawingError> {
        let mut pixels = vec![0; 3 * (self.width * self.height) as usize];
        let mut canvas = BitMapBackend::with_buffer(&mut pixels, (self.width, self.height));
        self.paint(&mut canvas, |canvas, text| {
            let [x, y] = text.start(letters);
            letters.cover(&text.text, text.size, |dx, dy, coverage| {
                let ink = BLACK.mix(f64::from(coverage)).to_backend_color();
                canvas.draw_pixel((x + dx, y + dy), ink).map_err(DrawingError::new)
            })
        })?;
        drop(canvas);
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&pixels));
        written.map_err(DrawingError::new)?;
        Ok(file)
    }

    /// Paints all marks; how letters are made depends on the canvas.
    fn paint<B: DrawingBackend>(
        &self,
        canvas: &mut B,
        write: impl Fn(&mut B, &Text) -> Result<(), DrawingError>,
    ) -> Result<(), DrawingError> {
        let corner = (self.width as i32, self.height as i32);
        canvas.draw_rect((0, 0), corner, &WHITE, true).map_err(DrawingError::new)?;
        for mark in &self.marks {
            let painted = match mark {
                Mark::Block(from, to, colour) => canvas.draw_rect(pair(from), pair(to), colour, true),
                Mark::Path(places, colour, width) => {
                    canvas.draw_path(places.iter().map(pair), &colour.stroke_width(*width))
                }
                Mark::Area(places, colour) => canvas.fill_polygon(places.iter().map(pair), colour),
                Mark::Disc(centre, radius, colour) => canvas.draw_circle(pair(centre), *radius, colour, true),
                Mark::Text(text) => {
                    write(canvas, text)?;
                    continue;
                }
            };
            painted.map_err(DrawingError::new)?;
        }
        canvas.present().map_err(DrawingError::new)
    }
}

impl Text {
    /// Left corner and right corner of the room that it takes.
    pub fn room(&self, letters: &Lettering) -> [Place; 2] {
        let [x, y] = self.start(letters);
        let height = self.size as i32;
        let right = x + letters.width(&self.text, self.size);
        [[x, self.at[1] - height / 2], [right, (y + height / 4).max(self.at[1] + height / 2)]]
    }

    /// Where its base line starts.
    fn start(&self, letters: &Lettering) -> Place {
        let width = letters.width(&self.text, self.size);
        let shift = match self.anchor {
            Anchor::Start => 0,
            Anchor::Middle => width / 2,
            Anchor::End => width,
        };
        // 0.26 em is half the height of a small letter of this font: it stands in the middle of the line.
        [self.at[0] - shift, self.at[1] + (0.26 * f64::from(self.size)).round() as i32]
    }
}

fn pair(&[x, y]: &Place) -> (i32, i32) {
    (x, y)
}

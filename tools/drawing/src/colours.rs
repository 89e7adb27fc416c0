use plotters::prelude::RGBColor;

/// From blue over white to red: ColorBrewer's RdBu with 11 classes (Harrower and Brewer 2003), which people tell apart
/// who do not see all colours, too.
const DIVERGING: [[u8; 3]; 11] = [
    [5, 48, 97],
    [33, 102, 172],
    [67, 147, 195],
    [146, 197, 222],
    [209, 229, 240],
    [247, 247, 247],
    [253, 219, 199],
    [244, 165, 130],
    [214, 96, 77],
    [178, 24, 43],
    [103, 0, 31],
];

/// Lines and letters that are there to help the eye.
pub const FAINT: RGBColor = RGBColor(150, 150, 150);
/// Six colours that people tell apart who do not see all colours, too (Okabe and Ito, "Color universal design", 2008;
/// their yellow is left out: too faint on white), then nearly black.
pub const DISTINCT: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(40, 40, 40),
];

/// The colour of a value from -1 (blue) over 0 (white) to 1 (red); beyond, that of the end.
pub fn diverging(value: f32) -> RGBColor {
    let place = (value.clamp(-1.0, 1.0) + 1.0) / 2.0 * (DIVERGING.len() - 1) as f32;
    let lower = (place as usize).min(DIVERGING.len() - 2);
    let fraction = place - lower as f32;
    let [from, to] = [DIVERGING[lower], DIVERGING[lower + 1]];
    let [r, g, b] = [0, 1, 2]
        .map(|i| (f32::from(from[i]) * (1.0 - fraction) + f32::from(to[i]) * fraction).round() as u8);
    RGBColor(r, g, b)
}

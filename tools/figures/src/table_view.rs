//! Figure 6: what the object memory holds, beside the table as the robot's camera saw it.

use crate::field_curves::FieldCurves;
use crate::line_style::LineStyle;
use crate::page::{Caption, LETTERS, MARGIN, RIGHT, WIDTH};
use crate::{Quantity, RunTrace};
use coact_drawing::{Anchor, BLACK, DISTINCT, FAINT, Lettering, Mark, Place, RGBColor, Sheet};
use coact_messages::LayerKind;

/// Pixels of a metre: the table fills the width of the page.
const SCALE: f64 = 620.0;
/// Height of a field's curve, pixels.
const CURVE: i32 = 270;
/// The disc that is assembled on.
const BASE: RGBColor = RGBColor(225, 225, 225);

/// The picture, of the instant at which the scene was copied.
pub fn object_memory(caption: Caption, trace: &RunTrace, letters: &Lettering) -> Sheet {
    let (mut sheet, y) = caption.sheet(letters);
    let field = |layer: LayerKind, title: &str| {
        let surface = trace.surface(layer, Quantity::Activity);
        let values = surface.at(RunTrace::SCENE_MS).iter().map(|&u| f64::from(u)).collect();
        FieldCurves {
            title: title.into(),
            curves: vec![(String::new(), values, LineStyle { colour: DISTINCT[0], dashes: &[] })],
            populations: surface.labels.clone(),
        }
    };
    let left = MARGIN + 80;
    let robot = field(LayerKind::ObjectMemoryRobot, "A  OML, robot's workspace: activity u(x)");
    robot.draw(&mut sheet, [left, y], [RIGHT, y + CURVE]);
    let y = table(&mut sheet, trace, y + CURVE + 20);
    let person = field(LayerKind::ObjectMemoryPerson, "C  OML, person's workspace: activity u(x)");
    person.draw(&mut sheet, [left, y + 20], [RIGHT, y + 20 + CURVE]);
    sheet.height = (y + 20 + CURVE + MARGIN) as u32;
    sheet
}

/// The table from above, the robot's side on top; returns where it ends.
fn table(sheet: &mut Sheet, trace: &RunTrace, top: i32) -> i32 {
    let scene = &trace.task.scene;
    let [depth, width] = scene.table_size;
    let far = scene.table_centre[0] + depth / 2.0;
    let pixels = |metres: f64| (metres * SCALE).round() as i32;
    let top = top + 50;
    // Seen with the robot on top, the world's y runs to the left.
    let place =
        |x: f64, y: f64| -> Place { [WIDTH / 2 - pixels(y - scene.table_centre[1]), top + pixels(far - x)] };
    let bottom = top + pixels(depth);
    let half = pixels(width / 2.0);
    let title = format!("B  What the robot's camera recognised at {:.1} s", RunTrace::SCENE_MS / 1000.0);
    sheet.text(title, [MARGIN + 80, top - 36], LETTERS + 2, Anchor::Start);
    sheet.frame([WIDTH / 2 - half, top], [WIDTH / 2 + half, bottom], BLACK);
    sheet.text("robot", [WIDTH / 2, top - 14], LETTERS, Anchor::Middle);
    sheet.text("person", [WIDTH / 2, bottom + 16], LETTERS, Anchor::Middle);
    for (owner, [low, high]) in ["robot's workspace", "person's workspace"].iter().zip(scene.workspace) {
        let (corner, opposite) = (place(high[0], high[1]), place(low[0], low[1]));
        sheet.frame(corner, opposite, FAINT);
        sheet.text(*owner, [corner[0], corner[1] - 12], LETTERS - 2, Anchor::Start);
    }
    let base = place(scene.platform[0], scene.platform[1]);
    sheet.marks.push(Mark::Disc(base, pixels(scene.platform_radius) as u32, BASE));
    sheet.text("base", base, LETTERS - 2, Anchor::Middle);
    for sighting in trace.scene.sightings() {
        let [x, y, _] = sighting.position;
        let kind = &trace.task.kinds[sighting.kind as usize];
        let [x, y] = place(x, y);
        let radius = pixels(kind.width / 2.0);
        sheet.marks.push(Mark::Disc([x, y], radius as u32, DISTINCT[0]));
        sheet.text(&kind.name, [x, y + radius + 11], LETTERS - 3, Anchor::Middle);
    }
    bottom + 30
}

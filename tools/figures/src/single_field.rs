//! Figures 3 and 4: one field by itself, before it is part of any architecture.

use crate::field_curves::FieldCurves;
use crate::heat_map::HeatMap;
use crate::layer_page::{Column, LayerPage};
use crate::line_style::LineStyle;
use crate::page::{Caption, LEFT, MARGIN, RIGHT};
use crate::{FigureError, Interval, Surface};
use coact_drawing::{BLACK, DISTINCT, Lettering, Sheet};
use coact_neural_field::{Field, Kernel, Parameters};
use coact_period::PERIOD;

/// Sites of a population: 30 units of length at a spacing of 0.5, so that a peak has room and dies away at the ends.
const SITES: usize = 60;
/// Input of the alternatives A1 to A4, all of them preshaped below threshold; A2 is not the strongest.
const PRESHAPE: [f64; 4] = [1.5, 1.5, 1.2, 1.8];
/// What A2 gets in addition, from time 0 on: enough that it wins against the others. Chosen by hand.
const ADDITIONAL: f64 = 1.5;
/// Time shown before and after the additional input, ms: until the decision has been made.
const SHOWN: [f64; 2] = [200.0, 400.0];

/// Step of the integration, ms: that of the robot's fields.
const STEP_MS: f64 = PERIOD.as_millis() as f64;

const DASHED: &[f64] = &[14.0, 9.0];
const DASH_DOTTED: &[f64] = &[16.0, 7.0, 3.0, 7.0];

/// A field that can be driven for a while.
struct DrivenField {
    field: Field,
    resting: Vec<f64>,
    activity: Vec<f64>,
}

impl DrivenField {
    /// At rest at the level `h`. Kernel and time constants are chosen by hand, such that a peak sustains itself and, with
    /// more `inhibition`, suppresses all others: the figure shows principles, no layer of the robot.
    fn new(populations: usize, inhibition: f64, h: f64) -> Result<Self, FigureError> {
        let kernel = Kernel { amplitude: 3.0, sigma: 2.0, inhibition, range: None };
        let parameters =
            Parameters { tau: 20.0, slope: 5.0, threshold: 0.0, spacing: 0.5, input_sigma: 2.0, kernel };
        let field = Field::new(parameters, populations, SITES)?;
        let activity = vec![h; field.sites()];
        Ok(Self { field, resting: vec![h; populations], activity })
    }

    /// Integrates so many steps with this input to each population.
    fn drive(&mut self, steps: usize, strength: &[f64]) -> Vec<f64> {
        let (mut input, mut next) = (vec![0.0; self.activity.len()], self.activity.clone());
        self.field.spread(strength, &mut input);
        for _ in 0..steps {
            self.field.step(STEP_MS, &self.activity, &input, &self.resting, &mut next);
            std::mem::swap(&mut self.activity, &mut next);
        }
        self.activity.clone()
    }
}

/// Figure 3: rest, response to weak input, and a peak that stands without input.
pub fn activation(caption: Caption, letters: &Lettering) -> Result<Sheet, FigureError> {
    let field = || DrivenField::new(1, 0.6, -2.0);
    let rest = field()?.drive(1000, &[0.0]);
    let weak = field()?.drive(1000, &[0.9]);
    let mut driven = field()?;
    driven.drive(300, &[3.0]);
    let peak = driven.drive(3000, &[0.0]);
    let curve = |name: &str, values, colour, dashes| (name.to_owned(), values, LineStyle { colour, dashes });
    let curves = FieldCurves {
        title: "activity u(x)".into(),
        populations: vec!["field position x: grasping".into()],
        curves: vec![
            curve("resting state: no input", rest, BLACK, &[]),
            curve("response to weak input, below threshold", weak, DISTINCT[0], DASHED),
            curve("self-stabilised peak: 3 s after strong input ended", peak, DISTINCT[1], DASH_DOTTED),
        ],
    };
    let (mut sheet, y) = caption.sheet(letters);
    curves.legend(&mut sheet, [MARGIN + 80, y + 16]);
    curves.draw(&mut sheet, [MARGIN + 80, y + 100], [RIGHT, y + 640]);
    sheet.height = (y + 640 + MARGIN) as u32;
    Ok(sheet)
}

/// Figure 4: four alternatives compete; one gets more input, wins and suppresses the others.
pub fn decision(caption: Caption, letters: &Lettering) -> Result<Sheet, FigureError> {
    let evolution = competition()?;
    let curves = three_instants(&evolution);
    let mut sheet = evolution_page(caption, evolution).draw(letters);
    let top = sheet.height as i32;
    curves.legend(&mut sheet, [MARGIN + 60, top + 50]);
    curves.draw(&mut sheet, [LEFT, top], [RIGHT, top + 360]);
    sheet.height = (top + 360 + MARGIN) as u32;
    Ok(sheet)
}

/// The alternatives' activity before and after A2 gets more input.
fn competition() -> Result<Surface, FigureError> {
    let mut field = DrivenField::new(PRESHAPE.len(), 1.5, -3.0)?;
    field.drive(1000, &PRESHAPE);
    let mut strength = PRESHAPE;
    let mut evolution = Surface {
        labels: (1..=PRESHAPE.len()).map(|number| format!("A{number}")).collect(),
        sites: SITES,
        start_ms: -SHOWN[0],
        period_ms: STEP_MS,
        values: Vec::new(),
    };
    for ms in -(SHOWN[0] as i64)..SHOWN[1] as i64 {
        strength[1] = PRESHAPE[1] + if ms >= 0 { ADDITIONAL } else { 0.0 };
        evolution.values.extend(field.drive(1, &strength).iter().map(|&u| u as f32));
    }
    Ok(evolution)
}

fn three_instants(evolution: &Surface) -> FieldCurves {
    let instant = |ms: f64, colour, dashes| {
        let values = evolution.at(ms).iter().map(|&u| f64::from(u)).collect();
        (format!("t = {ms:.0} ms"), values, LineStyle { colour, dashes })
    };
    FieldCurves {
        title: "activity u(x) at three instants".into(),
        curves: vec![
            instant(0.0, BLACK, &[]),
            instant(60.0, DISTINCT[0], DASHED),
            instant(SHOWN[1], DISTINCT[1], DASH_DOTTED),
        ],
        populations: evolution.labels.clone(),
    }
}

fn evolution_page(caption: Caption, evolution: Surface) -> LayerPage {
    let [low, high] = evolution.extremes();
    let input = Interval {
        name: "t = 0:".into(),
        doing: "additional input to A2".into(),
        from_ms: 0.0,
        to_ms: SHOWN[1],
    };
    LayerPage {
        caption,
        columns: vec![Column::marked(-SHOWN[0], SHOWN[1], vec![input])],
        maps: vec![HeatMap {
            title: "activity u(x, t)".into(),
            surfaces: vec![evolution],
            limits: [low.floor(), high.ceil()],
            ticks: Vec::new(),
        }],
    }
}

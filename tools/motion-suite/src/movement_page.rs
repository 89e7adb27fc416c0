use crate::chart::Chart;
use crate::{FAR, Quality, path};
use coact_drawing::{Anchor, DISTINCT, RGBColor, Sheet};
use coact_motion::{Capsule, Clearance, Plan, Problem, SegmentKind};
use coact_pictures::{ARM, HAND, THINGS, View, paint};
use nalgebra::Vector3;

/// A planned movement on one page: pictures of it, and curves of joints, hand and clearance.
pub struct MovementPage<'a> {
    /// What was asked for.
    pub problem: &'a Problem<'a>,
    /// What was planned.
    pub plan: &'a Plan,
}

/// Pictures of the movement, and how many stand side by side.
const PICTURES: (usize, usize) = (6, 3);
const WIDTH: i32 = 1500;
const PICTURE: [i32; 2] = [480, 400];
const CHART: i32 = 300;
/// Points of each curve.
const POINTS: usize = 300;
/// From the person's side of the table, to the left and above.
const TOWARDS: Vector3<f64> = Vector3::new(-0.75, 0.45, 0.5);

impl MovementPage<'_> {
    /// Draws the page.
    pub fn draw(&self) -> Sheet {
        let mut sheet = Sheet::new(WIDTH as u32);
        let quality = Quality::of(self.problem, self.plan);
        let title = format!(
            "{}: {:.2} s, path of the hand {:.2} m, {} peak(s) of speed, normalised jerk {:.0}",
            self.problem.mechanism.name,
            quality.duration_s,
            quality.path_m,
            quality.units,
            quality.normalised_jerk
        );
        sheet.text(title, [24, 30], 22, Anchor::Start);
        self.pictures(&mut sheet, 60);
        let below = 60 + PICTURE[1] * (PICTURES.0 / PICTURES.1) as i32 + 20;
        for (index, chart) in self.charts().iter().enumerate() {
            let (column, row) = ((index % 2) as i32, (index / 2) as i32);
            let corner = [24 + column * (WIDTH / 2), below + row * CHART];
            chart.draw(&mut sheet, corner, [corner[0] + WIDTH / 2 - 24, corner[1] + CHART - 10]);
        }
        sheet.height = (below + 2 * CHART + 20) as u32;
        sheet
    }

    fn posture(&self, t: f64) -> [f64; 7] {
        self.plan.at(t).map(|state| state.position)
    }

    fn pictures(&self, sheet: &mut Sheet, top: i32) {
        let hand = path(self.problem, self.plan);
        let view = self.view();
        for picture in 0..PICTURES.0 {
            let (column, row) = ((picture % PICTURES.1) as i32, (picture / PICTURES.1) as i32);
            let corner = [24 + column * (PICTURE[0] + 6), top + row * PICTURE[1]];
            let t = self.plan.duration() * picture as f64 / (PICTURES.0 - 1) as f64;
            let view = view.moved_to([corner[0] + PICTURE[0] / 2, corner[1] + PICTURE[1] / 2]);
            let bounding_capsules =
                self.problem.collision_model.bounding_capsules(self.problem.mechanism, &self.posture(t));
            let links = self.problem.collision_model.links().iter().zip(&bounding_capsules);
            let mut strokes: Vec<_> = links
                .map(|(link, bounding_capsule)| {
                    view.capsule(bounding_capsule, if link.hand { HAND } else { ARM })
                })
                .collect();
            let things = &self.problem.scene.obstacles;
            strokes.extend(things.iter().flat_map(|thing| view.edges(thing, THINGS)));
            paint(sheet, strokes);
            sheet.path(hand.places.iter().map(|place| view.place(place)).collect::<Vec<_>>(), DISTINCT[1], 2);
            sheet.frame(
                corner,
                [corner[0] + PICTURE[0], corner[1] + PICTURE[1] - 6],
                RGBColor(200, 200, 200),
            );
            sheet.text(format!("{t:.2} s"), [corner[0] + 10, corner[1] + 16], 16, Anchor::Start);
        }
    }

    /// A view of all places of the arm during the movement, and of all obstacles.
    fn view(&self) -> View {
        let capsules = (0..=4).flat_map(|step| {
            let posture = self.posture(self.plan.duration() * f64::from(step) / 4.0);
            self.problem.collision_model.bounding_capsules(self.problem.mechanism, &posture)
        });
        let things = self.problem.scene.obstacles.iter().map(|thing| thing.bounding_capsule);
        let capsules: Vec<Capsule> = capsules.chain(things).collect();
        View::of(&capsules, TOWARDS, PICTURE)
    }

    fn charts(&self) -> [Chart<'_>; 4] {
        let (problem, duration) = (self.problem, self.plan.duration());
        let times: Vec<f64> = (0..=POINTS).map(|point| duration * point as f64 / POINTS as f64).collect();
        let names = problem.mechanism.arm.joints.iter().map(|joint| joint.name.clone());
        let joints = |of: fn(&coact_robot::MotionState) -> f64| {
            let curve = |joint: usize| times.iter().map(|t| of(&self.plan.at(*t)[joint])).collect();
            names.clone().enumerate().map(|(joint, name)| (name, curve(joint))).collect()
        };
        let clearance = Clearance {
            mechanism: problem.mechanism,
            collision_model: problem.collision_model,
            scene: problem.scene,
            segment: SegmentKind::Approach,
        };
        let distance = |t: &f64| clearance.nearest(&self.posture(*t), FAR).map_or(FAR, |near| near.distance);
        let mut marks: Vec<f64> = self.plan.segments.iter().map(|(_, end)| *end).collect();
        marks.pop();
        let chart = |title, curves| Chart { title, curves, duration, marks: marks.clone() };
        [
            chart("joint positions, rad", joints(|state| state.position)),
            chart("joint velocities, rad/s", joints(|state| state.velocity)),
            chart("speed of the hand, m/s", vec![(String::new(), path(problem, self.plan).speed)]),
            chart(
                "nearest distance, m (0.3: that or more)",
                vec![(String::new(), times.iter().map(distance).collect())],
            ),
        ]
    }
}

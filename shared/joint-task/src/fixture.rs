use crate::{Shape, Task};

/// A thing of the scene that does not move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fixture {
    /// [`TABLE`](Self::TABLE) or [`PLATFORM`](Self::PLATFORM).
    pub name: &'static str,
    /// Its form.
    pub form: FixtureForm,
}

/// Form and place of a [`Fixture`]; m, world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FixtureForm {
    /// Something upright.
    Upright {
        /// Its shape.
        shape: Shape,
        /// Centre of its underside.
        underside: [f64; 3],
    },
    /// A rod with round ends.
    Rod {
        /// One end.
        from: [f64; 3],
        /// The other.
        to: [f64; 3],
        /// Its radius.
        radius: f64,
    },
}

/// Thickness of the table top, m: a usual one.
const THICKNESS: f64 = 0.04;
/// Radius of the foot that carries the base, m. Chosen by hand: narrower than the shipped bases, so that hands reach under its rim.
const FOOT: f64 = 0.05;
/// Radius of the axles, m. Chosen by hand: thinner than the narrowest part that is pushed onto one, a nut of 12.5 mm.
const AXLE: f64 = 0.006;
/// How far an axle sticks out beyond the place of the part on it, m: the height of a nut.
const AXLE_END: f64 = 0.02;
/// A foot lower than this is none, m: the base stands on the table.
const LEAST_FOOT: f64 = 1e-3;

impl Fixture {
    /// The table top.
    pub const TABLE: &'static str = "table";
    /// The base on which parts are mounted, its foot and its axles.
    pub const PLATFORM: &'static str = "platform";
}

impl Task {
    /// Table top, base, its foot, and its axles: a socket that points sideways is the end of one.
    pub fn fixtures(&self) -> Vec<Fixture> {
        let scene = &self.scene;
        let upright =
            |name, shape, underside| Fixture { name, form: FixtureForm::Upright { shape, underside } };
        let ([width, depth], [across, along]) = (scene.table_size, scene.table_centre);
        let top = Shape::Box { size: [width, depth, THICKNESS] };
        let [x, y, z] = scene.platform;
        let base = Shape::Cylinder { radius: scene.platform_radius, height: scene.platform_height };
        let foot =
            Shape::Cylinder { radius: FOOT.min(scene.platform_radius), height: z - scene.table_height };
        let mut found = vec![
            upright(Fixture::TABLE, top, [across, along, scene.table_height - THICKNESS]),
            upright(Fixture::PLATFORM, base, scene.platform),
        ];
        if foot.height() > LEAST_FOOT {
            found.push(upright(Fixture::PLATFORM, foot, [x, y, scene.table_height]));
        }
        for goal in self.subgoals.iter().filter(|goal| goal.axis[2].abs() < 0.5) {
            let to = std::array::from_fn(|axis| goal.socket[axis] + AXLE_END * goal.axis[axis]);
            let form = FixtureForm::Rod { from: [x, y, goal.socket[2]], to, radius: AXLE };
            found.push(Fixture { name: Fixture::PLATFORM, form });
        }
        found
    }

    /// How far a part comes through or around fixtures on its way along `axis` (unit) into its place, m: the depth of a hole,
    /// or as far as an axle sticks out. 0 where nothing but the place itself is met.
    pub fn insertion_depth(&self, place: [f64; 3], axis: [f64; 3]) -> f64 {
        let along = |point: [f64; 3]| {
            let offset: [f64; 3] = std::array::from_fn(|i| point[i] - place[i]);
            let along: f64 = (0..3).map(|i| offset[i] * axis[i]).sum();
            let across = (0..3).map(|i| (offset[i] - along * axis[i]).powi(2)).sum::<f64>().sqrt();
            (along, across)
        };
        let depths = self.fixtures().into_iter().map(|fixture| match fixture.form {
            FixtureForm::Rod { to, radius, .. } => {
                let (depth, off) = along(to);
                if off < radius { depth + radius } else { 0.0 }
            }
            FixtureForm::Upright { shape, underside: [x, y, z] } => {
                let (depth, off) = along([x, y, z + shape.height()]);
                if off < shape.radius() && axis[2] > 0.5 { depth } else { 0.0 }
            }
        });
        depths.fold(0.0, f64::max)
    }
}

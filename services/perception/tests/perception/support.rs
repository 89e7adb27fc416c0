//! A person's hand and parts on a table, as sensors would show them, for tests of perception.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use coact_joint_task::{Act, Scene, Task};
use coact_messages::{ArmSide, Keypoint, KeypointName, Percept, SensorSample, Sighting, SiteGrid, Surface};
use coact_perception::{Perception, PreshapeModel};
use std::path::PathBuf;

pub fn configuration(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../rt-config").join(file)
}

pub fn task() -> Task {
    Task::load(&configuration("tasks/toy-vehicle.toml")).unwrap()
}

pub fn perception(task: &Task) -> Perception {
    Perception::new(task, &PreshapeModel::load(&configuration("perception/preshape.toml")).unwrap()).unwrap()
}

/// The hand: middle of the finger tips (m), pitch (rad), thumb to index (m).
#[derive(Clone, Copy)]
pub struct Hand {
    pub centre: [f64; 3],
    pub pitch: f64,
    pub aperture: f64,
}

impl Hand {
    pub fn towards(&self, end: &Self, along: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * along;
        Self {
            centre: std::array::from_fn(|axis| mix(self.centre[axis], end.centre[axis])),
            pitch: mix(self.pitch, end.pitch),
            aperture: mix(self.aperture, end.aperture),
        }
    }

    /// The same with its fingers open, as people have them on their way to what they grasp.
    pub fn open(self) -> Self {
        Self { aperture: self.aperture + 0.03, ..self }
    }

    /// Keypoints of a hand that points along x: fingers 0.15 m from the wrist, thumb and index opposed along y. The left hand is the mirror
    /// image of the right one.
    fn keypoints(&self, side: ArmSide) -> [Keypoint; 9] {
        let mirror = if side == ArmSide::Right { 1.0 } else { -1.0 };
        let on_hand = |along: f64, aside: f64| Keypoint {
            position: [
                self.centre[0] + (along - 0.15) * self.pitch.cos(),
                self.centre[1] + mirror * aside,
                self.centre[2] + (along - 0.15) * self.pitch.sin(),
            ],
            confidence: 0.9,
        };
        let half = 0.5 * self.aperture;
        [
            on_hand(-0.5, 0.1),
            on_hand(-0.26, 0.05),
            on_hand(0.0, 0.0),
            on_hand(0.02, 0.02),
            on_hand(0.15, half),
            on_hand(0.09, 0.025),
            on_hand(0.15, -half),
            on_hand(0.16, -half),
            on_hand(0.08, -0.04),
        ]
    }
}

/// Minimum jerk.
pub fn smooth(time: f64) -> f64 {
    let t = time.clamp(0.0, 1.0);
    t * t * t * (10.0 + t * (-15.0 + 6.0 * t))
}

/// One part of the scene.
#[derive(Clone, Copy)]
pub struct Thing {
    pub kind: usize,
    pub position: [f64; 3],
    pub orientation: [f64; 4],
    pub visible: bool,
}

/// A table with parts, a hand, and a perception that watches.
pub struct Stage {
    pub task: Task,
    pub perception: Perception,
    /// The right hand.
    pub hand: Hand,
    /// The left one, if it is seen.
    pub left: Option<Hand>,
    pub things: Vec<Thing>,
    pub sample: Box<SensorSample>,
    pub percept: Box<Percept>,
    pub tick: u64,
    /// Whether the hand tracker delivers.
    pub tracking: bool,
    /// Keypoints that it delivers in the place of the hand's own.
    pub wrong: Vec<(KeypointName, Keypoint)>,
    /// Keypoints of the left hand that the tracker does not find.
    pub lost_left: Vec<KeypointName>,
}

impl Stage {
    /// All parts where the task lays them out, the hand at rest for two seconds.
    pub fn new() -> Self {
        let mut stage = Self::empty();
        stage.run(2000, |_, _| {});
        stage
    }

    /// The same, before anything was seen.
    pub fn empty() -> Self {
        let task = task();
        let things = task.parts.iter().map(|part| Thing {
            kind: part.kind,
            position: [part.at[0], part.at[1], task.scene.table_height],
            orientation: [0.0, 0.0, 0.0, 1.0],
            visible: true,
        });
        let mut sample: Box<SensorSample> = bytemuck::zeroed_box();
        bare_table(&task, &mut sample.scene.surface);
        Self {
            things: things.collect(),
            perception: perception(&task),
            hand: resting(&task),
            left: None,
            task,
            sample,
            percept: bytemuck::zeroed_box(),
            tick: 1,
            tracking: true,
            wrong: Vec::new(),
            lost_left: Vec::new(),
        }
    }

    /// Runs `ticks` periods; before each, `change` is told the time since the first and may change anything.
    pub fn run(&mut self, ticks: u64, mut change: impl FnMut(&mut Self, u64)) {
        for time in 0..ticks {
            change(self, time);
            self.sense();
            self.perception.step(self.tick, Some(&self.sample), &mut self.percept);
            self.tick += 1;
        }
    }

    /// Moves the hand on a minimum-jerk way to `end`; `watch` sees each percept.
    pub fn move_to(&mut self, end: Hand, ticks: u64, mut watch: impl FnMut(&Self)) {
        let start = self.hand;
        for time in 1..=ticks {
            self.hand = start.towards(&end, smooth(time as f64 / ticks as f64));
            self.run(1, |_, _| {});
            watch(self);
        }
    }

    /// Moves the left hand so.
    pub fn move_left_to(&mut self, end: Hand, ticks: u64, mut watch: impl FnMut(&Self)) {
        let start = self.left.unwrap();
        for time in 1..=ticks {
            self.left = Some(start.towards(&end, smooth(time as f64 / ticks as f64)));
            self.run(1, |_, _| {});
            watch(self);
        }
    }

    /// The hand as it grasps part `index` with grip `grip`.
    pub fn grasping(&self, index: usize, grip: usize) -> Hand {
        let thing = self.things[index];
        let kind = &self.task.kinds[thing.kind];
        let [x, y, z] = thing.position;
        Hand {
            centre: [x, y, z + 0.5 * kind.shape.height()],
            pitch: self.task.grips[grip].pitch,
            aperture: kind.width,
        }
    }

    /// Evidence for one act; of a grasp also that the hand is on its way to one.
    pub fn act(&self, act: Act) -> f64 {
        let shown = self.percept.act[self.task.acts.iter().position(|own| *own == act).unwrap()];
        match act {
            Act::Grasp { grip, kind } => (shown + self.on_the_way(kind)) * self.looks_like(grip),
            _ => shown,
        }
    }

    /// By how much more than mere chance the hand looks like a grip; 1 where nothing tells them apart.
    pub fn looks_like(&self, grip: usize) -> f64 {
        let grips = &self.percept.grips;
        if grips.count == 0 {
            return 1.0;
        }
        let (all, chance) = (grips.iter().map(|(_, _, fit)| fit).sum::<f64>(), 1.0 / f64::from(grips.count));
        ((grips.fit[grip] / all.max(f64::MIN_POSITIVE) - chance) / (1.0 - chance)).max(0.0)
    }

    /// By how much more than mere chance the hand's movement leads to parts of a kind, as far as it tells anything.
    pub fn on_the_way(&self, kind: usize) -> f64 {
        let destinations = &self.percept.destinations;
        let best = |kind: Option<usize>| {
            let of_kind = destinations.iter().filter(|(own, _, _)| *own == kind);
            of_kind.map(|(_, _, fit)| fit).fold(0.0, f64::max)
        };
        let kinds = || (0..self.task.kinds.len()).map(|kind| best(Some(kind)));
        let all = best(None) + kinds().sum::<f64>();
        let lie_there = kinds().filter(|best| *best > 0.0).count();
        let chance = if lie_there > 1 { 1.0 / lie_there as f64 } else { 0.0 };
        let share = best(Some(kind)) / all.max(f64::MIN_POSITIVE);
        destinations.told * ((share - chance) / (1.0 - chance)).max(0.0)
    }

    /// The strongest grasp that is not `act`.
    pub fn rival(&self, act: Act) -> f64 {
        let grasps = self.task.acts.iter().filter(|own| matches!(own, Act::Grasp { .. }));
        grasps.filter(|own| **own != act).map(|own| self.act(*own)).fold(0.0, f64::max)
    }

    pub fn kind(&self, name: &str) -> usize {
        self.task.kinds.iter().position(|kind| kind.name == name).unwrap()
    }

    /// The first part of a kind.
    pub fn part(&self, name: &str) -> usize {
        let kind = self.kind(name);
        self.things.iter().position(|thing| thing.kind == kind).unwrap()
    }

    /// Shows the sensors what there is now: hand at 60 Hz, parts at 30 Hz.
    pub fn sense(&mut self) {
        self.sample.header.cycle = self.tick;
        if self.tracking && self.tick.is_multiple_of(17) {
            for (side, hand) in [(ArmSide::Right, Some(self.hand)), (ArmSide::Left, self.left)] {
                let Some(hand) = hand else { continue };
                let view = &mut self.sample.hands[side as usize];
                view.frame += 1;
                view.captured_cycle = self.tick;
                view.keypoints = hand.keypoints(side);
            }
            for name in &self.lost_left {
                self.sample.hands[1].keypoints[*name as usize].confidence = 0.0;
            }
            for (name, keypoint) in &self.wrong {
                self.sample.hands[0].keypoints[*name as usize] = *keypoint;
            }
        }
        if self.tick.is_multiple_of(33) {
            self.show_parts();
        }
    }

    fn show_parts(&mut self) {
        let scene = &mut self.sample.scene;
        scene.frame += 1;
        scene.captured_cycle = self.tick;
        scene.sightings = 0;
        for thing in self.things.iter().filter(|thing| thing.visible) {
            scene.sighting[scene.sightings as usize] = Sighting {
                kind: thing.kind as u32,
                reserved: 0,
                confidence: 0.9,
                position: thing.position,
                orientation: thing.orientation,
            };
            scene.sightings += 1;
        }
    }
}

/// The picture of a table on which nothing is higher than it.
pub fn bare_table(task: &Task, surface: &mut Surface) {
    let Scene { table_centre: [x, y], table_size: [length, width], table_height, .. } = task.scene;
    let spacing = 0.022;
    let beyond = 0.1;
    let sites = [length, width].map(|size| ((size + 2.0 * beyond) / spacing) as u32 + 1);
    let first = [x - 0.5 * length - beyond, y - 0.5 * width - beyond];
    surface.grid = SiteGrid { first, spacing: [spacing; 2], sites };
    surface.level = table_height;
    surface.height.fill(0);
}

/// Something this high, m, stands on the lines of sight to `place`, to 10 cm above it, and around them.
pub fn stands_before(task: &Task, surface: &mut Surface, place: [f64; 3], height: f64) {
    let shadows = [0.0, 0.05, 0.1].map(|up| {
        let [x, y, z] = place;
        surface.shadow(task.scene.eye(), [x, y, z + up]).unwrap()
    });
    for site in 0..surface.grid.used() {
        let [x, y] = surface.grid.place(site);
        if shadows.iter().any(|shadow| (x - shadow[0]).hypot(y - shadow[1]) < 0.08) {
            surface.height[site] = (100.0 * height) as u8;
        }
    }
}

/// The right hand at rest.
pub fn resting(task: &Task) -> Hand {
    resting_on(task, ArmSide::Right)
}

/// One of the hands at rest.
pub fn resting_on(task: &Task, side: ArmSide) -> Hand {
    let [x, y, z] = task.scene.rest(side);
    let pitch = -0.35_f64;
    Hand { centre: [x + 0.15 * pitch.cos(), y, z + 0.15 * pitch.sin()], pitch, aperture: 0.03 }
}

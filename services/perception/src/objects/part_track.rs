use bytemuck::{Pod, Zeroable};
use coact_messages::Sighting;
use coact_period::cycles;
use coact_stage_state::{Implausible, bounded, ensure};
use nalgebra::{Isometry3, Quaternion, UnitQuaternion, Vector3};
use std::time::Duration;

/// Nobody has the part.
pub(crate) const FREE: u32 = 0;
/// Bit of `holder`: the part is in the robot's hand.
pub(crate) const BY_ROBOT: u32 = 1;
/// Bit of `holder`: the part is in the person's hand.
pub(crate) const BY_PERSON: u32 = 2;
/// Distance of a sighting from the track beyond which the part has moved, m; less is scatter. Six standard
/// deviations of the simulated recogniser, whose sightings scatter by 2 mm along each axis.
pub(super) const MOVED: f64 = 0.012;
/// Weight of a new sighting in the position of a part that lies still: the mean of about three sightings. Chosen by hand.
const SMOOTHING: f64 = 0.3;

/// How long a part must lie still to be settled where it is: two frames of the recogniser.
pub(super) const SETTLED: u32 = cycles(Duration::from_millis(60)) as u32;
/// The same while the person's hand is not seen, or is seen for the first time again: it may hold the part there. Longer than a person holds a
/// part still in its socket.
const SETTLED_UNSEEN: u32 = cycles(Duration::from_millis(2500)) as u32;

/// Frames in a row that must show a part where none was before it is taken to be there: a recogniser that sees one in a hundred frames where
/// there is none does so thrice in a row in a million.
const BELIEVED: u8 = 3;
/// How long a part must be taken for one of another kind, and never for its own, to be one: recognisers are mistaken for some frames at a
/// time. Chosen by hand.
const RELABELLED: u16 = cycles(Duration::from_millis(1000)) as u16;

/// No fingers are as wide, tenths of a millimetre: nobody knows how wide they were.
const UNSEEN: u16 = u16::MAX;
/// Tenths of a millimetre, m.
const TENTHS: f64 = 1e-4;

/// No part is farther away, m, and the square of no quaternion's length farther from 1: what readers take in of a percept, which
/// tells both.
const FARTHEST: f64 = 1e3;
const UNIT: f64 = 0.1;

/// One part that has been sighted, followed from sighting to sighting.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct PartTrack {
    /// Kind plus one; 0 = this track is not in use.
    kind_plus_one: u16,
    /// Kind plus one that the newest frames took it for, where that is another one; 0: they did not.
    taken_for: u16,
    /// Cycles for which they have.
    mistaken: u16,
    /// How wide the person's fingers lately were about it, tenths of a millimetre: 0 while they are away, [`UNSEEN`] where they were not seen.
    widest: u16,
    /// [`FREE`], or bits [`BY_ROBOT`] and [`BY_PERSON`].
    pub holder: u32,
    /// Cycles for which its place has been in view and empty.
    pub absent: u32,
    /// Cycles for which it has lain still.
    pub still: u32,
    /// 1: it is mounted, or was when it lay still in nobody's hand for the last time; else 0.
    lay_mounted: u8,
    /// 1: it was mounted when the person took it for the last time; else 0.
    taken_out: u8,
    /// 1: it lies where the robot has let go of it; else 0.
    put_by_robot: u8,
    /// Frames that have shown it, as far as they are needed to believe in it.
    frames: u8,
    /// Cycle of the newest sighting, or of the frame by which the person had taken it: where her fingers have closed on it, there it is.
    pub seen: u64,
    /// Centre of the underside, m.
    pub position: [f64; 3],
    /// Quaternion x, y, z, w.
    pub orientation: [f32; 4],
}

impl PartTrack {
    /// A part that is sighted for the first time.
    pub fn new(sighting: &Sighting, captured: u64) -> Self {
        Self {
            kind_plus_one: kind_plus_one(sighting),
            frames: 1,
            seen: captured,
            position: sighting.position,
            orientation: sighting.orientation.map(|value| value as f32),
            ..Self::zeroed()
        }
    }

    /// The part's kind; `None` when the track is not in use.
    pub fn kind(&self) -> Option<usize> {
        (self.kind_plus_one > 0).then(|| self.kind_plus_one as usize - 1)
    }

    /// Whether the kinds of part that it is about are among so many `kinds`.
    pub fn is_about(&self, kinds: usize) -> bool {
        self.kind_plus_one as usize <= kinds && self.taken_for as usize <= kinds
    }

    /// Kind of a part that enough frames have shown.
    pub fn believed_kind(&self) -> Option<usize> {
        self.kind().filter(|_| self.is_believed())
    }

    /// Whether enough frames have shown it: before, there may be nothing.
    pub fn is_believed(&self) -> bool {
        self.frames >= BELIEVED
    }

    /// Refuses what is no track.
    pub fn check(&self) -> Result<(), Implausible> {
        ensure(self.holder <= BY_ROBOT | BY_PERSON, "parts.holder", "the bits of robot and person")?;
        bounded("parts.position", &self.position, FARTHEST)?;
        ensure(self.frames <= BELIEVED, "parts.frames", "no more frames than are needed")?;
        let truths = [self.lay_mounted, self.taken_out, self.put_by_robot];
        ensure(
            truths.iter().all(|truth| *truth <= 1),
            "parts: mounted, taken out, put by the robot",
            "0 or 1",
        )?;
        let [x, y, z, w] = self.orientation.map(f64::from);
        let square = x * x + y * y + z * z + w * w;
        ensure(square == 0.0 || (square - 1.0).abs() <= UNIT, "parts.orientation", "a quaternion of length 1")
    }

    /// Takes in a new sighting, `cycles` after the last frame. Of another kind than the part's, it tells where the part is all the same.
    pub fn follow(&mut self, sighting: &Sighting, captured: u64, cycles: u64) {
        self.look_again_what_it_is(kind_plus_one(sighting), cycles.min(u64::from(u16::MAX)) as u16);
        self.frames = (self.frames + 1).min(BELIEVED);
        let (old, new) = (Vector3::from(self.position), Vector3::from(sighting.position));
        if (new - old).norm() > MOVED {
            self.position = sighting.position;
            (self.still, self.put_by_robot) = (0, 0);
        } else {
            self.position = (old + (new - old) * SMOOTHING).into();
            self.still = self.still.saturating_add(cycles as u32);
        }
        self.orientation = sighting.orientation.map(|value| value as f32);
        self.seen = captured;
        self.absent = 0;
    }

    /// It has been moved so with what holds it.
    pub fn go_along(&mut self, moved: &Isometry3<f64>) {
        let before = Isometry3::from_parts(Vector3::from(self.position).into(), self.turn());
        let now = moved * before;
        if (now.translation.vector - before.translation.vector).norm() > MOVED {
            self.still = 0;
        }
        self.position = now.translation.vector.into();
        self.orientation = now.rotation.coords.map(|value| value as f32).into();
    }

    /// A part that is taken for one of another kind for long, and never for its own, is one.
    fn look_again_what_it_is(&mut self, kind_plus_one: u16, cycles: u16) {
        self.mistaken = match kind_plus_one {
            own if own == self.kind_plus_one => 0,
            other if other == self.taken_for => self.mistaken.saturating_add(cycles),
            _ => cycles,
        };
        self.taken_for = if self.mistaken > 0 { kind_plus_one } else { 0 };
        if self.mistaken > RELABELLED {
            (self.kind_plus_one, self.taken_for, self.mistaken) = (kind_plus_one, 0, 0);
        }
    }

    /// How wide the person's fingers lately were about it, m: 0 while they are away, infinite where they were not seen.
    pub fn widest(&self) -> f64 {
        if self.widest == UNSEEN { f64::INFINITY } else { f64::from(self.widest) * TENTHS }
    }

    /// They were so wide.
    pub fn set_widest(&mut self, width: f64) {
        self.widest = (width / TENTHS).min(f64::from(UNSEEN)) as u16;
    }

    /// Point on the part's axis, `height` above its underside, m.
    pub fn above_underside(&self, height: f64) -> Vector3<f64> {
        Vector3::from(self.position) + self.turn() * (Vector3::z() * height)
    }

    fn turn(&self) -> UnitQuaternion<f64> {
        let [x, y, z, w] = self.orientation.map(f64::from);
        UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
    }

    /// Whether it has lain still for so long, in nobody's hand, that it has settled where it is; `followed`: what the person's hand does
    /// is known. Where the robot has put it, it need not look.
    pub fn has_settled(&self, followed: bool) -> bool {
        let still = self.still >= if followed { SETTLED } else { SETTLED_UNSEEN };
        !self.is_held() && (still || self.is_put_by_robot())
    }

    /// Whether it lies where the robot has let go of it: the robot's hand may hide it, but what it has put where it knows.
    pub fn is_put_by_robot(&self) -> bool {
        self.put_by_robot == 1
    }

    /// The robot has let go of it.
    pub fn is_let_go_by_the_robot(&mut self) {
        self.holder &= !BY_ROBOT;
        self.put_by_robot = (self.holder == FREE).into();
    }

    /// Takes in whether a part that has settled is `mounted` where it is.
    pub fn look_whether(&mut self, mounted: bool, followed: bool) {
        if self.has_settled(followed) {
            self.lay_mounted = mounted.into();
        }
    }

    /// The person has it, as a frame shows.
    pub fn is_taken_by_the_person(&mut self, captured: u64) {
        self.holder |= BY_PERSON;
        self.seen = captured;
        (self.taken_out, self.put_by_robot) = (self.lay_mounted, 0);
    }

    /// Whether the person took it out of its socket when she took it for the last time.
    pub fn is_taken_out(&self) -> bool {
        self.taken_out == 1
    }

    /// Whether the person has it.
    pub fn is_with_the_person(&self) -> bool {
        self.holder & BY_PERSON != 0
    }

    /// Whether the robot has it.
    pub fn is_with_the_robot(&self) -> bool {
        self.holder & BY_ROBOT != 0
    }

    /// Whether anybody has it.
    pub fn is_held(&self) -> bool {
        self.holder != FREE
    }
}

/// Of a sighting whose kind is one of the task's, which are few.
fn kind_plus_one(sighting: &Sighting) -> u16 {
    sighting.kind as u16 + 1
}

//! How each message lies in memory, in words: what a recording says of it, and where a byte of it belongs to.

use crate::{
    ArmPath, Command, Decision, Destinations, DriveReport, FieldFrame, Grips, HandPercept, HandView, Header,
    Heard, JointReading, Keypoint, LayerTable, PathKnot, Percept, PersonArm, Pulse, SceneView, SensorSample,
    Sighting, SiteGrid, Speech, Surface, TrackedPoint, Truth, WorkspacePercept,
};
use std::fmt;

/// Plain memory whose fields have names.
pub trait Described {
    /// How it lies in memory.
    fn description() -> Description;
}

/// How a number, a row of equal things or a struct lies in memory. Written out it is JSON, the same for every build.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Description {
    /// A number: its type in Rust, and its bytes.
    Number(&'static str, usize),
    /// So many of one form, one after another.
    Row(Box<Description>, usize),
    /// Fields, one after another, without gaps.
    Fields(Vec<(&'static str, Description)>),
}

impl Description {
    /// Bytes that it takes.
    pub fn size(&self) -> usize {
        match self {
            Self::Number(_, size) => *size,
            Self::Row(of, count) => of.size() * count,
            Self::Fields(fields) => fields.iter().map(|(_, form)| form.size()).sum(),
        }
    }

    /// The number that the byte at `offset` belongs to, in the words of Rust, as in `workspace[1].position[3][0]`; empty beyond
    /// the last one.
    ///
    /// ```
    /// use coact_messages::{Described, Percept};
    ///
    /// let offset = std::mem::offset_of!(Percept, act) + 8 * 7 + 3;
    /// assert_eq!(Percept::description().place(offset), "act[7]");
    /// ```
    pub fn place(&self, offset: usize) -> String {
        match self {
            Self::Number(..) => String::new(),
            Self::Row(of, count) if offset < of.size() * count => {
                format!("[{}]{}", offset / of.size(), dotted(&of.place(offset % of.size())))
            }
            Self::Row(..) => String::new(),
            Self::Fields(fields) => field_at(fields, offset),
        }
    }
}

fn field_at(fields: &[(&'static str, Description)], offset: usize) -> String {
    let mut begin = 0;
    for (name, form) in fields {
        if offset < begin + form.size() {
            return format!("{name}{}", dotted(&form.place(offset - begin)));
        }
        begin += form.size();
    }
    String::new()
}

/// What stands behind a name: an index as it is, a field after a dot.
fn dotted(place: &str) -> String {
    if place.is_empty() || place.starts_with('[') { place.to_owned() } else { format!(".{place}") }
}

impl fmt::Display for Description {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(kind, _) => write!(out, "\"{kind}\""),
            Self::Row(of, count) => write!(out, "{{\"count\":{count},\"of\":{of}}}"),
            Self::Fields(fields) => {
                out.write_str("{\"fields\":[")?;
                for (index, (name, form)) in fields.iter().enumerate() {
                    let comma = if index == 0 { "" } else { "," };
                    write!(out, "{comma}{{\"name\":\"{name}\",\"type\":{form}}}")?;
                }
                out.write_str("]}")
            }
        }
    }
}

impl<T: Described, const COUNT: usize> Described for [T; COUNT] {
    fn description() -> Description {
        Description::Row(Box::new(T::description()), COUNT)
    }
}

/// The description of the type of a field.
fn of_field<S, T: Described>(_: fn(&S) -> &T) -> Description {
    T::description()
}

macro_rules! numbers {
    ($($number:ident)*) => {$(
        impl Described for $number {
            fn description() -> Description {
                Description::Number(stringify!($number), size_of::<$number>())
            }
        }
    )*};
}

macro_rules! described {
    ($($name:ident { $($field:ident),* })*) => {
        $(impl Described for $name {
            fn description() -> Description {
                Description::Fields(vec![$((stringify!($field), of_field(|own: &Self| &own.$field))),*])
            }
        })*

        #[cfg(test)]
        mod tests {
            use super::*;

            #[test]
            fn every_field_is_described_where_it_lies() {
                $(
                    let mut end = 0;
                    $(
                        assert_eq!(end, std::mem::offset_of!($name, $field), stringify!($name.$field));
                        end += of_field(|own: &$name| &own.$field).size();
                    )*
                    assert_eq!(end, size_of::<$name>(), stringify!($name));
                )*
            }
        }
    };
}

numbers!(u8 u32 u64 f64);

described! {
    Header { layout, generation, sequence, cycle, sensor_ns, published_ns, reserved }
    SensorSample { header, joints, drive, hands, scene, heard }
    JointReading { position, velocity, touch, wrist_force }
    DriveReport {
        position, velocity, acceleration, elapsed, speed_override, override_rate, on_path, mode, hold, reserved,
        command_cycle, refused
    }
    HandView { frame, captured_cycle, keypoints }
    Keypoint { position, confidence }
    SceneView { frame, captured_cycle, sightings, obstacles, sighting, obstacle, surface }
    Surface { grid, level, height }
    Sighting { kind, reserved, confidence, position, orientation }
    Heard { sentences, cycle, length, text }
    Percept {
        header, arms, hand, act, destinations, grips, workspace, achieved, open, robot_holds, person_holds, lost, state
    }
    PersonArm { shoulder, elbow, wrist, fingertip, age, tracked, reserved }
    TrackedPoint { position, velocity, deviation, age, still }
    HandPercept { aperture, reaching, side, since_onset }
    Destinations { count, reserved, told, place, kind, fit }
    Grips { count, reserved, pitch, fit }
    WorkspacePercept { seen, gone, position, orientation }
    FieldFrame {
        header, task, noise_seed, layers, table, shapes, decision, activity, input, resting, signal, since, destination,
        grip, checksum
    }
    LayerTable { count, reserved, kind, first_site, sites, first_population, populations }
    SiteGrid { first, spacing, sites }
    Decision { action, reserved, since }
    Command {
        header, position, velocity, acceleration, tracking_error, path, action, phase, begun, reaction,
        speed_override, handover, reserved, state
    }
    ArmPath { knots, count, elapsed, speed_override, override_rate, shortest, followed }
    PathKnot { t, states }
    Pulse {
        header, released_ns, scheduled_ns, started_ns, input_published_ns, input_received_ns, missed, stale, skipped,
        refused, refused_topic, reserved
    }
    Speech { header, length, text }
    Truth {
        header, actions, phase, chain, subgoal, onset_cycle, grasp_cycle, turn_cycle, heading_cycle, hesitation_cycle, achieved, assemblies, error,
        waiting, hidden, handover, side, reserved,
        joints, arms, held
    }
}

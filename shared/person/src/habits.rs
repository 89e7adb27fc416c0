use crate::PersonError;
use coact_joint_task::Task;
use coact_random::{RandomStreams, Stream};
use rand_distr::{Distribution, StandardNormal};
use serde::Deserialize;
use std::path::Path;
use toml::Spanned;

/// Steepest pitch of a hand, degrees.
const STEEPEST: f64 = 90.0;
/// Widest standard deviation from person to person, degrees: with more, a grip says nothing.
const WIDEST: f64 = 45.0;

/// How people's hands show the grips and gestures of a task.
///
/// They are the people's own: what the robot expects of them stands in the task file, which says nothing of how they move.
#[derive(Debug, Clone, PartialEq)]
pub struct Habits {
    /// In the order of the task's grips.
    grips: Vec<Habit>,
    /// In the order of the task's gestures.
    gestures: Vec<Habit>,
}

/// One person's pitches, rad: from wrist to knuckles against the table plane.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OwnHabits {
    pub grips: Vec<f64>,
    pub gestures: Vec<f64>,
}

/// Pitch of a hand, rad: mean and standard deviation from person to person.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Habit {
    mean: f64,
    varies: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HabitsFile {
    #[serde(default)]
    grip: Vec<HabitEntry>,
    #[serde(default)]
    gesture: Vec<HabitEntry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct HabitEntry {
    name: String,
    pitch: Spanned<f64>,
    varies: Spanned<f64>,
}

/// Text of the file, and where it is from.
struct Source<'a> {
    path: &'a Path,
    text: &'a str,
}

impl Habits {
    /// Reads the habits for the grips and gestures of `task`: `[[grip]]` and `[[gesture]]` with `name`, `pitch` and `varies`, degrees.
    ///
    /// # Errors
    /// [`PersonError::Habits`] for a file that cannot be read, a value out of its range, or a name of the task that is not in it.
    pub fn load(path: &Path, task: &Task) -> Result<Self, PersonError> {
        let text = coact_input_file::read_text(path).map_err(|error| PersonError::Habits {
            place: path.display().to_string(),
            message: error.to_string(),
        })?;
        let source = Source { path, text: &text };
        let file: HabitsFile = toml::from_str(&text)
            .map_err(|error| source.fault(error.span().map_or(0, |span| span.start), error.message()))?;
        let grips = task.grips.iter().map(|grip| source.habit(&file.grip, "grip", &grip.name));
        let gestures = task.gestures.iter().map(|own| source.habit(&file.gesture, "gesture", &own.name));
        Ok(Self { grips: grips.collect::<Result<_, _>>()?, gestures: gestures.collect::<Result<_, _>>()? })
    }

    /// Those of one person, drawn with the run's seed.
    pub(crate) fn draw(&self, random: &RandomStreams) -> OwnHabits {
        let mut rng = random.at(Stream::Habit, 0);
        let mut own = |habits: &[Habit]| {
            let drawn = habits.iter().map(|habit| {
                let deviate: f64 = StandardNormal.sample(&mut rng);
                habit.mean + habit.varies * deviate.clamp(-2.0, 2.0)
            });
            drawn.collect()
        };
        OwnHabits { grips: own(&self.grips), gestures: own(&self.gestures) }
    }
}

impl Source<'_> {
    fn habit(&self, entries: &[HabitEntry], table: &str, name: &str) -> Result<Habit, PersonError> {
        let Some(entry) = entries.iter().find(|entry| entry.name == name) else {
            let lacking = format!(
                "no [[{table}]] \"{name}\", which the task has; expected one, to say how people show it"
            );
            return Err(PersonError::Habits { place: self.path.display().to_string(), message: lacking });
        };
        Ok(Habit {
            mean: self.radians("pitch", &entry.pitch, -STEEPEST..=STEEPEST)?,
            varies: self.radians("varies", &entry.varies, 0.0..=WIDEST)?,
        })
    }

    fn radians(
        &self,
        key: &str,
        degrees: &Spanned<f64>,
        range: std::ops::RangeInclusive<f64>,
    ) -> Result<f64, PersonError> {
        let value = *degrees.as_ref();
        if range.contains(&value) {
            return Ok(value.to_radians());
        }
        let (low, high) = (range.start(), range.end());
        let problem =
            format!("key \"{key}\": {value} is out of range; expected degrees from {low} to {high}");
        Err(self.fault(degrees.span().start, &problem))
    }

    /// A mistake at byte `at`.
    fn fault(&self, at: usize, message: &str) -> PersonError {
        let line = 1 + self.text[..at.min(self.text.len())].matches('\n').count();
        PersonError::Habits {
            place: format!("{}:{line}", self.path.display()),
            message: message.trim_end().to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::path::PathBuf;

    fn shipped(file: &str) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config").join(file)
    }

    fn toy_vehicle() -> Task {
        Task::load(&shipped("tasks/toy-vehicle.toml")).unwrap()
    }

    #[test]
    fn people_differ_by_as_much_as_the_file_says_and_not_in_the_order_of_their_grips() {
        let habits = Habits::load(&shipped("person.toml"), &toy_vehicle()).unwrap();
        let people: Vec<_> = (0..200).map(|seed| habits.draw(&RandomStreams::new(seed)).grips).collect();
        for (grip, habit) in habits.grips.iter().enumerate() {
            let own = people.iter().map(|person| person[grip] - habit.mean);
            let (sum, square) = own.fold((0.0, 0.0), |(sum, square), own| (sum + own, square + own * own));
            let deviation = (square / 200.0).sqrt();
            assert!((sum / 200.0).abs() < 0.2 * habit.varies, "{grip}: {sum}");
            assert!((0.75..1.1).contains(&(deviation / habit.varies)), "{grip}: {deviation}");
        }
        assert!(
            people.iter().all(|person| person[0] < person[1]),
            "from above is steeper than from the side"
        );
    }

    #[test]
    fn what_makes_no_sense_is_refused_with_its_place() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("person.toml");
        let shipped = std::fs::read_to_string(shipped("person.toml")).unwrap();
        for (old, new, expected) in [
            (
                "name = \"side\"",
                "name = \"beside\"",
                ": no [[grip]] \"side\", which the task has; expected one",
            ),
            (
                "varies = 4",
                "varies = -4",
                "key \"varies\": -4 is out of range; expected degrees from 0 to 45",
            ),
            ("varies = 4", "varied = 4", "unknown field `varied`"),
            ("[[grip]]\nname", "[[grip]\nname", ""),
        ] {
            std::fs::write(&file, shipped.replacen(old, new, 1)).unwrap();
            let error = Habits::load(&file, &toy_vehicle()).unwrap_err().to_string();
            assert!(error.starts_with(file.to_str().unwrap()) && error.contains(expected), "{error}");
            assert!(error.contains(':') && !error.contains('\n'), "{error}");
        }
        let missing = Habits::load(&folder.path().join("none.toml"), &toy_vehicle()).unwrap_err().to_string();
        assert!(missing.contains("none.toml: "), "{missing}");
    }
}

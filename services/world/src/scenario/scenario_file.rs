use super::Scenario;
use super::scenario_source::ScenarioSource;
use super::staging_file::{BlindLine, OccluderLine, SlipLine, StartTable};
use crate::WorldError;
use coact_joint_task::Task;
use coact_person::{Due, Script, ScriptEntry, ScriptedAction, Variation};
use coact_stage_state::Flag;
use serde::Deserialize;
use std::path::Path;
use toml::Spanned;

/// A scenario file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ScenarioFile {
    #[serde(default)]
    start: StartTable,
    #[serde(default)]
    occluder: Vec<Spanned<OccluderLine>>,
    #[serde(default)]
    blind: Vec<BlindLine>,
    #[serde(default)]
    slip: Vec<Spanned<SlipLine>>,
    #[serde(default)]
    action: Vec<Spanned<ActionLine>>,
}

/// One `[[action]]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ActionLine {
    at: Option<Spanned<f64>>,
    after: Option<Spanned<f64>>,
    #[serde(default)]
    once: Vec<Spanned<String>>,
    idle: Option<Spanned<f64>>,
    chain: Option<Spanned<String>>,
    kind: Option<Spanned<String>>,
    say: Option<Spanned<String>>,
    gives_up: Option<Spanned<f64>>,
    clarity: Option<Spanned<f64>>,
    hand: Option<Spanned<Hand>>,
}

/// With which hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Hand {
    Left,
    Right,
}

/// Longest sentence that a sensor sample can hold, bytes.
const LONGEST_SENTENCE: usize = 256;

impl Scenario {
    /// Reads a scenario.
    ///
    /// `[[action]]`: what the person does, one after the other: `idle` (s), or `chain` and `kind` (names of the task), or
    /// `say` (a sentence) alone or beside them. When it is due: `at` (s from the start of the run) or `after` (s after the
    /// end of the action before; 0 if not given), and not before all subgoals of `once` are achieved. How it is done:
    /// `gives_up` (s after grasp completion), `clarity` (0 to 1: how plainly the hand shows the grip), `hand` ("left" or
    /// "right"; the right one if not given). An action whose part
    /// does not come within reach for 20 s is left out, see [`World::skipped`](crate::World::skipped).
    ///
    /// `[start]`, `[[start.part]]`, `[[occluder]]`, `[[blind]]` and `[[slip]]` arrange the scene.
    ///
    /// # Errors
    /// [`WorldError`] with file, line, key and what was expected.
    pub fn load(path: &Path, task: &Task) -> Result<Self, WorldError> {
        let text = coact_input_file::read_text(path)
            .map_err(|source| WorldError::File { path: path.to_path_buf(), source })?;
        let source = ScenarioSource { path, text: &text, task };
        let file: ScenarioFile = toml::from_str(&text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            source.fault(
                at,
                format!("{}; expected [[action]] entries as in rt-config/scenarios", error.message()),
            )
        })?;
        let entries = file.action.iter().map(|line| source.entry(line)).collect::<Result<_, _>>()?;
        let staging = source.staging(&file.start, &file.occluder, &file.blind, &file.slip)?;
        Ok(Self { script: Script { entries }, staging })
    }
}

impl ScenarioSource<'_> {
    fn entry(&self, line: &Spanned<ActionLine>) -> Result<ScriptEntry, WorldError> {
        let here = line.span().start;
        let ActionLine { at, after, once, say, .. } = line.as_ref();
        let due = match (at, after) {
            (Some(at), None) => Due::At(self.cycles("at", at)?),
            (None, Some(after)) => Due::After(self.cycles("after", after)?),
            (None, None) => Due::After(0),
            (Some(at), Some(_)) => {
                return Err(self
                    .fault(at.span().start, "keys \"at\" and \"after\": expected only one of them".into()));
            }
        };
        let awaited: Vec<usize> =
            once.iter().map(|name| self.subgoal("once", name)).collect::<Result<_, _>>()?;
        Ok(ScriptEntry {
            due,
            once: awaited.iter().fold(0, |mask, goal| mask | (1 << goal)),
            action: self.action(here, line.as_ref())?,
            say: say.as_ref().map(|say| self.sentence(say)).transpose()?,
        })
    }

    fn action(&self, here: usize, line: &ActionLine) -> Result<ScriptedAction, WorldError> {
        let variation = self.variation(line)?;
        match (&line.idle, &line.chain, &line.kind) {
            (None, Some(chain), Some(kind)) => {
                return Ok(ScriptedAction::Chain(self.chain(chain, kind)?, variation));
            }
            (None, Some(chain), None) => {
                return Err(self.fault(chain.span().start, "key \"kind\" is missing beside \"chain\"".into()));
            }
            _ => {}
        }
        for (key, at) in [
            ("gives_up", line.gives_up.as_ref().map(|given| given.span().start)),
            ("clarity", line.clarity.as_ref().map(|given| given.span().start)),
            ("hand", line.hand.as_ref().map(|given| given.span().start)),
        ] {
            if let Some(at) = at {
                let message = format!("key \"{key}\": expected beside \"chain\" and \"kind\" only");
                return Err(self.fault(at, message));
            }
        }
        match (&line.idle, &line.chain, &line.kind, &line.say) {
            (Some(idle), None, None, _) => Ok(ScriptedAction::Idle(self.cycles("idle", idle)?)),
            (None, None, None, Some(_)) => Ok(ScriptedAction::Idle(0)),
            _ => Err(self
                .fault(here, "expected either \"idle\", or \"chain\" with \"kind\", or only \"say\"".into())),
        }
    }

    fn variation(&self, line: &ActionLine) -> Result<Variation, WorldError> {
        let gives_up = line.gives_up.as_ref().map(|given| self.cycles("gives_up", given)).transpose()?;
        let clarity = match &line.clarity {
            None => 1.0,
            Some(given) if (0.0..=1.0).contains(given.as_ref()) => *given.as_ref(),
            Some(given) => {
                let message = format!("key \"clarity\": {} is out of range; expected 0 to 1", given.as_ref());
                return Err(self.fault(given.span().start, message));
            }
        };
        let gives_up_after = gives_up.map_or(0, |cycles| cycles.max(1));
        let left = Flag::from(line.hand.as_ref().is_some_and(|hand| *hand.as_ref() == Hand::Left));
        Ok(Variation { gives_up_after, blur: 1.0 - clarity, left, ..Variation::default() })
    }

    fn sentence(&self, say: &Spanned<String>) -> Result<String, WorldError> {
        let sentence = say.as_ref().trim();
        if sentence.is_empty() || sentence.len() > LONGEST_SENTENCE {
            let message =
                format!("key \"say\": expected a sentence of at most {LONGEST_SENTENCE} bytes, not none");
            return Err(self.fault(say.span().start, message));
        }
        Ok(sentence.to_owned())
    }

    fn chain(&self, chain: &Spanned<String>, kind: &Spanned<String>) -> Result<usize, WorldError> {
        let task = self.task;
        let mut names: Vec<&str> = task.chains.iter().map(|chain| chain.name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        self.find("chain", chain, &names)?;
        let index = self.kind("kind", kind)?;
        let fits = |known: &coact_joint_task::Chain| known.name == *chain.as_ref() && known.kind == index;
        task.chains.iter().position(fits).ok_or_else(|| {
            let message = format!("key \"kind\": the task has no chain \"{}\" for it", chain.as_ref());
            self.fault(kind.span().start, message)
        })
    }
}

use crate::Pointer;
use coact_pipeline::Layout;
use serde::Deserialize;

/// What a page asks for: one thing in each message. What is not one of these, or has numbers that cannot be meant, is refused.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Request {
    /// To be the partner, or not to be it any more.
    Play(bool),
    /// Where the partner's hand is.
    Pointer(Pointer),
    /// The partner's hand leaves.
    Hide(bool),
    /// Says something to the robot.
    Say(String),
    /// Injects a fault.
    Inject {
        /// Into which process.
        process: String,
        /// Which.
        fault: String,
    },
    /// Stops the robot.
    Stop(bool),
    /// Lets it go on.
    Resume(bool),
    /// Ends the run, as Ctrl-C at its terminal does.
    End(bool),
    /// Ends the run, and begins another one.
    Again {
        /// With the task of this name.
        task: String,
        /// With its parts there.
        layout: Layout,
    },
    /// To be told why this population stands or does not; of none any more.
    Why(Option<usize>),
    /// The picture of the past that is nearest to this cycle.
    At(u64),
    /// Live pictures again.
    Live(bool),
}

/// Nothing on the table is farther from the world's origin, m; what is pointed at from farther away is refused.
const FARTHEST: f64 = 5.0;
/// Longest sentence, bytes: what a message of the pipeline holds.
const LONGEST_SENTENCE: usize = 256;

impl Request {
    /// Reads and judges what a page has sent.
    ///
    /// # Errors
    /// Why it is refused.
    pub fn read(text: &str) -> Result<Self, String> {
        let request: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        match &request {
            Self::Pointer(pointer) => {
                let numbers = [pointer.x, pointer.y, pointer.lift];
                let are_near = numbers.iter().all(|number| number.is_finite() && number.abs() <= FARTHEST);
                are_near.then_some(()).ok_or(format!("the pointer is not within {FARTHEST} m"))?;
            }
            Self::Say(sentence) => {
                let length = sentence.trim().len();
                let is_one = (1..=LONGEST_SENTENCE).contains(&length);
                is_one.then_some(()).ok_or(format!("the sentence has {length} bytes; expected 1 to 256"))?;
            }
            _ => (),
        }
        Ok(request)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn what_a_page_may_ask_is_read() {
        let pointer = r#"{"pointer":{"x":-0.9,"y":0.2,"pressed":true,"grip":1,"gesture":null}}"#;
        let Request::Pointer(pointer) = Request::read(pointer).unwrap() else { panic!() };
        assert_eq!((pointer.x, pointer.pressed, pointer.gesture), (-0.9, true, None));
        assert_eq!(Request::read(r#"{"why":17}"#).unwrap(), Request::Why(Some(17)));
        assert_eq!(Request::read(r#"{"why":null}"#).unwrap(), Request::Why(None));
        assert_eq!(Request::read(r#"{"at":1234}"#).unwrap(), Request::At(1234));
        assert_eq!(Request::read(r#"{"stop":true}"#).unwrap(), Request::Stop(true));
        let again = Request::Again { task: "toy-vehicle".into(), layout: Layout::Random(17) };
        assert_eq!(Request::read(r#"{"again":{"task":"toy-vehicle","layout":"random:17"}}"#).unwrap(), again);
    }

    #[test]
    fn everything_else_is_refused() {
        let long = format!(r#"{{"say":"{}"}}"#, "a".repeat(257));
        for text in [
            "",
            "null",
            "[]",
            r#"{"dance":true}"#,
            r#"{"stop":true,"resume":true}"#,
            r#"{"pointer":{"x":1e999,"y":0}}"#,
            r#"{"pointer":{"x":6,"y":0}}"#,
            r#"{"pointer":{"x":0,"y":0,"part":"wheel"}}"#,
            r#"{"say":"  "}"#,
            r#"{"at":-1}"#,
            r#"{"why":"IL"}"#,
            r#"{"again":"toy-vehicle"}"#,
            r#"{"again":{"task":"toy-vehicle","layout":"random"}}"#,
            r#"{"again":{"task":"toy-vehicle","layout":"random:-1"}}"#,
            r#"{"again":{"task":"toy-vehicle","layout":"task","at":[0,0]}}"#,
            &long,
        ] {
            assert!(Request::read(text).is_err(), "{text}");
        }
    }
}

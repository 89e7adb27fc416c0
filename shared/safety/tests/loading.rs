//! The shipped limits are read; what is wrong is refused with its line.
#![allow(clippy::unwrap_used)]

use coact_safety::SafetyLimits;
use std::path::Path;

const SHIPPED: &str = include_str!("../../../rt-config/safety.toml");

fn refusal(text: &str) -> String {
    SafetyLimits::parse(text, Path::new("safety.toml")).unwrap_err().to_string()
}

/// The shipped text with the line of `key` replaced, and that line's number.
fn with(key: &str, line: &str) -> (String, usize) {
    let number = SHIPPED.lines().position(|own| own.starts_with(key)).unwrap();
    let lines = SHIPPED.lines().enumerate().map(|(at, own)| if at == number { line } else { own });
    (lines.collect::<Vec<_>>().join("\n"), number + 1)
}

#[test]
fn shipped_limits_are_valid() {
    SafetyLimits::parse(SHIPPED, Path::new("safety.toml")).unwrap();
}

#[test]
fn every_number_out_of_its_range_is_refused_with_line_and_key() {
    let mut tried = 0;
    for line in SHIPPED.lines().filter(|line| line.contains(" = ") && !line.starts_with('#')) {
        let key = line.split(' ').next().unwrap();
        for value in ["-1e9", "1e9", "nan", "inf", "-1", "1000000000"] {
            let is_integer = !line.contains('.') || key.ends_with("_ms");
            if is_integer && value.parse::<i64>().is_err() {
                continue;
            }
            let (text, number) = with(key, &format!("{key} = {value}"));
            let refusal = refusal(&text);
            assert!(refusal.starts_with(&format!("safety.toml:{number}: ")), "{key} = {value}: {refusal}");
            tried += 1;
        }
    }
    assert!(tried > 60, "{tried}");
}

#[test]
fn range_is_named() {
    let (text, number) = with("protective_separation_m", "protective_separation_m = 1.5");
    assert_eq!(
        refusal(&text),
        format!("safety.toml:{number}: protective_separation_m = 1.5; expected 0 to 1")
    );
}

#[test]
fn missing_and_unknown_keys_are_refused() {
    let (missing, _) = with("hand_length_m", "");
    assert!(refusal(&missing).contains("hand_length_m"), "{}", refusal(&missing));
    let (unknown, number) = with("hand_length_m", "hand_length_m = 0.18\nhand_size = 1");
    let refusal = refusal(&unknown);
    assert!(
        refusal.starts_with(&format!("safety.toml:{}", number + 1)) && refusal.contains("hand_size"),
        "{refusal}"
    );
}

#[test]
fn missing_file_is_named_with_what_was_expected() {
    let error = SafetyLimits::load(Path::new("no/such/safety.toml")).unwrap_err().to_string();
    assert!(error.starts_with("no/such/safety.toml: ") && error.contains("rt-config/safety.toml"), "{error}");
}

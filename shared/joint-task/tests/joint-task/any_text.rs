//! Whatever stands in a task file: it is loaded and checked, or refused with one error.
#![allow(clippy::unwrap_used)]

use coact_joint_task::check;
use proptest::prelude::*;
use std::path::Path;

const BASE: &str = "tasks/template.toml";

fn shipped(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config").join(file);
    std::fs::read_to_string(path).unwrap()
}

/// Neither a panic nor an endless computation: that it returns is what is tested.
fn examine(text: &[u8]) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("tasks")).unwrap();
    std::fs::write(folder.path().join("joint-action.toml"), shipped("joint-action.toml")).unwrap();
    std::fs::write(folder.path().join(BASE), text).unwrap();
    if let Err(error) = check(&folder.path().join(BASE)) {
        assert!(error.to_string().contains("template.toml"), "{error}");
    }
}

/// Whether a character may belong to a number.
fn in_number(c: char) -> bool {
    c.is_ascii_alphanumeric() || "+-._".contains(c)
}

/// Where the numbers of a text begin.
fn numbers(text: &str) -> Vec<usize> {
    let words = text.split(|c| !in_number(c)).filter(|word| word.parse::<f64>().is_ok());
    words.map(|word| word.as_ptr() as usize - text.as_ptr() as usize).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_number_in_any_place_is_used_or_refused(
        at in any::<prop::sample::Index>(),
        number in prop_oneof![
            prop::sample::select(vec!["nan", "inf", "-inf", "1e300", "-1e300", "1e-300", "0", "-1", "1e9"])
                .prop_map(str::to_owned),
            (-1e3..1e3_f64).prop_map(|number| number.to_string()),
        ],
    ) {
        let mut text = shipped(BASE);
        let places = numbers(&text);
        let start = places[at.index(places.len())];
        let length = text[start..].find(|c| !in_number(c)).unwrap_or(0);
        text.replace_range(start..start + length, &number);
        examine(text.as_bytes());
    }

    #[test]
    fn damage_anywhere_is_survived(
        at in any::<prop::sample::Index>(),
        removed in 0_usize..200,
        inserted in prop::collection::vec(any::<u8>(), 0..20),
    ) {
        let mut text = shipped(BASE).into_bytes();
        let start = at.index(text.len());
        let end = (start + removed).min(text.len());
        text.splice(start..end, inserted);
        examine(&text);
    }
}

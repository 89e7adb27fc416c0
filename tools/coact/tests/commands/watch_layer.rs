//! `tools/watch-layer.py` reads the messages as they are laid out now.
#![allow(clippy::unwrap_used)]

use coact_messages::{
    FieldFrame, LAYOUT, LayerKind, MAX_GRIP_SITES, MAX_LAYERS, MAX_PLACES, MAX_POPULATIONS, MAX_SITES, NONE,
};
use std::path::{Path, PathBuf};
use std::process::Command;

fn client() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../watch-layer.py")
}

#[test]
fn the_python_client_has_the_constants_of_the_messages() {
    let program = std::fs::read_to_string(client()).unwrap();
    for line in [
        format!("LAYOUT = {LAYOUT}"),
        format!(
            "MAX_LAYERS, MAX_POPULATIONS, MAX_SITES, MAX_PLACES, MAX_GRIP_SITES = {MAX_LAYERS}, {MAX_POPULATIONS}, {MAX_SITES}, {MAX_PLACES}, {MAX_GRIP_SITES}"
        ),
        format!("NONE = 0x{:04X}_{:04X}", NONE >> 16, NONE & 0xFFFF),
        // On its command line a layer is one word.
        format!("LAYERS = {:?}", LayerKind::ALL.map(|layer| layer.name().replace(' ', "-"))),
    ] {
        assert!(program.lines().any(|own| own == line), "{line} is missing");
    }
}

#[test]
fn a_field_frame_has_the_same_size_in_python() {
    let size = "import runpy, sys, ctypes; print(ctypes.sizeof(runpy.run_path(sys.argv[1])['FieldFrame']))";
    let Ok(output) = Command::new("python3").args(["-c", size]).arg(client()).output() else {
        eprintln!("skipped: there is no python3");
        return;
    };
    let printed = String::from_utf8(output.stdout).unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(printed.trim(), size_of::<FieldFrame>().to_string(), "{said}");
}

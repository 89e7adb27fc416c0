//! A large task, generated: many parts of a few kinds, subgoals that follow each other on both sides.

use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Kinds of part: subgoals share them.
const KINDS: usize = 15;

/// Writes a task of so many `subgoals` and `parts` into `folder`, under the shipped architecture; its path.
pub fn write(folder: &Path, subgoals: usize, parts: usize) -> PathBuf {
    let configuration = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    let network = configuration.join("joint-action.toml").display().to_string();
    let template = std::fs::read_to_string(configuration.join("tasks/template.toml")).expect("it is shipped");
    // Grips, gestures, chains, actions and scene of the template serve any task.
    let rest = template
        .find("# ---------------------------------------------------------------- what the person's")
        .expect("the template has this heading");
    let mut text = format!("name = \"generated\"\nnetwork = {network:?}\n");
    let kinds = KINDS.min(subgoals);
    for kind in 0..kinds {
        let width = 0.02 + 0.003 * kind as f64;
        let radius = 0.5 * width;
        write!(
            text,
            "[[kind]]\nname = \"kind {kind}\"\nwidth = {width}\nmass = 0.05\n\
             shape = {{ cylinder = {{ radius = {radius}, height = 0.03 }} }}\n"
        )
        .expect("a string takes any text");
    }
    for part in 0..parts {
        let (column, row) = ((part / 2 % 3) as f64, (part / 6) as f64);
        let (workspace, x, y) = match part % 2 {
            0 => ("person", -1.15 + 0.1 * column, 0.02 + 0.1 * row),
            _ => ("robot", -0.50 + 0.1 * column, 0.46 + 0.07 * row),
        };
        let kind = part / 2 % kinds;
        writeln!(
            text,
            "[[part]]\nkind = \"kind {kind}\"\nworkspace = \"{workspace}\"\nat = [{x:.2}, {y:.2}]"
        )
        .expect("a string takes any text");
    }
    for goal in 0..subgoals {
        let (kind, side) = (goal % kinds, if goal % 2 == 0 { "person" } else { "robot" });
        let (x, z) = (if goal % 2 == 0 { -0.69 } else { -0.55 }, 0.89 + 0.002 * goal as f64);
        let after = if goal < 2 { String::new() } else { format!("after = [\"goal {}\"]\n", goal - 2) };
        write!(
            text,
            "[[subgoal]]\nname = \"goal {goal}\"\nkind = \"kind {kind}\"\nside = \"{side}\"\nsteadied = {}\n\
             socket = {{ at = [{x}, 0.30, {z:.3}] }}\n{after}",
            goal % 2 == 0
        )
        .expect("a string takes any text");
    }
    text.push_str(&template[rest..]);
    let path = folder.join(format!("generated-{subgoals}.toml"));
    std::fs::write(&path, text).expect("the folder can be written to");
    path
}

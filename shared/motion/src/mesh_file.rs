//! Files of meshes, read without trusting them.
//!
//! mesh-loader 0.1 takes memory for as many numbers as a Collada file says that it holds, and panics at triangles of corners that
//! the file does not have. So what such a file says of its own size is held against its length before it is parsed, and a panic
//! means a file that cannot be read, like any other.

use mesh_loader::{Loader, Scene};
use std::io::{Error, ErrorKind, Result};
use std::path::Path;

/// No mesh of a link is larger, bytes: a hundred times the usual ones.
const LARGEST: u64 = 256 << 20;
/// No corner of a Collada file has more numbers: position, normal, texture and colour have eleven.
const WIDEST: usize = 16;

/// Reads a mesh.
pub(crate) fn read(file: &Path) -> Result<Scene> {
    let bytes = coact_input_file::read_within(file, LARGEST)?;
    if file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("dae")) {
        check(&String::from_utf8_lossy(&bytes)).map_err(refused)?;
    }
    let parse = || Loader::default().load_from_slice(&bytes, file);
    std::panic::catch_unwind(parse).map_err(|_| refused("its parts do not fit each other".into()))?
}

fn refused(problem: String) -> Error {
    Error::new(ErrorKind::InvalidData, problem)
}

/// Refuses a Collada file that says it holds more than its length has room for: each number takes two bytes at least.
fn check(text: &str) -> std::result::Result<(), String> {
    for (name, most) in [("count", text.len()), ("offset", WIDEST), ("stride", WIDEST)] {
        for said in attributes(text, name) {
            if said.parse::<usize>().map_or(true, |number| number > most) {
                return Err(format!("says {name} = \"{said}\"; expected a number up to {most}"));
            }
        }
    }
    for list in text.split("vcount>").skip(1).step_by(2) {
        let corners = list.split('<').next().unwrap_or_default().split_whitespace();
        let sum = corners.filter_map(|number| number.parse::<usize>().ok()).fold(0, usize::saturating_add);
        if sum > text.len() {
            return Err(format!("says that its polygons have {sum} corners; expected as many as it holds"));
        }
    }
    Ok(())
}

/// The values of all attributes of this name.
fn attributes<'a>(text: &'a str, name: &str) -> impl Iterator<Item = &'a str> {
    text.split(name).skip(1).filter_map(|rest| {
        let value = rest.trim_start().strip_prefix('=')?.trim_start();
        let quote = value.chars().next().filter(|quote| matches!(quote, '"' | '\''))?;
        value[1..].split(quote).next()
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn a_file_that_says_it_holds_more_than_it_can_is_refused_before_memory_is_taken() {
        let refused = [
            "<float_array count=\"4294967295\">0 0</float_array>",
            "<float_array count = '99999'>0 0</float_array>",
            "<triangles count=\"&#57;9999\"/>",
            "<input offset=\"17\"/>",
            "<accessor stride=\"-1\"/>",
            "<polylist count=\"2\"><vcount>3 4294967295</vcount></polylist>",
        ];
        for text in refused {
            assert!(check(text).is_err(), "{text}");
        }
        check("<float_array count=\"2\">0 0</float_array><vcount>3 3</vcount><p>0 1 2 2 1 0</p>").unwrap();
    }
}

//! What the documents name exists: every path, and in CONTRIBUTING every item of a file; and shared crates have examples.
#![allow(clippy::unwrap_used)]

use coact_tests::checkout;
use std::path::Path;

const DOCUMENTS: [&str; 6] = [
    "README.md",
    "ARCHITECTURE.md",
    "GLOSSARY.md",
    "CONTRIBUTING.md",
    "docs/measured.md",
    "examples/README.md",
];
/// Folders and files that runs and builds make: named, but not in the repository.
const MADE: [&str; 4] = ["target", "reports", "figures", "motion"];
/// Endings of files that belong to the repository wherever a document names one without its folder.
const SOURCES: [&str; 3] = [".rs", ".py", ".urdf"];

/// Something that a document names, and where.
struct Named<'a> {
    text: &'a str,
    place: String,
}

/// All between backticks, and all words of code blocks.
fn in_code<'a>(document: &str, text: &'a str) -> Vec<Named<'a>> {
    let mut named = Vec::new();
    let mut in_block = false;
    for (line, number) in text.lines().zip(1..) {
        if line.starts_with("```") {
            in_block = !in_block;
            continue;
        }
        let place = || format!("{document}:{number}");
        let spans = line.split('`').skip(usize::from(!in_block)).step_by(if in_block { 1 } else { 2 });
        for span in spans {
            let words = span.split(|c: char| c.is_whitespace() || "\"'(),;=:|".contains(c));
            named.extend(words.map(|text| Named { text, place: place() }));
        }
    }
    named
}

/// Targets of links within the repository, without what follows `#`.
fn links<'a>(document: &str, text: &'a str) -> Vec<Named<'a>> {
    let mut named = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        for link in line.split("](").skip(1) {
            let target = link.split([')', '#']).next().unwrap();
            if !target.is_empty() && !target.contains("://") {
                named.push(Named { text: target, place: format!("{document}:{number}") });
            }
        }
    }
    named
}

/// Whether `path`, in which one `*` may stand in a name, exists below `folder`.
fn exists(folder: &Path, path: &str) -> bool {
    let (first, rest) = path.split_once('/').unwrap_or((path, ""));
    match first.split_once('*') {
        _ if first.is_empty() => true,
        None => folder.join(first).exists() && exists(&folder.join(first), rest),
        Some((begin, end)) => {
            let fits = |entry: &&String| entry.starts_with(begin) && entry.ends_with(end);
            entries(folder).iter().filter(fits).any(|entry| exists(&folder.join(entry), rest))
        }
    }
}

fn entries(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

/// All files of the repository below `folder`, as paths with `/`.
fn files(folder: &Path, prefix: &str, found: &mut Vec<String>) {
    for entry in entries(folder) {
        if entry.starts_with('.') || MADE.contains(&entry.as_str()) && prefix.is_empty() {
            continue;
        }
        let path = format!("{prefix}/{entry}");
        if folder.join(&entry).is_dir() {
            files(&folder.join(entry), &path, found);
        } else {
            found.push(path);
        }
    }
}

/// Whether what stands in code is no path, one of something that is not in the repository by its nature, or one that is.
fn is_right(text: &str, root: &Path, all: &[String]) -> bool {
    let first = text.split('/').next().unwrap();
    let is_placeholder = text.contains('<') || text.contains("NAME") || text.contains("mine.");
    if is_placeholder || first.is_empty() || MADE.contains(&first) {
        true
    } else if text.contains('/') && root.join(first).is_dir() {
        exists(root, text)
    } else if SOURCES.iter().any(|ending| text.ends_with(ending)) && !text.contains('*') {
        all.iter().any(|file| file.ends_with(&format!("/{text}")))
    } else {
        true
    }
}

#[test]
fn every_path_that_a_document_names_exists() {
    let (root, mut all, mut missing) = (checkout(), Vec::new(), Vec::new());
    files(&root, "", &mut all);
    for document in DOCUMENTS {
        let text = std::fs::read_to_string(root.join(document)).unwrap();
        let folder = root.join(document).parent().unwrap().to_owned();
        let wrong = in_code(document, &text).into_iter().filter(|named| !is_right(named.text, &root, &all));
        missing.extend(wrong.map(|named| format!("{}: {}", named.place, named.text)));
        let broken = links(document, &text).into_iter().filter(|link| !folder.join(link.text).exists());
        missing.extend(broken.map(|link| format!("{}: {}", link.place, link.text)));
    }
    assert!(missing.is_empty(), "not in the repository:\n{}", missing.join("\n"));
}

/// In CONTRIBUTING a path may be followed by items: in a table's next cell, in text in brackets.
#[test]
fn every_item_that_contributing_names_is_in_its_file() {
    let root = checkout();
    let text = std::fs::read_to_string(root.join("CONTRIBUTING.md")).unwrap();
    let (mut missing, mut checked) = (Vec::new(), 0);
    let mut check = |paths: &[&str], items: &[&str]| {
        for (path, item) in paths.iter().flat_map(|path| items.iter().map(move |item| (path, item))) {
            let file = std::fs::read_to_string(root.join(path)).unwrap_or_default();
            checked += 1;
            if !file.contains(item) {
                missing.push(format!("{path}: {item}"));
            }
        }
    };
    for row in text.lines().filter(|line| line.starts_with('|')) {
        let cells: Vec<_> = row.split('|').collect();
        let paths: Vec<_> = code(cells[2]).into_iter().filter(|span| root.join(span).is_file()).collect();
        check(&paths, &code(cells[3]));
    }
    let prose = text.replace('\n', " ");
    let spans: Vec<_> = prose.split('`').collect();
    for index in (1..spans.len().saturating_sub(2)).step_by(2) {
        if root.join(spans[index]).is_file() && spans[index + 1].trim() == "(" {
            let close = (index + 3..spans.len()).step_by(2).find(|&after| spans[after].contains(')'));
            let items: Vec<_> = (index + 2..close.unwrap()).step_by(2).map(|item| spans[item]).collect();
            check(&[spans[index]], &items);
        }
    }
    assert!(missing.is_empty(), "not in its file:\n{}", missing.join("\n"));
    assert!(checked > 40, "only {checked} items were found in CONTRIBUTING.md");
}

/// All between backticks in one line.
fn code(line: &str) -> Vec<&str> {
    line.split('`').skip(1).step_by(2).collect()
}

#[test]
fn every_shared_crate_begins_with_an_example_that_runs() {
    let shared = checkout().join("shared");
    let without = entries(&shared).into_iter().filter(|name| {
        let text = std::fs::read_to_string(shared.join(name).join("src/lib.rs")).unwrap();
        // The front page stands before the first item; of its fences each second one closes.
        let front_page = text.lines().take_while(|line| line.starts_with("//!"));
        let mut begins = front_page.filter(|line| line.starts_with("//! ```")).step_by(2);
        !begins.any(|line| line == "//! ```")
    });
    assert_eq!(
        without.collect::<Vec<_>>(),
        Vec::<String>::new(),
        "no example that runs: a fence of ``` alone"
    );
}

//! Lines of an XML text, for error messages.

/// Line (from 1) on which an element's `name` attribute has this value.
pub(crate) fn of_name(text: &str, name: &str) -> Option<usize> {
    let declared = [format!("name=\"{name}\""), format!("name='{name}'")];
    text.lines().position(|line| declared.iter().any(|name| line.contains(name))).map(|index| index + 1)
}

/// Line (from 1) of the first tag that closes nothing or is never closed, or of the first number that is none.
pub(crate) fn of_first_fault(text: &str) -> Option<usize> {
    unbalanced(text).or_else(|| bad_number(text)).map(|offset| 1 + text[..offset].matches('\n').count())
}

/// Offset of the first tag without its partner.
fn unbalanced(text: &str) -> Option<usize> {
    let mut open: Vec<(&str, usize)> = Vec::new();
    let mut at = 0;
    while let Some(start) = text[at..].find('<').map(|found| at + found) {
        let rest = &text[start..];
        let end_mark = if rest.starts_with("<!--") { "-->" } else { ">" };
        let Some(length) = rest.find(end_mark).map(|found| found + end_mark.len()) else {
            return Some(start);
        };
        let tag = &rest[..length];
        at = start + length;
        if tag.starts_with("<!") || tag.starts_with("<?") || tag.ends_with("/>") {
            continue;
        }
        let name = tag.trim_matches(['<', '>', '/']).split_whitespace().next().unwrap_or_default();
        if !tag.starts_with("</") {
            open.push((name, start));
        } else if open.pop().is_none_or(|(opened, _)| opened != name) {
            return Some(start);
        }
    }
    open.last().map(|&(_, start)| start)
}

/// Offset of the first attribute that must hold numbers and does not.
fn bad_number(text: &str) -> Option<usize> {
    const NUMERIC: [&str; 12] = [
        "xyz", "rpy", "lower", "upper", "effort", "velocity", "ixx", "iyy", "izz", "radius", "length", "size",
    ];
    let mut offsets = NUMERIC.iter().flat_map(|key| {
        let mark = format!(" {key}=\"");
        text.match_indices(&mark).map(|(at, mark)| at + mark.len()).collect::<Vec<_>>()
    });
    offsets.find(|&at| {
        let value = text[at..].split('"').next().unwrap_or_default();
        value.trim().is_empty() || value.split_whitespace().any(|word| word.parse::<f64>().is_err())
    })
}

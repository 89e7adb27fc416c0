//! Lines of an XML text, for error messages.

/// Line (from 1) on which an element's `name` attribute has this value.
pub(crate) fn of_name(text: &str, name: &str) -> Option<usize> {
    let declared = [format!("name=\"{name}\""), format!("name='{name}'")];
    text.lines().position(|line| declared.iter().any(|name| line.contains(name))).map(|index| index + 1)
}

/// Elements may be nested this deep. A URDF needs five levels; the parser recurses, and would overflow its stack.
const DEEPEST: usize = 32;

/// Line (from 1) and reason for which a text is not given to the parser: it is nested too deeply, or declares a document
/// type, whose entities could grow without bounds.
pub(crate) fn unreadable(text: &str) -> Option<(usize, &'static str)> {
    let line = |offset: usize| 1 + text[..offset].matches('\n').count();
    let (mut depth, mut at) = (0_usize, 0);
    while let Some(start) = text[at..].find('<').map(|found| at + found) {
        let rest = &text[start..];
        let skipped = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];
        let skipped = skipped.iter().find(|(begin, _)| rest.starts_with(begin));
        at = match skipped {
            Some((begin, end)) => start + begin.len() + rest[begin.len()..].find(end)? + end.len(),
            None if rest.starts_with("<!") => {
                return Some((line(start), "declares a document type, which no URDF needs"));
            }
            None => start + tag_length(rest)?,
        };
        let tag = &text[start..at];
        if tag.starts_with("</") {
            depth = depth.saturating_sub(1);
        } else if skipped.is_none() && !tag.ends_with("/>") {
            depth += 1;
        }
        if depth > DEEPEST {
            return Some((line(start), "is nested more than 32 deep"));
        }
    }
    None
}

/// Length of the tag at the beginning of `text`; a ">" in quotes does not end it.
fn tag_length(text: &str) -> Option<usize> {
    let mut quote = None;
    let end = text.bytes().position(|byte| {
        match quote {
            Some(open) if byte == open => quote = None,
            None if matches!(byte, b'"' | b'\'') => quote = Some(byte),
            _ => {}
        }
        quote.is_none() && byte == b'>'
    });
    end.map(|end| end + 1)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_nested_deeply_is_not_given_to_the_parser_whatever_its_attributes_look_like() {
        for tag in ["<a>", "<a b=\"/>\">", "<a b='>/>'>", "<a\n>"] {
            let nested = tag.repeat(200_000);
            assert!(unreadable(&nested).is_some_and(|(_, problem)| problem.contains("nested")), "{tag}");
        }
        let shallow = "<a>".repeat(DEEPEST) + &"</a>".repeat(DEEPEST) + &"<b/>".repeat(100);
        assert_eq!(unreadable(&shallow), None);
    }

    #[test]
    fn what_looks_like_tags_in_comments_and_raw_text_is_none() {
        let text = format!("<?xml version='1.0'?><a><!-- {0} --><![CDATA[{0}]]></a>", "<b>".repeat(100));
        assert_eq!(unreadable(&text), None);
    }

    #[test]
    fn a_document_type_is_refused_with_its_line() {
        let found = unreadable("<?xml version='1.0'?>\n<!DOCTYPE a [<!ENTITY b 'c'>]><a/>");
        assert!(found.is_some_and(|(line, problem)| line == 2 && problem.contains("document type")));
    }
}

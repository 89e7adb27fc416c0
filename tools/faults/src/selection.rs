use crate::Cell;
use std::str::FromStr;

/// Selects cells, as `coact inject` names faults: `TARGET:FAULT@MOMENT`, of which any part may be left out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Selection {
    target: Option<String>,
    fault: Option<String>,
    moment: Option<String>,
}

/// A selection that cannot be read.
#[derive(Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "'{0}' selects nothing; expected TARGET:FAULT@MOMENT, parts of which may be left out: fields:kill, kill@moving, control:"
)]
pub struct UnknownSelection(pub String);

impl Selection {
    /// Whether the cell is selected.
    pub fn selects(&self, cell: &Cell) -> bool {
        let is =
            |wanted: &Option<String>, found: String| wanted.as_ref().is_none_or(|wanted| *wanted == found);
        is(&self.target, cell.target.to_string())
            && is(&self.fault, cell.fault.to_string())
            && is(&self.moment, cell.moment.to_string())
    }
}

impl FromStr for Selection {
    type Err = UnknownSelection;

    fn from_str(text: &str) -> Result<Self, UnknownSelection> {
        let (rest, moment) = text.split_once('@').map_or((text, ""), |(rest, moment)| (rest, moment));
        let (target, fault) = rest.split_once(':').map_or(("", rest), |(target, fault)| (target, fault));
        let part = |part: &str| (!part.is_empty()).then(|| part.to_owned());
        let selection = Self { target: part(target), fault: part(fault), moment: part(moment) };
        match crate::matrix::whole().iter().any(|cell| selection.selects(cell)) {
            true => Ok(selection),
            false => Err(UnknownSelection(text.into())),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn parts_that_are_left_out_select_everything_and_what_selects_nothing_is_refused() {
        let count = |text: &str| {
            let selection: Selection = text.parse().unwrap();
            crate::matrix::whole().iter().filter(|cell| selection.selects(cell)).count()
        };
        assert_eq!(count("fields:kill@moving"), 1);
        assert!(count("kill") > count("kill@moving") && count("kill@moving") > 1);
        assert!(count("control:") > 10 && count("@idle") > 10);
        assert!("fields:melt".parse::<Selection>().is_err());
    }
}

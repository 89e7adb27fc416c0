//! Names of report folders: date and time (UTC), so that they sort by age.

use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

/// A folder for a report below `parent` that does not exist yet.
pub fn unused_report_folder(parent: &Path) -> PathBuf {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let name = date_and_time(seconds);
    let numbered = |count: u32| match count {
        1 => parent.join(&name),
        _ => parent.join(format!("{name}-{count}")),
    };
    (1..).map(numbered).find(|folder| !folder.exists()).unwrap_or_else(|| parent.join(name))
}

/// `seconds` since 1970 as `2026-11-21T09-02-43Z`.
fn date_and_time(seconds: u64) -> String {
    let (days, rest) = (seconds / 86_400, seconds % 86_400);
    let (year, month, day) = date(days);
    format!("{year:04}-{month:02}-{day:02}T{:02}-{:02}-{:02}Z", rest / 3600, rest / 60 % 60, rest % 60)
}

/// Year, month and day of the Gregorian calendar, `days` after 1970-01-01.
fn date(days: u64) -> (u64, u64, u64) {
    let leap = |year: u64| year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    let (mut year, mut left) = (1970, days);
    while left >= 365 + u64::from(leap(year)) {
        left -= 365 + u64::from(leap(year));
        year += 1;
    }
    let february = 28 + u64::from(leap(year));
    let mut month = 1;
    for length in [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31] {
        if left < length {
            break;
        }
        left -= length;
        month += 1;
    }
    (year, month, left + 1)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        assert_eq!(date_and_time(0), "1970-01-01T00-00-00Z");
        assert_eq!(date_and_time(951_782_399), "2000-02-28T23-59-59Z");
        assert_eq!(date_and_time(951_782_400), "2000-02-29T00-00-00Z");
        assert_eq!(date_and_time(1_709_251_200), "2024-03-01T00-00-00Z");
        assert_eq!(date_and_time(1_798_761_599), "2026-12-31T23-59-59Z");
    }

    #[test]
    fn a_folder_that_exists_is_not_named_again() {
        let parent = std::env::temp_dir().join(format!("folder-name-{}", std::process::id()));
        let first = unused_report_folder(&parent);
        std::fs::create_dir_all(&first).unwrap();
        let second = unused_report_folder(&parent);
        std::fs::remove_dir_all(&parent).unwrap();
        assert_ne!(first, second);
    }
}

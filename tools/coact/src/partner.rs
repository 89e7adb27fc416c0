use std::path::Path;

/// The setting of a `--partner`: its path is absolute, for processes run elsewhere, and `recorded` alone means the
/// shipped `reaches`. What makes no sense is left for the world to refuse.
pub fn setting(partner: &str, reaches: &Path) -> String {
    match partner.split_once(':') {
        None if partner == "recorded" => format!("recorded:{}", reaches.display()),
        Some((kind @ ("script" | "recorded" | "left-arm" | "right-arm"), path)) => {
            match std::path::absolute(Path::new(path)) {
                Ok(path) => format!("{kind}:{}", path.display()),
                Err(_) => partner.to_owned(),
            }
        }
        _ => partner.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn absolute(partner: &str) -> String {
        setting(partner, Path::new("/shipped/reaches"))
    }

    #[test]
    fn paths_become_absolute_and_all_else_stays() {
        let here = std::env::current_dir().unwrap();
        assert_eq!(absolute("recorded:reaches"), format!("recorded:{}/reaches", here.display()));
        assert_eq!(absolute("right-arm:a.csv"), format!("right-arm:{}/a.csv", here.display()));
        assert_eq!(absolute("script:/a/b"), "script:/a/b");
        for other in ["synthetic", "random:goal=0.1", "human", "script:", ""] {
            assert_eq!(absolute(other), other);
        }
    }

    #[test]
    fn a_recorded_partner_without_a_folder_is_one_of_the_shipped_people() {
        assert_eq!(absolute("recorded"), "recorded:/shipped/reaches");
    }
}

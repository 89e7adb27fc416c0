use std::path::Path;

/// A `--partner` with an absolute path: processes run elsewhere. What makes no sense is left for the world to refuse.
pub fn absolute(partner: &str) -> String {
    match partner.split_once(':') {
        Some((kind @ ("script" | "recorded"), path)) => match std::path::absolute(Path::new(path)) {
            Ok(path) => format!("{kind}:{}", path.display()),
            Err(_) => partner.to_owned(),
        },
        _ => partner.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn paths_become_absolute_and_all_else_stays() {
        let here = std::env::current_dir().unwrap();
        assert_eq!(absolute("recorded:reaches"), format!("recorded:{}/reaches", here.display()));
        assert_eq!(absolute("script:/a/b"), "script:/a/b");
        for other in ["synthetic", "random:goal=0.1", "human", "script:", ""] {
            assert_eq!(absolute(other), other);
        }
    }
}

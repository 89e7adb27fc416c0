use anyhow::{Context, Result, bail, ensure};
use std::path::Path;

/// Checks a `--partner` and makes its path absolute: processes run elsewhere.
///
/// # Errors
/// It is none of the three kinds, or what it names does not exist.
pub fn resolve(partner: &str) -> Result<String> {
    match partner.split_once(':') {
        None if partner == "synthetic" => Ok(partner.to_owned()),
        Some(("script", file)) => {
            let path = absolute(partner, file)?;
            ensure!(
                path.is_file(),
                "--partner {partner}: {} is not a file; expected a script",
                path.display()
            );
            Ok(format!("script:{}", path.display()))
        }
        Some(("recorded", folder)) => {
            let path = absolute(partner, folder)?;
            let path = path.display();
            ensure!(Path::new(folder).is_dir(), "--partner {partner}: {path} is not a folder of recordings");
            Ok(format!("recorded:{path}"))
        }
        _ => bail!("--partner {partner}: expected synthetic, script:FILE or recorded:DIR"),
    }
}

fn absolute(partner: &str, path: &str) -> Result<std::path::PathBuf> {
    Path::new(path).canonicalize().with_context(|| format!("--partner {partner}: {path}"))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn partners_that_exist_are_taken_with_absolute_paths() {
        assert_eq!(resolve("synthetic").unwrap(), "synthetic");
        let here = std::env::current_dir().unwrap();
        assert_eq!(resolve("recorded:.").unwrap(), format!("recorded:{}", here.display()));
        assert_eq!(resolve("script:Cargo.toml").unwrap(), format!("script:{}/Cargo.toml", here.display()));
    }

    #[test]
    fn other_partners_are_refused_with_what_was_expected() {
        for partner in ["", "human", "film:x", "script", "synthetic:1"] {
            assert!(resolve(partner).unwrap_err().to_string().contains("expected synthetic, script:FILE"));
        }
        assert!(format!("{:#}", resolve("script:/no/such").unwrap_err()).contains("/no/such"));
        assert!(resolve("script:.").unwrap_err().to_string().contains("not a file"));
        assert!(resolve("recorded:Cargo.toml").unwrap_err().to_string().contains("not a folder"));
    }
}

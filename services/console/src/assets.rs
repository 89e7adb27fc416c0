//! The files of the page, which are part of the program: a console needs nothing but itself.

/// The bytes of a file of the page, and their type; none when there is no such file.
pub(crate) fn find(path: &str) -> Option<(&'static [u8], &'static str)> {
    let name = if path == "/" { "index.html" } else { path.strip_prefix('/')? };
    let (_, bytes) = FILES.iter().find(|(own, _)| *own == name)?;
    let kind = match name.rsplit('.').next() {
        Some("html") => "text/html; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("svg") => "image/svg+xml",
        _ => "application/octet-stream",
    };
    Some((bytes, kind))
}

/// All files, by their names in the folder `page`: the build script lists them.
static FILES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/page.rs"));

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_page_names_is_there_and_nothing_else() {
        let (page, kind) = find("/").unwrap_or_default();
        assert!(kind.starts_with("text/html") && page.starts_with(b"<!doctype html>"));
        assert!(find("/style.css").is_some());
        for path in ["", "index.html", "/../Cargo.toml", "/none.js", "//index.html"] {
            assert!(find(path).is_none(), "{path}");
        }
        let bytes: usize = FILES.iter().map(|(_, bytes)| bytes.len()).sum();
        assert!(bytes < 1_000_000, "{bytes}");
    }
}

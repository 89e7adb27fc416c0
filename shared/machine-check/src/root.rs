use std::path::{Path, PathBuf};

/// The folder below which `/proc`, `/sys` and `/dev` are read.
pub(crate) struct Root<'a>(pub(crate) &'a Path);

impl Root<'_> {
    pub(crate) fn path(&self, path: &str) -> PathBuf {
        self.0.join(path.trim_start_matches('/'))
    }

    /// A file's text without the white space around it; none where it is not there or not allowed.
    pub(crate) fn text(&self, path: &str) -> Option<String> {
        std::fs::read_to_string(self.path(path)).ok().map(|text| text.trim().to_owned())
    }

    /// Names of what is in a folder.
    pub(crate) fn names(&self, folder: &str) -> Vec<String> {
        let entries = std::fs::read_dir(self.path(folder)).into_iter().flatten().flatten();
        let mut names: Vec<_> =
            entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}

/// Whether a list of the kernel's, as in "0-2,5", contains a number.
pub(crate) fn contains(list: &str, number: usize) -> bool {
    list.trim().split(',').any(|part| {
        let (first, last) = part.split_once('-').unwrap_or((part, part));
        matches!((first.parse(), last.parse()), (Ok(first), Ok(last)) if (first..=last).contains(&number))
    })
}

/// Whether a mask of the kernel's, as in "3" or "ff,00000001" (hexadecimal words of 32 bits, the highest first), contains a number.
pub(crate) fn mask_contains(mask: &str, number: usize) -> bool {
    let word = mask.trim().rsplit(',').nth(number / 32).and_then(|word| u32::from_str_radix(word, 16).ok());
    word.is_some_and(|word| word >> (number % 32) & 1 == 1)
}

#[cfg(test)]
mod tests {
    use super::{contains, mask_contains};

    #[test]
    fn masks_of_the_kernel_have_words() {
        assert!(
            mask_contains("2\n", 1) && mask_contains("ff,00000001", 0) && mask_contains("ff,00000001", 39)
        );
        assert!(!mask_contains("2", 0) && !mask_contains("ff,00000001", 40) && !mask_contains("1", 64));
        assert!(!mask_contains("", 0) && !mask_contains("none", 0));
    }

    #[test]
    fn lists_of_the_kernel_have_ranges() {
        assert!(contains("0-2,5\n", 2) && contains("0-2,5", 5));
        assert!(!contains("0-2,5", 3) && !contains("", 0) && !contains("none", 0));
    }
}

//! The interface of regex, by regex-lite.

pub use regex_lite::*;

//! Empty: no build script of a system that we run on calls bindgen.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| coact_fuzz_targets::run("recorded-ways", bytes));

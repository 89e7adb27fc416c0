//! The program `coact`.

fn main() -> std::process::ExitCode {
    coact::run_program()
}

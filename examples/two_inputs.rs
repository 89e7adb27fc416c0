//! A field decides between two inputs: only one peak can stand, and it stands on when the other input becomes a little
//! stronger.
//!
//! `cargo run -p coact-examples --example two_inputs`

use coact_neural_field::{Field, Kernel, ParameterError, Parameters};

/// Two things that could be decided for: one population each.
const NAMES: [&str; 2] = ["left", "right"];
/// Resting level h; the threshold is 0.
const RESTING: f64 = -3.0;

fn main() -> Result<(), ParameterError> {
    // Excitation that reaches a few sites, and inhibition that reaches everywhere: so all populations compete. The values
    // are those of the layer AEL in rt-config/joint-action.toml; with an inhibition of 0.5, both peaks would stand.
    let kernel = Kernel { amplitude: 3.0, sigma: 2.0, inhibition: 1.5, range: None };
    let parameters =
        Parameters { tau: 20.0, slope: 5.0, threshold: 0.0, spacing: 1.0, input_sigma: 2.0, kernel };
    let mut field = Field::new(parameters, NAMES.len(), 10)?;

    // The caller owns the activation: one step reads one buffer and writes the other.
    let (mut now, mut next) = (vec![RESTING; field.sites()], vec![0.0; field.sites()]);
    let (mut input, mut signal) = (vec![0.0; field.sites()], [0.0; 2]);

    // Each phase: what it shows, and the strength of both inputs. A step is 1 ms.
    let phases = [
        ("nothing", [0.0, 0.0]),
        ("both, left a little stronger", [4.2, 4.0]),
        ("both, right a little stronger", [4.0, 4.2]),
        ("right alone", [0.0, 4.2]),
    ];
    for (what, strength) in phases {
        for _ in 0..400 {
            field.spread(&strength, &mut input);
            field.step(1.0, &now, &input, &[RESTING; 2], &mut next);
            std::mem::swap(&mut now, &mut next);
        }
        field.signals(&now, &mut signal);
        println!("{what:30} left {:.2} right {:.2}  decision: {}", signal[0], signal[1], decision(&signal));
    }
    Ok(())
}

/// The population whose peak stands. A signal is 0 below the threshold, and grows to 1 with its peak.
fn decision(signal: &[f64; 2]) -> &'static str {
    match signal.map(|signal| signal > 0.5) {
        [true, false] => NAMES[0],
        [false, true] => NAMES[1],
        [false, false] => "none",
        [true, true] => "both",
    }
}

use super::fake_robot::FakeRobot;
use super::{Out, world};
use coact_messages::{KeypointName, PartnerPhase};
use coact_person::{Activity, FINGERS};
use glam::DVec3;
use std::sync::LazyLock;

/// One reach for a part as it went, tick by tick.
struct Reach {
    width: f64,
    wrist: Vec<DVec3>,
    aperture: Vec<f64>,
    pitch: Vec<f64>,
    wanted_pitch: f64,
}

/// The reaches of eight runs of five minutes each.
static REACHES: LazyLock<Vec<Reach>> = LazyLock::new(|| reaches(0..8));

/// The reaches for parts on the table, from rest, in five minutes of each of several runs.
fn reaches(seeds: std::ops::Range<u64>) -> Vec<Reach> {
    let mut all = Vec::new();
    for seed in seeds {
        let (mut world, mut robot, mut out) = (world(seed), FakeRobot::new(), Out::new());
        let mut now: Option<Reach> = None;
        for tick in 1..=300_000 {
            robot.step(tick, &mut world, &mut out);
            let person = &world.simulation.person;
            if out.truth.phase == PartnerPhase::Reach as u32
                && let Some(part) = person.part.get()
                && person.activity() != Activity::Receive
            {
                let points = world.person.keypoints(person, tick);
                let at = |name: KeypointName| points[name as usize];
                let reach = now.get_or_insert_with(|| Reach {
                    width: world.task.kinds[world.parts.kind(part)].width,
                    wrist: Vec::new(),
                    aperture: Vec::new(),
                    pitch: Vec::new(),
                    wanted_pitch: person.movement.to.pitch,
                });
                reach.wrist.push(at(KeypointName::Wrist));
                reach.aperture.push(at(KeypointName::ThumbTip).distance(at(KeypointName::IndexTip)));
                reach.pitch.push(person.hand.pitch);
            } else if let Some(reach) = now.take()
                && out.truth.grasp_cycle > 0
            {
                all.push(reach);
            }
        }
    }
    all
}

fn quantile(mut values: Vec<f64>, fraction: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * fraction).round() as usize]
}

#[test]
fn movement_times_are_distributed_as_in_the_recordings() {
    let times: Vec<f64> = REACHES.iter().map(|reach| reach.wrist.len() as f64).collect();
    assert!(times.len() > 100, "{} reaches", times.len());
    assert!((quantile(times.clone(), 0.5) - 530.0).abs() < 25.0, "median {}", quantile(times.clone(), 0.5));
    assert!((quantile(times.clone(), 0.05) - 429.0).abs() < 35.0, "p5 {}", quantile(times.clone(), 0.05));
    assert!((quantile(times.clone(), 0.95) - 743.0).abs() < 80.0, "p95 {}", quantile(times.clone(), 0.95));
    assert!(times.iter().all(|time| (340.0..=900.0).contains(time)));
}

#[test]
fn wrist_is_fastest_before_half_time_and_slow_from_three_quarters_on() {
    let reaches = &*REACHES;
    let peaks = reaches.iter().map(|reach| {
        let speed: Vec<f64> = reach.wrist.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
        let peak = (0..speed.len()).max_by(|a, b| speed[*a].total_cmp(&speed[*b])).unwrap();
        let slow = &speed[speed.len() * 3 / 4..];
        (peak as f64 / speed.len() as f64, slow.iter().sum::<f64>() / slow.len() as f64 / speed[peak])
    });
    let (time, slow): (Vec<f64>, Vec<f64>) = peaks.unzip();
    let median = quantile(time, 0.5);
    assert!((0.25..0.45).contains(&median), "fastest at {median} of movement time");
    let slow = quantile(slow, 0.5);
    assert!(slow < 0.25, "{slow} of the peak speed after 75 % of movement time");
}

#[test]
fn wrist_covers_the_way_as_in_the_recordings() {
    let recorded =
        [(0.1, 0.122), (0.2, 0.257), (0.3, 0.397), (0.4, 0.544), (0.5, 0.675), (0.75, 0.896), (0.9, 0.975)];
    let reaches = &*REACHES;
    for (time, median) in recorded {
        let covered = reaches.iter().map(|reach| {
            let (first, last) = (reach.wrist[0], *reach.wrist.last().unwrap());
            let now = reach.wrist[(time * reach.wrist.len() as f64) as usize];
            (now - first).dot(last - first) / (last - first).length_squared()
        });
        let covered = quantile(covered.collect(), 0.5);
        assert!(
            (covered - median).abs() < 0.08,
            "{covered} of the way at {time} of movement time, not {median}"
        );
    }
}

#[test]
fn aperture_peaks_at_two_thirds_grows_with_the_part_and_ends_on_it() {
    let reaches = &*REACHES;
    let peak = |reach: &Reach| {
        let (time, aperture) =
            reach.aperture.iter().enumerate().max_by(|one, other| one.1.total_cmp(other.1)).unwrap();
        (time as f64 / reach.aperture.len() as f64, *aperture)
    };
    let time = quantile(reaches.iter().map(|reach| peak(reach).0).collect(), 0.5);
    assert!((0.62..0.72).contains(&time), "largest aperture at {time} of movement time");
    let mean = |width: f64| {
        let of_width: Vec<f64> =
            reaches.iter().filter(|reach| reach.width == width).map(|reach| peak(reach).1).collect();
        assert!(of_width.len() > 5, "{} reaches for {width} m", of_width.len());
        of_width.iter().sum::<f64>() / of_width.len() as f64
    };
    let slope = (mean(0.075) - mean(0.055)) / 0.02;
    assert!((0.6..1.0).contains(&slope), "aperture grows by {slope} with width");
    for reach in reaches {
        assert!((reach.aperture.last().unwrap() - reach.width - FINGERS).abs() < 0.003, "{} m", reach.width);
    }
}

#[test]
fn grip_shows_in_the_pitch_long_before_contact() {
    let (mut right, mut all) = (0, 0);
    for reach in &*REACHES {
        let at = |fraction: f64| reach.pitch[(reach.pitch.len() as f64 * fraction) as usize];
        let middle = -0.74;
        all += 1;
        right += i32::from((at(0.6) < middle) == (reach.wanted_pitch < middle));
    }
    assert!(all > 40 && right * 100 >= all * 95, "{right} of {all} grips visible at 60 % of movement time");
}

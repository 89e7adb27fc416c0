//! Four processes in a chain like the real set's, with steps that do nothing: measures what the shell itself costs.
//!
//! `cargo run --release -p coact-realtime --example hop -- [SECONDS] [WORLD,PERCEPTION,FIELDS,CONTROL cores]`
//!
//! Prints the percentiles of wake-up lateness, hop and end to end, from the processes' own pulses.

use coact_messages::{Command, FieldFrame, Header, Percept, Pulse, SensorSample, topic};
use coact_pipeline::{Pipeline, Run, RunSettings};
use coact_realtime::{Bus, Cycle, Input, Message, Output, PortError, Process, Tick, TopicAnchors, now};
use hdrhistogram::Histogram;
use std::error::Error;
use std::process::{Child, Command as Program};
use std::time::{Duration, Instant};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// In which variable a copy of this program finds the name of the process that it is to be.
const ROLE: &str = "COACT_HOP_ROLE";
const NAMES: [&str; 4] = ["world", "perception", "fields", "control"];
/// From "all are ready" to tick 0: every process has seen the start by then. Chosen by hand.
const START_DELAY: Duration = Duration::from_millis(20);
/// Longest latency that the histograms take: far more than a machine is ever late.
const LONGEST: Duration = Duration::from_secs(1);
const MICROSECONDS_PER_SECOND: f64 = 1e6;
/// Significant digits of the histograms, as in the monitor's.
const DIGITS: u8 = 3;

/// Takes the trigger's newest message and publishes one of its own.
struct Relay<In: Message, Out: Message> {
    input: Input<In>,
    output: Output<Out>,
}

impl<In: Message, Out: Message> Cycle for Relay<In, Out> {
    type Trigger = In;

    fn trigger(&mut self) -> &mut Input<In> {
        &mut self.input
    }

    fn step(&mut self, tick: Tick) -> Result<Header, PortError> {
        let is_source = self.output.topic() == topic::SENSORS;
        let sensor_ns =
            if is_source { now() } else { self.input.header().map_or(0, |header| header.sensor_ns) };
        self.output.loan()?.send(tick.cycle, sensor_ns)
    }
}

fn relay<In: Message, Out: Message>(process: Process, from: &str, to: &str) -> Outcome<()> {
    let cycle = Relay::<In, Out> { input: process.bus().trigger(from)?, output: process.bus().output(to)? };
    Ok(process.run_cycles(cycle)?)
}

fn main() -> Outcome<()> {
    let Ok(role) = std::env::var(ROLE) else { return measure() };
    let process = Process::from_arguments(&role)?;
    match role.as_str() {
        "world" => relay::<Command, SensorSample>(process, topic::COMMAND, topic::SENSORS),
        "perception" => relay::<SensorSample, Percept>(process, topic::SENSORS, topic::PERCEPT),
        "fields" => relay::<Percept, FieldFrame>(process, topic::PERCEPT, topic::FIELDS),
        _ => relay::<FieldFrame, Command>(process, topic::FIELDS, topic::COMMAND),
    }
}

fn measure() -> Outcome<()> {
    let seconds = std::env::args().nth(1).map_or(Ok(10), |text| text.parse::<u64>())?;
    let cores = std::env::args().nth(2).unwrap_or_else(|| "0,1,1,1".to_owned());
    let table = std::env::temp_dir().join(format!("coact-hop-{}.toml", std::process::id()));
    std::fs::write(&table, process_table(&cores))?;
    let run = Run::create(RunSettings { pipeline: table.clone(), ..RunSettings::default() })?;
    let outcome = measure_run(&run, seconds);
    std::fs::remove_file(&table)?;
    run.remove()?;
    outcome
}

fn measure_run(run: &Run, seconds: u64) -> Outcome<()> {
    let pipeline = Pipeline::load(&run.settings().pipeline)?;
    let supervisor = Bus::open(run, "supervisor", 0)?;
    let _anchors = TopicAnchors::new(&supervisor, &pipeline)?;
    let mut children = NAMES.map(|name| spawn(run, name)).into_iter().collect::<Outcome<Vec<_>>>()?;
    let pulses = NAMES.map(|name| supervisor.input::<Pulse>(&topic::pulse(name)));
    let mut pulses = pulses.into_iter().collect::<Result<Vec<_>, _>>()?;
    let counted = wait_until_ready(run).and_then(|()| {
        run.start(now() + START_DELAY.as_nanos() as u64)?;
        collect(&mut pulses, Duration::from_secs(seconds))
    });
    children.iter_mut().for_each(stop);
    counted
}

fn spawn(run: &Run, name: &str) -> Outcome<Child> {
    let mut program = Program::new(std::env::current_exe()?);
    Ok(program.arg("--run").arg(run.directory()).env(ROLE, name).spawn()?)
}

fn wait_until_ready(run: &Run) -> Outcome<()> {
    for name in NAMES {
        let ready = loop {
            match run.ready(name, 0)? {
                Some(ready) => break ready,
                None => std::thread::sleep(Duration::from_millis(5)),
            }
        };
        println!(
            "{name:12} {} {} core {:?} {}",
            ready.scheduler,
            ready.priority,
            ready.core,
            ready.why_not.join("; ")
        );
    }
    Ok(())
}

fn collect(pulses: &mut [Input<Pulse>], duration: Duration) -> Outcome<()> {
    let histogram = || Histogram::<u64>::new_with_max(LONGEST.as_nanos() as u64, DIGITS);
    let mut late = NAMES.map(|_| histogram()).into_iter().collect::<Result<Vec<_>, _>>()?;
    let mut hop = late.clone();
    let mut end_to_end = histogram()?;
    let mut last = [Pulse::default(); NAMES.len()];
    let until = Instant::now() + duration;
    while Instant::now() < until {
        std::thread::sleep(Duration::from_millis(50));
        for (index, input) in pulses.iter_mut().enumerate() {
            input.each(|pulse| {
                last[index] = *pulse;
                late[index] += pulse.started_ns.saturating_sub(pulse.scheduled_ns);
                if pulse.input_received_ns > 0 {
                    hop[index] += pulse.input_received_ns.saturating_sub(pulse.input_published_ns);
                }
                if index == NAMES.len() - 1 && pulse.header.sensor_ns > 0 {
                    end_to_end += pulse.header.published_ns.saturating_sub(pulse.header.sensor_ns);
                }
            })?;
        }
    }
    println!("\n{:24}{:>9}{:>9}{:>9}{:>9}{:>9}   (us)", "", "count", "p50", "p99", "p99.9", "max");
    for (index, name) in NAMES.iter().enumerate() {
        print(&format!("{name} wake-up"), &late[index]);
        if index > 0 {
            print(&format!("{} -> {name}", NAMES[index - 1]), &hop[index]);
        }
    }
    print("end to end", &end_to_end);
    for (name, Pulse { missed, stale, skipped, .. }) in NAMES.iter().zip(last) {
        println!("{name:12} missed {missed}, stale {stale}, skipped {skipped}");
    }
    Ok(())
}

fn print(label: &str, histogram: &Histogram<u64>) {
    let at = |quantile| {
        Duration::from_nanos(histogram.value_at_quantile(quantile)).as_secs_f64() * MICROSECONDS_PER_SECOND
    };
    let (p50, p99, p999, max) = (at(0.5), at(0.99), at(0.999), at(1.0));
    println!("{label:24}{:9}{p50:9.1}{p99:9.1}{p999:9.1}{max:9.1}", histogram.len());
}

fn stop(child: &mut Child) {
    if let Some(pid) = i32::try_from(child.id()).ok().and_then(rustix::process::Pid::from_raw) {
        let _ = rustix::process::kill_process(pid, rustix::process::Signal::TERM);
    }
    let _ = child.wait();
}

fn process_table(cores: &str) -> String {
    let triggers = ["timer", topic::SENSORS, topic::PERCEPT, topic::FIELDS];
    let priorities = [83, 82, 81, 84];
    let entries = NAMES.iter().zip(triggers).zip(priorities).zip(cores.split(',')).enumerate();
    let entries = entries.map(|(index, (((name, trigger), priority), core))| {
        // Offsets in µs, one stage after another, all of them within the period; chosen by hand.
        let latest = 500 + 100 * index;
        format!(
            "[[process]]\nname = \"{name}\"\nprogram = \"hop\"\norder = 1\nrealtime = true\npriority = {priority}\n\
             core = {core}\ntrigger = \"{trigger}\"\nlatest_start_us = {latest}\n"
        )
    });
    entries.collect()
}

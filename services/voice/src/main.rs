//! The voice as a process: watches what the fields decide and what the arm does, publishes and prints what the robot says.

use coact_joint_task::NetworkPlan;
use coact_messages::{Command, FieldFrame, Percept, Speech, topic};
use coact_realtime::{Output, PortError, Process};
use coact_voice::{Meanings, Sentence, Speaker, Standstill, Voice};
use std::time::Duration;

/// How often the fields are looked at: speech has time.
const LOOK_EVERY: Duration = Duration::from_millis(10);

fn main() -> anyhow::Result<()> {
    let mut process = Process::from_arguments("voice")?;
    let (task, plan) = NetworkPlan::load(&process.run().settings().task)?;
    let mut voice = Voice::new(&task, Meanings::from(&plan));
    let mut fields = process.bus().input::<FieldFrame>(topic::FIELDS)?;
    let mut percepts = process.bus().input::<Percept>(topic::PERCEPT)?;
    let mut commands = process.bus().input::<Command>(topic::COMMAND)?;
    let mut speech = process.bus().output::<Speech>(topic::SPEECH)?;
    let mut standstill = Standstill::default();
    let mut speaker = Speaker::from_environment();
    process.report_ready()?;
    let mut heartbeat = process.heartbeat()?;
    while !process.stop_requested() {
        heartbeat.beat()?;
        std::thread::sleep(LOOK_EVERY);
        let (decides, moves) = (fields.refresh()?, commands.refresh()?);
        percepts.refresh()?;
        process.warn_of_refusals();
        let frame = fields.latest().filter(|_| decides);
        let of_fields = frame.and_then(|frame| Some((voice.observe(frame)?, frame.header.sensor_ns)));
        let command = commands.latest().filter(|_| moves);
        let of_arm = command.zip(percepts.latest()).and_then(|(command, percept)| {
            Some((standstill.observe(command, percept)?, command.header.sensor_ns))
        });
        for (sentence, sensor_ns) in of_fields.into_iter().chain(of_arm) {
            tracing::info!("{}", sentence.text);
            publish(&mut speech, &sentence, sensor_ns)?;
            speaker.say(&sentence.text);
        }
    }
    Ok(())
}

fn publish(speech: &mut Output<Speech>, sentence: &Sentence, sensor_ns: u64) -> Result<(), PortError> {
    let mut message = speech.loan()?;
    message.write(&sentence.text);
    message.send(sentence.cycle, sensor_ns)?;
    Ok(())
}

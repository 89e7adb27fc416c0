//! The voice as a process: watches the field frames, publishes and prints what the robot says.

use coact_joint_task::NetworkPlan;
use coact_messages::{FieldFrame, Speech, topic};
use coact_realtime::{Output, PortError, Process};
use coact_voice::{Meanings, Sentence, Speaker, Voice};
use std::time::Duration;

/// How often the fields are looked at: speech has time.
const LOOK_EVERY: Duration = Duration::from_millis(10);

fn main() -> anyhow::Result<()> {
    let mut process = Process::from_arguments("voice")?;
    let (task, plan) = NetworkPlan::load(&process.run().settings().task)?;
    let mut voice = Voice::new(&task, Meanings::from(&plan));
    let mut fields = process.bus().input::<FieldFrame>(topic::FIELDS)?;
    let mut speech = process.bus().output::<Speech>(topic::SPEECH)?;
    let mut speaker = Speaker::from_environment();
    process.report_ready()?;
    let mut heartbeat = process.heartbeat()?;
    while !process.stop_requested() {
        heartbeat.beat()?;
        std::thread::sleep(LOOK_EVERY);
        let is_news = fields.refresh()?;
        process.warn_of_refusals();
        if !is_news {
            continue;
        }
        let Some(frame) = fields.latest() else { continue };
        if let Some(sentence) = voice.observe(frame) {
            tracing::info!("{}", sentence.text);
            publish(&mut speech, &sentence, frame.header.sensor_ns)?;
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

//! What is written is read again; what is cut off, damaged or foreign is read as far as it goes, or refused in words.
#![allow(clippy::unwrap_used)]

use coact_messages::{LAYOUT, Percept, Pulse, topic};
use coact_pipeline::RunSettings;
use coact_run_recording::{JsonSchema, Origin, Recorded, Recording, RecordingError, RecordingWriter};
use std::path::{Path, PathBuf};

fn origin() -> Origin {
    let settings = RunSettings { task: "/a/task.toml".into(), seed: 7, ..RunSettings::default() };
    let mut origin = Origin { settings, start_ns: 5, clock_offset_ns: 100, ..Origin::default() };
    (origin.version, origin.code) = (Origin::VERSION.to_owned(), Origin::CODE.to_owned());
    origin.files.insert("/a/task.toml".as_ref(), b"name = \"a task\"\n".to_vec());
    origin
}

fn percept(cycle: u64) -> Recorded {
    let mut percept: Box<Percept> = bytemuck::zeroed_box();
    (percept.header.layout, percept.header.cycle, percept.header.sequence) = (LAYOUT, cycle, cycle);
    percept.act[2] = cycle as f64;
    Recorded::Percept(percept)
}

fn write(path: &Path, cycles: u64) -> RecordingWriter {
    let mut writer = RecordingWriter::create(path, &origin()).unwrap();
    let schema = JsonSchema { name: "foxglove.Log", text: "{\"type\":\"object\"}".to_owned() };
    for cycle in 0..cycles {
        writer.message(&percept(cycle)).unwrap();
        writer.json("/log", &schema, cycle, &"a line".into()).unwrap();
        let pulse = Recorded::Pulse { process: "fields".to_owned(), pulse: Box::new(Pulse::default()) };
        writer.message(&pulse).unwrap();
        writer.flush().unwrap();
    }
    writer
}

/// The cycles of the percepts that can be read, and whether the file ends in the middle.
fn read(path: &Path) -> Result<(Vec<u64>, bool), RecordingError> {
    let mut recording = Recording::open(path)?;
    let mut cycles = Vec::new();
    while let Some(message) = recording.next_message()? {
        if let Recorded::Percept(percept) = message {
            assert_eq!(percept.act[2], percept.header.cycle as f64);
            cycles.push(percept.header.cycle);
        }
    }
    Ok((cycles, recording.is_truncated()))
}

fn file(folder: &tempfile::TempDir) -> PathBuf {
    folder.path().join("run.mcap")
}

#[test]
fn messages_settings_files_and_losses_come_back_and_what_others_read_is_left_out() {
    let folder = tempfile::tempdir().unwrap();
    write(&file(&folder), 3).finish(&[(topic::SENSORS.to_owned(), 4)].into()).unwrap();
    let mut recording = Recording::open(&file(&folder)).unwrap();
    assert_eq!(
        (&recording.origin().settings, &recording.origin().files),
        (&origin().settings, &origin().files)
    );
    assert!(recording.origin().is_of_this_code());
    let mut topics = Vec::new();
    while let Some(message) = recording.next_message().unwrap() {
        topics.push(message.topic());
    }
    assert_eq!(topics, ["coact/percept", "coact/pulse/fields"].repeat(3));
    assert_eq!(recording.lost().unwrap()[topic::SENSORS], 4);
}

#[test]
fn a_file_that_exists_is_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(file(&folder), "mine").unwrap();
    let refused = RecordingWriter::create(&file(&folder), &origin()).map(drop).unwrap_err();
    assert!(refused.to_string().contains("cannot be written"), "{refused}");
    assert_eq!(std::fs::read(file(&folder)).unwrap(), b"mine");
}

#[test]
fn what_was_flushed_survives_a_writer_that_is_killed() {
    let folder = tempfile::tempdir().unwrap();
    let mut writer = write(&file(&folder), 5);
    writer.message(&percept(5)).unwrap();
    std::mem::forget(writer);
    assert_eq!(read(&file(&folder)).unwrap(), (vec![0, 1, 2, 3, 4], true));
}

#[test]
fn a_file_that_is_cut_off_anywhere_is_read_up_to_there_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    write(&file(&folder), 4).finish(&[].into()).unwrap();
    let bytes = std::fs::read(file(&folder)).unwrap();
    let mut most = 0;
    for length in (0..bytes.len()).step_by(7) {
        std::fs::write(file(&folder), &bytes[..length]).unwrap();
        match read(&file(&folder)) {
            Ok((cycles, _)) => {
                assert!(
                    cycles.len() >= most && cycles.iter().copied().eq(0..cycles.len() as u64),
                    "{length}"
                );
                most = cycles.len();
            }
            Err(error) => {
                assert!(most == 0 && error.to_string().contains("what run it is of"), "{length}: {error}")
            }
        }
    }
    assert_eq!(most, 4);
}

#[test]
fn a_damaged_byte_is_noticed_by_the_checksum_of_its_chunk() {
    let folder = tempfile::tempdir().unwrap();
    write(&file(&folder), 1).finish(&[].into()).unwrap();
    let mut bytes = std::fs::read(file(&folder)).unwrap();
    // The percept's zeros are compressed into the longest row of equal bytes; the schema's text stands in the chunk as it is.
    let place = bytes.windows(9).position(|part| part == b"sensor_ns").unwrap();
    bytes[place] ^= 1;
    std::fs::write(file(&folder), &bytes).unwrap();
    let refused = read(&file(&folder)).unwrap_err().to_string();
    assert!(refused.contains("a chunk is damaged"), "{refused}");
}

#[test]
fn what_is_no_recording_is_refused_with_what_is_expected() {
    let folder = tempfile::tempdir().unwrap();
    for (bytes, expected) in
        [(&b"a text that is none"[..], "is no MCAP file"), (b"", "does not say what run it is of")]
    {
        std::fs::write(file(&folder), bytes).unwrap();
        let refused = read(&file(&folder)).unwrap_err().to_string();
        assert!(refused.contains(expected) && refused.contains("coact launch --record"), "{refused}");
    }
    let refused = read("/no/such/run.mcap".as_ref()).unwrap_err().to_string();
    assert!(refused.contains("/no/such/run.mcap"), "{refused}");
}

//! The recording of a run: changed bytes of one, with its checksums and without.

use crate::assembly::{INSTANTS, settings};
use crate::configuration::taken;
use crate::patch::{apply, which};
use crate::scratch::Scratch;
use coact_run_recording::{Origin, Recorded, Recording, RecordingWriter};
use std::sync::LazyLock;

/// A recording as it is written, and one whose chunks nobody has summed up: what is changed in them is looked at.
static GOOD: LazyLock<[Vec<u8>; 2]> = LazyLock::new(|| {
    let whole = written();
    let unchecked = without_checksums(whole.clone());
    [whole, unchecked]
});

fn written() -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.mcap");
    let mut origin = Origin { settings: settings(), ..Origin::default() };
    origin.files.insert("/a/task.toml".as_ref(), b"name = \"a task\"\n".to_vec());
    let mut writer = RecordingWriter::create(&path, &origin).unwrap();
    for instant in INSTANTS.iter() {
        writer.message(&Recorded::Sample(instant.sample.clone())).unwrap();
        writer.message(&Recorded::Percept(instant.percept.clone())).unwrap();
    }
    writer.finish(&[("coact/percept".to_owned(), 3)].into()).unwrap();
    std::fs::read(path).unwrap()
}

/// A chunk: its kind, and where its checksum stands behind the begin of its record: behind length, two times and a size.
const CHUNK: (u8, usize) = (6, 9 + 3 * 8);
/// What the file begins with.
const MAGIC: usize = 8;

fn without_checksums(mut file: Vec<u8>) -> Vec<u8> {
    let mut at = MAGIC;
    while let Some(length) = file.get(at + 1..).and_then(|rest| rest.first_chunk::<8>()).copied() {
        if file[at] == CHUNK.0 {
            file[at + CHUNK.1..][..4].fill(0);
        }
        at += 9 + u64::from_le_bytes(length) as usize;
        if at + MAGIC >= file.len() {
            break;
        }
    }
    file
}

pub(crate) fn run_recording(bytes: &[u8]) -> bool {
    let mut file = GOOD[which(bytes, GOOD.len())].clone();
    apply(&mut file, bytes);
    Scratch::with("run.mcap", &file, |path| {
        let Some(mut recording) = taken(Recording::open(path)) else { return false };
        loop {
            match taken(recording.next_message()) {
                Some(Some(message)) => assert!(!message.bytes().is_empty()),
                Some(None) => return true,
                None => return false,
            }
        }
    })
}

//! What is done with arbitrary bytes. Any panic outside of a contained decoder, any hang and any output that does not
//! hold what was read is a fault of the core; an error with a code is not.

mod chunk;
mod scratch;

use groma_core::error::Result;
use groma_core::input::contain::is_contained;
use groma_core::pipeline::options::Options;
use groma_core::pipeline::{Pipeline, Summary};
use groma_core::progress::Silent;
use groma_core::scan::Scan;
use scratch::Scratch;
use std::path::Path;

/// A scan with more points is not converted: it only costs time.
const MOST_POINTS: u64 = 200_000;

/// Bytes that a conversion may take.
const MEMORY: u64 = 256 << 20;

/// Panics of decoders that the core contains are errors of the input; every other one ends the process.
pub fn abort_on_panic() {
    let panic = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        if !is_contained() {
            panic(info);
            std::process::abort();
        }
    }));
}

/// Reads header and records.
pub fn scan(data: &[u8]) {
    Scratch::with(|scratch| {
        if let Ok(scan) = Scan::read(&scratch.input(data)) {
            let _ = scan.describe();
        }
    });
}

/// Converts, and converts the result again: it must be accepted and have as many points.
pub fn convert(data: &[u8]) {
    Scratch::with(|scratch| {
        let input = scratch.input(data);
        if Scan::read(&input).map_or(true, |scan| scan.points > MOST_POINTS) {
            return;
        }
        let (once, twice) = (scratch.path("once.laz"), scratch.path("twice.laz"));
        match run(&input, &once) {
            Ok(summary) => {
                let again = run(&once, &twice).unwrap_or_else(|e| panic!("the output is refused: {e}"));
                assert_eq!(summary.points, again.points);
            }
            Err(error) => {
                assert!(!error.code().is_empty());
                assert!(!once.exists(), "half a file");
            }
        }
    });
}

/// Decodes the bytes as one LAZ chunk: the first says the format, the next two the number of points.
pub fn chunk(data: &[u8]) {
    if let Some(file) = chunk::file_around(data) {
        convert(&file);
    }
}

fn run(input: &Path, output: &Path) -> Result<Summary> {
    let options = Options {
        overwrite: true,
        threads: Some(1),
        memory: Some(MEMORY),
        ..Options::new(vec![input.to_path_buf()], output.to_path_buf())
    };
    Pipeline::scan(&options, &Silent)?.validate()?.distribute()?.build()?.write()
}

//! Reads all of a file, to find out whether it is as it was written.

use crate::error::{Error, Result};
use crate::input::{Pieces, Source};
use crate::threads;
use serde::Serialize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Damaged parts that an error names; of more, it gives the number.
const NAMED: usize = 3;

/// What was found in a file without damage.
#[derive(Debug, Serialize)]
pub struct Verified {
    event: &'static str,
    points: u64,
    /// Chunks that were read, or blocks of uncompressed points.
    parts: usize,
    /// Whether each of them was held against its checksum; otherwise its points were decoded.
    checksums: bool,
}

/// Reads every part of a file, on all processors.
///
/// Errors: `INPUT_CHECKSUM` or, of a file without checksums, `INPUT_CORRUPT`, with the first damaged parts; others where
/// the file cannot be read at all; `INPUT_TRUNCATED` where points are announced that are not in the file.
pub fn verify(source: Source) -> Result<Verified> {
    if let Some(rescued) = &source.rescued {
        return Err(rescued.refusal(&source.scan.path));
    }
    let parts = source.parts();
    let next = AtomicUsize::new(0);
    let faults: Mutex<Vec<(usize, Error)>> = Mutex::default();
    let work = || {
        let mut pieces = Pieces::default();
        loop {
            let part = next.fetch_add(1, Ordering::Relaxed);
            if part >= parts {
                return;
            }
            if let Err(error) = source.verify(part, &mut pieces) {
                faults.lock().unwrap_or_else(PoisonError::into_inner).push((part, error));
            }
        }
    };
    threads::on_each(threads::available().min(parts), work);
    let mut faults = faults.into_inner().unwrap_or_else(PoisonError::into_inner);
    faults.sort_by_key(|(part, _)| *part);
    let Some((_, first)) = faults.first() else {
        let checksums = source.has_checksums();
        return Ok(Verified { event: "verified", points: source.scan.points, parts, checksums });
    };
    if !matches!(first, Error::Checksum(_) | Error::Corrupt(_)) {
        return Err(first.clone());
    }
    let mut causes: Vec<_> = faults.iter().take(NAMED).map(|(_, error)| error.cause().to_string()).collect();
    if faults.len() > NAMED {
        causes.push(format!("{} more", faults.len() - NAMED));
    }
    let cause = format!("{} of {parts} parts are damaged: {}", faults.len(), causes.join("; "));
    let path = &source.scan.path;
    Err(if source.has_checksums() { Error::checksum(path, cause) } else { Error::corrupt(path, cause) })
}

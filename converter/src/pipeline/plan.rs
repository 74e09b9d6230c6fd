//! What a conversion will take, known before it reads a point.

use crate::build::{COMPRESSOR_BYTES, WorkerBudget, job_bytes};
use crate::distribute::{Inputs, pass};
use crate::error::{Error, Result};
use crate::input::Source;
use crate::memory::{Budget, FLOOR};
use crate::octree::limits::Limits;
use crate::sampling::Strategy;
use clap::ValueEnum;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Scratch files in the worst case, as a share of the uncompressed points: all of them, or what LAZ makes of points
/// that cannot be compressed, and the borders of the nodes.
const WORST_TEMP: f64 = 1.25;

/// What building holds in memory per point besides the distributed points: chunks, borders, what waits.
const BESIDES: f64 = 1.3;

/// Bytes of an uncompressed record that LAZ is expected to leave, where the inputs do not tell.
const COMPRESSED: f64 = 0.2;

/// What the LAZ chunks of an input may take, as a share of the memory, since they must be there as a whole.
const LARGEST_PART: u64 = 4;

/// What `--dry-run` prints.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Plan {
    pub event: &'static str,
    pub inputs: usize,
    pub points: u64,
    /// Bytes of a record of the output.
    pub record_length: usize,
    /// Levels of the octree, as far as the number of points tells.
    pub levels: u32,
    /// Cells that the points go to first, at most.
    pub cells: u64,
    /// Bytes that will be used at most.
    pub memory: u64,
    /// Bytes of scratch files in the worst case; 0 where memory suffices.
    pub temp_bytes: u64,
    pub temp_dir: PathBuf,
    /// Bytes that are free there; none where that is not known.
    pub temp_free: Option<u64>,
    /// Bytes of the output, estimated.
    pub output_bytes: u64,
    pub sampling: String,
    pub threads: usize,
}

/// How memory is shared out.
#[derive(Debug, Clone, Copy)]
pub struct Shares {
    /// Threads that read.
    pub readers: usize,
    pub force: WorkerBudget,
    /// Bytes in which points may wait.
    pub store: u64,
}

/// Shares out memory. Errors: `OPTION_MEMORY` where a single LAZ chunk takes too much of it.
pub fn shares(inputs: &Inputs, budget: Budget, threads: usize) -> Result<Shares> {
    if let Some(source) =
        inputs.sources.iter().find(|s| s.part_bytes() > budget.bytes().max(FLOOR) / LARGEST_PART)
    {
        let cause = format!(
            "{} has a LAZ chunk of {} MiB, which has to be in memory as a whole, and {} MiB may be used",
            source.scan.path.display(),
            source.part_bytes() >> 20,
            budget.bytes() >> 20
        );
        return Err(Error::option("MEMORY", cause));
    }
    let reading = budget.divide(threads, pass::worker_bytes(inputs));
    let compressing = budget.divide(threads, COMPRESSOR_BYTES);
    let cell = job_bytes(Limits::of(inputs.length).cell, inputs.length);
    let building = budget.divide(threads, cell);
    let store = building.store.saturating_sub(compressing.work).min(reading.store);
    let force = WorkerBudget { workers: compressing.workers, work: building.work };
    Ok(Shares { readers: reading.workers, force, store })
}

/// Scratch space that a conversion may need: none where everything has room in memory.
pub fn temp_bytes(inputs: &Inputs, shares: &Shares) -> u64 {
    let raw = inputs.points as f64 * inputs.length as f64;
    if raw * BESIDES <= shares.store as f64 { 0 } else { (raw * WORST_TEMP) as u64 }
}

/// What the stages take at most, with all points in memory that have room there.
fn working_bytes(inputs: &Inputs, shares: &Shares) -> u64 {
    let parts: usize = inputs.sources.iter().map(Source::parts).sum();
    let reading = (shares.readers.min(parts) as u64).saturating_mul(pass::worker_bytes(inputs));
    let building = shares.force.work.min(job_bytes(inputs.points, inputs.length));
    let is_leaf = inputs.points <= Limits::of(inputs.length).leaf;
    let compressing = if is_leaf { 1 } else { shares.force.workers as u64 } * COMPRESSOR_BYTES;
    let points = (inputs.points as f64 * inputs.length as f64 * BESIDES) as u64;
    reading.max(building + compressing).saturating_add(points)
}

/// Refuses a folder with too little room: `TEMP_SPACE`.
pub fn check_space(folder: &Path, needed: u64) -> Result<()> {
    match free(folder) {
        Some(free) if free < needed => {
            let cause =
                format!("up to {} MiB may be needed, {} MiB are free", needed.div_ceil(1 << 20), free >> 20);
            Err(Error::temp_space(folder, cause))
        }
        _ => Ok(()),
    }
}

/// Bytes that are free in a folder, where the system tells.
#[cfg(not(target_family = "wasm"))]
pub fn free(folder: &Path) -> Option<u64> {
    fs4::available_space(folder).ok()
}

#[cfg(target_family = "wasm")]
pub fn free(_folder: &Path) -> Option<u64> {
    None
}

/// The plan of a conversion.
pub fn plan(inputs: &Inputs, shares: &Shares, budget: Budget, temp_dir: &Path, sampling: Strategy) -> Plan {
    let limits = Limits::of(inputs.length);
    let first_level = inputs.first_plan().map_or(0, |plan| plan.level);
    let mut levels = 1;
    while inputs.points >> (2 * (levels - 1)) > limits.leaf {
        levels += 1;
    }
    let compressed = |source: &Source| {
        let scan = &source.scan;
        if scan.compressed {
            (scan.file_size - u64::from(scan.header.offset_to_point_data)) as f64
        } else {
            scan.points as f64 * inputs.length as f64 * COMPRESSED
        }
    };
    Plan {
        event: "plan",
        inputs: inputs.sources.len(),
        points: inputs.points,
        record_length: inputs.length,
        levels,
        cells: 1 << (2 * first_level),
        memory: budget.needed(working_bytes(inputs, shares)),
        temp_bytes: temp_bytes(inputs, shares),
        temp_dir: temp_dir.to_path_buf(),
        temp_free: free(temp_dir),
        output_bytes: inputs.sources.iter().map(compressed).sum::<f64>() as u64,
        sampling: sampling.to_possible_value().map_or_else(String::new, |value| value.get_name().to_string()),
        threads: shares.force.workers,
    }
}

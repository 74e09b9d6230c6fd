//! One pass over all inputs: parts are decoded and sorted by all threads, and arrive in the order of the input.

use super::Inputs;
use super::cells::Cells;
use super::ordered_parts::OrderedParts;
use super::sort::{Sorted, Sorter, Target};
use crate::error::Result;
use crate::input::{Pieces, piece_points};
use crate::octree::cube::Cube;
use crate::octree::place::Extent;
use crate::progress::Meter;
use crate::statistics::Tally;
use crate::temporary::store::Store;
use crate::threads;
use std::sync::atomic::{AtomicBool, Ordering};

/// Pieces that wait for their turn, per worker.
const WAITING: u64 = 2;

/// Buffers of that many pieces does a worker have: decoded, mapped, sorted.
const BUFFERS: u64 = 3;

/// What a decoder takes besides: models and layers of a LAZ chunk; and the sorter's table.
const DECODER: u64 = 12 << 20;

/// Where the points of a pass go to.
#[derive(Debug, Clone, Copy)]
pub struct Plan {
    /// All points lie within, if it is true.
    pub extent: Extent,
    pub cube: Cube,
    /// Level of the cells.
    pub level: u32,
}

/// What a pass has found.
pub struct Found {
    pub tally: Tally,
    pub extent: Extent,
    /// Empty if a point lay outside the plan's extent, or if there was no plan.
    pub cells: Cells,
    pub placed: bool,
}

/// Memory that a worker needs to read these inputs, the pieces that wait included.
pub fn worker_bytes(inputs: &Inputs) -> u64 {
    let part = inputs.sources.iter().map(|source| source.part_bytes()).max().unwrap_or(0);
    let piece = piece_points(inputs.length) * inputs.length;
    part * 2 + piece as u64 * (BUFFERS + WAITING) + DECODER
}

/// Reads everything. Without a plan, or once a point lies outside of it, only bounds and statistics are found.
pub fn read(
    inputs: &Inputs,
    plan: Option<&Plan>,
    workers: usize,
    store: &Store,
    meter: &Meter,
) -> Result<Found> {
    let parts: Vec<_> = inputs
        .sources
        .iter()
        .flat_map(|source| (0..source.parts()).map(move |part| (source, part)))
        .collect();
    let placed = AtomicBool::new(plan.is_some());
    let mut found = Found {
        tally: Tally::empty(inputs.fields.len()),
        extent: Extent::EMPTY,
        cells: Cells::default(),
        placed: true,
    };
    let take = |(tally, extent, sorted): (Tally, Extent, Option<Sorted>)| {
        found.tally.add(&tally);
        found.extent.join(&extent);
        match sorted {
            Some(sorted) if placed.load(Ordering::Relaxed) => {
                for run in &sorted.runs {
                    let records = &sorted.records[run.start..run.end];
                    found.cells.append(run.key, records, inputs.length, run.codes, store);
                }
                found.cells.relieve(store)
            }
            _ => {
                found.cells.clear(store);
                Ok(())
            }
        }
    };
    let ordered_parts = OrderedParts::new(parts.len(), workers * WAITING as usize, take);
    let work = || {
        let _watch = ordered_parts.watch();
        let (mut pieces, mut sorter) = (Pieces::default(), Sorter::default());
        while let Some(number) = ordered_parts.claim() {
            let (source, part) = parts[number];
            let read = source.read(part, &mut pieces, |records| {
                let tally = Tally::of(records, inputs.length, &inputs.fields);
                let extent = Extent::of(records, inputs.length);
                if plan.is_some_and(|plan| !plan.extent.contains(&extent)) {
                    placed.store(false, Ordering::Relaxed);
                }
                let sorted = plan.filter(|_| placed.load(Ordering::Relaxed)).map(|plan| {
                    let locator = inputs.frame.locator(&plan.cube);
                    let target = Target { locator, from: 0, to: plan.level };
                    sorter.sort(records, inputs.length, &target)
                });
                meter.add((records.len() / inputs.length) as u64);
                ordered_parts.give(number, (tally, extent, sorted))
            });
            if let Err(error) = read.and_then(|()| ordered_parts.end(number)) {
                ordered_parts.fail(error);
            }
        }
    };
    threads::on_each(workers.min(parts.len()), work);
    ordered_parts.finish().map(drop)?;
    found.placed = placed.into_inner();
    Ok(found)
}

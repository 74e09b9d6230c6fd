//! Building the octree from the leaves up, as in "Fast Out-of-Core Octree Generation for Massive Point Clouds"
//! (Schütz, Ohrhallinger, Wimmer 2020), with distances kept across the borders of nodes.
//!
//! A node with few points in all is a leaf and holds what its ancestors do not take. The points of any other node are
//! chosen among those that its children hold, and taken away from them. A node is finished, and its points
//! compressed, once its parent has chosen.
//!
//! Points with one and the same place in the finest grid of the root cube cannot be divided: such a *pile* begins at the
//! topmost node that holds no other points, with as many of its points as a node may hold. The others follow in
//! a chain of descendants, as many in each, or more where the levels down to the deepest do not suffice.
//!
//! The order of work makes the result the same for any number of threads: nodes whose samples depend on each other,
//! because they touch, are never worked on at the same time.

mod arrange;
mod bands;
mod board;
mod choose;
mod merge;
mod outline;
mod pile;
mod plan;
mod site;
mod split;
mod surroundings;

pub use site::{Node, Rules};

use crate::distribute::Inputs;
use crate::distribute::cells::Cells;
use crate::error::Result;
use crate::octree::cube::Cube;
use crate::octree::limits::Limits;
use crate::progress::Meter;
use crate::temporary::store::Store;
use board::{Board, Task};
use laz::LazVlr;
use plan::Job;
use site::{Desk, Site};

/// Bytes of working memory per point besides its record: code, order, candidate, and what sampling needs for it.
const POINT_BYTES: u64 = 80;

/// What compressing a node takes: its records, models and layers.
pub const COMPRESSOR_BYTES: u64 = 12 << 20;

/// Memory that building so many points at once takes.
pub fn job_bytes(points: u64, length: usize) -> u64 {
    points.saturating_mul(length as u64 + POINT_BYTES)
}

/// Threads and the bytes that they may use.
#[derive(Debug, Clone, Copy)]
pub struct Workforce {
    pub workers: usize,
    /// Bytes for all nodes that are being built.
    pub work: u64,
}

/// Builds all nodes. They come in no order; nodes without points are left out.
#[expect(clippy::too_many_arguments, reason = "all that a build is about, said once")]
pub fn build(
    inputs: &Inputs,
    cube: Cube,
    cells: Cells,
    rules: Rules,
    laz: &LazVlr,
    force: Workforce,
    store: &Store,
    meter: &Meter,
) -> Result<Vec<Node>> {
    let limits = Limits::of(inputs.length);
    let plan::Plan { phases, pending, outline } = plan::plan(cells, &limits);
    let bytes = |job: &Job| job_bytes(job.points(&limits), inputs.length);
    let board = Board::new(phases, bytes, force);
    let site = Site::new(inputs, cube, limits, rules, laz, store, meter, (pending, outline), &board);
    let work = || {
        let _watch = board.watch();
        let mut desk = Desk::default();
        while let Some(task) = board.next() {
            let done = match task {
                Task::Finish(finish) => site.compress(finish),
                Task::Job(job, bytes) => {
                    desk.arranger.begin(&site, job.key());
                    let done = match job {
                        Job::Split { key, cell } => split::split(&site, key, cell, &mut desk),
                        Job::Pile { key, cell } => pile::stream(&site, key, cell),
                        Job::Merge { key, .. } => merge::merge(&site, key, &mut desk),
                        Job::Root => site.finish_root(&mut desk.arranger),
                    };
                    board.job_done(bytes);
                    done
                }
            };
            if let Err(error) = done {
                board.fail(error);
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..force.workers {
            scope.spawn(work);
        }
    });
    let nodes = site.into_nodes();
    board.outcome()?;
    Ok(nodes)
}

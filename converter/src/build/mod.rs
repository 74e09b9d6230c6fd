//! Building the octree from the leaves up, as in "Fast Out-of-Core Octree Generation for Massive Point Clouds"
//! (Schütz, Ohrhallinger, Wimmer 2020), with distances kept across the borders of nodes.
//!
//! A node with few points in all is a leaf and holds what its ancestors do not take. The points of any other node are
//! chosen among those that its children hold, and taken away from them. A node is finished, and its points
//! compressed, once its parent has chosen.
//!
//! Points in one cell of the finest grid of the root cube are *coincident*: no level can divide them. They begin at the
//! topmost node that holds no other points, with as many as a node may hold. The others follow in a chain of descendants,
//! as many in each, or more where the levels down to the deepest do not suffice.
//!
//! The order of work makes the result the same for any number of threads: nodes whose samples depend on each other,
//! because they touch, are never worked on at the same time.

mod arrange;
mod border_points;
mod choose;
mod coincident;
mod context;
mod merge;
mod outline;
mod plan;
mod scheduler;
mod split;
mod surroundings;

pub use context::Rules;

use crate::copc::chunk::Node;
use crate::distribute::Inputs;
use crate::distribute::cells::Cells;
use crate::error::Result;
use crate::octree::cube::Cube;
use crate::octree::limits::Limits;
use crate::progress::Meter;
use crate::temporary::store::Store;
use crate::threads;
use context::{Buffers, Context};
use laz::LazVlr;
use plan::Job;
use scheduler::{Scheduler, Task};

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
pub struct WorkerBudget {
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
    force: WorkerBudget,
    store: &Store,
    meter: &Meter,
) -> Result<Vec<Node>> {
    let limits = Limits::of(inputs.length);
    let plan::Plan { phases, pending, outline } = plan::plan(cells, &limits);
    let bytes = |job: &Job| job_bytes(job.points(&limits), inputs.length);
    let scheduler = Scheduler::new(phases, bytes, force);
    let context =
        Context::new(inputs, cube, limits, rules, laz, store, meter, (pending, outline), &scheduler);
    let work = || {
        let _watch = scheduler.watch();
        let mut buffers = Buffers::default();
        while let Some(task) = scheduler.next() {
            let done = match task {
                Task::Compress(node) => context.compress(node),
                Task::Job(job, bytes) => {
                    buffers.arranger.begin(&context, job.key());
                    let done = match job {
                        Job::Split { key, cell } => split::split(&context, key, cell, &mut buffers),
                        Job::Coincident { key, cell } => coincident::stream(&context, key, cell),
                        Job::Merge { key, .. } => merge::merge(&context, key, &mut buffers),
                        Job::Root => context.finish_root(&mut buffers.arranger),
                    };
                    scheduler.job_done(bytes);
                    done
                }
            };
            if let Err(error) = done {
                scheduler.fail(error);
            }
        }
    };
    threads::on_each(force.workers, work);
    let nodes = context.into_nodes();
    scheduler.outcome()?;
    Ok(nodes)
}

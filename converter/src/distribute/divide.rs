//! Cells that hold too many points to be built at once are divided, as often as it takes.

use super::Inputs;
use super::cells::{Cell, Cells};
use super::sort::{Sorter, Target};
use crate::error::{Error, Result};
use crate::input::piece_points;
use crate::octree::cube::Cube;
use crate::octree::key::{BITS, Key};
use crate::octree::limits::Limits;
use crate::temporary::store::Store;
use crate::threads;
use std::sync::{Mutex, PoisonError};

/// Divides until no cell has more points than the limit, but for those whose points all have one code.
pub fn divide(
    cells: &mut Cells,
    inputs: &Inputs,
    cube: &Cube,
    limits: &Limits,
    workers: usize,
    store: &Store,
) -> Result<()> {
    let all = Mutex::new(std::mem::take(cells));
    loop {
        let large = all.lock().unwrap_or_else(PoisonError::into_inner).take_larger(limits.cell);
        if large.is_empty() {
            break;
        }
        let open = Mutex::new((large, None::<Error>));
        let work = || {
            let mut sorter = Sorter::default();
            while let Some((key, cell)) = {
                let mut open = open.lock().unwrap_or_else(PoisonError::into_inner);
                if open.1.is_some() { None } else { open.0.pop() }
            } {
                let target = target(key, &cell, inputs, cube, limits);
                let piece = piece_points(inputs.length) * inputs.length;
                let moved = cell.drain(piece, store, |records| {
                    let sorted = sorter.sort(records, inputs.length, &target);
                    let mut cells = all.lock().unwrap_or_else(PoisonError::into_inner);
                    for run in &sorted.runs {
                        let records = &sorted.records[run.start..run.end];
                        cells.append(run.key, records, inputs.length, run.codes, store);
                    }
                    cells.relieve(store)
                });
                if let Err(error) = moved {
                    open.lock().unwrap_or_else(PoisonError::into_inner).1.get_or_insert(error);
                }
            }
        };
        threads::on_each(workers, work);
        let (_, failure) = open.into_inner().unwrap_or_else(PoisonError::into_inner);
        if let Some(error) = failure {
            return Err(error);
        }
    }
    *cells = all.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok(())
}

/// Below the smallest node that holds all points of a cell, as many levels as its points need.
fn target(key: Key, cell: &Cell, inputs: &Inputs, cube: &Cube, limits: &Limits) -> Target {
    let differing = 64 - (cell.codes.0 ^ cell.codes.1).leading_zeros();
    let from = (BITS - differing.div_ceil(3)).max(key.level);
    let to = (from + limits.step(cell.points).max(1)).min(BITS);
    Target { locator: inputs.frame.locator(cube), from, to }
}

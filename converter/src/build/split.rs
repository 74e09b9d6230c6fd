//! All nodes below a cell whose points are in memory.

use super::arrange::{Arranger, Selection, gather};
use super::choose::{Candidates, choose};
use super::coincident;
use super::context::{Batch, Buffers, Context};
use crate::distribute::cells::Cell;
use crate::error::Result;
use crate::octree::key::{BITS, Key};

/// The points of a cell.
struct Points {
    batch: Batch,
    codes: Vec<u64>,
    /// Marks of points that a node takes from its children.
    taken: Vec<bool>,
}

/// Builds the nodes of a cell. The topmost one's points wait for its parent.
pub fn split(context: &Context, key: Key, cell: Cell, buffers: &mut Buffers) -> Result<()> {
    let length = context.inputs.length;
    let records = cell.load(length, context.store)?;
    let codes = context.codes(&records);
    let mut order: Vec<u32> = (0..codes.len() as u32).collect();
    let mut spare = order.clone();
    let weights = context.weights(codes.len());
    let taken = vec![false; codes.len()];
    let mut points = Points { batch: Batch { records, weights }, codes, taken };
    let own = points.grow(context, key, &mut order, &mut spare, buffers)?;
    context.keep(key, points.gather(&own, length))
}

impl Points {
    /// Builds what is below a node, and returns the numbers of its own points, ascending. `order` are the numbers of
    /// all its points, ascending; `spare` is as long.
    fn grow(
        &mut self,
        context: &Context,
        key: Key,
        order: &mut [u32],
        spare: &mut [u32],
        buffers: &mut Buffers,
    ) -> Result<Vec<u32>> {
        if order.len() as u64 <= context.limits.leaf {
            return Ok(order.to_vec());
        }
        let code = |number: u32| self.codes[number as usize];
        let first = code(order[0]);
        if order.iter().all(|number| code(*number) == first) {
            return self.coincident(context, key, first, order, &mut buffers.arranger);
        }
        let ends = self.partition(key.level, order, spare);
        let mut children = Vec::with_capacity(8);
        let mut start = 0;
        for (octant, end) in (0..8).zip(ends) {
            if start < end {
                let child = key.child(octant);
                children.push((
                    child,
                    self.grow(context, child, &mut order[start..end], &mut spare[start..end], buffers)?,
                ));
            }
            start = end;
        }
        let mut numbers: Vec<u32> = children.iter().flat_map(|(_, own)| own).copied().collect();
        // Runs of ascending numbers, which a stable sort merges.
        numbers.sort();
        let Batch { records, weights } = &mut self.batch;
        let chosen = choose(context, key, Candidates { records, numbers: &numbers, weights }, buffers)?;
        drop(numbers);
        chosen.iter().for_each(|number| self.taken[*number as usize] = true);
        for (child, mut own) in children {
            own.retain(|number| !self.taken[*number as usize]);
            context.finish(child, self.select(&own), &mut buffers.arranger)?;
        }
        // The marks are for this node's children only: its parent makes its own.
        chosen.iter().for_each(|number| self.taken[*number as usize] = false);
        Ok(chosen)
    }

    /// Brings the points of each octant together, in order, and returns where those of each one end.
    fn partition(&self, level: u32, order: &mut [u32], spare: &mut [u32]) -> [usize; 8] {
        let shift = 3 * (BITS - level - 1);
        let octant = |number: u32| (self.codes[number as usize] >> shift & 7) as usize;
        let mut ends = [0; 8];
        order.iter().for_each(|number| ends[octant(*number)] += 1);
        let mut at = 0;
        for end in &mut ends {
            at += std::mem::replace(end, at);
        }
        for number in order.iter() {
            let end = &mut ends[octant(*number)];
            spare[*end] = *number;
            *end += 1;
        }
        order.copy_from_slice(spare);
        ends
    }

    /// Points with one code: the first ones are the node's, the others its descendants'.
    fn coincident(
        &self,
        context: &Context,
        key: Key,
        code: u64,
        order: &[u32],
        arranger: &mut Arranger,
    ) -> Result<Vec<u32>> {
        let chain = coincident::chain(key, code, order.len() as u64, context.limits.node);
        let (own, mut rest) = order.split_at(chain.own as usize);
        for (key, points) in chain.below {
            let (now, later) = rest.split_at(points as usize);
            context.finish(key, self.select(now), arranger)?;
            rest = later;
        }
        Ok(own.to_vec())
    }

    fn select<'a>(&'a self, numbers: &'a [u32]) -> Selection<'a> {
        Selection { records: &self.batch.records, codes: &self.codes, numbers }
    }

    /// Copies of some points.
    fn gather(&self, numbers: &[u32], length: usize) -> Batch {
        let records = gather(&self.batch.records, numbers.iter().copied(), length);
        let weights = &self.batch.weights;
        let weights = if weights.is_empty() {
            Vec::new()
        } else {
            numbers.iter().map(|number| weights[*number as usize]).collect()
        };
        Batch { records, weights }
    }
}

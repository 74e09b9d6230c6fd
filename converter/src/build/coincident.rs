//! Coincident points: those that lie in one cell of the finest grid, so that no level of the tree can divide them.

use super::context::{Batch, Context};
use crate::copc::chunk::Compressor;
use crate::distribute::cells::Cell;
use crate::error::Result;
use crate::octree::key::{BITS, Key};

/// The nodes that hold coincident points.
#[derive(Debug, PartialEq, Eq)]
pub struct Chain {
    /// Points of the topmost node.
    pub own: u64,
    /// The nodes below it and their points.
    pub below: Vec<(Key, u64)>,
}

/// Divides coincident points among a node and its descendants. No node gets more than `most`, unless there are too few
/// levels.
pub fn chain(key: Key, code: u64, points: u64, most: u64) -> Chain {
    let levels = u64::from(BITS - key.level);
    if levels == 0 {
        return Chain { own: points, below: Vec::new() };
    }
    let own = points.min(most);
    let each = (points - own).div_ceil(levels).max(most);
    let mut left = points - own;
    let mut below = Vec::new();
    for level in key.level + 1..=BITS {
        let now = left.min(each);
        if now == 0 {
            break;
        }
        below.push((Key::of(code, level), now));
        left -= now;
    }
    Chain { own, below }
}

/// Builds the nodes of coincident points that may be larger than memory together.
pub fn stream(context: &Context, key: Key, cell: Cell) -> Result<()> {
    let length = context.inputs.length;
    let Chain { own, below } = chain(key, cell.codes.0, cell.points, context.limits.node);
    let mut top = Vec::new();
    let mut nodes = below.into_iter();
    let mut open: Option<(Key, u64, Compressor)> = None;
    let mut left = own;
    cell.drain(length * context.limits.node.min(own) as usize, context.store, |records| {
        let mut records = records;
        while !records.is_empty() {
            if left == 0 {
                if let Some((key, points, compressor)) = open.take() {
                    context.add(key, points, compressor.finish().map_err(Context::compression_failed)?)?;
                }
                let Some((key, points)) = nodes.next() else { return Ok(()) };
                open =
                    Some((key, points, Compressor::new(context.laz).map_err(Context::compression_failed)?));
                left = points;
            }
            let count = left.min((records.len() / length) as u64);
            let (now, later) = records.split_at(count as usize * length);
            match &mut open {
                None => top.extend_from_slice(now),
                Some((.., compressor)) => compressor.add(now).map_err(Context::compression_failed)?,
            }
            left -= count;
            records = later;
        }
        Ok(())
    })?;
    if let Some((key, points, compressor)) = open {
        context.add(key, points, compressor.finish().map_err(Context::compression_failed)?)?;
    }
    let weights = context.weights(top.len() / length);
    context.keep(key, Batch { records: top, weights })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_point_is_left_over() {
        let code = 0o123_4567;
        for level in [0, 1, 19, 20, 21] {
            for points in [1, 99, 100, 101, 1000, 1_000_000] {
                let key = Key::of(code, level);
                let chain = chain(key, code, points, 100);
                let sum: u64 = chain.below.iter().map(|(_, points)| points).sum();
                assert_eq!(chain.own + sum, points);
                assert!(level == BITS || chain.own <= 100);
                for (index, (below, points)) in chain.below.iter().enumerate() {
                    assert_eq!(*below, Key::of(code, level + 1 + index as u32));
                    assert!(*points > 0);
                }
            }
        }
        assert_eq!(chain(Key::ROOT, code, 1000, 100).below.len(), 9);
    }
}

//! A node whose children were built before it.

use super::arrange::Selection;
use super::choose::{Candidates, choose};
use super::context::{Batch, Buffers, Context};
use crate::error::Result;
use crate::octree::key::Key;

/// Builds a node from its children's points, which are finished with that.
pub fn merge(context: &Context, key: Key, buffers: &mut Buffers) -> Result<()> {
    let length = context.inputs.length;
    let mut all = Batch::default();
    let mut children = Vec::with_capacity(8);
    for octant in 0..8 {
        let child = key.child(octant);
        let mut batch = context.take(child)?;
        all.records.append(&mut batch.records);
        all.weights.append(&mut batch.weights);
        children.push((child, all.records.len() / length));
    }
    let numbers: Vec<u32> = (0..(all.records.len() / length) as u32).collect();
    let Batch { records, weights } = &mut all;
    let chosen = choose(context, key, Candidates { records, numbers: &numbers, weights }, buffers)?;
    let codes = context.codes(&all.records);
    let mut own = Batch::default();
    let mut taken = chosen.into_iter().peekable();
    let mut start = 0;
    for (child, end) in children {
        let mut rest = Vec::with_capacity(end - start);
        for number in start..end {
            if taken.next_if_eq(&(number as u32)).is_some() {
                own.records.extend_from_slice(&all.records[number * length..][..length]);
                own.weights.extend(all.weights.get(number));
            } else {
                rest.push(number as u32);
            }
        }
        let selection = Selection { records: &all.records, codes: &codes, numbers: &rest };
        context.finish(child, selection, &mut buffers.arranger)?;
        start = end;
    }
    context.keep(key, own)
}

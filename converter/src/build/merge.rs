//! A node whose children were built before it.

use super::choose::{Candidates, choose};
use super::site::{Batch, Desk, Site};
use crate::error::Result;
use crate::octree::key::Key;

/// Builds a node from its children's points, which are finished with that.
pub fn merge(site: &Site, key: Key, desk: &mut Desk) -> Result<()> {
    let length = site.inputs.length;
    let mut all = Batch::default();
    let mut children = Vec::with_capacity(8);
    for octant in 0..8 {
        let child = key.child(octant);
        let mut batch = site.take(child)?;
        all.records.append(&mut batch.records);
        all.weights.append(&mut batch.weights);
        children.push((child, all.records.len() / length));
    }
    let numbers: Vec<u32> = (0..(all.records.len() / length) as u32).collect();
    let Batch { records, weights } = &mut all;
    let chosen = choose(site, key, Candidates { records, numbers: &numbers, weights }, desk)?;
    let mut own = Batch::default();
    let mut taken = chosen.into_iter().peekable();
    let mut start = 0;
    for (child, end) in children {
        let mut rest = Vec::with_capacity((end - start) * length);
        for (number, record) in (start..).zip(all.records[start * length..end * length].chunks_exact(length))
        {
            if taken.next_if(|next| *next as usize == number).is_some() {
                own.records.extend_from_slice(record);
                own.weights.extend(all.weights.get(number));
            } else {
                rest.extend_from_slice(record);
            }
        }
        site.finish(child, rest, &mut desk.arranger)?;
        start = end;
    }
    site.keep(key, own)
}

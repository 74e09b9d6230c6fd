//! What is computed over all records at once.

use crate::octree::cube::{Bounds, Cube};
use crate::octree::sample::{self, Entry};
use crate::record::position;
use rayon::prelude::*;

/// Records that one task takes at a time.
const BLOCK: usize = 65_536;

/// The bounds of the records, not those that some header claims.
pub fn bounds(data: &[u8], length: usize, scale: [f64; 3], offset: [f64; 3]) -> Bounds {
    let empty = || ([i32::MAX; 3], [i32::MIN; 3]);
    let join = |(a, b): ([i32; 3], [i32; 3]), (c, d): ([i32; 3], [i32; 3])| {
        (std::array::from_fn(|i| a[i].min(c[i])), std::array::from_fn(|i| b[i].max(d[i])))
    };
    let (low, high) = data
        .par_chunks(length * BLOCK)
        .map(|block| block.chunks_exact(length).map(position).map(|p| (p, p)).fold(empty(), join))
        .reduce(empty, join);
    let place = |p: [i32; 3]| coordinates(p, scale, offset);
    let (a, b) = (place(low), place(high));
    // A negative scale turns an axis round.
    Bounds { min: std::array::from_fn(|i| a[i].min(b[i])), max: std::array::from_fn(|i| a[i].max(b[i])) }
}

/// One entry per record, sorted.
pub fn entries(data: &[u8], length: usize, scale: [f64; 3], offset: [f64; 3], cube: &Cube) -> Vec<Entry> {
    let entry = |(index, record): (usize, &[u8])| {
        let code = cube.code(coordinates(position(record), scale, offset));
        Entry { code, index: index as u32 }
    };
    let mut entries: Vec<_> =
        data.par_chunks_exact(length).enumerate().with_min_len(BLOCK).map(entry).collect();
    sample::sort(&mut entries);
    entries
}

#[inline]
fn coordinates(position: [i32; 3], scale: [f64; 3], offset: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| f64::from(position[i]) * scale[i] + offset[i])
}

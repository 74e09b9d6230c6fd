//! A random subset (Schütz 2016, 3.3.1, figure 3.3 b), as large as that of the strategies that go by cells.

use super::{Cell, Scratch, first};

/// Numbers of the candidates that are chosen, rising: those of the least seeds.
pub fn choose(cell: &Cell, candidates: &[[f64; 3]], seed: &[u64], scratch: &mut Scratch) -> Vec<u32> {
    let count = first::choose(cell, candidates, scratch).len();
    let mut chosen: Vec<_> = scratch.order.least(seed, count).collect();
    chosen.sort_unstable();
    chosen
}

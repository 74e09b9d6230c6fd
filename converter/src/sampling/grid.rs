//! Of each occupied cell the candidate nearest to its centre (Schütz 2016, 3.3.1, figure 3.3 d).

use super::lattice::EMPTY;
use super::{Cell, Scratch};

/// The best candidate of a cell so far.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Best {
    distance2: f64,
    seed: u64,
    index: u32,
}

/// Equally near ones go by seed.
pub fn choose(cell: &Cell, candidates: &[[f64; 3]], seed: &[u64], scratch: &mut Scratch) -> Vec<u32> {
    let Scratch { lattice, best, .. } = scratch;
    lattice.lay(cell.side / cell.spacing);
    best.clear();
    for ((position, seed), index) in candidates.iter().zip(seed).zip(0..) {
        let place = cell.place(position);
        let own = Best { distance2: off_centre2(place), seed: *seed, index };
        let at = lattice.cell(place);
        let slot = lattice.get(at);
        if slot == EMPTY {
            lattice.replace(at, best.len() as u32);
            best.push(own);
        } else if own < best[slot as usize] {
            best[slot as usize] = own;
        }
    }
    let mut chosen: Vec<_> = best.iter().map(|best| best.index).collect();
    chosen.sort_unstable();
    chosen
}

/// The square of the distance of a place from the centre of its cell, in edges of a cell.
#[inline]
fn off_centre2(place: [f64; 3]) -> f64 {
    place.into_iter().map(|along| (along - along.floor() - 0.5).powi(2)).sum()
}

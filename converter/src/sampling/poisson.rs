//! A maximal Poisson-disk sample of the candidates (Schütz 2016, 3.3.1), with the flaws named there (3.3.2)
//! mended: points are taken in the order of their seeds, which leaves no trace of the input's order, and
//! keep their distance from the neighbours' points too.

use super::lattice::EMPTY;
use super::{Cell, Scratch};

/// By this much the cells are wider than the spacing: more than all rounding of a cell's number, so that two
/// positions closer than the spacing are never two cells apart.
const SLACK: f64 = 1e-9;

/// Points that keep others away: those of one lattice cell are chained, the last one first.
#[derive(Debug, Default)]
pub struct Accepted {
    positions: Vec<[f64; 3]>,
    next: Vec<u32>,
}

pub fn choose(
    cell: &Cell,
    candidates: &[[f64; 3]],
    seed: &[u64],
    near: &[[f64; 3]],
    scratch: &mut Scratch,
) -> Vec<u32> {
    let Scratch { lattice, order, accepted, .. } = scratch;
    lattice.lay(cell, cell.spacing * (1.0 + SLACK));
    accepted.positions.clear();
    accepted.next.clear();
    let least = cell.spacing * cell.spacing;
    for position in near {
        let at = lattice.cell(position);
        accepted.push(*position, lattice.replace(at, accepted.positions.len() as u32));
    }
    let mut chosen = Vec::new();
    for index in order.all(seed) {
        let position = &candidates[index as usize];
        let at = lattice.inner_cell(position);
        let free = lattice
            .rows(at)
            .into_iter()
            .all(|row| (row..row + 3).all(|cell| accepted.keeps_away(lattice.get(cell), position, least)));
        if free {
            accepted.push(*position, lattice.replace(at, accepted.positions.len() as u32));
            chosen.push(index);
        }
    }
    chosen.sort_unstable();
    chosen
}

impl Accepted {
    fn push(&mut self, position: [f64; 3], next: u32) {
        self.positions.push(position);
        self.next.push(next);
    }

    /// Whether a position is not closer than the spacing to any point of a chain.
    #[inline]
    fn keeps_away(&self, mut first: u32, position: &[f64; 3], least: f64) -> bool {
        while first != EMPTY {
            if distance2(&self.positions[first as usize], position) < least {
                return false;
            }
            first = self.next[first as usize];
        }
        true
    }
}

/// The square of the distance of two positions.
#[inline]
pub fn distance2(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let [x, y, z] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    x * x + y * y + z * z
}

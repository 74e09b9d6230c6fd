//! A maximal Poisson-disk sample of the candidates (Schütz 2016, 3.3.1), with the flaws named there (3.3.2)
//! mended: points are taken in the order of their seeds, which leaves no trace of the input's order, and
//! keep their distance from the neighbours' points too.

use super::{Cell, Scratch};

pub fn choose(
    cell: &Cell,
    candidates: &[[f64; 3]],
    seed: &[u64],
    near: &[[f64; 3]],
    scratch: &mut Scratch,
) -> Vec<u32> {
    let Scratch { order, discs, .. } = scratch;
    discs.begin(cell, near);
    let mut chosen = Vec::new();
    order.visit(seed, candidates, |index, position| {
        if discs.add(position) {
            chosen.push(index);
        }
    });
    chosen.sort_unstable();
    chosen
}

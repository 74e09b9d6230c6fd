//! A maximal Poisson-disk sample of the candidates (Schütz 2016, 3.3.1), with the flaws named there (3.3.2)
//! mended: points are taken in the order of their seeds, which leaves no trace of the input's order, and
//! keep their distance from the neighbours' points too. At faces whose neighbours have not chosen yet,
//! stand-ins of their points keep the density even.

use super::{Cell, Scratch};

/// The largest distance of a candidate from the sample, in spacings, that stand-ins may leave. With this one, what
/// the first node and then its neighbour take are together as dense as the inside: with less the first takes too
/// much, and with more too little.
const WIDEST: f64 = 1.15;

pub fn choose(
    cell: &Cell,
    candidates: &[[f64; 3]],
    seed: &[u64],
    near: &[[f64; 3]],
    scratch: &mut Scratch,
) -> Vec<u32> {
    let Scratch { order, discs, rim, .. } = scratch;
    rim.find(cell, candidates, seed, near);
    discs.begin(cell, near);
    let mut chosen = Vec::new();
    let own = seed.iter().copied().zip(candidates.iter().copied());
    order.visit(own.chain(rim.rivals.iter().copied()), |index, position| {
        if discs.add(position) && (index as usize) < candidates.len() {
            chosen.push(index);
        }
    });
    if !rim.candidates.is_empty() {
        discs.begin(&Cell { spacing: WIDEST * cell.spacing, ..*cell }, near);
        chosen.iter().for_each(|index| discs.push(&candidates[*index as usize]));
        let left = rim.candidates.iter().map(|index| (seed[*index as usize], candidates[*index as usize]));
        order.visit(left, |number, position| {
            if discs.add(position) {
                chosen.push(rim.candidates[number as usize]);
            }
        });
    }
    chosen.sort_unstable();
    chosen
}

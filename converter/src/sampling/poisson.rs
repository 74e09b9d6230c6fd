//! A maximal Poisson-disk sample of the candidates (Schütz 2016, 3.3.1), with the flaws named there (3.3.2)
//! mended: points are taken in the order of their seeds, which leaves no trace of the input's order, and
//! keep their distance from the neighbours' points too. Neighbours that are processed later are taken into account: where their
//! candidates are known these compete as if they were the node's own, so that borders leave no trace; at other faces
//! stand-ins keep the density even.

use super::{Around, Cell, Scratch};

/// The largest distance of a candidate from the sample, in spacings, that stand-ins may leave. With this one, what
/// the first node and then its neighbour take are together as dense as the inside: with less the first takes too
/// much, and with more too little.
const WIDEST: f64 = 1.15;

/// Numbers of the candidates that are chosen, rising. Positions are in source units; `seed` orders the candidates.
pub fn choose(
    cell: &Cell,
    candidates: &[[f64; 3]],
    seed: &[u64],
    around: Around,
    scratch: &mut Scratch,
) -> Vec<u32> {
    let Scratch { order, discs, rim, .. } = scratch;
    rim.find(cell, candidates, seed, around);
    discs.begin(cell, around.chosen);
    let mut chosen = Vec::new();
    let own = candidates.len();
    let seed_of = |index: usize| if index < own { seed[index] } else { rim.rivals[index - own].0 };
    for index in order.all(own + rim.rivals.len(), seed_of) {
        match candidates.get(index as usize) {
            Some(position) if discs.add(position) => chosen.push(index),
            Some(_) => (),
            None => _ = discs.add(&rim.rivals[index as usize - own].1),
        }
    }
    if !rim.candidates.is_empty() {
        discs.begin(&Cell { spacing: WIDEST * cell.spacing, ..*cell }, around.chosen);
        chosen.iter().for_each(|index| discs.push(&candidates[*index as usize]));
        let left = order.all(rim.candidates.len(), |number| seed[rim.candidates[number] as usize]);
        let left = left.map(|number| rim.candidates[number as usize]);
        chosen.extend(left.filter(|index| discs.add(&candidates[*index as usize])));
    }
    chosen.sort_unstable();
    chosen
}

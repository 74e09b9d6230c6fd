//! Mean colours of what a point stands for, like the levels of a mip map (Schütz 2016, 7.1).

use super::Cell;
use super::discs::distance2;
use super::lattice::{EMPTY, Lattice, MOST};

/// How far a chosen point speaks for others, in spacings: the diagonal of a cell of the grid.
const REACH: f64 = 1.732_050_807_568_877_2;

/// Sums of the colours, each as often as it counts, and the number of points.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    colour: [u64; 3],
    weight: u64,
}

/// The mean colour of the points that each chosen one stands for, and their number.
///
/// `colours` are RGB of the candidates and `weights` the numbers of points that they stand for themselves.
/// A candidate counts for the nearest chosen point (the first of equally near ones), unless it is farther
/// off than a grid cell is long, √3 spacings: then a neighbour's point stands for it. A chosen one counts
/// for itself. Means are rounded to the nearest integer, halves up.
pub fn average(
    cell: &Cell,
    candidates: &[[f64; 3]],
    colours: &[[u16; 3]],
    weights: &[u32],
    chosen: &[u32],
) -> Vec<([u16; 3], u32)> {
    let chains = Chains::new(cell, candidates, chosen);
    let mut sums = vec![Sum::default(); chosen.len()];
    let mut own = chosen.iter().zip(0usize..).peekable();
    for (index, position) in candidates.iter().enumerate() {
        let of = match own.next_if(|(number, _)| **number as usize == index) {
            Some((_, slot)) => Some(slot),
            None => chains.nearest(candidates, chosen, position),
        };
        if let Some(sum) = of.map(|slot| &mut sums[slot]) {
            let weight = u64::from(weights[index]);
            sum.weight += weight;
            for (total, value) in sum.colour.iter_mut().zip(colours[index]) {
                *total += weight * u64::from(value);
            }
        }
    }
    sums.iter().map(Sum::mean).collect()
}

impl Sum {
    fn mean(&self) -> ([u16; 3], u32) {
        let weight = self.weight.max(1);
        let mean = self.colour.map(|total| ((total + weight / 2) / weight) as u16);
        (mean, u32::try_from(self.weight).unwrap_or(u32::MAX))
    }
}

/// The chosen points by lattice cell, the last one first.
struct Chains<'a> {
    cell: &'a Cell,
    lattice: Lattice,
    next: Vec<u32>,
    /// Spacings in an edge of the lattice.
    edge: f64,
}

impl<'a> Chains<'a> {
    fn new(cell: &'a Cell, candidates: &[[f64; 3]], chosen: &[u32]) -> Self {
        let across = cell.side / cell.spacing;
        let edge = (2.001 * REACH).max(across / MOST);
        let mut chains = Self { cell, lattice: Lattice::default(), next: Vec::new(), edge };
        chains.lattice.lay(across / edge);
        for (index, slot) in chosen.iter().zip(0..) {
            let at = chains.lattice.cell(chains.place(&candidates[*index as usize]));
            let next = chains.lattice.replace(at, slot);
            chains.next.push(next);
        }
        chains
    }

    fn place(&self, position: &[f64; 3]) -> [f64; 3] {
        self.cell.place(position).map(|spacings| spacings / self.edge)
    }

    /// The number among the chosen ones of the nearest within reach.
    fn nearest(&self, candidates: &[[f64; 3]], chosen: &[u32], position: &[f64; 3]) -> Option<usize> {
        let reach = REACH * self.cell.spacing;
        let mut best = (reach * reach, EMPTY);
        for mut slot in self.lattice.around(self.place(position)) {
            while slot != EMPTY {
                let other = &candidates[chosen[slot as usize] as usize];
                let own = (distance2(other, position), slot);
                if own < best {
                    best = own;
                }
                slot = self.next[slot as usize];
            }
        }
        (best.1 != EMPTY).then_some(best.1 as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Strategy;
    use super::super::scene::{Scene, cube, scenes};
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_mean_is_weighted_and_rounded() {
        let cell = cube([0.0; 3], 1.0);
        let points = [[1.0, 1.0, 1.0], [1.4, 1.0, 1.0], [9.0, 9.0, 9.0], [1.0, 1.5, 1.0]];
        let colours = [[100, 0, 65535], [200, 1, 65535], [7, 8, 9], [0, 0, 65535]];
        let means = average(&cell, &points, &colours, &[1, 2, 5, 1], &[0, 2]);
        assert_eq!(means, [([125, 1, 65535], 4), ([7, 8, 9], 5)]);
    }

    #[test]
    fn who_is_far_from_all_counts_for_none() {
        let cell = cube([0.0; 3], 1.0);
        let points = [[1.0, 1.0, 1.0], [2.8, 1.0, 1.0], [2.7, 1.0, 1.0]];
        let means = average(&cell, &points, &[[10; 3], [90; 3], [20; 3]], &[1; 3], &[0]);
        assert_eq!(means, [([15; 3], 2)]);
    }

    /// Otherwise the result is the same, and each candidate is compared with all chosen points.
    #[test]
    fn only_chosen_points_within_reach_are_chained() {
        let points: Vec<_> = (0..18).map(|i| [f64::from(i) * 7.0 + 1.0, 64.0, 64.0]).collect();
        let chosen: Vec<_> = (0..18).collect();
        let cell = cube([0.0; 3], 1.0);
        let chains = Chains::new(&cell, &points, &chosen);
        assert!(chains.next.iter().all(|next| *next == EMPTY), "{:?}", chains.next);
    }

    #[test]
    fn weights_beyond_32_bits_stay_at_the_most() {
        let means = average(&cube([0.0; 3], 1.0), &[[1.0; 3]; 2], &[[4; 3]; 2], &[u32::MAX; 2], &[0]);
        assert_eq!(means, [([4; 3], u32::MAX)]);
    }

    proptest! {
        #[test]
        fn each_candidate_counts_for_the_nearest(scene in scenes()) {
            let Scene { cell, points, .. } = &scene;
            let chosen = scene.choose(Strategy::Random);
            let colours: Vec<_> = (0..points.len()).map(|i| [i as u16, 3, 65535]).collect();
            let weights: Vec<_> = (0..points.len() as u32).map(|i| 1 + i % 3).collect();
            let mut expected = vec![[0u64; 2]; chosen.len()];
            for (index, point) in points.iter().enumerate() {
                let distance = |slot: usize| distance2(point, &points[chosen[slot] as usize]);
                let nearest = (0..chosen.len()).min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
                let slot = match chosen.binary_search(&(index as u32)) {
                    Ok(slot) => slot,
                    Err(_) => nearest.unwrap(),
                };
                if distance(slot) <= (REACH * cell.spacing).powi(2) {
                    expected[slot][0] += u64::from(weights[index]) * index as u64;
                    expected[slot][1] += u64::from(weights[index]);
                }
            }
            let means = average(cell, points, &colours, &weights, &chosen);
            for ((mean, weight), [sum, count]) in means.iter().zip(expected) {
                prop_assert_eq!(u64::from(*weight), count);
                prop_assert_eq!(u64::from(mean[0]), (sum + count / 2) / count);
                prop_assert_eq!([mean[1], mean[2]], [3, 65535]);
            }
        }
    }
}

//! Candidates for tests: shapes that scans have and shapes that they should not have.

use super::{Around, Cell, Rival, Scratch, Strategy, choose};
use proptest::prelude::*;
use proptest::strategy::Strategy as _;

/// A node with its candidates.
#[derive(Debug, Clone)]
pub struct Scene {
    pub cell: Cell,
    pub points: Vec<[f64; 3]>,
    pub seed: Vec<u64>,
    /// Points of finished neighbours.
    pub near: Vec<[f64; 3]>,
    /// Candidates of neighbours that choose later.
    pub rivals: Vec<Rival>,
    pub unknown: [bool; 6],
}

impl Scene {
    pub fn of(cell: Cell, points: Vec<[f64; 3]>) -> Self {
        let seed = (0..points.len() as u64).map(scatter).collect();
        Self { cell, points, seed, near: Vec::new(), rivals: Vec::new(), unknown: [true; 6] }
    }

    pub fn around(&self) -> Around<'_> {
        Around { chosen: &self.near, rivals: &self.rivals, unknown: self.unknown }
    }

    pub fn choose(&self, strategy: Strategy) -> Vec<u32> {
        self.choose_with(strategy, &mut Scratch::default())
    }

    pub fn choose_with(&self, strategy: Strategy, scratch: &mut Scratch) -> Vec<u32> {
        choose(strategy, &self.cell, &self.points, &self.seed, self.around(), scratch)
    }

    pub fn chosen(&self, strategy: Strategy) -> Vec<[f64; 3]> {
        self.choose(strategy).into_iter().map(|i| self.points[i as usize]).collect()
    }
}

/// A cube of 128 spacings.
pub fn cube(min: [f64; 3], spacing: f64) -> Cell {
    Cell { min, side: 128.0 * spacing, spacing }
}

/// A hash with good spread.
pub fn scatter(seed: u64) -> u64 {
    let mut v = seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    v = (v ^ v >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    v ^ v >> 31
}

/// Numbers from 0 to 1 without order.
pub fn unit(seed: u64) -> f64 {
    (scatter(seed) >> 11) as f64 / (1u64 << 53) as f64
}

/// Some hundred points in a part of a cube: in space, on a plane, on a line or at few places, with neighbours'
/// points around the lower x face and, in some, candidates of others around the lower y face; near the origin or as far off as the earth is wide, down to the scale
/// where float64 has hardly a digit left.
pub fn scenes() -> impl proptest::strategy::Strategy<Value = Scene> {
    let place = prop::sample::select(vec![
        ([0.0; 3], 1.0),
        ([-63.5, 12.25, 7.0], 0.25),
        ([1e7, -1e7, 1e7], 1e-9),
        ([1e7, 4e6, 100.0], 1e-3),
        ([-1e7; 3], 1e6),
    ]);
    let shape = prop::sample::select(vec![[1.0; 3], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0; 3]]);
    let behind = (0u64..60, any::<[bool; 6]>());
    (place, shape, 0usize..500, 0.5..12.0f64, any::<u64>(), any::<bool>(), behind).prop_map(
        |((min, spacing), shape, count, part, random, repeat, (rivals, unknown))| {
            let cell = cube(min, spacing);
            let at = |i: u64, from: f64, to: f64| {
                [0, 1, 2].map(|axis| {
                    let share = from + (to - from) * unit(random ^ (3 * i + axis as u64)) * shape[axis];
                    (min[axis] + share * spacing).min(min[axis] + cell.side)
                })
            };
            let step = if repeat { 7 } else { 1 };
            let points = (0..count as u64).map(|i| at(i / step, 0.0, part)).collect();
            let mut near: Vec<_> = (0..30).map(|i| at(1_000_000 + i, 0.0, part)).collect();
            near.iter_mut().for_each(|p| p[0] = min[0] - (p[0] - min[0]) / part);
            let seed = (0..count as u64).map(|i| scatter(i ^ random)).collect();
            let beyond = |i: u64| {
                let mut place = at(2_000_000 + i, 0.0, part);
                place[1] = min[1] - 2.0 * (place[1] - min[1]) / part;
                (scatter(!i ^ random), place)
            };
            Scene { cell, points, seed, near, rivals: (0..rivals).map(beyond).collect(), unknown }
        },
    )
}

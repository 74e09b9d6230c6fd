//! How many points stand together. By the length of a record and the number of points alone, never by memory or
//! threads: the same input gives the same file on any machine.

use super::cube::Bounds;
use super::key::BITS;

/// A node with no more points in all is a leaf. Smaller ones cost bytes and requests, in larger ones more points stand
/// closer together than their level's spacing. `autzen.laz`, Poisson samples, share of all points that lie in a leaf
/// with another point of the level closer than the spacing (one in fifty of each level, 20,000 at least, looked at):
///
/// | leaf    | nodes | file     | close |
/// | ------- | ----- | -------- | ----- |
/// | 20,000  | 1,745 | 60.85 MB | 46 %  |
/// | 35,000  | 979   | 59.34 MB | 60 %  |
/// | 50,000  | 778   | 58.66 MB | 67 %  |
/// | 70,000  | 448   | 57.24 MB | 80 %  |
/// | 100,000 | 276   | 56.38 MB | 88 %  |
pub const LEAF_POINTS: u64 = 50_000;

/// The most points that a sampled node takes, and their bytes.
const NODE_POINTS: u64 = 100_000;
const NODE_BYTES: u64 = 4 << 20;

/// The most points that are built at once, and their bytes.
const CELL_POINTS: u64 = 500_000;
const CELL_BYTES: u64 = 20 << 20;

/// The most levels that points go down in one step, and the most cells that they go to.
const DEEPEST_STEP: u32 = 7;
const MOST_CELLS: f64 = 32_768.0;

/// The limits for records of one length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// A node with no more points in all is a leaf.
    pub leaf: u64,
    /// No node has more, but for coincident points, see [`crate::build`].
    pub node: u64,
    /// A cell with more is divided before it is built.
    pub cell: u64,
}

impl Limits {
    /// For records of so many bytes.
    pub fn of(record_length: usize) -> Self {
        let length = record_length.max(1) as u64;
        let node = (NODE_BYTES / length).clamp(64, NODE_POINTS);
        let cell = (CELL_BYTES / length).clamp(8 * 64, CELL_POINTS);
        Self { leaf: LEAF_POINTS.min(node), node, cell }
    }

    /// Levels to go down so that a surface of so many points comes to cells of half the limit: it takes a quarter of
    /// the eight cubes at each. One level at least.
    pub fn step(&self, points: u64) -> u32 {
        let mut levels = 0;
        while levels < DEEPEST_STEP && points >> (2 * levels) > self.cell / 2 {
            levels += 1;
        }
        levels
    }

    /// The level of the cells that all points go to first. Points that do not lie on a surface fill more cells, as
    /// many as the bounds allow.
    pub fn first_level(&self, points: u64, bounds: &Bounds) -> u32 {
        let extents: [f64; 3] = std::array::from_fn(|i| bounds.max[i] - bounds.min[i]);
        let side = extents.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        let cells = |level: u32| -> f64 {
            let along = f64::from(1u32 << level);
            extents.iter().map(|extent| (extent / side * along).floor() + 1.0).map(|n| n.min(along)).product()
        };
        let wanted = self.step(points).min(BITS);
        (0..=wanted).rev().find(|level| cells(*level) <= MOST_CELLS).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn longer_records_stand_in_smaller_groups() {
        assert_eq!(Limits::of(36), Limits { leaf: 50_000, node: 100_000, cell: 500_000 });
        let long = Limits::of(230);
        assert!(long.node < 20_000 && long.leaf == long.node && long.cell < 100_000);
        assert_eq!(Limits::of(65_535), Limits { leaf: 64, node: 64, cell: 512 });
    }

    #[test]
    fn the_first_level_follows_points_and_shape() {
        let limits = Limits::of(36);
        let flat = Bounds { min: [0.0; 3], max: [1000.0, 800.0, 20.0] };
        let cube = Bounds { min: [0.0; 3], max: [1000.0; 3] };
        assert_eq!(limits.first_level(1000, &flat), 0);
        assert_eq!(limits.first_level(10_653_336, &flat), 3);
        assert_eq!(limits.first_level(100_000_000, &flat), 5);
        assert_eq!(limits.first_level(u64::MAX, &flat), 6);
        assert_eq!(limits.first_level(u64::MAX, &cube), 5);
    }
}

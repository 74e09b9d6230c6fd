//! The root cube.

use super::key::{BITS, Key, morton};
use crate::sampling::Cell;

/// Cells along the edge of a node's cube: the spacing of a node's points is its side by this number.
pub const GRID: u32 = 128;

/// Smallest and largest coordinate on each axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    pub min: [f64; 3],
    pub max: [f64; 3],
}

/// The share of a step of the integer grid by which the cube's lower faces keep off the outermost points.
const MARGIN: f64 = 1.0 / 1024.0;

/// The smallest such margin, as a share of the coordinate: 16 times the precision of float64.
const SMALLEST_MARGIN: f64 = 1.0 / (1u64 << 48) as f64;

/// A cube smaller than this share of its coordinates could not be told apart from a point in float64.
const SMALLEST_SIDE: f64 = 1.0 / (1u64 << 40) as f64;

/// The cube that the root node stands for, in source coordinates. Centre and half size are what is stored.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cube {
    pub center: [f64; 3],
    pub half_size: f64,
}

impl Cube {
    /// A cube around all points: their bounds from the lower corner on, and a hair more.
    ///
    /// The hair is a thousandth of a step of the integer grid (`scale`) below and two above. It shifts the
    /// faces between nodes off the grid (the shift is 0 only a third of the way, where no face is), so that
    /// every reader finds a point in the same node, however it rounds; and it is so small that a reader that
    /// takes the header's bounds for the cube, as copclib does, hardly differs.
    pub fn around(bounds: &Bounds, scale: [f64; 3]) -> Self {
        let axes = [0, 1, 2];
        let largest = axes.map(|i| bounds.min[i].abs().max(bounds.max[i].abs()));
        let margins = axes.map(|i| (scale[i].abs() * MARGIN).max(largest[i] * SMALLEST_MARGIN));
        let extents = axes.map(|i| (bounds.max[i] - bounds.min[i]).max(scale[i].abs()));
        let most = |values: [f64; 3]| values.into_iter().fold(0.0, f64::max);
        let side = (most(extents) + 3.0 * most(margins)).max(most(largest) * SMALLEST_SIDE);
        let half_size = side / 2.0;
        Self { center: axes.map(|i| bounds.min[i] - margins[i] + half_size), half_size }
    }

    /// The lower corner, as a reader computes it.
    pub fn min(&self) -> [f64; 3] {
        self.center.map(|c| c - self.half_size)
    }

    pub fn side(&self) -> f64 {
        self.half_size * 2.0
    }

    /// The cube of a node.
    pub fn cell(&self, key: Key) -> Cell {
        let side = self.side() / f64::from(1u32 << key.level);
        let min = self.min();
        let at = [key.x, key.y, key.z];
        Cell {
            min: std::array::from_fn(|i| min[i] + f64::from(at[i]) * side),
            side,
            spacing: side / f64::from(GRID),
        }
    }

    /// The finest grid of places in the cube.
    pub fn grid(&self) -> Grid {
        let cells = f64::from(1u32 << BITS);
        Grid { min: self.min(), factor: cells / self.side(), last: cells - 1.0 }
    }

    /// The Morton code of a position, see [`Grid::code`].
    pub fn code(&self, position: [f64; 3]) -> u64 {
        self.grid().code(position)
    }
}

/// The finest grid of places in a root cube.
#[derive(Debug, Clone, Copy)]
pub struct Grid {
    min: [f64; 3],
    /// Cells per unit.
    factor: f64,
    last: f64,
}

impl Grid {
    /// The Morton code of a position; one outside the cube gets that of the nearest cell.
    #[inline]
    pub fn code(&self, position: [f64; 3]) -> u64 {
        let cell = |i: usize| ((position[i] - self.min[i]) * self.factor).clamp(0.0, self.last) as u32;
        morton([cell(0), cell(1), cell(2)])
    }
}

#[cfg(test)]
mod tests {
    use super::super::place::Frame;
    use super::*;
    use proptest::prelude::*;

    fn cube_of(points: &[[f64; 3]], scale: [f64; 3]) -> Cube {
        let fold =
            |f: fn(f64, f64) -> f64, start| [0, 1, 2].map(|i| points.iter().map(|p| p[i]).fold(start, f));
        let bounds = Bounds { min: fold(f64::min, f64::INFINITY), max: fold(f64::max, f64::NEG_INFINITY) };
        Cube::around(&bounds, scale)
    }

    #[test]
    fn one_point_has_a_cube_of_about_one_step() {
        let cube = cube_of(&[[470_692.44, 4_602_888.9, 16.0]], [0.01; 3]);
        assert!(cube.side() > 0.01 && cube.side() < 0.0101);
        assert!(cube.min()[0] < 470_692.44 && 470_692.44 < cube.min()[0] + cube.side());
    }

    /// Steps of a nanometre far from the origin: float64 has no room for the levels of a cube that is as small as they are.
    #[test]
    fn a_cube_is_large_enough_to_be_divided_in_float64() {
        let (east, north) = (4e6, 5e6);
        let cube = cube_of(&[[east, north, 0.0]], [1e-9; 3]);
        assert_eq!(cube.side(), north / f64::from(2u32).powi(40));
        let far = Key { level: 9, x: 511, y: 511, z: 511 };
        let (first, last) = (cube.cell(Key { level: 9, x: 0, y: 0, z: 0 }), cube.cell(far));
        for axis in [0, 1] {
            assert!(first.min[axis] < first.min[axis] + first.side);
            assert!(last.min[axis] < last.min[axis] + last.side);
            assert!(first.min[axis] < last.min[axis]);
        }
    }

    #[test]
    fn the_cube_is_hardly_larger_than_the_points() {
        let cube = cube_of(&[[0.0; 3], [1000.0, 3.0, 2.0]], [0.01; 3]);
        assert!(cube.side() > 1000.0 && cube.side() < 1000.0001);
        assert!(cube.min().iter().all(|v| *v < 0.0 && *v > -0.0001));
    }

    proptest! {
        #[test]
        fn every_reader_finds_a_point_in_its_node(
            integers in proptest::collection::vec(proptest::array::uniform3(-40_000i32..40_000), 1..40),
            offset in proptest::array::uniform3(-5_000_000i32..5_000_000),
            scale in proptest::sample::select(vec![0.01, 0.001, 0.25, 1.0]),
        ) {
            let frame = Frame { scale: [scale; 3], offset: offset.map(f64::from) };
            let place = |p: &[i32; 3]| [0, 1, 2].map(|i| f64::from(p[i]) * scale + f64::from(offset[i]));
            let points: Vec<_> = integers.iter().map(place).collect();
            let cube = cube_of(&points, [scale; 3]);
            let locator = frame.locator(&cube);
            for (integers, point) in integers.iter().zip(&points) {
                let record: Vec<u8> = integers.iter().flat_map(|v| v.to_le_bytes()).collect();
                let code = locator.code(&record);
                for level in 0..8 {
                    let key = Key::of(code, level);
                    let size = cube.side() / f64::from(1u32 << level);
                    if size < scale * 2.0 {
                        break;
                    }
                    for (i, k) in [key.x, key.y, key.z].into_iter().enumerate() {
                        let low = cube.min()[i] + f64::from(k) * size;
                        prop_assert!(low < point[i] && point[i] < low + size, "level {} axis {}", level, i);
                    }
                }
            }
        }
    }
}

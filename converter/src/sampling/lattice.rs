//! Cubic cells over a node's cube, each with one number.

use super::Cell;

/// More cells along an axis are never made: larger ones stand in for them.
const MOST: usize = 256;

/// What a cell that holds nothing holds.
pub const EMPTY: u32 = u32::MAX;

/// A dense grid with a border of one cell around the node's cube, so that each cell within has 26 neighbours.
/// Between two uses only the cells that were set are cleared.
#[derive(Debug, Default)]
pub struct Lattice {
    cells: Vec<u32>,
    set: Vec<u32>,
    min: [f64; 3],
    inverse: f64,
    count: usize,
}

impl Lattice {
    /// Clears the grid and lays it over a cube with cells of about the given edge, not smaller.
    pub fn lay(&mut self, cell: &Cell, edge: f64) {
        for at in self.set.drain(..) {
            self.cells[at as usize] = EMPTY;
        }
        let inner = (cell.side / edge).ceil().clamp(1.0, MOST as f64);
        self.min = cell.min;
        self.inverse = (1.0 / edge).min(inner / cell.side);
        self.count = inner as usize + 2;
        let needed = self.count.pow(3);
        if self.cells.len() < needed {
            self.cells.resize(needed, EMPTY);
        }
    }

    /// The cell of a position; one outside the cube goes to the nearest cell of the border. No coordinate
    /// moves two positions farther apart than they are, so neighbours stay neighbours.
    #[inline]
    pub fn cell(&self, position: &[f64; 3]) -> usize {
        let last = (self.count - 1) as f64;
        self.flat([0, 1, 2].map(|i| ((position[i] - self.min[i]) * self.inverse + 1.0).clamp(0.0, last)))
    }

    /// The cell of a position within the cube: never one of the border.
    #[inline]
    pub fn inner_cell(&self, position: &[f64; 3]) -> usize {
        let last = (self.count - 2) as f64;
        self.flat([0, 1, 2].map(|i| ((position[i] - self.min[i]) * self.inverse + 1.0).clamp(1.0, last)))
    }

    /// The square of the distance of a position from the centre of its inner cell, in edges of a cell.
    #[inline]
    pub fn off_centre2(&self, position: &[f64; 3]) -> f64 {
        let last = (self.count - 3) as f64;
        let off = |i: usize| {
            let place = (position[i] - self.min[i]) * self.inverse;
            place - place.floor().clamp(0.0, last) - 0.5
        };
        [0, 1, 2].map(|i| off(i) * off(i)).iter().sum()
    }

    #[inline]
    fn flat(&self, [x, y, z]: [f64; 3]) -> usize {
        (z as usize * self.count + y as usize) * self.count + x as usize
    }

    #[inline]
    pub fn get(&self, cell: usize) -> u32 {
        self.cells[cell]
    }

    /// Sets a cell and returns what it held.
    #[inline]
    pub fn replace(&mut self, cell: usize, value: u32) -> u32 {
        let before = std::mem::replace(&mut self.cells[cell], value);
        if before == EMPTY {
            self.set.push(cell as u32);
        }
        before
    }

    /// The first cells of the nine rows of three cells that lie around an inner cell, the middle row first.
    #[inline]
    pub fn rows(&self, cell: usize) -> [usize; 9] {
        let (y, z) = (self.count, self.count * self.count);
        let x = cell - 1;
        [x, x - y, x + y, x - z, x + z, x - z - y, x - z + y, x + z - y, x + z + y]
    }
}

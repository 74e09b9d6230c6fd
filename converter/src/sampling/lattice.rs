//! A grid of cubic cells over a node's cube, with one number per cell: for points to be found by their place. A place is
//! given in edges of a cell from the cube's lower corner.

/// The most cells along an axis.
pub const MOST: f64 = 256.0;

/// The value of an empty cell.
pub const EMPTY: u32 = u32::MAX;

/// A dense grid over a node's cube. A place outside the cube is moved to the nearest cell, which brings no two places
/// farther apart: neighbours stay neighbours. Between two uses only those cells are cleared that were set.
#[derive(Debug, Default)]
pub struct Lattice {
    cells: Vec<u32>,
    set: Vec<u32>,
    count: u32,
}

impl Lattice {
    /// Clears the grid and gives it `along` cells along each axis, 2 at least and [`MOST`] at most.
    pub fn lay(&mut self, along: f64) {
        for at in self.set.drain(..) {
            self.cells[at as usize] = EMPTY;
        }
        self.count = along.ceil().clamp(2.0, MOST) as u32;
        let needed = (self.count as usize).pow(3);
        if self.cells.len() < needed {
            self.cells.resize(needed, EMPTY);
        }
    }

    #[inline]
    fn flat(&self, x: f64, y: f64, z: f64) -> u32 {
        (z as u32 * self.count + y as u32) * self.count + x as u32
    }

    /// The cell of a place.
    #[inline]
    pub fn cell(&self, [x, y, z]: [f64; 3]) -> u32 {
        let last = f64::from(self.count - 1);
        self.flat(x.clamp(0.0, last), y.clamp(0.0, last), z.clamp(0.0, last))
    }

    /// The values of eight cells that together hold every place within half an edge of this one: the place's own cell
    /// first, then those that share a face with it.
    #[inline]
    pub fn around(&self, [x, y, z]: [f64; 3]) -> impl Iterator<Item = u32> {
        let last = f64::from(self.count - 2);
        let low = |along: f64| (along - 0.5).clamp(0.0, last) as u32;
        let high = |along: f64, low: u32| u32::from(along >= f64::from(low + 1));
        let [i, j, k] = [low(x), low(y), low(z)];
        let own = high(x, i) | high(y, j) << 1 | high(z, k) << 2;
        let corner = (k * self.count + j) * self.count + i;
        [0, 1, 2, 4, 3, 5, 6, 7].into_iter().map(move |turn| {
            let at = own ^ turn;
            let (x, y, z) = (at & 1, at >> 1 & 1, at >> 2);
            self.get(corner + x + (y + z * self.count) * self.count)
        })
    }

    #[inline]
    pub fn get(&self, cell: u32) -> u32 {
        self.cells[cell as usize]
    }

    /// Sets a cell and returns its former value.
    #[inline]
    pub fn replace(&mut self, cell: u32, value: u32) -> u32 {
        let before = std::mem::replace(&mut self.cells[cell as usize], value);
        if before == EMPTY {
            self.set.push(cell);
        }
        before
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid whose cells hold their own x, y and z.
    fn numbered(along: u32) -> Lattice {
        let mut lattice = Lattice::default();
        lattice.lay(f64::from(along));
        for number in 0..along.pow(3) {
            let place = [number % along, number / along % along, number / along.pow(2)].map(f64::from);
            let cell = lattice.cell(place);
            assert_eq!(lattice.replace(cell, number), EMPTY);
        }
        lattice
    }

    #[test]
    fn around_a_place_its_own_cell_comes_first_then_those_that_share_a_face() {
        let along = 5;
        let lattice = numbered(along);
        let values: [f64; 12] = [0.0, 0.3, 0.5, 0.8, 1.0, 1.5, 2.4, 2.6, 3.9, 4.1, 4.4, 4.9];
        for (x, y, z) in values.iter().flat_map(|x| values.map(|y| (*x, y, 5.0 - x.max(y)))) {
            let place = [x, y, z.min(4.9)];
            let own = place.map(|v| v as u32);
            let found: Vec<_> = lattice.around(place).collect();
            let apart = |number: &u32| {
                let cell = [number % along, number / along % along, number / along.pow(2)];
                (0..3).map(|i| cell[i].abs_diff(own[i])).collect::<Vec<_>>()
            };
            assert!(found.iter().flat_map(apart).all(|steps| steps < 2), "{place:?}: {found:?}");
            let steps: Vec<u32> = found.iter().map(|number| apart(number).iter().sum()).collect();
            assert_eq!(steps, [0, 1, 1, 1, 2, 2, 2, 3], "{place:?}");
            for axis in 0..3 {
                for step in [-0.499, 0.499] {
                    let mut nearby = place;
                    nearby[axis] += step;
                    let number = lattice.get(lattice.cell(nearby));
                    assert!(found.contains(&number), "{place:?} {nearby:?}");
                }
            }
        }
    }

    #[test]
    fn places_outside_belong_to_the_nearest_cell() {
        let lattice = numbered(3);
        let at = |place| lattice.get(lattice.cell(place));
        assert_eq!(at([-7.0, 1.5, 2.5]), at([0.0, 1.0, 2.0]));
        assert_eq!(at([1.5, 99.0, -1.0]), at([1.0, 2.0, 0.0]));
    }

    #[test]
    fn laid_anew_it_is_empty_and_has_two_cells_along_an_axis_at_least() {
        let mut lattice = numbered(4);
        lattice.lay(0.1);
        assert_eq!(lattice.cell([9.0; 3]), 7);
        assert!((0..64).all(|cell| lattice.get(cell) == EMPTY));
        lattice.lay(1e9);
        assert_eq!(lattice.cell([1e9; 3]), MOST.powi(3) as u32 - 1);
    }
}

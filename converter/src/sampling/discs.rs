//! Positions that keep others at a distance.

use super::Cell;
use super::lattice::{EMPTY, Lattice, MOST};

/// Spacings in an edge of the lattice: by the last digit, which is more than all rounding of a cell's number,
/// positions closer than one spacing are sure to lie in the eight cells around a position.
const EDGE: f64 = 2.000_000_001;

/// The discs' centres: those of one lattice cell are chained, the last one first.
#[derive(Debug, Default)]
pub struct Discs {
    lattice: Lattice,
    links: Vec<Link>,
    min: [f64; 3],
    /// Square of the spacing.
    spacing2: f64,
    /// Edges of the lattice in a unit of the source coordinates.
    inverse: f64,
}

#[derive(Debug)]
struct Link {
    position: [f64; 3],
    next: u32,
}

impl Discs {
    /// Removes all discs and begins anew with those around some positions, which may overlap.
    pub fn begin(&mut self, cell: &Cell, positions: &[[f64; 3]]) {
        let across = cell.side / cell.spacing;
        let edge = EDGE.max(across / MOST);
        self.lattice.lay(across / edge);
        self.links.clear();
        self.min = cell.min;
        self.spacing2 = cell.spacing * cell.spacing;
        self.inverse = 1.0 / (edge * cell.spacing);
        positions.iter().for_each(|position| self.push(position));
    }

    /// Adds a position if it is no closer than the spacing to any that is there; says whether it was added.
    #[inline]
    pub fn add(&mut self, position: &[f64; 3]) -> bool {
        for mut at in self.lattice.around(self.place(position)) {
            while at != EMPTY {
                let link = &self.links[at as usize];
                if distance2(&link.position, position) < self.spacing2 {
                    return false;
                }
                at = link.next;
            }
        }
        self.push(position);
        true
    }

    /// Adds a position wherever it is.
    pub fn push(&mut self, position: &[f64; 3]) {
        let cell = self.lattice.cell(self.place(position));
        let next = self.lattice.replace(cell, self.links.len() as u32);
        self.links.push(Link { position: *position, next });
    }

    #[inline]
    fn place(&self, [x, y, z]: &[f64; 3]) -> [f64; 3] {
        [(x - self.min[0]) * self.inverse, (y - self.min[1]) * self.inverse, (z - self.min[2]) * self.inverse]
    }
}

/// The square of the distance of two positions.
#[inline]
pub fn distance2(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    let [x, y, z] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    x * x + y * y + z * z
}

#[cfg(test)]
mod tests {
    use super::super::scene::cube;
    use super::*;

    /// Otherwise the result is the same, and each point is compared with all others.
    #[test]
    fn only_discs_within_reach_share_a_cell() {
        let mut discs = Discs::default();
        for (min, spacing) in [([0.0; 3], 1.0), ([1e6, -5e5, 40.0], 0.125), ([-3.0; 3], 1000.0)] {
            discs.begin(&cube(min, spacing), &[]);
            let cell = |discs: &Discs, spacings: f64| {
                discs.lattice.cell(discs.place(&min.map(|from| from + spacings * spacing)))
            };
            let cells: std::collections::HashSet<_> =
                (0..64).map(|i| cell(&discs, 2.0 * f64::from(i) + 1.0)).collect();
            assert_eq!(cells.len(), 64);
            assert_eq!(cell(&discs, 0.1), cell(&discs, 1.9));
        }
        // A cube of more cells than there may be has larger ones.
        discs.begin(&Cell { min: [0.0; 3], side: 4096.0, spacing: 1.0 }, &[]);
        assert_eq!(discs.lattice.cell(discs.place(&[4095.9; 3])), MOST.powi(3) as u32 - 1);
        assert_ne!(discs.lattice.cell(discs.place(&[4070.0; 3])), MOST.powi(3) as u32 - 1);
    }
}

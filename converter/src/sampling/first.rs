//! Of each occupied cell the first candidate (Schütz 2016, 3.3.1: the grid of the modifiable nested octree).

use super::lattice::EMPTY;
use super::{Cell, Scratch};

/// Numbers of the candidates that are chosen, rising. Positions are in source units.
pub fn choose(cell: &Cell, candidates: &[[f64; 3]], scratch: &mut Scratch) -> Vec<u32> {
    let lattice = &mut scratch.lattice;
    lattice.lay(cell.side / cell.spacing);
    let mut is_first = |position| {
        let at = lattice.cell(cell.place(position));
        lattice.replace(at, 0) == EMPTY
    };
    candidates.iter().zip(0..).filter(|(position, _)| is_first(position)).map(|(_, index)| index).collect()
}

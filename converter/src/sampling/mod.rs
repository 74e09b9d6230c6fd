//! Which points of its children a node takes: pure functions of positions, knowing neither tree nor files.

mod average;
mod discs;
mod first;
mod grid;
mod lattice;
mod order;
mod poisson;
#[cfg(test)]
mod properties;
mod random;
mod rivals;
#[cfg(test)]
mod scene;

pub use average::average;

use lattice::Lattice;

/// How a node's points are chosen among its children's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Strategy {
    /// No two points closer than the spacing, and no room left for another.
    Poisson,
    /// Of each occupied cell of the grid the point nearest to its centre.
    Grid,
    /// As many as there are occupied cells, of any place.
    Random,
    /// Of each occupied cell the first point of the input.
    First,
}

/// A node's cube, in source coordinates. Its grid has cells of the edge `spacing`, 128 along each axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    pub min: [f64; 3],
    pub side: f64,
    /// The least distance of a Poisson sample, and the edge of the cells of the other strategies.
    pub spacing: f64,
}

impl Cell {
    /// A position in spacings from the lower corner.
    #[inline]
    fn place(&self, [x, y, z]: &[f64; 3]) -> [f64; 3] {
        let inverse = 1.0 / self.spacing;
        [(x - self.min[0]) * inverse, (y - self.min[1]) * inverse, (z - self.min[2]) * inverse]
    }
}

/// Buffers that live from one choice to the next, so that nothing is allocated per point.
#[derive(Debug, Default)]
pub struct Scratch {
    lattice: Lattice,
    order: order::Order,
    discs: discs::Discs,
    best: Vec<grid::Best>,
    rim: rivals::Rim,
}

/// Chooses among candidates (source coordinates, in the input's order of points).
///
/// `seed[i]` belongs to point i itself, so that the choice depends on nothing else; equal seeds go by place
/// among the candidates. `near` are positions that neighbours of the same level hold already, within one
/// spacing of the cell; only [`Strategy::Poisson`] keeps away from them.
///
/// A Poisson sample comes within one spacing of each candidate, at faces behind which `near` has nothing
/// within 1.15. Returns ascending indices, at least one if there is a candidate: but none by [`Strategy::Poisson`] if
/// each candidate is closer than one spacing to `near`.
pub fn choose(
    strategy: Strategy,
    cell: &Cell,
    candidates: &[[f64; 3]],
    seed: &[u64],
    near: &[[f64; 3]],
    scratch: &mut Scratch,
) -> Vec<u32> {
    debug_assert_eq!(candidates.len(), seed.len());
    match strategy {
        Strategy::Poisson => poisson::choose(cell, candidates, seed, near, scratch),
        Strategy::Grid => grid::choose(cell, candidates, seed, scratch),
        Strategy::Random => random::choose(cell, candidates, seed, scratch),
        Strategy::First => first::choose(cell, candidates, scratch),
    }
}

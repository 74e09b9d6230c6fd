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
pub mod seed;

pub use average::average;
pub use rivals::Rival;

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

/// How far beyond a node candidates of its neighbours matter to it, in spacings: what those that are farther do to its
/// own hardly shows.
pub const REACH: f64 = 2.0;

/// What is known around a node; only [`Strategy::Poisson`] asks for it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Around<'a> {
    /// Positions that neighbours of the same level hold already, within one spacing of the cell.
    pub chosen: &'a [[f64; 3]],
    /// What neighbours of the same level will choose among, within [`REACH`] of the cell, with the seeds that it will have.
    pub rivals: &'a [Rival],
    /// Faces behind which there may be more that nobody knows yet: low x, high x, low y, high y, low z, high z.
    pub unknown: [bool; 6],
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
/// among the candidates.
///
/// A Poisson sample keeps away from the neighbours' points, and together with them and with what the rivals leave comes
/// within one spacing of each candidate; at faces behind which nothing is known, within 1.15. Returns ascending indices, at
/// least one if there is a candidate: but none by [`Strategy::Poisson`] if neighbours' points and rivals cover all.
pub fn choose(
    strategy: Strategy,
    cell: &Cell,
    candidates: &[[f64; 3]],
    seed: &[u64],
    around: Around,
    scratch: &mut Scratch,
) -> Vec<u32> {
    debug_assert_eq!(candidates.len(), seed.len());
    match strategy {
        Strategy::Poisson => poisson::choose(cell, candidates, seed, around, scratch),
        Strategy::Grid => grid::choose(cell, candidates, seed, scratch),
        Strategy::Random => random::choose(cell, candidates, seed, scratch),
        Strategy::First => first::choose(cell, candidates, scratch),
    }
}

//! The octree: names of nodes and the cubes that they stand for. Knows positions, not files.

pub mod cube;
pub mod key;
pub mod limits;
pub mod place;

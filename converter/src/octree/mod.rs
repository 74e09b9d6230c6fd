//! The octree: which node each point goes to. Knows positions, not files.

pub mod cube;
pub mod key;
pub mod sample;

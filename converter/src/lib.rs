//! The core of the `groma` command: LAS and LAZ in, one COPC 1.0 file out, every input record in exactly one
//! node, coordinates and attributes bit for bit.
//!
//! The way of the data is a chain of stages whose order the types enforce, see [`pipeline::Pipeline`].

pub mod build;
pub mod compress;
pub mod copc;
pub mod distribute;
pub mod error;
pub mod input;
pub mod memory;
pub mod octree;
pub mod output;
pub mod pipeline;
pub mod progress;
pub mod record;
pub mod sampling;
pub mod scan;
pub mod statistics;
pub mod temporary;
pub mod threads;
pub mod verify;

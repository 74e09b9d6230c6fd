//! COPC 1.0: a LAS 1.4 file whose LAZ chunks are the nodes of an octree (https://copc.io).

pub mod checksums;
pub mod chunk;
pub mod header;
pub mod hierarchy;
pub mod info;
pub mod records;
pub mod write;

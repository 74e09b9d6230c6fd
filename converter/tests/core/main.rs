//! The binary as a user runs it.

mod bench;
mod checksums;
mod conversion;
mod damage;
mod limits;
mod refusals;
mod samples;
mod temporary;

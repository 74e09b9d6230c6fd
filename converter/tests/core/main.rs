//! The binary as a user runs it.

mod bench;
mod conversion;
mod limits;
mod refusals;
mod samples;
mod temporary;

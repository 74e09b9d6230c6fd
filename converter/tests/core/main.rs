//! The binary as a user runs it.

mod bench;
mod conversion;
mod refusals;

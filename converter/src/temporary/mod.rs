//! What a run keeps outside memory for as long as it runs.

pub mod folder;
pub mod store;

//! Decoders on data that may be garbage: their panics are errors of the input.

use laz::LasZipError;
use std::panic::{AssertUnwindSafe, catch_unwind};

thread_local! {
    static CONTAINED: std::cell::Cell<bool> = const { std::cell::Cell::new(false) };
}

/// Whether the current thread runs a decoder whose panic will be caught and reported as an error of the input.
pub fn is_contained() -> bool {
    CONTAINED.get()
}

/// Runs a decoder on data that may be garbage: its error or panic becomes a cause in words.
pub fn contained<T>(
    work: impl FnOnce() -> std::result::Result<T, LasZipError>,
) -> std::result::Result<T, String> {
    CONTAINED.set(true);
    let result = catch_unwind(AssertUnwindSafe(work));
    CONTAINED.set(false);
    match result {
        Ok(result) => result.map_err(|e| e.to_string()),
        Err(_) => Err("the decoder gave up".to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_a_cause() {
        let cause = contained(|| -> std::result::Result<(), LasZipError> { panic!("index out of bounds") });
        assert_eq!(cause, Err("the decoder gave up".to_string()));
        assert!(!is_contained());
    }
}

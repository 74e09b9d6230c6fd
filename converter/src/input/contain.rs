//! Decoders on data that may be garbage: their panics are errors of the input.

use crate::error::{Error, Result};
use laz::LasZipError;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};

thread_local! {
    static CONTAINED: RefCell<Option<Error>> = const { RefCell::new(None) };
}

/// What a panic of the decoder that the current thread runs means; none where it runs no decoder. For the panic hook: such a
/// panic is caught and reported as an error of the input, or, where a program cannot catch panics (WebAssembly), has to
/// be reported by the hook.
pub fn meaning_of_panic() -> Option<Error> {
    CONTAINED.with_borrow(Clone::clone)
}

/// Runs a decoder on data that may be garbage. `fail` makes the error of the input from what the decoder says.
pub fn contained<T>(
    fail: impl Fn(String) -> Error,
    work: impl FnOnce() -> std::result::Result<T, LasZipError>,
) -> Result<T> {
    let given_up = fail("the decoder gave up".to_string());
    CONTAINED.set(Some(given_up.clone()));
    let result = catch_unwind(AssertUnwindSafe(work));
    CONTAINED.set(None);
    match result {
        Ok(result) => result.map_err(|e| fail(e.to_string())),
        Err(_) => Err(given_up),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn a_panic_becomes_an_error_of_the_input() {
        let fail = |cause| Error::corrupt(Path::new("a.laz"), cause);
        let mut told = None;
        let result = contained(fail, || -> std::result::Result<(), LasZipError> {
            told = meaning_of_panic();
            panic!("index out of bounds")
        });
        assert_eq!(result, Err(fail("the decoder gave up".to_string())));
        assert_eq!(told, result.err());
        assert_eq!(meaning_of_panic(), None);
    }
}

//! A queue for numbered parts of some work: threads take them in order and do them at once, and the results are handed
//! on in the order of the parts.

use crate::error::{Error, Result};
use std::collections::{BTreeMap, VecDeque};
use std::path::Path;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// Hands out parts by number, and hands on what they give: all of part 0 first, then all of part 1, and so on.
pub struct OrderedParts<T, F> {
    parts: usize,
    /// Results that may wait for their turn.
    most_waiting: usize,
    state: Mutex<State<T, F>>,
    moved: Condvar,
}

struct State<T, F> {
    claimed: usize,
    turn: usize,
    waiting: BTreeMap<usize, Waiting<T>>,
    count: usize,
    failure: Option<Error>,
    sink: F,
}

struct Waiting<T> {
    results: VecDeque<T>,
    ended: bool,
}

impl<T, F: FnMut(T) -> Result<()>> OrderedParts<T, F> {
    /// A queue of parts whose results `sink` gets, in the order of the parts.
    pub fn new(parts: usize, most_waiting: usize, sink: F) -> Self {
        let state = State { claimed: 0, turn: 0, waiting: BTreeMap::new(), count: 0, failure: None, sink };
        Self { parts, most_waiting, state: Mutex::new(state), moved: Condvar::new() }
    }

    /// The next part, if there is one and nothing has failed.
    pub fn claim(&self) -> Option<usize> {
        let mut state = self.state();
        let part = state.claimed;
        if part == self.parts || state.failure.is_some() {
            return None;
        }
        state.claimed += 1;
        Some(part)
    }

    /// Gives a result of a claimed part. Waits where too many wait before it; the part whose turn it is never does.
    pub fn give(&self, part: usize, result: T) -> Result<()> {
        let mut state = self.state();
        while state.failure.is_none() && state.turn != part && state.count >= self.most_waiting {
            state = self.moved.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
        if let Some(error) = &state.failure {
            return Err(error.clone());
        }
        if state.turn == part {
            return (state.sink)(result);
        }
        state.count += 1;
        state.waiting.entry(part).or_insert_with(Waiting::new).results.push_back(result);
        Ok(())
    }

    /// Says that a part has given all that it has.
    pub fn end(&self, part: usize) -> Result<()> {
        let mut state = self.state();
        state.waiting.entry(part).or_insert_with(Waiting::new).ended = true;
        while let Some(ended) = state.hand_on()? {
            if !ended {
                break;
            }
            let turn = state.turn;
            state.waiting.remove(&turn);
            state.turn += 1;
        }
        self.moved.notify_all();
        Ok(())
    }

    /// Stops everything. The first error counts.
    pub fn fail(&self, error: Error) {
        self.state().failure.get_or_insert(error);
        self.moved.notify_all();
    }

    /// The first error, or what the results went to.
    pub fn finish(self) -> Result<F> {
        let state = self.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        state.failure.map_or(Ok(state.sink), Err)
    }

    /// Stops everything if the current thread panics before the value is dropped: the others would wait for ever.
    pub fn watch(&self) -> Watch<'_, T, F> {
        Watch(self)
    }

    fn state(&self) -> MutexGuard<'_, State<T, F>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// See [`OrderedParts::watch`].
pub struct Watch<'a, T, F: FnMut(T) -> Result<()>>(&'a OrderedParts<T, F>);

impl<T, F: FnMut(T) -> Result<()>> Drop for Watch<'_, T, F> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.fail(Error::interrupted(Path::new("groma-core"), "a thread has failed"));
        }
    }
}

impl<T, F: FnMut(T) -> Result<()>> State<T, F> {
    /// Hands on what waits for the current turn, and tells whether its part has ended; `None` if nothing is known of it.
    fn hand_on(&mut self) -> Result<Option<bool>> {
        let Some(waiting) = self.waiting.get_mut(&self.turn) else { return Ok(None) };
        for result in waiting.results.drain(..) {
            self.count -= 1;
            (self.sink)(result)?;
        }
        Ok(Some(waiting.ended))
    }
}

impl<T> Waiting<T> {
    fn new() -> Self {
        Self { results: VecDeque::new(), ended: false }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs parts of some results each on threads of uneven speed.
    fn run(threads: usize, parts: usize, fails_at: Option<usize>) -> Result<Vec<(usize, usize)>> {
        let mut all = Vec::new();
        let ordered_parts = OrderedParts::new(parts, 3, |result| {
            all.push(result);
            Ok(())
        });
        std::thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(|| {
                    while let Some(part) = ordered_parts.claim() {
                        let work = || {
                            for index in 0..part % 4 {
                                if part % 3 == 0 {
                                    std::thread::sleep(std::time::Duration::from_micros(300));
                                }
                                ordered_parts.give(part, (part, index))?;
                            }
                            if fails_at == Some(part) {
                                return Err(Error::corrupt(Path::new("a"), "b"));
                            }
                            ordered_parts.end(part)
                        };
                        if let Err(error) = work() {
                            ordered_parts.fail(error);
                        }
                    }
                });
            }
        });
        ordered_parts.finish().map(drop)?;
        Ok(all)
    }

    #[test]
    fn results_arrive_in_order() {
        let expected: Vec<_> = (0..60).flat_map(|part| (0..part % 4).map(move |i| (part, i))).collect();
        for threads in [1, 2, 7] {
            assert_eq!(run(threads, 60, None).unwrap(), expected);
        }
    }

    #[test]
    fn a_failure_stops_all() {
        for threads in [1, 5] {
            assert_eq!(run(threads, 60, Some(20)).unwrap_err().code(), "INPUT_CORRUPT");
        }
    }
}

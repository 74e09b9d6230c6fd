//! Work on several threads, or on the current one where a program has no others (WebAssembly).

use std::thread;

/// Threads that can run at once.
pub fn available() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

/// Does the same work on so many threads at once, and ends when all of them have ended. One is the current thread.
///
/// Panics where the work does.
pub fn on_each(threads: usize, work: impl Fn() + Sync) {
    if threads <= 1 {
        return (0..threads).for_each(|_| work());
    }
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(&work);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;
    use std::sync::Mutex;

    #[test]
    fn one_is_the_current_thread_and_several_are_others() {
        let seen = |threads| {
            let ids = Mutex::new(HashSet::new());
            on_each(threads, || {
                ids.lock().unwrap().insert(thread::current().id());
            });
            ids.into_inner().unwrap()
        };
        let own = HashSet::from([thread::current().id()]);
        assert_eq!(seen(0), HashSet::new());
        assert_eq!(seen(1), own);
        assert_eq!(seen(3).len(), 3);
        assert!(seen(3).is_disjoint(&own));
    }
}

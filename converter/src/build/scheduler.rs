//! The scheduler: hands jobs to the workers phase by phase and, between them, nodes to be compressed.

use super::WorkerBudget;
use super::context::Uncompressed;
use super::plan::Job;
use crate::error::{Error, Result};
use std::collections::VecDeque;
use std::path::Path;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// Bytes of records that wait to be compressed, per worker.
const QUEUE: u64 = 4 << 20;

/// What a worker is given to do.
pub enum Task {
    /// A job and the bytes of memory that it takes.
    Job(Job, u64),
    Compress(Uncompressed),
}

/// The tasks that are left, shared by the workers.
pub struct Scheduler {
    work: u64,
    queue: u64,
    state: Mutex<State>,
    moved: Condvar,
}

struct State {
    /// The last phase comes first.
    phases: Vec<Vec<(Job, u64)>>,
    /// Jobs of the current phase, the smallest first.
    jobs: Vec<(Job, u64)>,
    active: usize,
    active_bytes: u64,
    /// Nodes that wait to be compressed, the oldest first.
    compressions: VecDeque<Uncompressed>,
    /// Bytes of their records.
    queued: u64,
    failure: Option<Error>,
}

impl Scheduler {
    /// `phases` in order; the jobs of one may be done at once, and all of them before any of the next. `bytes` tells
    /// what a job takes.
    pub fn new(phases: Vec<Vec<Job>>, bytes: impl Fn(&Job) -> u64, force: WorkerBudget) -> Self {
        let weighed = |jobs: Vec<Job>| {
            let mut jobs: Vec<_> = jobs
                .into_iter()
                .map(|job| {
                    let b = bytes(&job);
                    (job, b)
                })
                .collect();
            jobs.sort_by_key(|(_, bytes)| *bytes);
            jobs
        };
        let mut state = State {
            phases: phases.into_iter().rev().map(weighed).collect(),
            jobs: Vec::new(),
            active: 0,
            active_bytes: 0,
            compressions: VecDeque::new(),
            queued: 0,
            failure: None,
        };
        state.advance();
        Self {
            work: force.work,
            queue: QUEUE * force.workers as u64,
            state: Mutex::new(state),
            moved: Condvar::new(),
        }
    }

    /// Waits for something to do; `None` when there will be nothing more.
    pub fn next(&self) -> Option<Task> {
        let mut state = self.state();
        loop {
            if state.failure.is_some() {
                return None;
            }
            let full = state.queued >= self.queue;
            let fits =
                |bytes: u64, state: &State| state.active == 0 || state.active_bytes + bytes <= self.work;
            // Where the largest does not fit, a smaller one may.
            let job = state.jobs.iter().rposition(|(_, bytes)| fits(*bytes, &state)).filter(|_| !full);
            if let Some(index) = job {
                let (job, bytes) = state.jobs.remove(index);
                state.active += 1;
                state.active_bytes += bytes;
                return Some(Task::Job(job, bytes));
            }
            if let Some(node) = state.compressions.pop_front() {
                state.queued -= node.bytes();
                return Some(Task::Compress(node));
            }
            if state.active == 0 && state.jobs.is_empty() {
                return None;
            }
            state = self.moved.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Says that a job is done which took so many bytes.
    pub fn job_done(&self, bytes: u64) {
        let mut state = self.state();
        state.active -= 1;
        state.active_bytes -= bytes;
        if state.active == 0 && state.jobs.is_empty() {
            state.advance();
        }
        self.moved.notify_all();
    }

    /// Puts a node in line for compression; gives it back where too much waits already.
    pub fn queue(&self, node: Uncompressed) -> Option<Uncompressed> {
        let mut state = self.state();
        if state.queued >= self.queue {
            return Some(node);
        }
        state.queued += node.bytes();
        state.compressions.push_back(node);
        self.moved.notify_one();
        None
    }

    /// Stops everything. The first error counts.
    pub fn fail(&self, error: Error) {
        self.state().failure.get_or_insert(error);
        self.moved.notify_all();
    }

    /// The first error, if there is one.
    pub fn outcome(self) -> Result<()> {
        let state = self.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        state.failure.map_or(Ok(()), Err)
    }

    /// Stops everything if the current thread panics before the value is dropped: the others would wait for ever.
    pub fn watch(&self) -> Watch<'_> {
        Watch(self)
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    /// Goes on to the next phase that has jobs.
    fn advance(&mut self) {
        while self.jobs.is_empty() {
            let Some(jobs) = self.phases.pop() else { return };
            self.jobs = jobs;
        }
    }
}

/// See [`Scheduler::watch`].
pub struct Watch<'a>(&'a Scheduler);

impl Drop for Watch<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.fail(Error::interrupted(Path::new("groma-core"), "a thread has failed"));
        }
    }
}

//! Where a run tells how far it is.

use crate::error::steers;
use serde::Serialize;
use std::io::{StdoutLock, Write};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// The stages that a user sees, in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    Read,
    Build,
    Write,
}

/// Receives what a run has to tell. Called from several threads.
pub trait Progress: Sync {
    /// `done` of `total` points of a stage are done.
    fn advance(&self, stage: Stage, done: u64, total: u64);
    /// Something in the input was not as the standard wants it, and this is what was made of it.
    fn warn(&self, text: &str);
    /// The points lie within these, source units; said once, to who asked for it.
    fn bounds(&self, min: [f64; 3], max: [f64; 3]);
}

/// Tells nobody.
pub struct Silent;

impl Progress for Silent {
    fn advance(&self, _: Stage, _: u64, _: u64) {}
    fn warn(&self, _: &str) {}
    fn bounds(&self, _: [f64; 3], _: [f64; 3]) {}
}

#[derive(Serialize)]
#[serde(tag = "event", rename_all = "lowercase")]
enum Line<'a> {
    Progress { stage: Stage, done: u64, total: u64 },
    Warning { text: &'a str },
    Bounds { min: [f64; 3], max: [f64; 3] },
}

/// One JSON object per line on standard output.
pub struct JsonLines;

impl JsonLines {
    /// Prints one event. A closed pipe is not an error of the run, so a failed write is dropped.
    pub fn print(event: &impl Serialize) {
        let line = escaped(serde_json::to_string(event).unwrap_or_default());
        let mut out = std::io::stdout().lock();
        let _ = writeln!(out, "{line}").and_then(|()| out.flush());
    }

    /// Prints the last event of a process that ends next: while what it returns lives, other threads that print wait.
    pub fn print_last(event: &impl Serialize) -> StdoutLock<'static> {
        let out = std::io::stdout().lock();
        Self::print(event);
        out
    }
}

/// JSON that a terminal may show: the same to whoever parses it, but with escapes for what would steer a terminal.
/// Outside of strings JSON has no such characters.
fn escaped(json: String) -> String {
    if !json.chars().any(steers) {
        return json;
    }
    let mut out = String::with_capacity(json.len() + 16);
    for character in json.chars() {
        if steers(character) {
            let mut units = [0; 2];
            character
                .encode_utf16(&mut units)
                .iter()
                .for_each(|unit| out.push_str(&format!("\\u{unit:04x}")));
        } else {
            out.push(character);
        }
    }
    out
}

impl Progress for JsonLines {
    fn advance(&self, stage: Stage, done: u64, total: u64) {
        Self::print(&Line::Progress { stage, done, total });
    }

    fn warn(&self, text: &str) {
        Self::print(&Line::Warning { text });
    }

    fn bounds(&self, min: [f64; 3], max: [f64; 3]) {
        Self::print(&Line::Bounds { min, max });
    }
}

const INTERVAL: Duration = Duration::from_millis(100);

/// Counts the points of one stage and passes the count on, at most ten times a second and once at the end.
pub struct Meter<'a> {
    sink: &'a dyn Progress,
    stage: Stage,
    total: u64,
    done: AtomicU64,
    last: Mutex<Instant>,
}

impl<'a> Meter<'a> {
    /// Begins a stage of `total` points.
    pub fn start(sink: &'a dyn Progress, stage: Stage, total: u64) -> Self {
        sink.advance(stage, 0, total);
        Self { sink, stage, total, done: AtomicU64::new(0), last: Mutex::new(Instant::now()) }
    }

    /// Counts points that are done.
    pub fn add(&self, points: u64) {
        let done = self.done.fetch_add(points, Ordering::Relaxed) + points;
        if done == self.total {
            return;
        }
        if let Ok(mut last) = self.last.try_lock()
            && last.elapsed() >= INTERVAL
        {
            *last = Instant::now();
            self.sink.advance(self.stage, done, self.total);
        }
    }

    /// Ends the stage: all its points are done.
    pub fn finish(self) {
        self.sink.advance(self.stage, self.total, self.total);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_show_nothing_that_steers_and_mean_the_same() {
        let text = "a\u{1b}[31m\n\u{7f}\u{9b}\u{202e}\u{feff}ö\u{1f600}";
        let line = escaped(serde_json::to_string(&Line::Warning { text }).unwrap());
        assert!(!line.chars().any(steers), "{line}");
        assert_eq!(serde_json::from_str::<serde_json::Value>(&line).unwrap()["text"], text);
    }

    #[test]
    fn nothing_is_printed_after_the_last_word() {
        let last = JsonLines::print_last(&"last");
        let late = std::thread::spawn(|| JsonLines.warn("late"));
        std::thread::sleep(Duration::from_millis(50));
        assert!(!late.is_finished());
        drop(last);
        late.join().unwrap();
    }
}

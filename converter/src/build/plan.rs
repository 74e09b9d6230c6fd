//! Which nodes are built in which order.

use super::context::Pending;
use super::outline::Outline;
use crate::distribute::cells::{Cell, Cells};
use crate::octree::key::Key;
use crate::octree::limits::Limits;
use std::collections::HashMap;

/// A part of the tree that is built at once.
pub enum Job {
    /// A cell with too many points for a leaf: all nodes below it.
    Split { key: Key, cell: Cell },
    /// A cell whose points all have one code.
    Coincident { key: Key, cell: Cell },
    /// A node whose children are there.
    Merge { key: Key, children: u32 },
    /// The root has no parent that would take anything.
    Root,
}

impl Job {
    /// The node that it builds, with all below it that is not there yet.
    pub fn key(&self) -> Key {
        match self {
            Self::Split { key, .. } | Self::Coincident { key, .. } | Self::Merge { key, .. } => *key,
            Self::Root => Key::ROOT,
        }
    }

    /// Points that it holds in memory at a time, at most.
    pub fn points(&self, limits: &Limits) -> u64 {
        match self {
            Self::Split { cell, .. } => cell.points,
            Self::Coincident { .. } | Self::Root => limits.node,
            Self::Merge { children, .. } => u64::from(*children) * limits.node,
        }
    }
}

/// The jobs, and the nodes for which there is nothing to do until their parents come.
pub struct Plan {
    /// The jobs of a phase may be done at once: no two of its nodes touch.
    pub phases: Vec<Vec<Job>>,
    pub pending: HashMap<Key, Pending>,
    pub outline: Outline,
}

/// From the deepest level up, and on each level the nodes of one colour after those of another.
pub fn plan(cells: Cells, limits: &Limits) -> Plan {
    let cells: Vec<_> = cells.into_cells().collect();
    let outline = Outline::of(cells.iter().map(|(key, cell)| (*key, cell.points, cell.codes)), limits);
    let mut pending: HashMap<Key, Vec<Cell>> = HashMap::new();
    let mut jobs = Vec::new();
    let mut merges: HashMap<Key, u32> = HashMap::new();
    let mut cells = cells;
    cells.sort_by_key(|(_, cell)| cell.codes.0);
    for (key, cell) in cells {
        if let Some(leaf) = outline.leaf(key) {
            pending.entry(leaf).or_default().push(cell);
        } else if let Some(key) = outline.coincident(key) {
            jobs.push((key, Job::Coincident { key, cell }));
        } else {
            jobs.push((key, Job::Split { key, cell }));
        }
    }
    let mut open: Vec<Key> = pending.keys().copied().chain(jobs.iter().map(|(key, _)| *key)).collect();
    while let Some(key) = open.pop() {
        if key.level == 0 {
            continue;
        }
        let children = merges.entry(key.parent()).or_insert(0);
        *children += 1;
        if *children == 1 {
            open.push(key.parent());
        }
    }
    jobs.extend(merges.into_iter().map(|(key, children)| (key, Job::Merge { key, children })));
    jobs.sort_by_key(|(key, _)| (std::cmp::Reverse(key.level), key.colour(), key.morton()));
    let mut phases: Vec<Vec<Job>> = Vec::new();
    let mut last = None;
    for (key, job) in jobs {
        if last != Some((key.level, key.colour())) {
            last = Some((key.level, key.colour()));
            phases.push(Vec::new());
        }
        if let Some(phase) = phases.last_mut() {
            phase.push(job);
        }
    }
    phases.push(vec![Job::Root]);
    let pending = pending.into_iter().map(|(key, cells)| (key, Pending::of_cells(cells))).collect();
    Plan { phases, pending, outline }
}

//! The state that all jobs of a build share.

use super::arrange::{Arranger, Orders, Selection};
use super::border_points::BorderPoints;
use super::outline::Outline;
use super::scheduler::Scheduler;
use super::surroundings::Surroundings;
use crate::copc::chunk::{self, Node};
use crate::distribute::Inputs;
use crate::distribute::cells::Cell;
use crate::error::{Error, Result};
use crate::octree::cube::Cube;
use crate::octree::key::Key;
use crate::octree::limits::Limits;
use crate::progress::Meter;
use crate::record::has_colour;
use crate::sampling::{REACH, Scratch, Strategy};
use crate::temporary::store::{Held, Store};
use laz::LazVlr;
use std::collections::HashMap;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// How nodes are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rules {
    pub sampling: Strategy,
    /// Whether a sampled point has the mean colour of the points that it stands for, instead of its own.
    pub average_colors: bool,
}

/// Poisson samples, no colour changed.
impl Default for Rules {
    fn default() -> Self {
        Self { sampling: Strategy::Poisson, average_colors: false }
    }
}

/// Records of a node that has only to be compressed.
pub struct Uncompressed {
    pub key: Key,
    pub records: Vec<u8>,
}

impl Uncompressed {
    pub fn bytes(&self) -> u64 {
        self.records.len() as u64
    }
}

/// Points of a node whose parent has not chosen yet.
pub enum Pending {
    /// A leaf's, as distributed.
    Cells(Vec<Cell>),
    /// Records, then a u32 each of the points that they stand for, where colours are averaged.
    Held(Held),
}

impl Pending {
    /// A leaf's points.
    pub fn of_cells(cells: Vec<Cell>) -> Self {
        Self::Cells(cells)
    }
}

/// Records with the numbers of points that they stand for, which are missing where nothing is averaged.
#[derive(Debug, Default)]
pub struct Batch {
    pub records: Vec<u8>,
    pub weights: Vec<u32>,
}

/// Buffers of one worker, which serve job after job.
#[derive(Debug, Default)]
pub struct Buffers {
    pub positions: Vec<[f64; 3]>,
    pub seeds: Vec<u64>,
    pub surroundings: Surroundings,
    pub scratch: Scratch,
    pub arranger: Arranger,
}

/// Inputs, options and intermediate results of a build, shared by all workers.
pub struct Context<'a> {
    pub inputs: &'a Inputs,
    pub cube: Cube,
    pub limits: Limits,
    pub rules: Rules,
    pub laz: &'a LazVlr,
    pub store: &'a Store,
    /// Points that nodes have chosen, near the nodes' faces.
    pub chosen_borders: BorderPoints,
    /// Points that nodes hold until their parents choose, near the parents' faces.
    pub pending_borders: BorderPoints,
    pub outline: Outline,
    pub orders: Orders,
    meter: &'a Meter<'a>,
    scheduler: &'a Scheduler,
    pending: Mutex<HashMap<Key, Pending>>,
    nodes: Mutex<Vec<Node>>,
}

impl<'a> Context<'a> {
    #[expect(clippy::too_many_arguments, reason = "all that a build is about, said once")]
    pub fn new(
        inputs: &'a Inputs,
        cube: Cube,
        limits: Limits,
        rules: Rules,
        laz: &'a LazVlr,
        store: &'a Store,
        meter: &'a Meter<'a>,
        (pending, outline): (HashMap<Key, Pending>, Outline),
        scheduler: &'a Scheduler,
    ) -> Self {
        let (pending, nodes) = (Mutex::new(pending), Mutex::new(Vec::new()));
        Self {
            inputs,
            cube,
            limits,
            rules,
            laz,
            store,
            chosen_borders: BorderPoints::default(),
            pending_borders: BorderPoints::default(),
            outline,
            orders: Orders::default(),
            meter,
            scheduler,
            pending,
            nodes,
        }
    }

    /// Whether colours are averaged: asked for, and there.
    pub fn averages(&self) -> bool {
        self.rules.average_colors && has_colour(self.inputs.target)
    }

    /// Whether points keep a distance from those of neighbours.
    pub fn keeps_distance(&self) -> bool {
        self.rules.sampling == Strategy::Poisson
    }

    /// Where a record's point is, source coordinates.
    pub fn position(&self, record: &[u8]) -> [f64; 3] {
        self.inputs.frame.coordinates(crate::record::position(record))
    }

    /// Weights of points of the input.
    pub fn weights(&self, points: usize) -> Vec<u32> {
        if self.averages() { vec![1; points] } else { Vec::new() }
    }

    /// Keeps the points of a node until its parent chooses.
    pub fn keep(&self, key: Key, batch: Batch) -> Result<()> {
        if key.level > 0 && self.keeps_distance() {
            let parent = self.cube.cell(key.parent());
            let positions =
                batch.records.chunks_exact(self.inputs.length).map(|record| self.position(record));
            self.pending_borders.keep(key, &parent, REACH * parent.spacing, positions, self.store)?;
        }
        let mut bytes = batch.records;
        batch.weights.iter().for_each(|weight| bytes.extend(weight.to_le_bytes()));
        let held = self.store.keep(bytes)?;
        self.pending().insert(key, Pending::Held(held));
        Ok(())
    }

    /// Takes back the points of a node; none where there is no such node.
    pub fn take(&self, key: Key) -> Result<Batch> {
        self.pending_borders.forget(key, self.store)?;
        let length = self.inputs.length;
        let pending = self.pending().remove(&key);
        match pending {
            None => Ok(Batch::default()),
            Some(Pending::Cells(cells)) => {
                let mut records = Vec::new();
                for cell in cells {
                    records.append(&mut cell.load(length, self.store)?);
                }
                let weights = self.weights(records.len() / length);
                Ok(Batch { records, weights })
            }
            Some(Pending::Held(held)) => {
                let mut records = self.store.take(held)?;
                let mut weights = Vec::new();
                if self.averages() {
                    let count = records.len() / (length + 4);
                    weights.extend(
                        records[count * length..].as_chunks::<4>().0.iter().map(|b| u32::from_le_bytes(*b)),
                    );
                    records.truncate(count * length);
                }
                Ok(Batch { records, weights })
            }
        }
    }

    /// Gives a node its records for good.
    pub fn finish(&self, key: Key, selection: Selection, arranger: &mut Arranger) -> Result<()> {
        if selection.numbers.is_empty() {
            return Ok(());
        }
        let records = arranger.arrange(self, selection)?;
        match self.scheduler.queue(Uncompressed { key, records }) {
            Some(finish) => self.compress(finish),
            None => Ok(()),
        }
    }

    /// The Morton codes of records.
    pub fn codes(&self, records: &[u8]) -> Vec<u64> {
        let locator = self.inputs.frame.locator(&self.cube);
        records.chunks_exact(self.inputs.length).map(|record| locator.code(record)).collect()
    }

    /// Makes the root of what its children left to it, once all of them have chosen.
    pub fn finish_root(&self, arranger: &mut Arranger) -> Result<()> {
        let Batch { records, .. } = self.take(Key::ROOT)?;
        let codes = self.codes(&records);
        let numbers: Vec<u32> = (0..codes.len() as u32).collect();
        let selection = Selection { records: &records, codes: &codes, numbers: &numbers };
        self.finish(Key::ROOT, selection, arranger)
    }

    /// Compresses a node's records.
    pub fn compress(&self, finish: Uncompressed) -> Result<()> {
        let bytes = chunk::compress(&finish.records, self.laz);
        let points = finish.bytes() / self.inputs.length as u64;
        self.add(finish.key, points, bytes.map_err(Self::compression_failed)?)
    }

    /// Adds a node whose chunk is there.
    pub fn add(&self, key: Key, points: u64, chunk: Vec<u8>) -> Result<()> {
        let mut chunk = chunk;
        chunk.shrink_to_fit();
        let chunk = self.store.record(chunk)?;
        self.nodes.lock().unwrap_or_else(PoisonError::into_inner).push(Node { key, points, chunk });
        self.meter.add(points);
        Ok(())
    }

    /// A compression that failed.
    pub fn compression_failed(error: laz::LasZipError) -> Error {
        Error::output_write(Path::new("LAZ"), error)
    }

    /// All nodes that were added, in no order.
    pub fn into_nodes(self) -> Vec<Node> {
        self.nodes.into_inner().unwrap_or_else(PoisonError::into_inner)
    }

    fn pending(&self) -> MutexGuard<'_, HashMap<Key, Pending>> {
        self.pending.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

//! What a node has around it when it chooses: points that its neighbours took before, and those among which they will
//! choose after it.

use super::context::Context;
use crate::error::Result;
use crate::octree::key::Key;
use crate::sampling::{Around, Cell, REACH, Rival, seed};

/// Buffers for the surroundings of one node after another.
#[derive(Debug, Default)]
pub struct Surroundings {
    chosen: Vec<[f64; 3]>,
    rivals: Vec<Rival>,
    unknown: [bool; 6],
}

impl Surroundings {
    /// Looks around a node.
    ///
    /// Neighbours that choose later choose among what their children hold, and what these hold near the neighbour's
    /// faces is in [`Context::pending_borders`] until then: but for leaves, and for what is below a cell.
    pub fn look(&mut self, context: &Context, key: Key, cell: &Cell) -> Result<()> {
        let Self { chosen, rivals, unknown } = self;
        chosen.clear();
        context
            .chosen_borders
            .near(key.neighbours(), cell, cell.spacing, context.store, |position| chosen.push(position))?;
        rivals.clear();
        let children =
            key.neighbours().flat_map(|neighbour| (0..8).map(move |octant| neighbour.child(octant)));
        context.pending_borders.near(children, cell, REACH * cell.spacing, context.store, |position| {
            rivals.push((seed::of_place(key.level, &position), position));
        })?;
        *unknown = std::array::from_fn(|face| {
            key.beyond(face).is_some_and(|neighbour| context.outline.may_choose(neighbour))
        });
        Ok(())
    }

    /// What was seen last, as a sample takes it.
    pub fn around(&self) -> Around<'_> {
        Around { chosen: &self.chosen, rivals: &self.rivals, unknown: self.unknown }
    }
}

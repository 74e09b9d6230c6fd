//! What a node has around it when it chooses: points that its neighbours took before, and those among which they will
//! choose after it.

use super::site::Site;
use crate::error::Result;
use crate::octree::key::Key;
use crate::sampling::{Around, Cell, REACH, Rival};

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
    /// faces is in the site's rims until then: but for leaves, and for what is below a cell.
    pub fn look(&mut self, site: &Site, key: Key, cell: &Cell) -> Result<()> {
        let Self { chosen, rivals, unknown } = self;
        chosen.clear();
        site.borders
            .near(key.neighbours(), cell, cell.spacing, site.store, |position| chosen.push(position))?;
        rivals.clear();
        let children =
            key.neighbours().flat_map(|neighbour| (0..8).map(move |octant| neighbour.child(octant)));
        site.rims.near(children, cell, REACH * cell.spacing, site.store, |position| {
            rivals.push((seed(key.level, &position), position));
        })?;
        *unknown = std::array::from_fn(|face| {
            key.beyond(face).is_some_and(|neighbour| site.outline.may_choose(neighbour))
        });
        Ok(())
    }

    pub fn around(&self) -> Around<'_> {
        Around { chosen: &self.chosen, rivals: &self.rivals, unknown: self.unknown }
    }
}

/// The seed of a point for the choice of a level: by its place alone, so that neighbours know it too.
pub fn seed(level: u32, position: &[f64; 3]) -> u64 {
    let place = position.iter().fold(u64::from(level), |seed, v| hash(seed ^ v.to_bits()));
    hash(place)
}

/// A number with no visible relation to another (SplitMix64: Steele, Lea, Flood 2014).
pub fn hash(value: u64) -> u64 {
    let mut v = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    v = (v ^ v >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    v = (v ^ v >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    v ^ v >> 31
}

//! Positions near the faces of cubes: what neighbours have to know of each other to keep a distance across borders.

use crate::error::Result;
use crate::octree::key::Key;
use crate::sampling::Cell;
use crate::temporary::store::{Held, Store};
use std::collections::HashMap;
use std::sync::{PoisonError, RwLock};

/// Bytes of a position: three float64.
const POSITION: usize = 24;

/// Positions of nodes that lie near the faces of a cube.
#[derive(Debug, Default)]
pub struct BorderPoints(RwLock<HashMap<Key, Held>>);

impl BorderPoints {
    /// Keeps those of a node's positions that lie within `width` of a face of `cube`, source units.
    pub fn keep(
        &self,
        key: Key,
        cube: &Cell,
        width: f64,
        positions: impl Iterator<Item = [f64; 3]>,
        store: &Store,
    ) -> Result<()> {
        let (low, high) = (width, cube.side - width);
        let mut bytes = Vec::new();
        for position in positions {
            let inside = (0..3).all(|i| (low..=high).contains(&(position[i] - cube.min[i])));
            if !inside {
                position.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
            }
        }
        if !bytes.is_empty() {
            let held = store.record(bytes)?;
            self.0.write().unwrap_or_else(PoisonError::into_inner).insert(key, held);
        }
        Ok(())
    }

    /// Hands on the positions kept of some nodes that lie within `width` of a cube.
    pub fn near(
        &self,
        keys: impl Iterator<Item = Key>,
        cube: &Cell,
        width: f64,
        store: &Store,
        mut each: impl FnMut([f64; 3]),
    ) -> Result<()> {
        let (low, high) = (-width, cube.side + width);
        let border_points = self.0.read().unwrap_or_else(PoisonError::into_inner);
        for held in keys.filter_map(|key| border_points.get(&key)) {
            store.with(held, |bytes| {
                for position in bytes.as_chunks::<POSITION>().0 {
                    let (numbers, _) = position.as_chunks::<8>();
                    let position: [f64; 3] = std::array::from_fn(|i| f64::from_le_bytes(numbers[i]));
                    if (0..3).all(|i| (low..=high).contains(&(position[i] - cube.min[i]))) {
                        each(position);
                    }
                }
            })?;
        }
        Ok(())
    }

    /// Gives up what is kept of a node.
    pub fn forget(&self, key: Key, store: &Store) -> Result<()> {
        let held = self.0.write().unwrap_or_else(PoisonError::into_inner).remove(&key);
        held.map_or(Ok(()), |held| store.take(held).map(drop))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_near_a_face_is_kept_and_found_until_it_is_forgotten() {
        let folder = tempfile::tempdir().unwrap();
        for budget in [0, 1 << 20] {
            let store = Store::new(folder.path(), budget);
            let border_points = BorderPoints::default();
            let cell = |x: f64| Cell { min: [x, 0.0, 0.0], side: 128.0, spacing: 1.0 };
            let key = |x| Key { level: 3, x, y: 0, z: 0 };
            let positions = [[127.5, 50.0, 50.0], [126.5, 50.0, 50.0], [64.0, 0.5, 64.0], [64.0; 3]];
            border_points.keep(key(0), &cell(0.0), 1.0, positions.into_iter(), &store).unwrap();
            let near = |x: u32| {
                let mut near = Vec::new();
                let cube = cell(128.0 * f64::from(x));
                border_points
                    .near(key(x).neighbours(), &cube, 1.0, &store, |position| near.push(position))
                    .unwrap();
                near
            };
            assert_eq!(near(1), [positions[0]]);
            assert!(near(2).is_empty() && near(0).is_empty());
            border_points.forget(key(0), &store).unwrap();
            border_points.forget(key(1), &store).unwrap();
            assert!(near(1).is_empty());
            let _ = std::fs::remove_file(folder.path().join("log"));
        }
    }
}

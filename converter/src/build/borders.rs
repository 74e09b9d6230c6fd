//! Positions near the faces of nodes, from which later neighbours of the same level keep their distance.

use crate::error::Result;
use crate::octree::key::Key;
use crate::sampling::Cell;
use crate::temporary::store::{Held, Store};
use std::collections::HashMap;
use std::sync::{PoisonError, RwLock};

/// Bytes of a position: three float64.
const POSITION: usize = 24;

/// The borders of all nodes that have chosen their points.
#[derive(Debug, Default)]
pub struct Borders(RwLock<HashMap<Key, Held>>);

impl Borders {
    /// Keeps those of a node's positions that lie within one spacing of a face.
    pub fn keep(
        &self,
        key: Key,
        cell: &Cell,
        chosen: impl Iterator<Item = [f64; 3]>,
        store: &Store,
    ) -> Result<()> {
        let (low, high) = (cell.spacing, cell.side - cell.spacing);
        let mut bytes = Vec::new();
        for position in chosen {
            let inside = (0..3).all(|i| (low..=high).contains(&(position[i] - cell.min[i])));
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

    /// Appends the positions of a node's neighbours that lie within one spacing of the node's cube.
    pub fn near(&self, key: Key, cell: &Cell, store: &Store, near: &mut Vec<[f64; 3]>) -> Result<()> {
        let (low, high) = (-cell.spacing, cell.side + cell.spacing);
        let borders = self.0.read().unwrap_or_else(PoisonError::into_inner);
        for held in key.neighbours().filter_map(|neighbour| borders.get(&neighbour)) {
            store.with(held, |bytes| {
                for position in bytes.as_chunks::<POSITION>().0 {
                    let (numbers, _) = position.as_chunks::<8>();
                    let position: [f64; 3] = std::array::from_fn(|i| f64::from_le_bytes(numbers[i]));
                    if (0..3).all(|i| (low..=high).contains(&(position[i] - cell.min[i]))) {
                        near.push(position);
                    }
                }
            })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_near_a_face_is_kept_and_found() {
        let folder = tempfile::tempdir().unwrap();
        for budget in [0, 1 << 20] {
            let store = Store::new(folder.path(), budget);
            let borders = Borders::default();
            let cell = |x: f64| Cell { min: [x, 0.0, 0.0], side: 128.0, spacing: 1.0 };
            let key = |x| Key { level: 3, x, y: 0, z: 0 };
            let positions = [[127.5, 50.0, 50.0], [126.5, 50.0, 50.0], [64.0, 0.5, 64.0], [64.0; 3]];
            borders.keep(key(0), &cell(0.0), positions.into_iter(), &store).unwrap();
            let near = |x: u32| {
                let mut near = Vec::new();
                borders.near(key(x), &cell(128.0 * f64::from(x)), &store, &mut near).unwrap();
                near
            };
            assert_eq!(near(1), [positions[0]]);
            assert!(near(2).is_empty() && near(0).is_empty());
            let _ = std::fs::remove_file(folder.path().join("log"));
        }
    }
}

//! What is known of the tree before it is built.

use crate::octree::key::Key;
use crate::octree::limits::Limits;
use std::collections::HashMap;

/// What is below a node.
#[derive(Debug, Clone, Copy)]
struct Part {
    points: u64,
    /// Smallest and largest Morton code.
    codes: (u64, u64),
    /// Whether it is a cell, of whose inside nothing is known.
    cell: bool,
}

/// The cells and all nodes above them.
#[derive(Debug)]
pub struct Outline {
    parts: HashMap<Key, Part>,
    leaf: u64,
}

impl Outline {
    /// `cells` are given by their keys, with their points and their smallest and largest Morton codes.
    pub fn of(cells: impl Iterator<Item = (Key, u64, (u64, u64))>, limits: &Limits) -> Self {
        let mut parts: HashMap<Key, Part> = HashMap::new();
        for (cell, points, codes) in cells {
            let mut key = cell;
            loop {
                let part = parts.entry(key).or_insert(Part { points: 0, codes, cell: key == cell });
                part.points += points;
                part.codes = (part.codes.0.min(codes.0), part.codes.1.max(codes.1));
                if key.level == 0 {
                    break;
                }
                key = key.parent();
            }
        }
        Self { parts, leaf: limits.leaf }
    }

    /// The topmost leaf that a cell lies in, if it has no more points than a leaf may have.
    pub fn leaf(&self, key: Key) -> Option<Key> {
        self.topmost(key, |part| part.points <= self.leaf)
    }

    /// The topmost node that holds nothing but the coincident points of a cell, if all its points are.
    pub fn coincident(&self, key: Key) -> Option<Key> {
        self.topmost(key, |part| part.codes.0 == part.codes.1)
    }

    /// Whether a node may choose points: not if there is nothing in it, or no more than a leaf holds.
    pub fn may_choose(&self, key: Key) -> bool {
        let mut above = key;
        loop {
            match self.parts.get(&above) {
                Some(part) => return part.points > self.leaf && (above == key || part.cell),
                None if above.level == 0 => return false,
                None => above = above.parent(),
            }
        }
    }

    /// The highest node above one, or itself, of which something holds that holds of every node below.
    fn topmost(&self, mut key: Key, holds: impl Fn(&Part) -> bool) -> Option<Key> {
        let holds = |key: Key| self.parts.get(&key).is_some_and(&holds);
        if !holds(key) {
            return None;
        }
        while key.level > 0 && holds(key.parent()) {
            key = key.parent();
        }
        Some(key)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::octree::key::BITS;

    const LIMITS: Limits = Limits { leaf: 50_000, node: 100_000, cell: 500_000 };

    /// A cell of points with different codes.
    fn cell(key: Key, points: u64) -> (Key, u64, (u64, u64)) {
        let code = key.morton() << (3 * (BITS - key.level));
        (key, points, (code, code + 1))
    }

    #[test]
    fn what_cannot_choose_is_known_and_what_may_is_told_apart() {
        let (full, few) = (Key::ROOT.child(0).child(3), Key::ROOT.child(0).child(5));
        let cells = [cell(full, 400_000), cell(few, 10), cell(Key::ROOT.child(7), 10)];
        let outline = Outline::of(cells.into_iter(), &LIMITS);
        let may = [Key::ROOT, Key::ROOT.child(0), full, full.child(2)];
        assert!(may.into_iter().all(|key| outline.may_choose(key)));
        let not = [few, few.child(1), Key::ROOT.child(7), Key::ROOT.child(1), Key::ROOT.child(0).child(1)];
        assert!(!not.into_iter().any(|key| outline.may_choose(key)));
        assert_eq!(
            (outline.leaf(few), outline.leaf(full), outline.coincident(full)),
            (Some(few), None, None)
        );
    }

    #[test]
    fn leaves_and_coincident_points_begin_as_high_as_they_can() {
        let parent = Key::ROOT.child(2);
        let cells = [cell(parent.child(0), 20_000), cell(parent.child(1), 20_000), cell(Key::ROOT, 90_000)];
        let outline = Outline::of(cells.into_iter(), &LIMITS);
        assert_eq!(outline.leaf(parent.child(1)), Some(parent));
        let code = 5 << 57;
        let cell = Key::of(code, 2);
        let outline = Outline::of([(cell, 900_000, (code, code))].into_iter(), &LIMITS);
        assert_eq!(outline.coincident(cell), Some(Key::ROOT));
    }
}

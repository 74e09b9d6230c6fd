//! Rivals beyond the faces of a node: candidates of neighbours that choose later, or mirror images of the node's own
//! where the neighbours' are not known. Without them a candidate at a face would have rivals on one side only, and the
//! sample would be denser there.

use super::seed::hash;
use super::{Around, Cell};

/// Candidates nearer to a face than this have a stand-in, in spacings: what is farther keeps no candidate away.
const DEPTH: f64 = 1.0;

/// So far along the face a stand-in is from the candidate that it mirrors, in spacings: the two are no rivals.
const ASIDE: f64 = 4.0;

/// A seed and a position.
pub type Rival = (u64, [f64; 3]);

/// What a node's candidates have as rivals beside each other.
#[derive(Debug, Default)]
pub struct Rim {
    /// Neighbours' candidates, and mirror images of the node's own at faces behind which nothing is known.
    pub rivals: Vec<Rival>,
    /// Numbers of the candidates that have images; some more than once.
    pub candidates: Vec<u32>,
}

impl Rim {
    /// Finds them for a node's candidates, whose seeds stand at the same indices.
    pub fn find(&mut self, cell: &Cell, candidates: &[[f64; 3]], seed: &[u64], around: Around) {
        self.rivals.clear();
        self.candidates.clear();
        for axis in 0..3 {
            let faces = [(cell.min[axis], -1.0), (cell.min[axis] + cell.side, 1.0)];
            for ((face, outward), unknown) in faces.into_iter().zip(&around.unknown[2 * axis..]) {
                let is_beyond = |position: &[f64; 3]| (position[axis] - face) * outward > 0.0;
                let mut rivals = around.rivals.iter().map(|(_, position)| position);
                if !unknown || around.chosen.iter().any(is_beyond) || rivals.any(is_beyond) {
                    continue;
                }
                let depth = |position: &[f64; 3]| (face - position[axis]) * outward;
                let is_near = |position: &[f64; 3]| (0.0..DEPTH * cell.spacing).contains(&depth(position));
                let image = |seed: u64, mut position: [f64; 3]| {
                    position[axis] = face + outward * depth(&position);
                    position[if axis == 0 { 1 } else { 0 }] += ASIDE * cell.spacing;
                    (hash(seed ^ (axis as u64 + 1)), position)
                };
                // Those of the axes before have images too: neighbours across edges and corners.
                for index in 0..self.rivals.len() {
                    let (seed, position) = self.rivals[index];
                    if is_near(&position) {
                        self.rivals.push(image(seed, position));
                    }
                }
                for (position, number) in candidates.iter().zip(0u32..) {
                    if is_near(position) {
                        self.rivals.push(image(seed[number as usize], *position));
                        self.candidates.push(number);
                    }
                }
            }
        }
        self.rivals.extend_from_slice(around.rivals);
    }
}

#[cfg(test)]
mod tests {
    use super::super::scene::cube;
    use super::*;

    #[test]
    fn only_faces_behind_which_nothing_is_known_have_stand_ins() {
        let cell = cube([0.0; 3], 1.0);
        let candidates = [[0.25, 50.0, 50.0], [64.0, 64.0, 64.0], [127.5, 50.0, 50.0]];
        let mut rim = Rim::default();
        let mut unknown = [false; 6];
        (unknown[0], unknown[1]) = (true, true);
        let around = Around { chosen: &[[-0.5, 9.0, 9.0]], rivals: &[], unknown };
        rim.find(&cell, &candidates, &[1, 2, 3], around);
        assert_eq!(rim.candidates, [2]);
        assert_eq!(rim.rivals.len(), 1);
        assert_eq!(rim.rivals[0].1, [128.5, 54.0, 50.0]);
        assert_ne!(rim.rivals[0].0, 3);
        let rivals = [(9, [128.5, 50.0, 50.0])];
        rim.find(&cell, &candidates, &[1, 2, 3], Around { rivals: &rivals, ..around });
        assert!(rim.candidates.is_empty() && rim.rivals == rivals);
        rim.find(&cell, &candidates, &[1, 2, 3], Around::default());
        assert!(rim.candidates.is_empty() && rim.rivals.is_empty());
    }

    #[test]
    fn a_corner_has_stand_ins_on_all_sides() {
        let mut rim = Rim::default();
        rim.find(&cube([0.0; 3], 1.0), &[[0.5; 3]], &[1], Around { unknown: [true; 6], ..Around::default() });
        let behind = |axis: usize| rim.rivals.iter().filter(|(_, position)| position[axis] < 0.0).count();
        // Each has images at the faces of the axes after its own, along which it was not moved.
        assert_eq!([behind(0), behind(1), behind(2)], [1, 2, 3]);
        assert_eq!(rim.candidates, [0, 0, 0]);
    }
}

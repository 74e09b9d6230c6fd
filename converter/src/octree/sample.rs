//! Building the tree from the root down by grid sampling: a node takes the point nearest to the centre of
//! each occupied cell of a 128³ grid over its cube and leaves the others to its children. A node with few
//! points left takes them all.

use super::key::{BITS, Key, coordinates};
use rayon::prelude::*;

/// log₂ of the cells along a node's edge.
const GRID_BITS: u32 = 7;

/// Cells along the edge of a node's cube: the spacing of a node's points is its side by this number.
pub const GRID: u32 = 1 << GRID_BITS;

/// A node with no more points than this is a leaf.
pub const LEAF_POINTS: usize = 50_000;

/// Levels below this are not made: a node there takes all its points, however many.
const DEEPEST_LEVEL: u32 = 20;

/// One point to be placed: its Morton code in the root cube and its number in the input.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Entry {
    pub code: u64,
    pub index: u32,
}

/// A node and the numbers of its points, in Morton order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Node {
    pub key: Key,
    pub points: Vec<u32>,
}

/// Sorts points along the Morton curve; equal codes keep the input's order, whatever the number of threads.
pub fn sort(entries: &mut [Entry]) {
    entries.par_sort_unstable();
}

/// Distributes sorted entries over nodes, each entry to exactly one. The nodes come level by level, each
/// level along the Morton curve; every node holds at least one point. `placed` hears of every node's points.
pub fn build(mut entries: Vec<Entry>, placed: &(impl Fn(u64) + Sync)) -> Vec<Node> {
    let mut nodes = Vec::new();
    if !entries.is_empty() {
        nodes = subtree(Key::ROOT, &mut entries, placed);
    }
    nodes.sort_by_key(|node| (node.key.level, node.key.morton()));
    nodes
}

fn subtree(key: Key, entries: &mut [Entry], placed: &(impl Fn(u64) + Sync)) -> Vec<Node> {
    let points = take(key.level, entries);
    placed(points.len() as u64);
    let rest = entries.len() - points.len();
    let mut nodes = vec![Node { key, points }];
    let mut children = Vec::new();
    let mut tail = &mut entries[..rest];
    let shift = 3 * (BITS - key.level - 1);
    for octant in 0..8 {
        if tail.is_empty() {
            break;
        }
        let end = tail.partition_point(|entry| entry.code >> shift & 7 <= octant);
        let (child, after) = tail.split_at_mut(end);
        if !child.is_empty() {
            children.push((key.child(octant as u32), child));
        }
        tail = after;
    }
    let below: Vec<_> = children.into_par_iter().map(|(key, child)| subtree(key, child, placed)).collect();
    nodes.extend(below.into_iter().flatten());
    nodes
}

/// Chooses a node's own points. The others move, in order, to the front of `entries`.
fn take(level: u32, entries: &mut [Entry]) -> Vec<u32> {
    let coincident = entries.first().map(|e| e.code) == entries.last().map(|e| e.code);
    if entries.len() <= LEAF_POINTS || coincident || level >= DEEPEST_LEVEL {
        return entries.iter().map(|entry| entry.index).collect();
    }
    let cell_bits = BITS.saturating_sub(level + GRID_BITS);
    let mut chosen = Vec::new();
    let (mut start, mut left) = (0, 0);
    while start < entries.len() {
        let cell = entries[start].code >> (3 * cell_bits);
        let length =
            entries[start..].iter().take_while(|entry| entry.code >> (3 * cell_bits) == cell).count();
        let run = start..start + length;
        let best =
            run.clone().min_by_key(|i| distance_to_center(entries[*i].code, cell_bits)).unwrap_or(start);
        chosen.push(entries[best].index);
        for index in run.filter(|index| *index != best) {
            entries[left] = entries[index];
            left += 1;
        }
        start += length;
    }
    chosen
}

/// Square of the distance of a code from the centre of its cell of 2^bits codes along each edge, in half codes.
fn distance_to_center(code: u64, bits: u32) -> u64 {
    let center = 1i64 << bits;
    let mask = (1u32 << bits) - 1;
    let square = |c: u32| (2 * i64::from(c & mask) + 1 - center).pow(2) as u64;
    coordinates(code).into_iter().map(square).sum()
}

#[cfg(test)]
mod tests {
    use super::super::key::morton;
    use super::*;
    use proptest::prelude::*;
    use std::collections::HashSet;

    fn entries(codes: impl IntoIterator<Item = u64>) -> Vec<Entry> {
        let mut all: Vec<_> =
            codes.into_iter().enumerate().map(|(i, code)| Entry { code, index: i as u32 }).collect();
        sort(&mut all);
        all
    }

    fn tree(codes: &[u64]) -> Vec<Node> {
        build(entries(codes.iter().copied()), &|_| ())
    }

    /// A hash with good spread, for points without any order.
    fn scatter(seed: u64) -> u64 {
        let mut v = seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        v = (v ^ v >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        v ^ v >> 31
    }

    fn check(codes: &[u64], nodes: &[Node]) {
        let mut seen = vec![0u8; codes.len()];
        let keys: HashSet<_> = nodes.iter().map(|n| n.key).collect();
        assert_eq!(keys.len(), nodes.len());
        for node in nodes {
            assert!(!node.points.is_empty());
            for point in &node.points {
                seen[*point as usize] += 1;
                assert_eq!(Key::of(codes[*point as usize], node.key.level), node.key);
                for level in 0..node.key.level {
                    assert!(keys.contains(&Key::of(codes[*point as usize], level)));
                }
            }
        }
        assert!(seen.iter().all(|times| *times == 1));
    }

    #[test]
    fn a_surface_is_split_into_levels() {
        let codes: Vec<_> = (0..400_000)
            .map(|i| {
                morton([
                    scatter(i) as u32 % (1 << BITS),
                    scatter(i + 1_000_000) as u32 % (1 << BITS),
                    1 << 20,
                ])
            })
            .collect();
        let nodes = tree(&codes);
        check(&codes, &nodes);
        assert_eq!(nodes[0].key, Key::ROOT);
        assert!(nodes[0].points.len() <= 128 * 128 && nodes[0].points.len() > 16_000);
        assert!(nodes.iter().all(|n| n.points.len() <= LEAF_POINTS));
    }

    #[test]
    fn coincident_points_share_a_node() {
        let codes = vec![morton([5, 6, 7]); 200_000];
        assert_eq!(tree(&codes).len(), 1);
        let mut with_others = codes.clone();
        with_others.extend((0..1000).map(|i| scatter(i) >> 1));
        let nodes = tree(&with_others);
        check(&with_others, &nodes);
        assert!(nodes.len() < 100, "{}", nodes.len());
    }

    #[test]
    fn a_line_is_split() {
        let codes: Vec<_> = (0..300_000).map(|i| morton([i * 6, 0, 0])).collect();
        let nodes = tree(&codes);
        check(&codes, &nodes);
        assert_eq!(nodes[0].points.len(), 110);
    }

    #[test]
    fn the_chosen_point_is_the_nearest_to_the_centre() {
        assert!(distance_to_center(morton([4, 4, 4]), 3) < distance_to_center(morton([4, 4, 7]), 3));
        assert_eq!(distance_to_center(morton([3, 3, 3]), 3), distance_to_center(morton([4, 4, 4]), 3));
        assert_eq!(distance_to_center(morton([9, 9, 9]), 0), 0);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(12))]
        #[test]
        fn every_point_is_in_exactly_one_node(
            count in 1usize..200_000,
            seed in any::<u64>(),
            spread in 1u32..63,
        ) {
            let codes: Vec<_> = (0..count as u64).map(|i| scatter(i ^ seed) >> 1 >> (63 - spread)).collect();
            check(&codes, &tree(&codes));
        }
    }

    #[test]
    fn nothing_gives_no_node() {
        assert!(tree(&[]).is_empty());
    }
}

//! What stands in the nodes of a file, read by its hierarchy.

use crate::bench::{Bench, Las, cloud, scatter};
use groma_core::copc::chunk::parameters;
use groma_core::octree::cube::GRID;
use laz::record::{LayeredPointRecordDecompressor, RecordDecompressor};
use std::collections::HashMap;
use std::io::Cursor;
use std::path::Path;

type Key = [i32; 4];

/// The integer positions of every node of a file of format 6, whose hierarchy is one page; and the root's side.
fn nodes(path: &Path) -> (HashMap<Key, Vec<[i32; 3]>>, f64) {
    let bytes = std::fs::read(path).unwrap();
    let long = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize;
    let int = |at: usize| i32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let info = 375 + 54;
    let half = f64::from_le_bytes(bytes[info + 24..info + 32].try_into().unwrap());
    let (page, size) = (long(info + 40), long(info + 48));
    let mut nodes = HashMap::new();
    for at in (page..page + size).step_by(32) {
        let (key, count) = ([int(at), int(at + 4), int(at + 8), int(at + 12)], int(at + 28));
        let mut records = vec![0; count as usize * 30];
        if count > 0 {
            let chunk = &bytes[long(at + 16)..][..int(at + 24) as usize];
            let mut decoder = LayeredPointRecordDecompressor::new(Cursor::new(chunk));
            decoder.set_fields_from(parameters(6, 0).unwrap().items()).unwrap();
            decoder.decompress_many(&mut records).unwrap();
        }
        nodes.insert(key, records.chunks_exact(30).map(groma_core::record::position).collect());
    }
    (nodes, half * 2.0)
}

fn parent([level, x, y, z]: Key) -> Key {
    [level - 1, x >> 1, y >> 1, z >> 1]
}

#[test]
fn poisson_samples_keep_their_distance_across_borders() {
    let bench = Bench::new();
    let mut positions: Vec<_> = (0..900_000u64)
        .map(|i| {
            let (x, y) = (scatter(2 * i) % 400_000, scatter(2 * i + 1) % 400_000);
            [x as i32, y as i32, ((x as f64 / 40_000.0).sin() * 9000.0) as i32]
        })
        .collect();
    positions.extend(cloud(150_000, [30_000, 30_000, 30_000]));
    let mut las = Las::at(6, 0, &positions);
    las.scale = [1.0; 3];
    las.offset = [0.0; 3];
    bench.put("in.las", &las.las());
    bench.convert(&["in.las", "out.copc.laz", "--sampling", "poisson"]);
    let (nodes, side) = nodes(&bench.path("out.copc.laz"));
    let inner: std::collections::HashSet<Key> =
        nodes.keys().filter(|key| key[0] > 0).map(|key| parent(*key)).collect();
    for level in 0..=2 {
        let spacing = side / f64::from(1 << level) / f64::from(GRID);
        let mut grid: HashMap<[i64; 3], Vec<[i32; 3]>> = HashMap::new();
        let cell = |p: &[i32; 3]| p.map(|v| (f64::from(v) / spacing).floor() as i64);
        for (_, points) in nodes.iter().filter(|(key, _)| key[0] == level && inner.contains(*key)) {
            points.iter().for_each(|p| grid.entry(cell(p)).or_default().push(*p));
        }
        let mut pairs = 0;
        for (at, points) in &grid {
            let around = (0..27).map(|i| [at[0] + i % 3 - 1, at[1] + i / 3 % 3 - 1, at[2] + i / 9 - 1]);
            let near: Vec<_> = around.filter_map(|c| grid.get(&c)).flatten().collect();
            for p in points {
                let close = |q: &[i32; 3]| {
                    (0..3).map(|i| (f64::from(p[i]) - f64::from(q[i])).powi(2)).sum::<f64>()
                        < spacing * spacing
                };
                // A point is close to itself.
                pairs += near.iter().filter(|q| close(q)).count() - 1;
            }
        }
        assert_eq!(pairs, 0, "level {level}");
        assert!(level > 1 || !grid.is_empty());
    }
}

#[test]
fn a_million_coincident_points_stand_in_a_chain() {
    let bench = Bench::new();
    let mut positions = vec![[7, 8, 9]; 1_000_000];
    positions.push([500_000, 400_000, 300_000]);
    bench.put("in.las", &Las::at(6, 0, &positions).las());
    bench.convert(&["in.las", "out.copc.laz"]);
    let (nodes, _) = nodes(&bench.path("out.copc.laz"));
    assert!(nodes.values().all(|points| points.len() <= 100_000));
    assert_eq!(nodes.values().map(Vec::len).sum::<usize>(), 1_000_001);
    assert!(nodes.len() < 16, "{}", nodes.len());
    assert!(nodes.keys().filter(|key| key[0] > 0).all(|key| nodes.contains_key(&parent(*key))));
}

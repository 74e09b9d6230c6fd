//! What sampling costs and how even it is: `cargo run --release --example sampling -- scan.laz [strategy …]`.
//!
//! Builds the tree in memory on one thread, bottom-up and in eight phases as the converter does, but as if it knew all
//! candidates of neighbours everywhere, and prints per strategy the seconds spent in `choose`, and per level the density at borders against the interior.

use clap::ValueEnum;
use groma_core::octree::cube::{Bounds, Cube};
use groma_core::octree::key::{BITS, Key};
use groma_core::sampling::{Around, Cell, REACH, Rival, Scratch, Strategy, choose};
use groma_core::scan::Scan;
use laz::{LasZipDecompressor, LazVlr};
use std::collections::{BTreeMap, HashMap};
use std::fs::File;
use std::io::{BufReader, Seek, SeekFrom};
use std::time::{Duration, Instant};

const GRID: f64 = 128.0;
/// Each choice is timed so often, and the least time counts.
const ROUNDS: usize = 3;
const LEAF_POINTS: usize = 50_000;

struct Cloud {
    positions: Vec<[f64; 3]>,
    seeds: Vec<u64>,
    codes: Vec<u64>,
    cube: Cube,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let cloud = Cloud::read(&arguments.next().ok_or("the name of a LAS or LAZ file is missing")?)?;
    let asked: Vec<_> = arguments.map(|name| Strategy::from_str(&name, true)).collect::<Result<_, _>>()?;
    let strategies = if asked.is_empty() { Strategy::value_variants().to_vec() } else { asked };
    for strategy in strategies {
        cloud.report(strategy);
    }
    Ok(())
}

/// A hash with good spread.
fn scatter(seed: u64) -> u64 {
    let mut v = seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    v = (v ^ v >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    v ^ v >> 31
}

type Nodes = BTreeMap<u64, Vec<u32>>;

impl Cloud {
    fn read(path: &str) -> Result<Self, Box<dyn std::error::Error>> {
        let scan = Scan::read(path.as_ref())?;
        let record = scan.record(LazVlr::USER_ID, LazVlr::RECORD_ID).ok_or("this is not a LAZ file")?;
        let mut file = BufReader::new(File::open(path)?);
        file.seek(SeekFrom::Start(scan.header.offset_to_point_data.into()))?;
        let mut laz = LasZipDecompressor::new(file, LazVlr::from_buffer(&record.data)?)?;
        let length = usize::from(scan.header.point_data_record_length);
        let mut records = vec![0; scan.points as usize * length];
        laz.decompress_many(&mut records)?;
        let header = &scan.header;
        let scale = [header.x_scale_factor, header.y_scale_factor, header.z_scale_factor];
        let offset = [header.x_offset, header.y_offset, header.z_offset];
        let integer = |record: &[u8], i: usize| i32::from_le_bytes([0, 1, 2, 3].map(|b| record[4 * i + b]));
        let position = |record| [0, 1, 2].map(|i| f64::from(integer(record, i)) * scale[i] + offset[i]);
        let positions: Vec<_> = records.chunks_exact(length).map(position).collect();
        let fold = |f: fn(f64, f64) -> f64, from: f64| {
            [0, 1, 2].map(|i| positions.iter().map(|p: &[f64; 3]| p[i]).fold(from, f))
        };
        let bounds = Bounds { min: fold(f64::min, f64::INFINITY), max: fold(f64::max, f64::NEG_INFINITY) };
        let cube = Cube::around(&bounds, scale);
        let codes = positions.iter().map(|p| cube.code(*p)).collect();
        let seeds = (0..positions.len() as u64).map(scatter).collect();
        Ok(Self { positions, seeds, codes, cube })
    }

    fn cell(&self, key: Key) -> Cell {
        let side = self.cube.side() / f64::from(1u32 << key.level);
        let min = self.cube.min();
        let corner = [key.x, key.y, key.z];
        Cell { min: [0, 1, 2].map(|i| min[i] + side * f64::from(corner[i])), side, spacing: side / GRID }
    }

    /// Leaves by level, by the Morton code of their keys.
    fn leaves(&self) -> Vec<Nodes> {
        let mut leaves = vec![];
        let mut open = Nodes::from([(0, (0..self.positions.len() as u32).collect())]);
        while !open.is_empty() {
            let level = leaves.len() as u32;
            let shift = 3 * (BITS - level - 1);
            let mut next = Nodes::new();
            let mut own = Nodes::new();
            for (node, points) in open {
                if points.len() <= LEAF_POINTS {
                    own.insert(node, points);
                } else {
                    points.iter().for_each(|i| {
                        next.entry(self.codes[*i as usize] >> shift).or_default().push(*i);
                    });
                }
            }
            leaves.push(own);
            open = next;
        }
        leaves
    }

    fn report(&self, strategy: Strategy) {
        let leaves = self.leaves();
        let (mut spent, mut candidates) = (Duration::ZERO, 0);
        let mut held = Nodes::new();
        let mut scratch = Scratch::default();
        println!("{strategy:?}");
        for level in (0..leaves.len() as u32).rev() {
            let mut below = std::mem::replace(&mut held, leaves[level as usize].clone());
            let mut parents = Nodes::new();
            below.iter_mut().for_each(|(node, points)| parents.entry(node >> 3).or_default().append(points));
            let mut chosen = HashMap::<[u32; 3], Vec<[f64; 3]>>::new();
            if level + 1 == leaves.len() as u32 {
                continue;
            }
            let key = |node: u64| Key::of(node << (3 * (BITS - level)), level);
            let rivals: HashMap<[u32; 3], Vec<Rival>> = parents
                .iter()
                .map(|(node, own)| {
                    let rival = |i: &u32| (self.seeds[*i as usize], self.positions[*i as usize]);
                    let Key { x, y, z, .. } = key(*node);
                    ([x, y, z], own.iter().map(rival).collect())
                })
                .collect();
            for phase in 0..8u64 {
                for (node, own) in parents.iter_mut().filter(|(node, _)| *node & 7 == phase) {
                    own.sort_unstable();
                    let (name, cell) = (key(*node), self.cell(key(*node)));
                    let positions: Vec<_> = own.iter().map(|i| self.positions[*i as usize]).collect();
                    let seeds: Vec<_> = own.iter().map(|i| self.seeds[*i as usize]).collect();
                    let place = [name.x, name.y, name.z];
                    let near = beside(place, &cell, 1.0, |other| chosen.get(&other), |p| p);
                    let later = |other| rivals.get(&other).filter(|_| !chosen.contains_key(&other));
                    let later = beside(place, &cell, REACH, later, |(_, p)| p);
                    let around = Around { chosen: &near, rivals: &later, unknown: [false; 6] };
                    let mut least = Duration::MAX;
                    let mut taken = Vec::new();
                    for _ in 0..ROUNDS {
                        let began = Instant::now();
                        taken = choose(strategy, &cell, &positions, &seeds, around, &mut scratch);
                        least = least.min(began.elapsed());
                    }
                    spent += least;
                    candidates += own.len();
                    let at = taken.iter().map(|i| positions[*i as usize]).collect();
                    chosen.insert([name.x, name.y, name.z], at);
                    held.insert(*node, taken.iter().map(|i| own[*i as usize]).collect());
                }
            }
            let total: usize = chosen.values().map(Vec::len).sum();
            println!(
                "  level {level}: {} nodes, {total} points, {}",
                chosen.len(),
                self.strip(level, &chosen)
            );
        }
        println!("  {candidates} candidates, {:.3} s in choose", spent.as_secs_f64());
    }

    /// Density within a quarter of a spacing of the borders along x and y that two nodes share, against that from
    /// two to six spacings inside; per side of the border by the phase of the node (even: chooses first).
    fn strip(&self, level: u32, chosen: &HashMap<[u32; 3], Vec<[f64; 3]>>) -> String {
        let mut counts = [[0usize; 2]; 2];
        for (name, points) in chosen {
            let cell = self.cell(Key { level, x: name[0], y: name[1], z: name[2] });
            for (axis, up) in [(0, false), (0, true), (1, false), (1, true)] {
                let mut other = *name;
                other[axis] = if up { name[axis] + 1 } else { name[axis].wrapping_sub(1) };
                if !chosen.contains_key(&other) {
                    continue;
                }
                let side = usize::from(name[axis] & 1 == 1);
                for point in points {
                    let from = (point[axis] - cell.min[axis]) / cell.spacing;
                    let off = if up { GRID - from } else { from };
                    counts[side][0] += usize::from(off < 0.25);
                    counts[side][1] += usize::from((2.0..6.0).contains(&off));
                }
            }
        }
        let ratio = |[strip, inside]: [usize; 2]| 16.0 * strip as f64 / inside as f64;
        let both = [counts[0][0] + counts[1][0], counts[0][1] + counts[1][1]];
        format!("strip {:.3} (first {:.3}, second {:.3})", ratio(both), ratio(counts[0]), ratio(counts[1]))
    }
}

/// What the 26 neighbours hold within some spacings of a cell.
fn beside<'a, T: Copy + 'a>(
    name: [u32; 3],
    cell: &Cell,
    spacings: f64,
    held: impl Fn([u32; 3]) -> Option<&'a Vec<T>>,
    place: impl Fn(&T) -> &[f64; 3],
) -> Vec<T> {
    let width = spacings * cell.spacing;
    let mut near = Vec::new();
    for step in (0..27u32).filter(|step| *step != 13) {
        let other = [step % 3, step / 3 % 3, step / 9];
        let other = [0, 1, 2].map(|i| (name[i] + other[i]).wrapping_sub(1));
        near.extend(held(other).into_iter().flatten().filter(|item| {
            (0..3).all(|i| {
                let from = place(item)[i] - cell.min[i];
                from > -width && from < cell.side + width
            })
        }));
    }
    near
}

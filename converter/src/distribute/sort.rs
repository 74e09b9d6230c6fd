//! Sorting a piece of the input by the cells that its points go to.

use crate::octree::key::{BITS, Key};
use crate::octree::place::Locator;

/// Where a sorter puts points: to the cells of a level within one node.
#[derive(Debug, Clone, Copy)]
pub struct Target {
    pub locator: Locator,
    /// Level of a node that holds all points.
    pub from: u32,
    /// Level of the cells, a few below.
    pub to: u32,
}

/// Records in a row that go to one cell.
#[derive(Debug, Clone, Copy)]
pub struct Run {
    pub key: Key,
    pub start: usize,
    pub end: usize,
    /// Smallest and largest Morton code.
    pub codes: (u64, u64),
}

/// Records cell by cell, those of a cell in the order in which they came.
#[derive(Debug)]
pub struct Sorted {
    pub records: Vec<u8>,
    pub runs: Vec<Run>,
}

/// Buffers of one thread.
#[derive(Debug, Default)]
pub struct Sorter {
    codes: Vec<u64>,
    /// Per cell of the level: the number of its run, plus one.
    slots: Vec<u32>,
}

impl Sorter {
    /// Sorts records of `length` bytes, all of which lie in the node of the target.
    pub fn sort(&mut self, records: &[u8], length: usize, target: &Target) -> Sorted {
        let shift = 3 * (BITS - target.to);
        let mask = (1u64 << (3 * (target.to - target.from))) - 1;
        self.slots.resize(self.slots.len().max(mask as usize + 1), 0);
        let Self { codes, slots } = self;
        codes.clear();
        codes.extend(records.chunks_exact(length).map(|record| target.locator.code(record)));
        let mut runs: Vec<Run> = Vec::new();
        for code in codes.iter() {
            let slot = &mut slots[(code >> shift & mask) as usize];
            if *slot == 0 {
                runs.push(Run { key: Key::of(*code, target.to), start: 0, end: 0, codes: (*code, *code) });
                *slot = runs.len() as u32;
            }
            let run = &mut runs[*slot as usize - 1];
            run.end += length;
            run.codes = (run.codes.0.min(*code), run.codes.1.max(*code));
        }
        let mut at = 0;
        for run in &mut runs {
            (run.start, at) = (at, at + run.end);
            run.end = run.start;
        }
        let mut sorted = vec![0; at];
        for (record, code) in records.chunks_exact(length).zip(codes.iter()) {
            let run = &mut runs[slots[(code >> shift & mask) as usize] as usize - 1];
            sorted[run.end..run.end + length].copy_from_slice(record);
            run.end += length;
        }
        for run in &runs {
            slots[(run.codes.0 >> shift & mask) as usize] = 0;
        }
        Sorted { records: sorted, runs }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::octree::cube::Cube;
    use crate::octree::place::Frame;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn each_record_goes_to_its_cell_in_order(
            positions in proptest::collection::vec(proptest::array::uniform3(0i32..1000), 1..300),
            to in 0u32..5,
        ) {
            let frame = Frame { scale: [1.0; 3], offset: [0.0; 3] };
            let cube = Cube { center: [500.0; 3], half_size: 500.5 };
            let locator = frame.locator(&cube);
            let mut records = Vec::new();
            for (index, position) in positions.iter().enumerate() {
                position.iter().for_each(|v| records.extend(v.to_le_bytes()));
                records.extend((index as u16).to_le_bytes());
            }
            let mut sorter = Sorter::default();
            for _ in 0..2 {
                let target = Target { locator, from: 0, to };
                let sorted = sorter.sort(&records, 14, &target);
                let mut seen = 0;
                for run in &sorted.runs {
                    let mut last = None;
                    for record in sorted.records[run.start..run.end].chunks_exact(14) {
                        let code = locator.code(record);
                        prop_assert_eq!(Key::of(code, to), run.key);
                        prop_assert!(run.codes.0 <= code && code <= run.codes.1);
                        let index = u16::from_le_bytes([record[12], record[13]]);
                        prop_assert!(last < Some(index));
                        prop_assert_eq!(&records[usize::from(index) * 14..][..14], record);
                        last = Some(index);
                        seen += 1;
                    }
                }
                prop_assert_eq!(seen, positions.len());
            }
        }
    }
}

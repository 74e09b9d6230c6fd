//! The order of seeds.

/// Seeds are first thrown into this many buckets, by their upper bits.
const BUCKETS: usize = 1 << BUCKET_BITS;
const BUCKET_BITS: u32 = 9;

/// A candidate: its seed, its number, its position.
type Candidate = (u64, u32, [f64; 3]);

/// Candidates by seed, equal seeds by number.
#[derive(Debug, Default)]
pub struct Order {
    sorted: Vec<Candidate>,
    keys: Vec<(u64, u32)>,
}

impl Order {
    /// Visits all candidates, the least seed first.
    ///
    /// Positions travel with the seeds: who visits reads memory in order, and what is sorted at a time stays
    /// in the nearest cache.
    pub fn visit(
        &mut self,
        candidates: impl Iterator<Item = (u64, [f64; 3])> + Clone,
        mut visitor: impl FnMut(u32, &[f64; 3]),
    ) {
        let (mut most, mut count) = (0, 0);
        candidates.clone().for_each(|(seed, _)| (most, count) = (seed.max(most), count + 1));
        let shift = (u64::BITS - most.leading_zeros()).saturating_sub(BUCKET_BITS);
        let bucket = |seed: u64| (seed >> shift) as usize;
        let mut ends = [0; BUCKETS];
        candidates.clone().for_each(|(seed, _)| ends[bucket(seed)] += 1);
        let mut sum = 0;
        for end in &mut ends {
            sum += std::mem::replace(end, sum);
        }
        // Each bucket's start moves on to its end while the bucket is filled.
        self.sorted.resize(count, (0, 0, [0.0; 3]));
        for ((seed, position), index) in candidates.zip(0..) {
            let end = &mut ends[bucket(seed)];
            self.sorted[*end] = (seed, index, position);
            *end += 1;
        }
        let mut start = 0;
        for end in ends {
            let run = &mut self.sorted[start..end];
            run.sort_unstable_by_key(|(seed, index, _)| (*seed, *index));
            run.iter().for_each(|(_, index, position)| visitor(*index, position));
            start = end;
        }
    }

    /// The numbers of the `count` candidates of least seed, in no order.
    pub fn least(&mut self, seed: &[u64], count: usize) -> impl Iterator<Item = u32> {
        self.keys.clear();
        self.keys.extend(seed.iter().copied().zip(0..));
        if count < self.keys.len() {
            self.keys.select_nth_unstable(count);
        }
        self.keys.iter().take(count).map(|(_, index)| *index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn visited(seed: &[u64]) -> Vec<u32> {
        let candidates = seed.iter().enumerate().map(|(i, seed)| (*seed, [i as f64; 3]));
        let mut all = Vec::new();
        Order::default().visit(candidates, |index, position| {
            assert_eq!(*position, [f64::from(index); 3]);
            all.push(index);
        });
        all
    }

    proptest! {
        #[test]
        fn visits_go_by_seed_then_by_number(
            mut seed in prop::collection::vec(any::<u64>(), 0..2000), shift in 0u32..64,
        ) {
            seed.iter_mut().for_each(|seed| *seed >>= shift);
            let mut expected: Vec<_> = (0..seed.len() as u32).collect();
            expected.sort_by_key(|index| seed[*index as usize]);
            prop_assert_eq!(visited(&seed), expected);
        }
    }
}

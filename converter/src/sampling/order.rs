//! The order of seeds.

/// Points by seed, equal seeds by number: a key has the upper half of the seed above the point's number.
#[derive(Debug, Default)]
pub struct Order {
    keys: Vec<u64>,
}

impl Order {
    /// The numbers of all points, the least seed first. `seed` tells that of a number below `count`.
    pub fn all(&mut self, count: usize, seed: impl Fn(usize) -> u64) -> impl ExactSizeIterator<Item = u32> {
        self.fill(count, &seed);
        self.keys.sort_unstable();
        for run in self.keys.chunk_by_mut(|a, b| a >> 32 == b >> 32).filter(|run| run.len() > 1) {
            run.sort_unstable_by_key(|key| (seed(*key as u32 as usize), *key));
        }
        self.keys.iter().map(|key| *key as u32)
    }

    /// The numbers of the `count` candidates of least seed, in no order.
    pub fn least(&mut self, seed: &[u64], count: usize) -> impl Iterator<Item = u32> {
        self.fill(seed.len(), |index| seed[index]);
        if count < self.keys.len() {
            self.keys.select_nth_unstable_by_key(count, |key| (seed[*key as u32 as usize], *key));
        }
        self.keys.iter().take(count).map(|key| *key as u32)
    }

    fn fill(&mut self, count: usize, seed: impl Fn(usize) -> u64) {
        self.keys.clear();
        self.keys.extend((0..count).map(|index| seed(index) >> 32 << 32 | index as u64));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn all_go_by_seed_then_by_number(
            mut seed in prop::collection::vec(any::<u64>(), 0..2000), shift in 0u32..64,
        ) {
            seed.iter_mut().for_each(|seed| *seed >>= shift);
            let mut expected: Vec<_> = (0..seed.len() as u32).collect();
            expected.sort_by_key(|index| seed[*index as usize]);
            let all: Vec<_> = Order::default().all(seed.len(), |index| seed[index]).collect();
            prop_assert_eq!(all, expected);
        }
    }
}

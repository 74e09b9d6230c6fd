//! A node's choice among the points of its children.

use super::context::{Buffers, Context};
use crate::error::Result;
use crate::octree::key::Key;
use crate::record::colour;
use crate::sampling::{self, seed};

/// Points that a node chooses among: records, in order.
pub struct Candidates<'a> {
    pub records: &'a mut [u8],
    /// Numbers of the candidates among the records, ascending.
    pub numbers: &'a [u32],
    /// Of all records: how many points each stands for; empty where nothing is averaged.
    pub weights: &'a mut [u32],
}

/// Chooses a node's points: the numbers of their records, ascending. No more than a node may hold; of more, those with
/// the smallest seeds, which of a Poisson sample leaves one of fewer points, and as even. Colours are averaged
/// where the rules say so.
pub fn choose(
    context: &Context,
    key: Key,
    candidates: Candidates,
    buffers: &mut Buffers,
) -> Result<Vec<u32>> {
    let Candidates { records, numbers, weights } = candidates;
    let (length, cell) = (context.inputs.length, context.cube.cell(key));
    let Buffers { positions, seeds, surroundings, scratch, .. } = buffers;
    let record = |number: u32| &records[number as usize * length..][..length];
    positions.clear();
    positions.extend(numbers.iter().map(|number| context.position(record(*number))));
    seeds.clear();
    if context.keeps_distance() {
        seeds.extend(positions.iter().map(|position| seed::of_place(key.level, position)));
        surroundings.look(context, key, &cell)?;
    } else {
        let node = key.morton() ^ u64::from(key.level) << 60;
        seeds.extend(numbers.iter().map(|number| seed::of_number(node, *number)));
    }
    let around = surroundings.around();
    let mut chosen = sampling::choose(context.rules.sampling, &cell, positions, seeds, around, scratch);
    let most = context.limits.node as usize;
    if chosen.len() > most {
        chosen.select_nth_unstable_by_key(most, |index| (seeds[*index as usize], *index));
        chosen.truncate(most);
        chosen.sort_unstable();
    }
    if context.keeps_distance() {
        let taken = chosen.iter().map(|index| positions[*index as usize]);
        context.chosen_borders.keep(key, &cell, cell.spacing, taken, context.store)?;
    }
    if context.averages() {
        let colours: Vec<_> = numbers.iter().map(|number| colour(record(*number))).collect();
        let counts: Vec<_> = numbers.iter().map(|number| weights[*number as usize]).collect();
        let means = sampling::average(&cell, positions, &colours, &counts, &chosen);
        for (index, (mean, count)) in chosen.iter().zip(means) {
            let number = numbers[*index as usize] as usize;
            crate::record::set_colour(&mut records[number * length..][..length], mean);
            weights[number] = count;
        }
    }
    chosen.iter_mut().for_each(|index| *index = numbers[*index as usize]);
    Ok(chosen)
}

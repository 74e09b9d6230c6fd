//! What the strategies promise, over scenes of every kind.

use super::discs::distance2;
use super::rivals::Rim;
use super::scene::{Scene, cube, scatter, scenes, unit};
use super::{Cell, Scratch, Strategy};
use proptest::prelude::*;
use std::collections::{HashMap, HashSet};

const ALL: [Strategy; 4] = [Strategy::Poisson, Strategy::Grid, Strategy::Random, Strategy::First];

/// A choice by the definition: each point in the order of seeds, against all that were taken before; then with more
/// distance those that only stand-ins kept away.
fn dart_throwing(scene: &Scene) -> Vec<u32> {
    let mut rim = Rim::default();
    rim.find(&scene.cell, &scene.points, &scene.seed, scene.around());
    let rivals = rim.rivals.iter().map(|(seed, position)| (*seed, *position));
    let own = || scene.seed.iter().copied().zip(scene.points.iter().copied());
    let mut chosen = throw(own().chain(rivals).zip(0..), &scene.near, scene.cell.spacing);
    chosen.retain(|index| (*index as usize) < scene.points.len());
    let taken: Vec<_> = chosen.iter().map(|index| scene.points[*index as usize]).collect();
    let left = own().zip(0..).filter(|(_, index)| rim.candidates.contains(index));
    chosen.extend(throw(left, &[&scene.near[..], &taken].concat(), 1.15 * scene.cell.spacing));
    chosen.sort_unstable();
    chosen
}

fn throw(darts: impl Iterator<Item = ((u64, [f64; 3]), u32)>, near: &[[f64; 3]], spacing: f64) -> Vec<u32> {
    let mut order: Vec<_> = darts.collect();
    order.sort_by_key(|((seed, _), index)| (*seed, *index));
    let mut taken = near.to_vec();
    let mut chosen = Vec::new();
    for ((_, point), index) in order {
        if taken.iter().all(|other| distance2(other, &point) >= spacing * spacing) {
            taken.push(point);
            chosen.push(index);
        }
    }
    chosen
}

/// Whether a point is farther than one spacing from all faces.
fn inside(cell: &Cell, point: &[f64; 3]) -> bool {
    (0..3).all(|i| (cell.spacing..cell.side - cell.spacing).contains(&(point[i] - cell.min[i])))
}

/// The grid cell of a point, without any of the code under test.
fn grid_cell(scene: &Scene, point: &[f64; 3]) -> [u64; 3] {
    [0, 1, 2].map(|i| (((point[i] - scene.cell.min[i]) * (1.0 / scene.cell.spacing)) as u64).min(127))
}

fn cells(scene: &Scene) -> HashMap<[u64; 3], Vec<u32>> {
    let mut cells = HashMap::<_, Vec<u32>>::new();
    for (index, point) in scene.points.iter().enumerate() {
        cells.entry(grid_cell(scene, point)).or_default().push(index as u32);
    }
    cells
}

proptest! {
    #[test]
    fn poisson_is_dart_throwing(scene in scenes()) {
        prop_assert_eq!(scene.choose(Strategy::Poisson), dart_throwing(&scene));
    }

    #[test]
    fn a_border_leaves_no_trace_where_the_candidates_behind_it_are_known(scene in scenes(), at in 0.0..6.0f64) {
        let whole = Scene { near: Vec::new(), rivals: Vec::new(), unknown: [false; 6], ..scene };
        let border = whole.cell.min[0] + at * whole.cell.spacing;
        let (first, second): (Vec<u32>, Vec<u32>) =
            (0..whole.points.len() as u32).partition(|index| whole.points[*index as usize][0] < border);
        let part = |numbers: &[u32]| {
            let points = numbers.iter().map(|index| whole.points[*index as usize]).collect();
            let seed = numbers.iter().map(|index| whole.seed[*index as usize]).collect();
            Scene { points, seed, ..whole.clone() }
        };
        let (mut low, mut high) = (part(&first), part(&second));
        low.rivals = high.seed.iter().copied().zip(high.points.iter().copied()).collect();
        high.near = low.chosen(Strategy::Poisson);
        let mut both: Vec<u32> = low.choose(Strategy::Poisson).into_iter().map(|i| first[i as usize]).collect();
        both.extend(high.choose(Strategy::Poisson).into_iter().map(|i| second[i as usize]));
        both.sort_unstable();
        prop_assert_eq!(both, whole.choose(Strategy::Poisson));
    }

    #[test]
    fn poisson_keeps_its_distance_and_leaves_no_hole(scene in scenes()) {
        let least = scene.cell.spacing * scene.cell.spacing;
        let chosen = scene.chosen(Strategy::Poisson);
        for (i, point) in chosen.iter().enumerate() {
            prop_assert!(chosen[..i].iter().chain(&scene.near).all(|other| distance2(other, point) >= least));
        }
        for point in &scene.points {
            let widest = if inside(&scene.cell, point) { least } else { 1.15 * 1.15 * 1.000_001 * least };
            let left = scene.rivals.iter().any(|(_, rival)| distance2(rival, point) < least);
            prop_assert!(left || chosen.iter().chain(&scene.near).any(|other| distance2(other, point) < widest));
        }
    }

    #[test]
    fn the_order_of_candidates_does_not_matter(scene in scenes(), turn in any::<u64>()) {
        let mut order: Vec<_> = (0..scene.points.len()).collect();
        order.sort_by_key(|i| scatter(*i as u64 ^ turn));
        let other = Scene {
            points: order.iter().map(|i| scene.points[*i]).collect(),
            seed: order.iter().map(|i| scene.seed[*i]).collect(),
            near: scene.near.iter().rev().copied().collect(),
            ..scene.clone()
        };
        for strategy in [Strategy::Poisson, Strategy::Grid, Strategy::Random] {
            let mut chosen: Vec<_> =
                other.choose(strategy).into_iter().map(|i| order[i as usize] as u32).collect();
            chosen.sort_unstable();
            prop_assert_eq!(chosen, scene.choose(strategy), "{:?}", strategy);
        }
    }

    #[test]
    fn a_used_scratch_is_as_good_as_a_new_one(list in prop::collection::vec(scenes(), 1..6)) {
        let mut scratch = Scratch::default();
        for scene in &list {
            for strategy in ALL {
                prop_assert_eq!(scene.choose_with(strategy, &mut scratch), scene.choose(strategy));
            }
        }
    }

    #[test]
    fn indices_ascend_and_there_is_one_at_least(mut scene in scenes()) {
        scene.near.clear();
        scene.rivals.clear();
        for strategy in ALL {
            let chosen = scene.choose(strategy);
            prop_assert!(chosen.windows(2).all(|pair| pair[0] < pair[1]));
            prop_assert!(chosen.iter().all(|i| (*i as usize) < scene.points.len()));
            prop_assert_eq!(chosen.is_empty(), scene.points.is_empty());
        }
    }

    #[test]
    fn strategies_by_cells_take_one_of_each(scene in scenes()) {
        let cells = cells(&scene);
        let of = |strategy| scene.choose(strategy).into_iter().collect::<HashSet<_>>();
        let mut first: Vec<_> = cells.values().map(|cell| cell[0]).collect();
        first.sort_unstable();
        prop_assert_eq!(scene.choose(Strategy::First), first);
        prop_assert_eq!(of(Strategy::Random).len(), cells.len());
        let grid = of(Strategy::Grid);
        prop_assert_eq!(grid.len(), cells.len());
        for (cell, points) in cells {
            let off = |index: u32| -> f64 {
                let point = scene.points[index as usize];
                let from = |i: usize| {
                    (point[i] - scene.cell.min[i]) / scene.cell.spacing - cell[i] as f64 - 0.5
                };
                (0..3).map(|i| from(i).powi(2)).sum()
            };
            let taken: Vec<_> = points.iter().filter(|index| grid.contains(index)).collect();
            prop_assert_eq!(taken.len(), 1);
            prop_assert!(points.iter().all(|index| off(*taken[0]) <= off(*index) + 1e-9));
        }
    }

    #[test]
    fn random_takes_the_least_seeds(scene in scenes()) {
        let chosen: HashSet<_> = scene.choose(Strategy::Random).into_iter().collect();
        let (taken, left): (Vec<_>, Vec<_>) = (0..scene.seed.len()).partition(|i| chosen.contains(&(*i as u32)));
        let most = taken.iter().map(|i| scene.seed[*i]).max();
        prop_assert!(left.iter().all(|i| Some(scene.seed[*i]) >= most));
    }
}

#[test]
fn one_point_and_none() {
    for strategy in ALL {
        assert_eq!(Scene::of(cube([0.0; 3], 1.0), vec![[3.0, 4.0, 5.0]]).choose(strategy), [0]);
        assert!(Scene::of(cube([0.0; 3], 1.0), vec![]).choose(strategy).is_empty());
    }
}

#[test]
fn of_coincident_points_one_is_taken() {
    for strategy in ALL {
        let scene = Scene::of(cube([1e7; 3], 1e-3), vec![[1e7 + 0.05; 3]; 100_000]);
        assert_eq!(scene.choose(strategy).len(), 1, "{strategy:?}");
    }
}

#[test]
fn poisson_takes_none_where_neighbours_cover_all() {
    let mut scene = Scene::of(cube([0.0; 3], 1.0), vec![[0.1, 5.0, 5.0], [0.2, 5.0, 5.3]]);
    scene.near = vec![[-0.5, 5.0, 5.0]];
    assert!(scene.choose(Strategy::Poisson).is_empty());
}

#[test]
fn a_distance_of_exactly_one_spacing_is_enough() {
    let lattice = (0..40u32).map(|i| [8.0 + f64::from(i % 20) * 0.25, 8.0 + f64::from(i / 20) * 0.25, 9.0]);
    let scene = Scene::of(cube([0.0; 3], 0.25), lattice.collect());
    assert_eq!(scene.choose(Strategy::Poisson).len(), 40);
}

#[test]
fn points_outside_the_cube_keep_their_distance_too() {
    let points = (0..300).map(|i| [0, 1, 2].map(|axis| unit(3 * i + axis) * 6.0 - 9.0)).collect();
    let scene = Scene::of(cube([0.0; 3], 1.0), points);
    assert_eq!(scene.choose(Strategy::Poisson), dart_throwing(&scene));
}

/// Points line by line, as a scanner writes them: taken in the input's order they would give stripes (Schütz
/// 2016, figure 3.5 c). Rows and columns of the sample may not differ more than chance lets them.
#[test]
fn the_order_of_a_scanner_leaves_no_stripes() {
    let line = |i: u32| (0..400u32).map(move |j| [f64::from(j) * 0.0625, f64::from(i) * 0.0625, 9.0]);
    let scene = Scene::of(cube([0.0; 3], 1.0), (0..400).flat_map(line).collect());
    let chosen = scene.chosen(Strategy::Poisson);
    for axis in [0, 1] {
        let mut strips = [0i32; 100];
        chosen.iter().for_each(|p| strips[((p[axis] * 4.0) as usize).min(99)] += 1);
        // The outermost spacing has fewer rivals; inside, no quarter of a spacing stands out.
        let inner = &strips[8..92];
        let mean = inner.iter().sum::<i32>() as f64 / inner.len() as f64;
        assert!(mean > 3.0, "{mean}");
        assert!(inner.iter().all(|n| (f64::from(*n) - mean).abs() < 5.0 * mean.sqrt()), "{inner:?}");
    }
}

/// Density on both sides of a border in the first quarter of a spacing against that from two to six spacings inside:
/// of the node that chooses first, of its neighbour, of both.
#[test]
fn density_is_even_across_borders() {
    let (first, second) = (cube([0.0; 3], 1.0), cube([128.0, 0.0, 0.0], 1.0));
    let mut counts = [[0u32; 2]; 2];
    for turn in 0..100u64 {
        let at = |i: u64, from: f64| {
            let number = |axis: u64| unit(turn << 40 ^ (3 * i + axis) ^ (from as u64) << 20);
            [from + 8.0 * number(0), 128.0 * number(1), 64.0]
        };
        let scene = Scene::of(first, (0..10_000).map(|i| at(i, 120.0)).collect());
        let chosen = scene.chosen(Strategy::Poisson);
        let mut other = Scene::of(second, (0..10_000).map(|i| at(i, 128.0)).collect());
        other.near = chosen.iter().filter(|p| p[0] >= 127.0).copied().collect();
        for (counts, sample) in counts.iter_mut().zip([chosen, other.chosen(Strategy::Poisson)]) {
            for off in sample.iter().map(|p| (p[0] - 128.0).abs()) {
                counts[0] += u32::from(off < 0.25);
                counts[1] += u32::from((2.0..6.0).contains(&off));
            }
        }
    }
    let ratio = |[strip, inside]: [u32; 2]| 16.0 * f64::from(strip) / f64::from(inside);
    let both = ratio([counts[0][0] + counts[1][0], counts[0][1] + counts[1][1]]);
    assert!((0.93..1.07).contains(&both), "{both}");
    assert!(ratio(counts[0]) < 1.6, "{}", ratio(counts[0]));
}

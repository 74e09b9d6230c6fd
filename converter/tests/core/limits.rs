//! Memory and threads change no byte; inputs of awkward shape go through them all the same.

use crate::bench::{Bench, Las, cloud, records, scatter, sorted};
use groma_core::build::Rules;
use groma_core::octree::limits::Limits;
use groma_core::pipeline::Pipeline;
use groma_core::pipeline::options::Options;
use groma_core::progress::Silent;
use groma_core::sampling::Strategy;
use proptest::prelude::*;
use std::process::Stdio;
use std::time::Duration;

/// Memory with room for a part of the points of [`memory_and_threads_change_no_byte`], while others wait in files.
const PART: u64 = 140 << 20;

/// Converts with given memory, which may be far less than the binary takes, and threads.
fn converted(bench: &Bench, inputs: &[&str], memory: u64, threads: usize, rules: Rules) -> Vec<u8> {
    let output = bench.path("limited.copc.laz");
    let options = Options {
        overwrite: true,
        memory: Some(memory),
        threads: Some(threads),
        rules,
        ..Options::new(inputs.iter().map(|name| bench.path(name)).collect(), output.clone())
    };
    let distributed = Pipeline::scan(&options, &Silent).unwrap().validate().unwrap().distribute().unwrap();
    distributed.build().unwrap().write().unwrap();
    std::fs::read(output).unwrap()
}

/// A rolling surface with a dense spot, in no order.
fn surface(count: u64) -> Vec<[i32; 3]> {
    (0..count)
        .map(|i| {
            let side = if i % 4 == 0 { 9_000 } else { 200_000 };
            let (x, y) = (scatter(2 * i) % side, scatter(2 * i + 1) % side);
            let z = (x as f64 / 9000.0).sin() * 700.0 + (y as f64 / 7000.0).cos() * 500.0;
            [x as i32, y as i32, z as i32]
        })
        .collect()
}

#[test]
fn memory_and_threads_change_no_byte() {
    let bench = Bench::new();
    let mut las = Las::at(7, 3, &surface(320_000));
    // A decoder is made for each chunk, at the price of some hundred points.
    las.chunk = Some(50_000);
    bench.put("a.laz", &las.laz());
    bench.put("b.las", &Las::at(7, 3, &cloud(60_000, [190_000, 100_000, 60_000])).las());
    let inputs = ["a.laz", "b.las"];
    for (sampling, average_colors) in [(Strategy::Poisson, false), (Strategy::Grid, true)] {
        let rules = Rules { sampling, average_colors };
        let expected = converted(&bench, &inputs, 4 << 30, 1, rules);
        for (memory, threads) in [(0, 3), (PART, 2), (4 << 30, 5)] {
            assert!(converted(&bench, &inputs, memory, threads, rules) == expected, "{memory} {threads}");
        }
        assert_eq!(bench.names(), ["a.laz", "b.las", "limited.copc.laz"]);
        if !average_colors {
            let input = [records(&bench.path("a.laz")), records(&bench.path("b.las"))].concat();
            assert!(sorted(input) == sorted(records(&bench.path("limited.copc.laz"))));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]
    #[test]
    fn every_point_is_in_exactly_one_node(
        count in 1u64..400_000,
        size in proptest::array::uniform3(1u64..2_000_000_000),
        repeated in 1u64..40,
        format in proptest::sample::select(vec![1u8, 6, 8]),
    ) {
        let bench = Bench::new();
        let positions: Vec<_> =
            cloud(count, size).into_iter().flat_map(|p| std::iter::repeat_n(p, repeated as usize)).take(count as usize).collect();
        let input = bench.put("in.las", &Las::at(format, 0, &positions).las());
        let expected = converted(&bench, &["in.las"], 4 << 30, 2, Rules::default());
        prop_assert!(sorted(records(&input)) == sorted(records(&bench.path("limited.copc.laz"))));
        prop_assert!(converted(&bench, &["in.las"], 0, 3, Rules::default()) == expected);
    }
}

#[test]
fn chunks_of_any_size() {
    let bench = Bench::new();
    for format in [1, 3, 6, 7] {
        for chunk in [None, Some(200_000), Some(1)] {
            let count = if chunk == Some(1) { 300 } else { 70_000 };
            let mut las = Las::at(format, 1, &surface(count));
            las.chunk = chunk;
            let input = bench.put("in.laz", &las.laz());
            bench.convert(&["in.laz", "out.copc.laz", "--overwrite"]);
            assert!(sorted(records(&input)) == sorted(records(&bench.path("out.copc.laz"))));
        }
    }
}

#[test]
fn bounds_in_a_header_are_not_believed() {
    let bench = Bench::new();
    let mut las = Las::at(7, 0, &surface(120_000));
    bench.put("in.las", &las.las());
    bench.convert(&["in.las", "truth.copc.laz"]);
    let truth = std::fs::read(bench.path("truth.copc.laz")).unwrap();
    let lies = [
        [[0.0; 3], [0.0; 3]],
        [[f64::NAN; 3], [f64::NAN; 3]],
        [[1e300; 3], [-1e300; 3]],
        [[-1e6; 3], [1e6; 3]],
        [[1000.0, -2000.0, -20.0], [1500.0, -1500.0, 20.0]],
    ];
    for bounds in lies {
        las.bounds = Some(bounds);
        bench.put("in.las", &las.las());
        let lines = bench.convert(&["in.las", "out.copc.laz", "--overwrite"]);
        assert!(lines.iter().any(|line| line["event"] == "warning"));
        assert!(std::fs::read(bench.path("out.copc.laz")).unwrap() == truth, "{bounds:?}");
    }
}

#[test]
fn long_records_have_small_nodes() {
    let bench = Bench::new();
    let input = bench.put("in.laz", &Las::at(6, 192, &surface(60_000)).laz());
    bench.convert(&["in.laz", "out.copc.laz", "--memory", "256MB"]);
    assert!(sorted(records(&input)) == sorted(records(&bench.path("out.copc.laz"))));
}

#[test]
fn a_cell_with_too_many_points_is_divided() {
    let bench = Bench::new();
    // All but one point lie in a thousandth of the cube, in one cell of any level that the number of points calls for:
    // more than are built at once. Long records make that few.
    let extra = 1000;
    let limits = Limits::of(usize::from(extra) + 30);
    let mut positions = cloud(limits.cell + 5_000, [900_000, 900_000, 4_000]);
    positions.push([1_000_000_000, 1_000_000_000, 0]);
    let input = bench.put("in.las", &Las::at(6, extra, &positions).las());
    let expected = converted(&bench, &["in.las"], 4 << 30, 2, Rules::default());
    assert!(sorted(records(&input)) == sorted(records(&bench.path("limited.copc.laz"))));
    assert!(converted(&bench, &["in.las"], 0, 3, Rules::default()) == expected);
}

/// The most memory that a process has had until now, bytes.
#[cfg(target_os = "linux")]
fn peak_of(process: u32) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? << 10)
}

#[cfg(target_os = "linux")]
#[test]
fn a_run_keeps_within_its_memory() {
    let bench = Bench::new();
    let mut las = Las::at(6, 0, &surface(6_000_000));
    // What is not a position is all alike, and costs little time.
    las.records.chunks_exact_mut(30).for_each(|record| record[12..].fill(0));
    bench.put("in.las", &las.las());
    drop(las);
    let most = 256 << 20;
    let mut command = bench.command();
    command.args(["convert", "in.las", "out.copc.laz", "--memory", "256MB"]).stdout(Stdio::null());
    let mut run = command.spawn().unwrap();
    let mut peak = 0;
    while run.try_wait().unwrap().is_none() {
        peak = peak_of(run.id()).map_or(peak, |now| now.max(peak));
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(run.wait().unwrap().success());
    assert!(peak > most / 4 && peak <= most, "{} MiB", peak >> 20);
}

#[test]
fn inputs_from_a_list() {
    let bench = Bench::new();
    let mut list = String::new();
    for index in 0..120 {
        let name = format!("tile {index}.las");
        bench.put(&name, &Las::at(1, 0, &[[index * 100, 7, 1], [index * 100 + 50, 9, 2]]).las());
        list.push_str(&format!("{name}\n\n"));
    }
    bench.put("list.txt", list.as_bytes());
    bench.put("first.las", &Las::at(1, 0, &[[-9, -9, -9]]).las());
    bench.convert(&["first.las", "out.copc.laz", "--list", "list.txt"]);
    assert_eq!(records(&bench.path("out.copc.laz")).len(), 241);
    bench.convert(&["only.copc.laz", "--list", "list.txt"]);
    assert_eq!(records(&bench.path("only.copc.laz")).len(), 240);
    assert_eq!(bench.refused(&["x.copc.laz", "--list", "nowhere"]), "OPTION_LIST");
}

#[test]
fn a_dry_run_plans_and_writes_nothing() {
    let bench = Bench::new();
    bench.put("in.las", &Las::at(3, 0, &surface(1000)).las());
    let before = bench.names();
    let planned = |memory: &str| {
        let arguments = ["in.las", "out.copc.laz", "--dry-run", "--threads", "2", "--memory", memory];
        bench.convert(&arguments).pop().unwrap()
    };
    let plan = planned("256MB");
    assert_eq!(plan["event"], "plan");
    assert_eq!(
        (&plan["points"], &plan["recordLength"], &plan["inputs"]),
        (&1000.into(), &36.into(), &1.into())
    );
    // What a thousand points take, however much may be taken.
    assert!(plan["memory"].as_u64().unwrap() < 100 << 20, "{plan}");
    assert_eq!((&plan["memory"], &plan["tempBytes"]), (&planned("64GB")["memory"], &0.into()));
    assert_eq!(
        (&plan["sampling"], &plan["levels"], &plan["threads"]),
        (&"poisson".into(), &1.into(), &2.into())
    );
    assert!(["cells", "tempFree", "outputBytes"].iter().all(|key| plan[key].is_u64()), "{plan}");
    assert!(plan["tempDir"].is_string());
    assert_eq!(bench.names(), before);
}

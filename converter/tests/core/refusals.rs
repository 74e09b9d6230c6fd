//! What cannot be converted: one error with a stable code, and nothing left behind.

use crate::bench::{Bench, Las, cloud, records, sorted};
use groma_core::scan::variable_record::{PROJECTION, VariableRecord, WKT};

/// Overwrites bytes of a file.
fn patched(mut bytes: Vec<u8>, at: usize, with: &[u8]) -> Vec<u8> {
    bytes[at..at + with.len()].copy_from_slice(with);
    bytes
}

fn code_of(bytes: &[u8]) -> String {
    let bench = Bench::new();
    bench.put("in.las", bytes);
    bench.refused(&["in.las", "out.copc.laz"])
}

fn small() -> Las {
    Las::at(3, 0, &cloud(50, [500, 500, 500]))
}

#[test]
fn headers_that_lie() {
    let las = small().las();
    assert_eq!(code_of(b""), "INPUT_MAGIC");
    assert_eq!(code_of(b"LAZ!...."), "INPUT_MAGIC");
    assert_eq!(code_of(b"LAS"), "INPUT_TRUNCATED");
    assert_eq!(code_of(&las[..200]), "INPUT_TRUNCATED");
    assert_eq!(code_of(&las[..las.len() - 1]), "INPUT_TRUNCATED");
    assert_eq!(code_of(&patched(las.clone(), 25, &[7])), "INPUT_FORMAT");
    assert_eq!(code_of(&patched(las.clone(), 94, &100u16.to_le_bytes())), "INPUT_CORRUPT");
    assert_eq!(code_of(&patched(las.clone(), 96, &u32::MAX.to_le_bytes())), "INPUT_TRUNCATED");
    assert_eq!(code_of(&patched(las.clone(), 96, &10u32.to_le_bytes())), "INPUT_CORRUPT");
    assert_eq!(code_of(&patched(las.clone(), 104, &[11])), "INPUT_FORMAT");
    assert_eq!(code_of(&patched(las.clone(), 105, &33u16.to_le_bytes())), "INPUT_CORRUPT");
    assert_eq!(code_of(&patched(las.clone(), 107, &51u32.to_le_bytes())), "INPUT_TRUNCATED");
    assert_eq!(code_of(&patched(las.clone(), 107, &0u32.to_le_bytes())), "INPUT_EMPTY");
    for bad in [f64::NAN, f64::INFINITY, 0.0, 1e300] {
        assert_eq!(code_of(&patched(las.clone(), 131, &bad.to_le_bytes())), "INPUT_CORRUPT", "scale {bad}");
    }
    assert_eq!(code_of(&patched(las.clone(), 155, &f64::NAN.to_le_bytes())), "INPUT_CORRUPT");
}

#[test]
fn compressed_points_that_are_not_there() {
    let las = small().las();
    assert_eq!(code_of(&patched(las, 104, &[3 | 0x80])), "INPUT_CORRUPT");
    for format in [3, 7] {
        let laz = Las::at(format, 0, &cloud(3000, [500, 500, 500])).laz();
        for end in (0..laz.len()).step_by(1009) {
            let code = code_of(&laz[..end]);
            assert!(
                ["INPUT_TRUNCATED", "INPUT_CORRUPT", "INPUT_MAGIC"].contains(&code.as_str()),
                "{end}: {code}"
            );
        }
        let claim = if format < 6 { (107, 4) } else { (247, 8) };
        let few = patched(laz.clone(), claim.0, &10u64.to_le_bytes()[..claim.1]);
        assert_eq!(code_of(&few), "INPUT_CORRUPT");
        let start = u32::from_le_bytes(laz[96..100].try_into().unwrap()) as usize;
        let table = u64::from_le_bytes(laz[start..start + 8].try_into().unwrap()) as usize;
        assert_eq!(code_of(&patched(laz, table + 4, &u32::MAX.to_le_bytes())), "INPUT_CORRUPT");
    }
}

#[test]
fn a_chunk_holds_more_points_than_are_announced() {
    let mut las = Las::at(7, 0, &cloud(2000, [500, 500, 500]));
    las.chunk = Some(50_000);
    let few = patched(las.laz(), 247, &700u64.to_le_bytes());
    assert_eq!(code_of(&few), "INPUT_CORRUPT");
    let bench = Bench::new();
    bench.put("in.las", &patched(las.las(), 247, &700u64.to_le_bytes()));
    let lines = bench.convert(&["in.las", "out.copc.laz"]);
    let text = "the header declares 700 points, the file has room for 2000";
    assert!(lines.iter().any(|l| l["event"] == "warning" && l.to_string().contains(text)), "{lines:?}");
}

#[test]
fn layered_chunks_without_a_table() {
    let las = Las::at(7, 1, &cloud(2300, [500, 500, 500]));
    let laz = las.laz();
    let start = u32::from_le_bytes(laz[96..100].try_into().unwrap()) as usize;
    let table = u64::from_le_bytes(laz[start..start + 8].try_into().unwrap()) as usize;
    let untabled = patched(laz[..table].to_vec(), start, &(-1i64).to_le_bytes());
    let bench = Bench::new();
    let input = bench.put("in.laz", &untabled);
    bench.convert(&["in.laz", "out.copc.laz"]);
    let whole = bench.put("whole.las", &las.las());
    assert!(sorted(records(&input)) == sorted(records(&whole)));
    assert!(sorted(records(&bench.path("out.copc.laz"))) == sorted(records(&whole)));
    let sizes_at = start + 8 + 37 + 4;
    assert_eq!(code_of(&patched(untabled.clone(), sizes_at, &u32::MAX.to_le_bytes())), "INPUT_TRUNCATED");
    assert_eq!(code_of(&untabled[..untabled.len() - 1]), "INPUT_TRUNCATED");
    assert_eq!(code_of(&patched(untabled, 247, &2200u64.to_le_bytes())), "INPUT_CORRUPT");
}

#[cfg(unix)]
#[test]
fn inputs_that_are_no_files() {
    let bench = Bench::new();
    let pipe = bench.path("pipe.las");
    assert!(std::process::Command::new("mkfifo").arg(pipe).status().unwrap().success());
    for input in ["pipe.las", "/dev/zero", "."] {
        assert_eq!(bench.refused(&[input, "out.copc.laz"]), "INPUT_NOT_FOUND", "{input}");
    }
}

#[test]
fn flipped_bytes_never_hang_or_crash() {
    let laz = Las::at(7, 0, &cloud(1200, [500, 500, 500])).laz();
    let bench = Bench::new();
    for seed in 0..60 {
        let at = crate::bench::scatter(seed) as usize % laz.len();
        let flipped = patched(laz.clone(), at, &[laz[at] ^ (1 << (seed % 8))]);
        bench.put("in.laz", &flipped);
        let output =
            bench.command().args(["convert", "in.laz", "out.copc.laz", "--overwrite"]).output().unwrap();
        let event = crate::bench::lines(&output).last().unwrap()["event"].clone();
        assert_eq!(event, if output.status.success() { "done" } else { "error" }, "byte {at}");
    }
}

#[test]
fn inputs_that_do_not_fit_together() {
    let bench = Bench::new();
    bench.put("a.las", &small().las());
    let other = |name: &str, change: fn(&mut Las)| {
        let mut las = small();
        change(&mut las);
        bench.put(name, &las.las());
        bench.refused(&["a.las", name, "out.copc.laz"])
    };
    assert_eq!(other("finer.las", |las| las.scale = [0.001; 3]), "INPUT_MIXED");
    assert_eq!(other("far.las", |las| las.offset = [1e9, 0.0, 0.0]), "INPUT_MIXED");
    let foretold = |name: &str| {
        let (done, lines) = bench.run(&["convert", "a.las", name, "out.copc.laz", "--dry-run"]);
        assert!(done, "{lines:?}");
        let texts =
            lines.iter().filter(|line| line["event"] == "warning").map(|line| line["text"].to_string());
        texts.filter(|text| text.contains("INPUT_MIXED")).collect::<Vec<_>>()
    };
    let [between, reach] = ["finer.las", "far.las"].map(foretold);
    assert!(
        between.len() == 1 && between[0].contains("finer.las: its coordinates may lie between"),
        "{between:?}"
    );
    assert!(
        reach.len() == 1 && reach[0].contains("far.las: its coordinates may be out of reach"),
        "{reach:?}"
    );
    let mut moved = small();
    moved.offset = [1000.5, -2000.0, 10.0];
    bench.put("moved.las", &moved.las());
    assert_eq!(foretold("moved.las"), Vec::<String>::new());
    let crs = |las: &mut Las| las.vlrs = vec![VariableRecord::new(PROJECTION, WKT, "", b"OTHER[]".to_vec())];
    assert_eq!(other("crs.las", crs), "INPUT_MIXED");
    bench.put("b.las", &small().las());
    let (_, lines) = bench.run(&["convert", "a.las", "crs.las", "b.las", "out.copc.laz"]);
    let cause = lines.last().unwrap()["cause"].as_str().unwrap();
    assert!(cause.contains("none declared (a.las, b.las); OTHER[] (crs.las)"), "{cause}");
    bench.put("crs.wkt", b"SETTLED[]");
    bench.convert(&["a.las", "crs.las", "b.las", "settled.copc.laz", "--wkt", "crs.wkt"]);
    bench.put("format.las", &Las::at(1, 0, &[[0; 3]]).las());
    assert_eq!(bench.refused(&["a.las", "format.las", "out.copc.laz"]), "INPUT_MIXED");
    bench.put("extra.las", &Las::at(3, 2, &[[0; 3]]).las());
    assert_eq!(bench.refused(&["a.las", "extra.las", "out.copc.laz"]), "INPUT_MIXED");
}

#[test]
fn outputs_and_options() {
    let bench = Bench::new();
    bench.put("a.las", &small().las());
    bench.put("old.laz", b"old");
    assert_eq!(bench.refused(&["nowhere.las", "out.laz"]), "INPUT_NOT_FOUND");
    assert_eq!(bench.refused(&["a.las", "old.laz"]), "OUTPUT_EXISTS");
    assert_eq!(bench.refused(&["a.las", "a.las", "--overwrite"]), "OUTPUT_INPUT");
    assert_eq!(bench.refused(&["a.las", "b.las"]), "OUTPUT_NAME");
    assert_eq!(bench.refused(&["a.las", "no/such/folder/out.laz"]), "OUTPUT_WRITE");
    assert_eq!(bench.refused(&["a.las", ".", "--overwrite"]), "OUTPUT_WRITE");
    assert_eq!(bench.refused(&["a.las", "out.laz", "--memory", "1MB"]), "OPTION_MEMORY");
    assert_eq!(bench.refused(&["a.las", "out.laz", "--memory", "much"]), "OPTION_MEMORY");
    assert_eq!(bench.refused(&["a.las", "out.laz", "--sampling", "best"]), "OPTION_SAMPLING");
    assert_eq!(bench.refused(&["a.las", "out.laz", "--temp-dir", "nowhere"]), "OPTION_TEMP_DIR");
    assert_eq!(bench.refused(&["a.las", "out.laz", "--record", "nowhere"]), "OPTION_RECORD");
    assert_eq!(bench.refused(&["a.las", "out.laz", "--wkt", "nowhere"]), "OPTION_WKT");
    assert_eq!(bench.refused(&["a.las", "out.laz", "--memory", "255MB"]), "OPTION_MEMORY");
    assert_eq!(bench.refused(&["a.las", "out.laz", "--threads", "0"]), "OPTION_THREADS");
    assert_eq!(bench.refused(&["a.las"]), "OPTION_USAGE");
    assert_eq!(std::fs::read(bench.path("old.laz")).unwrap(), b"old");
    bench.convert(&["a.las", "old.laz", "--overwrite"]);
    assert_eq!(bench.names(), ["a.las", "old.laz"]);
}

#[cfg(unix)]
#[test]
fn a_stopped_run_leaves_nothing_behind() {
    use std::time::{Duration, Instant};
    let bench = Bench::new();
    bench.put("in.las", &Las::at(7, 0, &cloud(2_000_000, [90_000, 90_000, 3000])).las());
    for signal in ["-TERM", "-INT"] {
        let mut command = bench.command();
        command.args(["convert", "in.las", "out.copc.laz", "--threads", "1"]);
        let child = command.stdout(std::process::Stdio::piped()).spawn().unwrap();
        let start = Instant::now();
        while !bench.names().iter().any(|name| name.starts_with(".groma-out.copc.laz-")) {
            assert!(start.elapsed() < Duration::from_secs(60), "{:?}", bench.names());
            std::thread::sleep(Duration::from_millis(2));
        }
        let id = child.id().to_string();
        assert!(std::process::Command::new("kill").args([signal, &id]).status().unwrap().success());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(130));
        assert_eq!(crate::bench::lines(&output).last().unwrap()["code"], "INTERRUPTED");
        assert_eq!(bench.names(), ["in.las"]);
    }
}

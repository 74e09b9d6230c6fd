//! Whole conversions by the binary: every record arrives once, and the file is the same on any machine.

use crate::bench::{Bench, Las, cloud, records, sorted};
use groma_core::scan::Scan;
use groma_core::scan::variable_record::{GEOTIFF_DIRECTORY, PROJECTION, SPECIFICATION, VariableRecord, WKT};

/// Converts one file and compares the multisets of records; returns the number of nodes.
fn round_trip(bench: &Bench, bytes: &[u8]) -> u64 {
    let input = bench.put("in.laz", bytes);
    let lines = bench.convert(&["in.laz", "out.copc.laz", "--overwrite"]);
    assert!(sorted(records(&input)) == sorted(records(&bench.path("out.copc.laz"))));
    lines.last().unwrap()["nodes"].as_u64().unwrap()
}

#[test]
fn every_point_format_as_las_and_laz() {
    let bench = Bench::new();
    let positions = cloud(1201, [5000, 3000, 400]);
    for format in 0..=10 {
        for extra in [0, 3] {
            let las = Las::at(format, extra, &positions);
            round_trip(&bench, &las.las());
            let mut before = records(&bench.path("in.laz"));
            round_trip(&bench, &las.laz());
            assert!(records(&bench.path("in.laz")) == before, "format {format}");
            before.clear();
        }
    }
}

#[test]
fn shapes_that_are_hard_to_split() {
    let bench = Bench::new();
    let las = |positions: &[[i32; 3]]| Las::at(6, 0, positions).las();
    assert_eq!(round_trip(&bench, &las(&[[i32::MAX, i32::MIN, 0]])), 1);
    assert_eq!(round_trip(&bench, &las(&[[7, 8, 9]; 1_000_000])), 10);
    assert_eq!(round_trip(&bench, &las(&[[i32::MIN; 3], [i32::MAX; 3]])), 1);
    let line: Vec<_> = (0..120_000).map(|i| [i, 0, 0]).collect();
    assert!(round_trip(&bench, &las(&line)) > 2);
    let mut clusters = vec![[0; 3]; 60_000];
    clusters.extend([[2_000_000_000, 5, 5]; 60_000]);
    assert_eq!(round_trip(&bench, &las(&clusters)), 3);
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let bench = Bench::new();
    bench.put("in.laz", &Las::at(7, 2, &cloud(200_000, [9000, 9000, 300])).laz());
    let mut outputs = Vec::new();
    for threads in ["1", "2", "5"] {
        let mut command = bench.command();
        command.args(["convert", "in.laz", "out.copc.laz", "--overwrite", "--threads", threads]);
        assert!(command.output().unwrap().status.success());
        outputs.push(std::fs::read(bench.path("out.copc.laz")).unwrap());
    }
    assert!(outputs.iter().all(|bytes| *bytes == outputs[0]));
}

#[test]
fn a_file_without_chunk_table_is_read_from_start_to_end() {
    let bench = Bench::new();
    for format in [1, 7] {
        let mut bytes = Las::at(format, 0, &cloud(2100, [5000, 3000, 400])).laz();
        let whole = bench.put("whole.laz", &bytes);
        let expected = sorted(records(&whole));
        let start = u32::from_le_bytes(bytes[96..100].try_into().unwrap()) as usize;
        let table = i64::from_le_bytes(bytes[start..start + 8].try_into().unwrap()) as usize;
        bytes[start..start + 8].copy_from_slice(&(-1i64).to_le_bytes());
        bytes.truncate(table);
        bench.put("in.laz", &bytes);
        bench.convert(&["in.laz", "out.copc.laz", "--overwrite"]);
        assert!(sorted(records(&bench.path("out.copc.laz"))) == expected);
    }
}

#[test]
fn several_inputs_become_one_octree() {
    let bench = Bench::new();
    let first = Las::at(3, 0, &cloud(3000, [5000, 3000, 400]));
    let mut moved = Las::at(3, 0, &[[100, 100, 100], [12_345, -5, 0]]);
    moved.offset = [0.0, 0.0, 0.0];
    moved.scale = [0.02, 0.01, 0.01];
    bench.put("a.las", &first.las());
    bench.put("b.laz", &moved.laz());
    bench.convert(&["a.las", "b.laz", "out.copc.laz"]);
    let output = records(&bench.path("out.copc.laz"));
    assert_eq!(output.len(), 3002);
    // 100 × 0.02 = 2.00 = -99,800 × 0.01 + 1000; y: 1.00 = 200,100 × 0.01 - 2000.
    let x = |record: &Vec<u8>| groma_core::record::position(record);
    assert!(output.iter().any(|record| x(record) == [-99_800, 200_100, 100]));
    assert!(output.iter().any(|record| x(record) == [-75_310, 199_995, 0]));
}

#[test]
fn records_are_carried_over_or_replaced() {
    let bench = Bench::new();
    let mut las = Las::at(1, 0, &cloud(10, [50, 50, 50]));
    let note = VariableRecord::new("somebody", 7, "a note", vec![1, 2, 3]);
    las.vlrs = vec![
        note.clone(),
        VariableRecord::new(PROJECTION, GEOTIFF_DIRECTORY, "", vec![1, 0, 1, 0, 0, 0, 0, 0]),
        VariableRecord::new(PROJECTION, WKT, "", b"OLD[]\0".to_vec()),
        VariableRecord::new(SPECIFICATION, 100, "waveform packet descriptor", vec![0; 26]),
        VariableRecord::new("copc", 1, "", vec![0; 160]),
        VariableRecord::new("groma", 1, "", b"old".to_vec()),
    ];
    bench.put("in.las", &las.las());
    bench.put("new.wkt", b"NEW[]\n");
    bench.put("record.json", b"{\"version\":1}");
    bench.convert(&["in.las", "kept.copc.laz", "--record", "record.json"]);
    let scan = Scan::read(&bench.path("kept.copc.laz")).unwrap();
    let ids: Vec<_> = scan.vlrs.iter().map(|r| (r.user(), r.record_id)).collect();
    let expected = [
        ("copc", 1),
        ("laszip encoded", 22204),
        (PROJECTION, WKT),
        ("groma", 1),
        ("groma", 2),
        ("somebody", 7),
        ("groma", 5),
        ("groma", 4),
    ];
    assert_eq!(ids, expected.map(|(user, id)| (user.to_string(), id)));
    assert_eq!(scan.vlrs[5], note);
    assert_eq!(scan.vlrs[3].data, b"{\"version\":1}");
    assert_eq!(scan.wkt().as_deref(), Some("OLD[]"));
    assert_eq!(scan.scale(), [0.01; 3]);
    assert_eq!(scan.header.global_encoding, 1 << 4);

    bench.convert(&["in.las", "replaced.copc.laz", "--wkt", "new.wkt"]);
    let scan = Scan::read(&bench.path("replaced.copc.laz")).unwrap();
    assert_eq!(scan.wkt().as_deref(), Some("NEW[]"));
    assert!(scan.record("groma", 1).is_none());

    las.vlrs.retain(|record| !record.is(PROJECTION, WKT));
    bench.put("keys.las", &las.las());
    bench.convert(&["keys.las", "keys.copc.laz"]);
    let keys = Scan::read(&bench.path("keys.copc.laz")).unwrap();
    assert!(keys.record(PROJECTION, GEOTIFF_DIRECTORY).is_some());
    bench.convert(&["keys.las", "text.copc.laz", "--wkt", "new.wkt"]);
    let text = Scan::read(&bench.path("text.copc.laz")).unwrap();
    assert!(text.record(PROJECTION, GEOTIFF_DIRECTORY).is_none());
}

#[test]
fn scan_prints_one_object() {
    let bench = Bench::new();
    bench.put("in.las", &Las::at(7, 0, &cloud(20, [50, 50, 50])).las());
    bench.put("record.bin", &[0, 255, 7]);
    bench.convert(&["in.las", "out.copc.laz", "--record", "record.bin"]);
    let (done, lines) = bench.run(&["scan", "out.copc.laz"]);
    assert!(done && lines.len() == 1);
    let scan = &lines[0];
    assert_eq!((&scan["copc"], &scan["compressed"]), (&true.into(), &true.into()));
    assert_eq!((&scan["points"], &scan["pointFormat"]), (&20.into(), &7.into()));
    assert_eq!(scan["groma"]["1"], "AP8H");
    assert_eq!(scan["groma"]["2"]["points"], 20);
    assert_eq!(scan["warnings"], serde_json::json!([]));
    assert_eq!(scan["wktBit"], true);
    let (_, lines) = bench.run(&["scan", "in.las"]);
    assert_eq!(lines[0]["wktBit"], false);
}

#[test]
fn a_transformation_stands_before_or_behind_the_points() {
    let bench = Bench::new();
    let mut las = Las::at(7, 0, &cloud(2000, [5000, 3000, 400]));
    las.vlrs = vec![VariableRecord::new("groma", 3, "", b"old".to_vec())];
    let input = bench.put("in.las", &las.las());
    // Where it leaves no room in the first 64 KiB, the checksums stand behind the points.
    for (length, behind, extended) in
        [(0, false, 1), (65_535, false, 2), (65_536, true, 2), (300_000, true, 2)]
    {
        let bytes: Vec<u8> = (0..length).map(|i| crate::bench::scatter(i) as u8).collect();
        bench.put("transformation.bin", &bytes);
        let arguments = ["in.las", "out.copc.laz", "--overwrite", "--transformation", "transformation.bin"];
        bench.convert(&arguments);
        let scan = Scan::read(&bench.path("out.copc.laz")).unwrap();
        let record = VariableRecord::new("groma", 3, "transformation", bytes);
        let (holds, other) = if behind { (&scan.evlrs, &scan.vlrs) } else { (&scan.vlrs, &scan.evlrs) };
        assert!(holds.contains(&record));
        assert!(!other.iter().any(|other| other.is("groma", 3)));
        assert_eq!(scan.header.evlr.unwrap().number_of_evlrs, extended);
        assert!(scan.warnings.is_empty());
        assert!(sorted(records(&input)) == sorted(records(&bench.path("out.copc.laz"))));
        let (_, lines) = bench.run(&["scan", "out.copc.laz"]);
        let expected = base64::Engine::encode(&base64::engine::general_purpose::STANDARD, &record.data);
        assert_eq!(lines[0]["groma"]["3"], expected);
    }
    bench.convert(&["out.copc.laz", "again.copc.laz"]);
    assert!(Scan::read(&bench.path("again.copc.laz")).unwrap().record("groma", 3).is_none());
}

#[test]
fn the_records_may_be_made_when_the_bounds_are_known() {
    let bench = Bench::new();
    bench.put("in.las", &Las::at(7, 0, &[[-7, 2, 3], [5, 6, 7]]).las());
    bench.put("record.json", b"{}");
    bench.put("transformation.bin", b"GTRF");
    let answer = serde_json::json!({
        "record": bench.path("record.json"),
        "transformation": bench.path("transformation.bin"),
    });
    let lines = bench.answered(&["in.las", "out.copc.laz", "--wait-for-record"], &format!("{answer}\n"));
    let bounds = lines.iter().find(|line| line["event"] == "bounds").unwrap();
    let scan = Scan::read(&bench.path("out.copc.laz")).unwrap();
    let h = &scan.header;
    assert_eq!(bounds["min"], serde_json::json!([h.min_x, h.min_y, h.min_z]));
    assert_eq!(bounds["max"], serde_json::json!([h.max_x, h.max_y, h.max_z]));
    assert_eq!(scan.record("groma", 1).unwrap().data, b"{}");
    assert_eq!(scan.record("groma", 3).unwrap().data, b"GTRF");

    let before = bench.names();
    let lines = bench.answered(&["in.las", "none.copc.laz", "--wait-for-record"], "");
    assert_eq!(lines.last().unwrap()["code"], "INTERRUPTED");
    let lines =
        bench.answered(&["in.las", "none.copc.laz", "--wait-for-record"], "{\"record\":\"nowhere\"}\n");
    assert_eq!(lines.last().unwrap()["code"], "OPTION_RECORD");
    assert_eq!(bench.names(), before);
}

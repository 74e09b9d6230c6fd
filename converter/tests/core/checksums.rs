//! The checksums of the nodes: every damaged byte of the points is found, by whatever command reads them.

use crate::bench::{Bench, Las, cloud};
use groma_core::copc::checksums::{self, Stored};
use groma_core::copc::hierarchy::{ENTRY, Entry};
use groma_core::scan::Scan;
use std::ops::Range;

/// Bytes of the chunks of a file.
fn chunk_area(bytes: &[u8]) -> Range<usize> {
    let start = u32::from_le_bytes(bytes[96..100].try_into().unwrap()) as usize;
    let table = u64::from_le_bytes(bytes[start..start + 8].try_into().unwrap()) as usize;
    start + 8..table
}

#[test]
fn each_node_has_the_checksum_of_its_chunk() {
    let bench = Bench::new();
    bench.put("in.las", &Las::at(7, 3, &cloud(300_000, [90_000, 90_000, 500])).las());
    bench.convert(&["in.las", "out.copc.laz"]);
    let scan = Scan::read(&bench.path("out.copc.laz")).unwrap();
    let bytes = std::fs::read(bench.path("out.copc.laz")).unwrap();
    let Stored::Yes { checksums, hierarchy_at } = checksums::stored(&scan) else { panic!("none are stored") };
    let mut points = 0;
    for (index, checksum) in checksums.iter().enumerate() {
        let entry = Entry::parse(&bytes[hierarchy_at as usize + index * ENTRY..]).unwrap();
        if entry.points > 0 {
            let chunk = &bytes[entry.offset as usize..][..entry.bytes as usize];
            assert_eq!(u32::from_le_bytes(*checksum), checksums::of(chunk), "{:?}", entry.key);
            points += entry.points;
        } else {
            assert_eq!(checksum, &[0; 4]);
        }
    }
    assert_eq!(points, 300_000);
    let (_, lines) = bench.run(&["scan", "out.copc.laz"]);
    assert_eq!(lines[0]["checksums"], "CRC-32C");
    let (done, lines) = bench.run(&["verify", "out.copc.laz"]);
    assert!(done && lines[0]["points"] == 300_000 && lines[0]["checksums"] == true, "{lines:?}");
}

#[test]
fn a_flipped_byte_of_any_chunk_is_refused_by_name() {
    let bench = Bench::new();
    bench.put("in.las", &Las::at(7, 0, &cloud(90_000, [90_000, 90_000, 500])).las());
    bench.convert(&["in.las", "out.copc.laz"]);
    let good = std::fs::read(bench.path("out.copc.laz")).unwrap();
    let area = chunk_area(&good);
    let step = area.len() / 40;
    for at in area.clone().step_by(step).chain([area.start, area.end - 1]) {
        let mut bad = good.clone();
        bad[at] ^= 1 << (at % 8);
        bench.put("bad.copc.laz", &bad);
        let (done, lines) = bench.run(&["verify", "bad.copc.laz"]);
        let cause = lines[0]["cause"].as_str().unwrap();
        assert!(
            !done && lines[0]["code"] == "INPUT_CHECKSUM" && cause.contains("the points of node "),
            "{cause}"
        );
        assert!(cause.starts_with("1 of "), "{cause}");
        assert_eq!(bench.refused(&["bad.copc.laz", "again.copc.laz"]), "INPUT_CHECKSUM", "byte {at}");
    }
    let mut bad = good.clone();
    area.step_by(step).for_each(|at| bad[at] ^= 0x40);
    bench.put("bad.copc.laz", &bad);
    let (_, lines) = bench.run(&["verify", "bad.copc.laz"]);
    let cause = lines[0]["cause"].as_str().unwrap();
    assert_eq!(cause.matches("the points of node").count(), 3, "{cause}");
    assert!(cause.ends_with(" more"), "{cause}");
}

#[test]
fn a_file_of_many_nodes_has_its_checksums_behind_the_points() {
    let bench = Bench::new();
    let mut las = Las::at(7, 0, &cloud(200_000, [90_000, 90_000, 500]));
    // With other records in front there is no room for the checksums in what readers ask for first.
    let long =
        |id| groma_core::scan::variable_record::VariableRecord::new("somebody", id, "", vec![7; 32_700]);
    las.vlrs = vec![long(1), long(2)];
    bench.put("in.las", &las.las());
    bench.convert(&["in.las", "out.copc.laz"]);
    let scan = Scan::read(&bench.path("out.copc.laz")).unwrap();
    assert!(scan.evlrs[0].is("groma", 4) && scan.vlrs.iter().all(|record| !record.is("groma", 4)));
    assert!(matches!(checksums::stored(&scan), Stored::Yes { .. }));
    assert!(bench.run(&["verify", "out.copc.laz"]).0);
    bench.convert(&["out.copc.laz", "again.copc.laz"]);
    let again = Scan::read(&bench.path("again.copc.laz")).unwrap();
    assert_eq!(again.records().filter(|record| record.is("groma", 4)).count(), 1);
}

#[test]
fn checksums_of_another_file_are_not_believed_and_a_file_without_says_so() {
    let bench = Bench::new();
    bench.put("in.laz", &Las::at(7, 0, &cloud(5_000, [9_000, 9_000, 500])).laz());
    let (_, lines) = bench.run(&["scan", "in.laz"]);
    assert!(lines[0]["checksums"].is_null());
    let (done, lines) = bench.run(&["verify", "in.laz"]);
    assert!(done && lines[0]["checksums"] == false && lines[0]["points"] == 5_000, "{lines:?}");

    bench.convert(&["in.laz", "out.copc.laz"]);
    let scan = Scan::read(&bench.path("out.copc.laz")).unwrap();
    let mut bytes = std::fs::read(bench.path("out.copc.laz")).unwrap();
    let data = &scan.record("groma", 4).unwrap().data;
    let at = bytes.windows(data.len()).position(|window| window == data).unwrap();
    // A checksum that lies is no licence to read the points all the same.
    bytes[at + 16] ^= 1;
    bench.put("other.copc.laz", &bytes);
    assert_eq!(bench.refused(&["other.copc.laz", "again.copc.laz"]), "INPUT_CHECKSUM");
    bytes[at + 16] ^= 1;
    // The byte of the hierarchy that they belong to.
    bytes[at + 8] ^= 1;
    bench.put("other.copc.laz", &bytes);
    let lines = bench.convert(&["other.copc.laz", "again.copc.laz"]);
    let told = "the checksums of its nodes are those of another file";
    assert!(lines.iter().any(|line| line.to_string().contains(told)), "{lines:?}");
    let (_, lines) = bench.run(&["scan", "other.copc.laz"]);
    assert!(lines[0]["checksums"].is_null());
}

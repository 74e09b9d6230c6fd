//! Damaged files whose points can be read all the same: with a warning, or refused where that is asked for.

use crate::bench::{Bench, Las, cloud, records, sorted};
use groma_core::scan::Scan;
use groma_core::scan::variable_record::{EXTRA_BYTES, SPECIFICATION, VariableRecord};
use laz::laszip::{ChunkTable, LazVlr};
use std::io::Cursor;

/// The file with the chunk table that `change` makes of its own.
fn with_table(laz: &[u8], bench: &Bench, change: impl Fn(ChunkTable) -> ChunkTable) -> Vec<u8> {
    let scan = Scan::read(&bench.put("whole.laz", laz)).unwrap();
    let vlr = LazVlr::from_buffer(&scan.record(LazVlr::USER_ID, LazVlr::RECORD_ID).unwrap().data).unwrap();
    let start = scan.header.offset_to_point_data as usize;
    let at = u64::from_le_bytes(laz[start..start + 8].try_into().unwrap()) as usize;
    let table = ChunkTable::read(&mut Cursor::new(&laz[at..]), vlr.uses_variable_size_chunks()).unwrap();
    let mut bytes = laz[..at].to_vec();
    change(table).write_to(&mut bytes, &vlr).unwrap();
    bytes
}

fn without(table: &ChunkTable, lost: usize) -> ChunkTable {
    let mut shorter = ChunkTable::with_capacity(table.len());
    table.as_ref().iter().enumerate().filter(|(i, _)| *i != lost).for_each(|(_, entry)| shorter.push(*entry));
    shorter
}

/// Converts what must be refused with `--strict`: the warnings.
fn warnings(bench: &Bench, strict: &str) -> String {
    assert_eq!(bench.refused(&["in.laz", "out.copc.laz", "--strict", "--overwrite"]), strict);
    let lines = bench.convert(&["in.laz", "out.copc.laz", "--overwrite"]);
    lines.iter().filter(|line| line["event"] == "warning").map(|line| line["text"].to_string()).collect()
}

#[test]
fn a_short_chunk_table_loses_no_point() {
    let bench = Bench::new();
    for (format, chunk, lost) in
        [(7, Some(500), 0), (7, None, 2), (7, Some(500), 5), (1, Some(500), 5), (1, None, 3)]
    {
        let mut las = Las::at(format, 0, &cloud(2_700, [5000, 3000, 400]));
        las.chunk = chunk;
        let laz = las.laz();
        let short = with_table(&laz, &bench, |table| {
            // Of chunks that do not tell their own length only the last can be found.
            without(&table, if format < 6 { table.len() - 1 } else { lost })
        });
        bench.put("in.laz", &short);
        let told = warnings(&bench, "INPUT_CORRUPT");
        assert!(told.contains("of 2700 points"), "{told}");
        let whole = bench.put("whole.laz", &laz);
        let found = sorted(records(&bench.path("out.copc.laz")));
        assert!(found == sorted(records(&whole)), "format {format}, {lost}");
    }
}

#[test]
fn bytes_behind_the_last_chunk_that_can_be_none_cost_no_point() {
    let bench = Bench::new();
    let mut las = Las::at(7, 0, &cloud(2_700, [5000, 3000, 400]));
    las.chunk = Some(500);
    let laz = las.laz();
    let start = u32::from_le_bytes(laz[96..100].try_into().unwrap()) as usize;
    let at = u64::from_le_bytes(laz[start..start + 8].try_into().unwrap());
    // Too few for the head of a chunk, also with the table behind them.
    let mut short = with_table(&laz, &bench, |table| without(&table, table.len() - 1));
    short.splice(at as usize..at as usize, [7; 10]);
    short[start..start + 8].copy_from_slice(&(at + 10).to_le_bytes());
    bench.put("in.laz", &short);
    let told = warnings(&bench, "INPUT_CORRUPT");
    assert!(told.contains("all were recovered from the chunks"), "{told}");
    let whole = bench.put("whole.laz", &laz);
    assert!(sorted(records(&bench.path("out.copc.laz"))) == sorted(records(&whole)));
}

#[test]
fn what_the_chunk_table_lacks_in_the_middle_of_chunks_without_heads_is_refused() {
    let bench = Bench::new();
    let laz = Las::at(1, 0, &cloud(2_700, [5000, 3000, 400])).laz();
    let short = with_table(&laz, &bench, |table| without(&without(&table, 5), 4));
    bench.put("in.laz", &short);
    assert_eq!(bench.refused(&["in.laz", "out.copc.laz"]), "INPUT_CORRUPT");
}

#[test]
fn a_header_that_announces_more_points_than_the_file_has_costs_none_of_them() {
    let bench = Bench::new();
    let laz = Las::at(7, 0, &cloud(2_700, [5000, 3000, 400])).laz();
    let mut many = laz.clone();
    many[247..255].copy_from_slice(&0x7fff_ffff_ffffu64.to_le_bytes());
    bench.put("in.laz", &many);
    let told = warnings(&bench, "INPUT_TRUNCATED");
    assert!(
        told.contains("2700 were recovered from the chunks, 140737488352627 are not in the file"),
        "{told}"
    );
    let whole = bench.put("whole.laz", &laz);
    assert!(sorted(records(&bench.path("out.copc.laz"))) == sorted(records(&whole)));
    assert_eq!(Scan::read(&bench.path("out.copc.laz")).unwrap().points, 2_700);
    // Chunks without heads do not tell how many points the last one has.
    let mut many = Las::at(3, 0, &cloud(2_700, [5000, 3000, 400])).laz();
    many[107..111].copy_from_slice(&u32::MAX.to_le_bytes());
    bench.put("in.laz", &many);
    assert_eq!(bench.refused(&["in.laz", "out.copc.laz", "--overwrite"]), "INPUT_TRUNCATED");
}

#[test]
fn only_extra_bytes_that_are_there_are_described() {
    let bench = Bench::new();
    let mut las = Las::at(6, 4, &cloud(50, [500, 500, 500]));
    let mut descriptors = vec![0; 3 * 192];
    for (index, name) in [b"Amplitude", b"Reflectan", b"Deviation"].iter().enumerate() {
        descriptors[index * 192 + 2] = 3;
        descriptors[index * 192 + 4..][..9].copy_from_slice(*name);
    }
    las.vlrs = vec![VariableRecord::new(SPECIFICATION, EXTRA_BYTES, "", descriptors.clone())];
    let input = bench.put("in.las", &las.las());
    let lines = bench.convert(&["in.las", "out.copc.laz"]);
    let told = "the attribute Deviation is described as the extra bytes 5 to 6, and 4 are there";
    assert!(lines.iter().any(|line| line.to_string().contains(told)), "{lines:?}");
    let scan = Scan::read(&bench.path("out.copc.laz")).unwrap();
    assert_eq!(scan.record(SPECIFICATION, EXTRA_BYTES).unwrap().data, descriptors[..2 * 192]);
    assert!(scan.warnings.is_empty(), "{:?}", scan.warnings);
    assert!(sorted(records(&bench.path("out.copc.laz"))) == sorted(records(&input)));
}

#[test]
fn scan_says_what_a_conversion_would_refuse() {
    let bench = Bench::new();
    let las = Las::at(7, 0, &cloud(50, [500, 500, 500])).las();
    bench.put("good.las", &las);
    bench.put("cut.las", &las[..las.len() - 1]);
    let problem = |name: &str| bench.run(&["scan", name]).1[0]["problem"].clone();
    assert!(problem("good.las").is_null());
    assert_eq!(problem("cut.las")["code"], "INPUT_TRUNCATED");
}

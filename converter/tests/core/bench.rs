//! LAS and LAZ files to order, runs of the binary, and what a run left behind.

use groma_core::input::{Pieces, Source};
use groma_core::scan::Scan;
use groma_core::scan::variable_record::VariableRecord;
use las::Version;
use las::raw::Header;
use las::raw::header::LargeFile;
use laz::{LasZipCompressor, LazVlr, LazVlrBuilder};
use serde_json::Value;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A file to be written.
pub struct Las {
    pub minor: u8,
    pub format: u8,
    pub extra: u16,
    pub scale: [f64; 3],
    pub offset: [f64; 3],
    pub records: Vec<u8>,
    pub vlrs: Vec<VariableRecord>,
    /// What the header says of the bounds; default: the truth.
    pub bounds: Option<[[f64; 3]; 2]>,
    /// Points of a LAZ chunk; none: as many as the writer likes in each.
    pub chunk: Option<u32>,
}

impl Las {
    /// Records of a format at the given integer positions; the other bytes vary from record to record.
    pub fn at(format: u8, extra: u16, positions: &[[i32; 3]]) -> Self {
        let length = usize::from(groma_core::scan::RECORD_LENGTHS[usize::from(format)] + extra);
        let mut records = Vec::with_capacity(length * positions.len());
        for (index, position) in positions.iter().enumerate() {
            let start = records.len();
            records.extend(position.iter().flat_map(|v| v.to_le_bytes()));
            records.extend((12..length).map(|at| scatter(index as u64 * 97 + at as u64) as u8));
            if groma_core::record::has_gps_time(format) {
                let gps = start + if format < 6 { 20 } else { 22 };
                records[gps..gps + 8].copy_from_slice(&(index as f64 * 0.25).to_le_bytes());
            }
        }
        let minor = if format < 4 { 2 } else { 4 };
        Self {
            minor,
            format,
            extra,
            scale: [0.01; 3],
            offset: [1000.0, -2000.0, 0.0],
            records,
            vlrs: Vec::new(),
            bounds: None,
            chunk: Some(500),
        }
    }

    /// The bounds of the points.
    fn true_bounds(&self) -> [[f64; 3]; 2] {
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for record in self.records.chunks_exact(self.length()) {
            let position = groma_core::record::position(record);
            for axis in 0..3 {
                let value = f64::from(position[axis]) * self.scale[axis] + self.offset[axis];
                bounds[0][axis] = bounds[0][axis].min(value);
                bounds[1][axis] = bounds[1][axis].max(value);
            }
        }
        bounds
    }

    fn length(&self) -> usize {
        usize::from(groma_core::scan::RECORD_LENGTHS[usize::from(self.format)] + self.extra)
    }

    fn file(&self, compressed: Option<LazVlr>) -> Vec<u8> {
        let mut vlrs = self.vlrs.clone();
        if let Some(vlr) = &compressed {
            let mut data = Vec::new();
            vlr.write_to(&mut data).unwrap();
            vlrs.push(VariableRecord::new(LazVlr::USER_ID, LazVlr::RECORD_ID, "", data));
        }
        let mut area = Vec::new();
        vlrs.iter().for_each(|record| record.write(&mut area).unwrap());
        let version = Version::new(1, self.minor);
        let count = (self.records.len() / self.length()) as u64;
        let [min, max] = self.bounds.unwrap_or_else(|| self.true_bounds());
        let header = Header {
            min_x: min[0],
            min_y: min[1],
            min_z: min[2],
            max_x: max[0],
            max_y: max[1],
            max_z: max[2],
            version,
            header_size: version.header_size(),
            offset_to_point_data: u32::from(version.header_size()) + area.len() as u32,
            number_of_variable_length_records: vlrs.len() as u32,
            point_data_record_format: self.format | if compressed.is_some() { 0x80 } else { 0 },
            point_data_record_length: self.length() as u16,
            number_of_point_records: if self.format < 6 { count as u32 } else { 0 },
            x_scale_factor: self.scale[0],
            y_scale_factor: self.scale[1],
            z_scale_factor: self.scale[2],
            x_offset: self.offset[0],
            y_offset: self.offset[1],
            z_offset: self.offset[2],
            large_file: Some(LargeFile {
                number_of_point_records: count,
                number_of_points_by_return: [0; 15],
            }),
            ..Header::default()
        };
        let mut bytes = Vec::new();
        header.write_to(&mut bytes).unwrap();
        bytes.extend(area);
        match compressed {
            None => bytes.extend(&self.records),
            Some(vlr) => {
                let mut out = Cursor::new(bytes);
                out.set_position(out.get_ref().len() as u64);
                let mut compressor = LasZipCompressor::new(&mut out, vlr).unwrap();
                if self.chunk.is_some() {
                    compressor.compress_many(&self.records).unwrap();
                } else {
                    let mut rest = self.records.as_slice();
                    for points in (1..).map(|i| scatter(i) as usize % 700 + 1) {
                        let (now, later) = rest.split_at(rest.len().min(points * self.length()));
                        compressor.compress_many(now).unwrap();
                        rest = later;
                        if rest.is_empty() {
                            break;
                        }
                        compressor.finish_current_chunk().unwrap();
                    }
                }
                compressor.done().unwrap();
                drop(compressor);
                bytes = out.into_inner();
            }
        }
        bytes
    }

    pub fn las(&self) -> Vec<u8> {
        self.file(None)
    }

    pub fn laz(&self) -> Vec<u8> {
        let builder = LazVlrBuilder::default().with_point_format(self.format, self.extra).unwrap();
        self.file(Some(match self.chunk {
            Some(points) => builder.with_fixed_chunk_size(points).build(),
            None => builder.with_variable_chunk_size().build(),
        }))
    }
}

/// A hash with good spread.
pub fn scatter(seed: u64) -> u64 {
    let mut v = seed.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    v = (v ^ v >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    v ^ v >> 31
}

/// Positions without any order in a box of the given size.
pub fn cloud(count: u64, size: [u64; 3]) -> Vec<[i32; 3]> {
    let at = |i: u64, axis: u64| (scatter(i * 3 + axis) % size[axis as usize]) as i32;
    (0..count).map(|i| [at(i, 0), at(i, 1), at(i, 2)]).collect()
}

/// A folder of one test, with the binary at hand.
pub struct Bench {
    folder: tempfile::TempDir,
}

impl Bench {
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn put(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.path(name);
        std::fs::write(&path, bytes).unwrap();
        path
    }

    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    pub fn command(&self) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_groma-core"));
        command.current_dir(self.folder.path());
        command
    }

    /// Runs `groma-core` and returns whether it succeeded and the JSON lines that it printed.
    pub fn run(&self, arguments: &[&str]) -> (bool, Vec<Value>) {
        let output = self.command().args(arguments).output().unwrap();
        (output.status.success(), lines(&output))
    }

    /// A conversion that must succeed.
    pub fn convert(&self, arguments: &[&str]) -> Vec<Value> {
        let (done, lines) = self.run(&[&["convert"], arguments].concat());
        assert!(done, "{lines:?}");
        lines
    }

    /// A conversion with something on its standard input: the JSON lines that it printed.
    pub fn answered(&self, arguments: &[&str], input: &str) -> Vec<Value> {
        let mut command = self.command();
        command
            .arg("convert")
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null());
        let mut child = command.spawn().unwrap();
        // Who ends without reading has closed the pipe.
        let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
        lines(&child.wait_with_output().unwrap())
    }

    /// A conversion that must fail, and must leave nothing behind: its code.
    pub fn refused(&self, arguments: &[&str]) -> String {
        let before = self.names();
        let (done, lines) = self.run(&[&["convert"], arguments].concat());
        assert!(!done, "{lines:?}");
        assert_eq!(self.names(), before);
        let last = lines.last().unwrap();
        assert_eq!(last["event"], "error");
        assert!(["file", "cause", "fix"].iter().all(|key| last[key].is_string()), "{last}");
        last["code"].as_str().unwrap().to_string()
    }
}

pub fn lines(output: &Output) -> Vec<Value> {
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// The records of a file in the output's format, in file order.
pub fn records(path: &Path) -> Vec<Vec<u8>> {
    let source = Source::plan(Scan::read(path).unwrap()).unwrap();
    let length = source.mapping.target_length();
    let mut data = Vec::with_capacity(source.scan.points as usize * length);
    for part in 0..source.parts() {
        let mut keep = |records: &[u8]| {
            data.extend_from_slice(records);
            Ok(())
        };
        source.read(part, &mut Pieces::default(), &mut keep).unwrap();
    }
    data.chunks_exact(length).map(<[u8]>::to_vec).collect()
}

/// The records in an order that does not depend on where they stand.
pub fn sorted(mut records: Vec<Vec<u8>>) -> Vec<Vec<u8>> {
    records.sort();
    records
}

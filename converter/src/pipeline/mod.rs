//! One conversion, as stages whose order the types enforce:
//! `Pipeline::scan(..)?.validate()?.distribute()?.build()?.write()?`.
//!
//! Between `distribute` and `write` all records are held in memory.

pub mod answer;
pub mod options;
mod points;

use crate::copc;
use crate::copc::header::Points;
use crate::copc::info::Info;
use crate::copc::records::{self, Additions};
use crate::error::{Error, Result};
use crate::input::{Source, merge};
use crate::memory;
use crate::octree::cube::Cube;
use crate::octree::sample::{self, Entry, Node};
use crate::output::{self, PendingFile};
use crate::progress::{Meter, Progress, Stage};
use crate::record::{fields, has_gps_time, has_waveform};
use crate::scan::Scan;
use crate::statistics::Statistics;
use options::Options;
use serde::Serialize;
use std::path::Path;

/// A conversion at one of its stages.
pub struct Pipeline<'a, S> {
    options: &'a Options,
    progress: &'a dyn Progress,
    stage: S,
}

/// The headers are read.
pub struct Scanned(Vec<Scan>);

/// The inputs fit together, the memory suffices, and the files that the options name are read.
pub struct Validated {
    sources: Vec<Source>,
    points: u64,
    additions: Additions,
}

/// All records are in memory in the output's format, and sorted along the Morton curve of the root cube.
pub struct Distributed {
    sources: Vec<Source>,
    additions: Additions,
    data: Vec<u8>,
    bounds: crate::octree::cube::Bounds,
    cube: Cube,
    entries: Vec<Entry>,
}

/// Every point has its node.
pub struct Built {
    sources: Vec<Source>,
    additions: Additions,
    data: Vec<u8>,
    points: Points,
    info: Info,
    nodes: Vec<Node>,
}

/// What stands at the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Summary {
    pub points: u64,
    pub nodes: usize,
    pub bytes: u64,
}

impl<'a> Pipeline<'a, Scanned> {
    /// Reads the headers of all inputs. Refuses first an output that must not be written.
    pub fn scan(options: &'a Options, progress: &'a dyn Progress) -> Result<Self> {
        output::check_target(&options.output, options.overwrite)?;
        if options.inputs.iter().any(|input| is_same_file(input, &options.output)) {
            return Err(Error::output_exists(&options.output, "the output is one of the inputs"));
        }
        let scans = options.inputs.iter().map(|path| Scan::read(path)).collect::<Result<_>>()?;
        Ok(Self { options, progress, stage: Scanned(scans) })
    }

    /// Checks what can be checked without decoding points.
    pub fn validate(self) -> Result<Pipeline<'a, Validated>> {
        let Self { options, progress, stage: Scanned(scans) } = self;
        for scan in &scans {
            warn(scan, progress);
        }
        let mut sources = scans.into_iter().map(Source::plan).collect::<Result<Vec<_>>>()?;
        merge::unify(&mut sources)?;
        let points = sources.iter().map(|s| s.scan.points).fold(0, u64::saturating_add);
        memory::check(points, record_length(&sources) as u64, options.memory)?;
        let additions = options.additions()?;
        Ok(Pipeline { options, progress, stage: Validated { sources, points, additions } })
    }
}

impl<'a> Pipeline<'a, Validated> {
    /// Decodes all points, finds the root cube around them and orders them.
    pub fn distribute(self) -> Result<Pipeline<'a, Distributed>> {
        let Self { options, progress, stage: Validated { sources, points, additions } } = self;
        let length = record_length(&sources);
        let mut data = vec![0; points as usize * length];
        let meter = Meter::start(progress, Stage::Read, points);
        let mut rest = data.as_mut_slice();
        for source in &sources {
            let (part, after) = rest.split_at_mut(source.scan.points as usize * length);
            source.read(part, &meter)?;
            rest = after;
        }
        meter.finish();
        let first = &sources[0].scan;
        let (scale, offset) = (first.scale(), first.offset());
        let bounds = points::bounds(&data, length, scale, offset);
        if options.wait_for_record {
            progress.bounds(bounds.min, bounds.max);
        }
        let cube = Cube::around(&bounds, scale);
        let entries = points::entries(&data, length, scale, offset, &cube);
        let stage = Distributed { sources, additions, data, bounds, cube, entries };
        Ok(Pipeline { options, progress, stage })
    }
}

impl<'a> Pipeline<'a, Distributed> {
    /// Gives every point its node and sums up the attributes.
    pub fn build(self) -> Result<Pipeline<'a, Built>> {
        let Self { options, progress, stage } = self;
        let Distributed { sources, mut additions, data, bounds, cube, entries } = stage;
        let count = entries.len() as u64;
        let meter = Meter::start(progress, Stage::Build, count);
        let nodes = sample::build(entries, &|points| meter.add(points));
        meter.finish();

        let (first, length) = (&sources[0].scan, record_length(&sources));
        let target = sources[0].mapping.target();
        let mut fields = fields::fields(target, first.scale(), first.offset(), &first.extra_bytes(), length);
        if sources.iter().all(|source| !has_gps_time(source.scan.point_format)) {
            fields.retain(|field| field.name != "gpsTime");
        }
        let statistics = Statistics::of(&data, length, &fields);
        let time = statistics.attribute("gpsTime").map_or([0.0; 2], |t| [t.min, t.max]);
        let json = serde_json::to_vec(&statistics).map_err(|e| Error::output_write(&options.output, e))?;
        additions.statistics = json;
        let record_length = u16::try_from(length).map_err(|_| {
            Error::corrupt(
                &first.path,
                format!("records of {length} bytes are too long for point format {}", target.id()),
            )
        })?;
        let by_return = statistics.points_by_return();
        let points = Points { target, record_length, count, by_return, bounds };
        let info = Info { cube, root_page: (0, 0), gps_time: time };
        let stage = Built { sources, additions, data, points, info, nodes };
        Ok(Pipeline { options, progress, stage })
    }
}

impl Pipeline<'_, Built> {
    /// Writes the file; it has its name only when all of it is on disk.
    pub fn write(self) -> Result<Summary> {
        let Self { options, progress, stage } = self;
        let Built { sources, mut additions, data, points, info, nodes } = stage;
        if options.wait_for_record {
            answer::read(std::io::stdin().lock(), &options.output, &mut additions)?;
        }
        let failed = |e: std::io::Error| Error::output_write(&options.output, e);
        let first = &sources[0];
        let extra = first.mapping.extra() as u16;
        let laz = copc::chunk::parameters(points.target.id(), extra)
            .map_err(|e| failed(std::io::Error::other(e)))?;
        let records = records::collect(&first.scan, &laz, &additions).map_err(failed)?;
        if !records.has_wkt() {
            progress.warn(
                "the output has no WKT: readers of LAS 1.4 will not know its coordinate reference system",
            );
        }
        let meter = Meter::start(progress, Stage::Write, points.count);
        let summary = (points.count, nodes.len());
        let header = &first.scan.header;
        let (pending, mut file) = PendingFile::create(&options.output, options.overwrite)?;
        let content = copc::write::Content {
            input: header,
            points,
            info,
            laz: &laz,
            records: &records,
            data: &data,
            nodes: &nodes,
        };
        let bytes = copc::write::write(&mut file, &content, &meter).map_err(failed)?;
        pending.commit(file)?;
        meter.finish();
        Ok(Summary { points: summary.0, nodes: summary.1, bytes })
    }
}

/// Bytes of a record of the output; the same for all sources once they are unified.
fn record_length(sources: &[Source]) -> usize {
    sources.first().map_or(0, |source| source.mapping.target_length())
}

fn is_same_file(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}

/// Tells what in an input is not as it should be, or will not be in the output.
fn warn(scan: &Scan, progress: &dyn Progress) {
    let tell = |text: &str| progress.warn(&format!("{}: {text}", scan.path.display()));
    scan.warnings.iter().for_each(|text| tell(text));
    if has_waveform(scan.point_format) {
        tell("the waveforms are left out: COPC has no point format for them");
    }
    let described: usize = scan.extra_bytes().iter().map(|attribute| attribute.size).sum();
    let base = crate::record::LENGTHS.get(usize::from(scan.point_format)).copied().unwrap_or(u16::MAX);
    let there = usize::from(scan.header.point_data_record_length.saturating_sub(base));
    if described != there {
        tell(&format!("{there} extra bytes per point are there, {described} are described; all are kept"));
    }
}

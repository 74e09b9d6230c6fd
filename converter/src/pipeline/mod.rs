//! One conversion, as stages whose order the types enforce:
//! `Pipeline::scan(..)?.validate()?.distribute()?.build()?.write()?`.
//!
//! Whatever the number of points, memory stays within what the options allow: what has no room waits in scratch files.

pub mod answer;
pub mod options;
pub mod plan;

use crate::build;
use crate::copc;
use crate::copc::checksums::{self, Stored};
use crate::copc::chunk::Node;
use crate::copc::header::Points;
use crate::copc::info::Info;
use crate::copc::records::{self, Additions};
use crate::distribute::{self, Distribution, Inputs};
use crate::error::{Error, Result};
use crate::input::{Source, merge};
use crate::memory::Budget;
use crate::octree::place::Frame;
use crate::output::{self, PendingFile};
use crate::progress::{Meter, Progress, Stage};
use crate::record::{fields, has_gps_time, has_waveform};
use crate::scan::Scan;
use crate::statistics::Statistics;
use crate::temporary::folder::TempFolder;
use crate::temporary::store::Store;
use laz::LazVlr;
use options::Options;
use plan::{Plan, Shares};
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

/// The inputs fit together, memory and disk suffice, and the files that the options name are read.
pub struct Validated {
    inputs: Inputs,
    additions: Additions,
    budget: Budget,
    shares: Shares,
}

/// All records are in the output's form and in cells of the octree.
pub struct Distributed {
    inputs: Inputs,
    additions: Additions,
    shares: Shares,
    distribution: Distribution,
    workspace: Workspace,
}

/// Every point has its node, and every node is compressed.
pub struct Built {
    points: Points,
    info: Info,
    laz: LazVlr,
    additions: Additions,
    rgb_bits: Option<u8>,
    first: Scan,
    nodes: Vec<Node>,
    workspace: Workspace,
}

/// Where the run works. The store goes before the folders that it writes to.
struct Workspace {
    store: Store,
    _temporary: Option<TempFolder>,
    output: PendingFile,
}

/// What stands at the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Summary {
    pub points: u64,
    pub nodes: usize,
    pub bytes: u64,
    /// As in the statistics.
    pub rgb_bits: Option<u8>,
}

impl<'a> Pipeline<'a, Scanned> {
    /// Reads the headers of all inputs. Refuses first an output that must not be written.
    pub fn scan(options: &'a Options, progress: &'a dyn Progress) -> Result<Self> {
        if options.inputs.iter().any(|input| is_same_file(input, &options.output)) {
            return Err(Error::output_input(&options.output, "the output is one of the inputs"));
        }
        output::check_target(&options.output, options.overwrite)?;
        let scans = options.inputs.iter().map(|path| Scan::read(path)).collect::<Result<_>>()?;
        Ok(Self { options, progress, stage: Scanned(scans) })
    }

    /// Checks what can be checked without decoding points.
    pub fn validate(self) -> Result<Pipeline<'a, Validated>> {
        let Self { options, progress, stage: Scanned(scans) } = self;
        let mut sources = scans.into_iter().map(Source::plan).collect::<Result<Vec<_>>>()?;
        for source in &sources {
            if let Some(rescued) = source.rescued.as_ref().filter(|_| options.strict) {
                return Err(rescued.refusal(&source.scan.path));
            }
            warn(source, progress);
        }
        if options.wkt.is_none() {
            merge::check_systems(&sources)?;
        }
        merge::unify(&mut sources)?;
        let inputs = inputs(sources)?;
        let budget = Budget::new(options.memory);
        let shares = plan::shares(&inputs, budget, options.workers())?;
        plan::check_space(temp_dir(options), plan::temp_bytes(&inputs, &shares))?;
        let additions = options.additions()?;
        Ok(Pipeline { options, progress, stage: Validated { inputs, additions, budget, shares } })
    }
}

impl<'a> Pipeline<'a, Validated> {
    /// What the conversion will take.
    pub fn plan(&self) -> Plan {
        let Validated { inputs, budget, shares, .. } = &self.stage;
        plan::plan(inputs, shares, *budget, temp_dir(self.options), self.options.rules.sampling)
    }

    /// Warns of inputs whose points alone decide whether they go into one output.
    pub fn foretell(&self) {
        let Validated { inputs, .. } = &self.stage;
        for source in &inputs.sources {
            if let Some(doubt) = inputs.doubt(source) {
                let path = source.scan.path.display();
                self.progress
                    .warn(&format!("{path}: {doubt}; points that do would be refused (INPUT_MIXED)"));
            }
        }
    }

    /// Decodes all points and brings them to the cells of the octree.
    pub fn distribute(self) -> Result<Pipeline<'a, Distributed>> {
        let Self { options, progress, stage: Validated { inputs, additions, shares, .. } } = self;
        let output = PendingFile::create(&options.output, options.overwrite)?;
        let name = options.output.file_name().unwrap_or_default().to_string_lossy();
        let make =
            |parent: &Path| TempFolder::create(parent, &name).map_err(|e| Error::temporary(parent, &e));
        let temporary = options.temp_dir.as_deref().map(make).transpose()?;
        let folder = temporary.as_ref().map_or(output.folder(), TempFolder::path);
        let store = Store::new(folder, shares.store);
        let distribution = distribute::distribute(&inputs, shares.readers, &store, progress)?;
        if options.wait_for_record {
            progress.bounds(distribution.bounds.min, distribution.bounds.max);
        }
        let workspace = Workspace { store, _temporary: temporary, output };
        let stage = Distributed { inputs, additions, shares, distribution, workspace };
        Ok(Pipeline { options, progress, stage })
    }
}

impl<'a> Pipeline<'a, Distributed> {
    /// Gives every point its node and compresses the nodes.
    pub fn build(self) -> Result<Pipeline<'a, Built>> {
        let Self { options, progress, stage } = self;
        let Distributed { inputs, mut additions, shares, distribution, workspace } = stage;
        let Distribution { cells, cube, bounds, tally } = distribution;
        let first = &inputs.sources[0];
        let failed = |e: std::io::Error| Error::output_write(&options.output, e);
        let laz = copc::chunk::parameters(inputs.target.id(), first.mapping.extra() as u16)
            .map_err(|e| failed(std::io::Error::other(e)))?;
        let meter = Meter::start(progress, Stage::Build, inputs.points);
        let nodes =
            build::build(&inputs, cube, cells, options.rules, &laz, shares.force, &workspace.store, &meter)?;
        meter.finish();

        let statistics = Statistics::of(&tally, &inputs.fields);
        let time = statistics.attribute("gpsTime").map_or([0.0; 2], |t| [t.min, t.max]);
        additions.statistics =
            serde_json::to_vec(&statistics).map_err(|e| Error::output_write(&options.output, e))?;
        let by_return = statistics.points_by_return();
        let points = Points {
            target: inputs.target,
            record_length: inputs.length as u16,
            count: inputs.points,
            by_return,
            bounds,
        };
        let info = Info { cube, root_page: (0, 0), gps_time: time };
        let first = inputs.sources.into_iter().next().map(|source| source.scan);
        let first = first.ok_or_else(|| Error::option("USAGE", "no input"))?;
        let rgb_bits = statistics.rgb_bits;
        let stage = Built { points, info, laz, additions, rgb_bits, first, nodes, workspace };
        Ok(Pipeline { options, progress, stage })
    }
}

impl Pipeline<'_, Built> {
    /// Writes the file; it has its name only when all of it is on disk.
    pub fn write(self) -> Result<Summary> {
        let Self { options, progress, stage } = self;
        let Built { points, info, laz, mut additions, rgb_bits, first, nodes, workspace } = stage;
        if options.wait_for_record {
            answer::read(std::io::stdin().lock(), &options.output, &mut additions)?;
        }
        let records = records::collect(&first, &laz, &additions)
            .map_err(|e| Error::output_write(&options.output, e))?;
        if !records.has_wkt() {
            progress.warn(
                "the output has no WKT: readers of LAS 1.4 will not know its coordinate reference system",
            );
        }
        let meter = Meter::start(progress, Stage::Write, points.count);
        let nodes = copc::write::ordered(nodes);
        let (count, number) = (points.count, nodes.len());
        let Workspace { store, _temporary, output } = workspace;
        let mut file = output.open()?;
        let content = copc::write::Content {
            input: &first.header,
            points,
            info,
            laz: &laz,
            records: &records,
            nodes,
            store: &store,
        };
        let bytes = copc::write::write(&mut file, &content, &options.output, &meter)?;
        output.commit(file)?;
        meter.finish();
        Ok(Summary { points: count, nodes: number, bytes, rgb_bits })
    }
}

/// What is to be distributed. Errors: `INPUT_CORRUPT` where the output's records would be too long.
fn inputs(mut sources: Vec<Source>) -> Result<Inputs> {
    // The records between header and points are the first input's; those of ten thousand others would fill memory.
    for other in sources.iter_mut().skip(1) {
        other.forget_records();
    }
    let first = &sources[0];
    let (target, length) = (first.mapping.target(), first.mapping.target_length());
    if u16::try_from(length).is_err() {
        let cause = format!("records of {length} bytes are too long for point format {}", target.id());
        return Err(Error::corrupt(&first.scan.path, cause));
    }
    let frame = Frame { scale: first.scan.scale(), offset: first.scan.offset() };
    let mut fields =
        fields::fields(target, frame.scale, frame.offset, &first.scan.extra_bytes.attributes, length);
    if sources.iter().all(|source| !has_gps_time(source.scan.point_format)) {
        fields.retain(|field| field.name != "gpsTime");
    }
    let points = sources.iter().map(|s| s.scan.points).fold(0, u64::saturating_add);
    Ok(Inputs { sources, points, length, target, frame, fields })
}

/// Where scratch files go.
fn temp_dir(options: &Options) -> &Path {
    options.temp_dir.as_deref().unwrap_or_else(|| output::parent(&options.output))
}

fn is_same_file(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}

/// Tells what in an input is not as it should be, or will not be in the output.
fn warn(source: &Source, progress: &dyn Progress) {
    let scan = &source.scan;
    let tell = |text: &str| progress.warn(&format!("{}: {text}", scan.path.display()));
    scan.warnings
        .iter()
        .chain(source.rescued.as_ref().map(|rescued| &rescued.text))
        .for_each(|text| tell(text));
    if checksums::stored(scan) == Stored::Foreign {
        tell(
            "the checksums of its nodes are those of another file, or of a newer program: they are not checked",
        );
    }
    for record in scan.records().filter(|record| !record.is_named()) {
        tell(&format!("record {} is left out: its user id is not text", record.record_id));
    }
    if has_waveform(scan.point_format) {
        tell("the waveforms are left out: COPC has no point format for them");
    }
}

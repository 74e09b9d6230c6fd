//! `groma-core`: the part of the `groma` command that reads and writes points.

use clap::{Args, Parser, Subcommand};
use groma_core::build::Rules;
use groma_core::compress::compress;
use groma_core::copc::checksums::{self, Stored};
use groma_core::error::{Error, Result, Wire};
use groma_core::input::Source;
use groma_core::input::contain;
use groma_core::memory;
use groma_core::pipeline::options::Options;
use groma_core::pipeline::{Pipeline, Summary};
use groma_core::progress::JsonLines;
use groma_core::sampling::Strategy;
use groma_core::scan::Scan;
use groma_core::scan::describe::Description;
use groma_core::temporary::folder;
use groma_core::verify;
use serde::Serialize;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

#[global_allocator]
static ALLOCATOR: memory::Allocator = memory::Allocator;

#[derive(Parser)]
#[command(version, about)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Print what stands before and after the points of a LAS or LAZ file, as one JSON object
    Scan { file: PathBuf },
    /// Read all points of a LAS or LAZ file, hold its chunks against their checksums, and print what was found
    Verify { file: PathBuf },
    /// Compress a LAS 1.4 file of point format 6, 7 or 8 to LAZ, and print what was done
    Compress { input: PathBuf, output: PathBuf },
    /// Convert LAS or LAZ files into one COPC file; prints JSON lines
    Convert(Convert),
}

#[derive(Args)]
struct Convert {
    /// Inputs, then the output
    #[arg(required = true, num_args = 1.., value_names = ["IN", "OUT"])]
    files: Vec<PathBuf>,
    /// File with further inputs, one a line
    #[arg(long)]
    list: Option<PathBuf>,
    /// File whose bytes become the georeference record (user id groma, record id 1)
    #[arg(long)]
    record: Option<PathBuf>,
    /// File whose bytes become the transformation record (user id groma, record id 3)
    #[arg(long)]
    transformation: Option<PathBuf>,
    /// Print the bounds of the points when they are known, and before writing wait for a line on standard input that
    /// names the files of the two records: {"record":PATH,"transformation":PATH}
    #[arg(long, conflicts_with_all = ["record", "transformation"])]
    wait_for_record: bool,
    /// File with the WKT that the output carries instead of the input's
    #[arg(long)]
    wkt: Option<PathBuf>,
    /// Replace an existing output
    #[arg(long)]
    overwrite: bool,
    /// Refuse a damaged input whose points can be read in part, or only by other ways than its own tables
    #[arg(long)]
    strict: bool,
    /// How a node's points are chosen
    #[arg(long, default_value = "poisson")]
    sampling: Strategy,
    /// Give sampled points the mean colour of the points that they stand for
    #[arg(long)]
    average_colors: bool,
    /// Most threads to work with [default: all]
    #[arg(long)]
    threads: Option<NonZeroUsize>,
    /// Most memory to use, e.g. 2GB, 256MB at least; points that have no room wait in scratch files [default: most of
    /// what is available]
    #[arg(long)]
    memory: Option<String>,
    /// Folder for scratch files [default: the output's]
    #[arg(long)]
    temp_dir: Option<PathBuf>,
    /// Print what the conversion would take, and stop before it reads a point
    #[arg(long)]
    dry_run: bool,
}

#[derive(Serialize)]
struct Done {
    event: &'static str,
    #[serde(flatten)]
    summary: Summary,
    seconds: f64,
}

fn main() -> ExitCode {
    let panic = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| match contain::meaning_of_panic() {
        None => panic(info),
        Some(error) if cfg!(panic = "abort") => JsonLines::print(&error.wire()),
        Some(_) => {}
    }));
    let outcome = match Cli::try_parse() {
        Ok(Cli { command: Command::Scan { file } }) => scan(&file),
        Ok(Cli { command: Command::Verify { file } }) => verify(&file),
        Ok(Cli { command: Command::Compress { input, output } }) => {
            compress(&input, &output).map(|done| JsonLines::print(&done))
        }
        Ok(Cli { command: Command::Convert(arguments) }) => convert(arguments),
        Err(error) if error.use_stderr() => Err(usage(&error)),
        Err(help) => help.exit(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // A run that is being stopped fails because its files have gone; the signal's handler says what happened.
            let _held = folder::hold();
            JsonLines::print(&error.wire());
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// What `groma-core scan` prints.
#[derive(Serialize)]
struct Scanned {
    #[serde(flatten)]
    description: Description,
    /// How the checksums of the nodes were made; `null` where there are none.
    checksums: Option<&'static str>,
    /// Why a conversion would refuse the file, as far as that shows without reading its points.
    problem: Option<Wire>,
}

fn scan(file: &Path) -> Result<()> {
    let scan = Scan::read(file)?;
    let description = scan.describe();
    let checksums = matches!(checksums::stored(&scan), Stored::Yes { .. }).then_some("CRC-32C");
    let problem = Source::plan(scan).err().map(|error| error.wire());
    JsonLines::print(&Scanned { description, checksums, problem });
    Ok(())
}

fn verify(file: &Path) -> Result<()> {
    JsonLines::print(&verify::verify(Source::plan(Scan::read(file)?)?)?);
    Ok(())
}

fn convert(arguments: Convert) -> Result<()> {
    let start = Instant::now();
    let dry_run = arguments.dry_run;
    let options = options(arguments)?;
    stop_cleanly(options.output.clone());
    let progress = JsonLines;
    let validated = Pipeline::scan(&options, &progress)?.validate()?;
    let plan = validated.plan();
    if dry_run {
        validated.foretell();
        JsonLines::print(&plan);
        return Ok(());
    }
    if plan.temp_bytes > 0 {
        memory::return_freed();
    }
    let summary = validated.distribute()?.build()?.write()?;
    let seconds = (start.elapsed().as_secs_f64() * 1000.0).round() / 1000.0;
    JsonLines::print(&Done { event: "done", summary, seconds });
    Ok(())
}

fn options(arguments: Convert) -> Result<Options> {
    let mut inputs = arguments.files;
    let output = inputs.pop().unwrap_or_default();
    if let Some(list) = &arguments.list {
        let text = std::fs::read_to_string(list)
            .map_err(|e| Error::option("LIST", format!("{} cannot be read ({e})", list.display())))?;
        inputs.extend(text.lines().map(str::trim_end).filter(|line| !line.is_empty()).map(PathBuf::from));
    }
    if inputs.is_empty() {
        return Err(Error::option("USAGE", "no input is given"));
    }
    if let Some(folder) = arguments.temp_dir.as_ref().filter(|folder| !folder.is_dir()) {
        return Err(Error::option("TEMP_DIR", format!("{} is not a folder", folder.display())));
    }
    let memory = arguments.memory.as_deref().map(memory::parse_size).transpose()?;
    if let Some(bytes) = memory.filter(|bytes| *bytes < memory::FLOOR) {
        let cause = format!("{bytes} bytes are less than the {} MiB that a run needs", memory::FLOOR >> 20);
        return Err(Error::option("MEMORY", cause));
    }
    Ok(Options {
        record: arguments.record,
        transformation: arguments.transformation,
        wait_for_record: arguments.wait_for_record,
        wkt: arguments.wkt,
        overwrite: arguments.overwrite,
        strict: arguments.strict,
        rules: Rules { sampling: arguments.sampling, average_colors: arguments.average_colors },
        threads: arguments.threads.map(NonZeroUsize::get),
        memory,
        temp_dir: arguments.temp_dir,
        ..Options::new(inputs, output)
    })
}

/// On SIGINT, SIGTERM and SIGHUP: nothing is left behind, and the exit status says what happened.
#[cfg(not(target_family = "wasm"))]
fn stop_cleanly(output: PathBuf) {
    let handler = move || {
        let _held = folder::abandon_all();
        let _last = JsonLines::print_last(&Error::interrupted(&output, "the conversion was stopped").wire());
        std::process::exit(130);
    };
    // Without a handler the process ends as it would anyway, leaving the unfinished file.
    if let Err(error) = ctrlc::set_handler(handler) {
        eprintln!("signals are not handled: {error}");
    }
}

/// In a page nothing is sent: the worker is ended, and all files with it.
#[cfg(target_family = "wasm")]
fn stop_cleanly(_output: PathBuf) {}

/// A command line that clap refuses, as an error like all others.
fn usage(error: &clap::Error) -> Error {
    let text = error.to_string();
    let cause = text.lines().next().unwrap_or_default().trim_start_matches("error: ").to_string();
    let option = error.get(clap::error::ContextKind::InvalidArg).map(ToString::to_string).unwrap_or_default();
    let name = [
        "SAMPLING",
        "MEMORY",
        "THREADS",
        "LIST",
        "TEMP_DIR",
        "WAIT_FOR_RECORD",
        "RECORD",
        "TRANSFORMATION",
        "WKT",
    ]
    .into_iter()
    .find(|name| option.contains(&format!("--{}", name.to_lowercase().replace('_', "-"))));
    Error::option(name.unwrap_or("USAGE"), cause)
}

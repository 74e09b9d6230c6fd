//! `groma-core`: the part of the `groma` command that reads and writes points.

use clap::{Args, Parser, Subcommand, ValueEnum};
use groma_core::error::{Error, Result};
use groma_core::input::contain::is_contained;
use groma_core::pipeline::options::Options;
use groma_core::pipeline::{Pipeline, Summary};
use groma_core::progress::JsonLines;
use groma_core::scan::Scan;
use groma_core::{memory, output};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

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
    /// Convert LAS or LAZ files into one COPC file; prints JSON lines
    Convert(Convert),
}

#[derive(Args)]
struct Convert {
    /// One or more inputs, then the output
    #[arg(required = true, num_args = 2.., value_names = ["IN", "OUT"])]
    files: Vec<PathBuf>,
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
    /// Replace an output that is there already
    #[arg(long)]
    overwrite: bool,
    /// How a node's points are chosen
    #[arg(long, default_value = "grid")]
    sampling: Sampling,
    /// Most memory to use, e.g. 2GB; a conversion that needs more is refused [default: what is available]
    #[arg(long)]
    memory: Option<String>,
    /// Folder for scratch files
    #[arg(long)]
    temp_dir: Option<PathBuf>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Sampling {
    /// The point nearest to the centre of each cell of a 128³ grid
    Grid,
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
    std::panic::set_hook(Box::new(move |info| {
        if !is_contained() {
            panic(info);
        }
    }));
    let outcome = match Cli::try_parse() {
        Ok(Cli { command: Command::Scan { file } }) => scan(&file),
        Ok(Cli { command: Command::Convert(arguments) }) => convert(arguments),
        Err(error) if error.use_stderr() => Err(usage(&error)),
        Err(help) => help.exit(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            JsonLines::print(&error.wire());
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn scan(file: &Path) -> Result<()> {
    JsonLines::print(&Scan::read(file)?.describe());
    Ok(())
}

fn convert(arguments: Convert) -> Result<()> {
    let start = Instant::now();
    let options = options(arguments)?;
    stop_cleanly(options.output.clone());
    let progress = JsonLines;
    let summary = Pipeline::scan(&options, &progress)?.validate()?.distribute()?.build()?.write()?;
    let seconds = (start.elapsed().as_secs_f64() * 1000.0).round() / 1000.0;
    JsonLines::print(&Done { event: "done", summary, seconds });
    Ok(())
}

fn options(arguments: Convert) -> Result<Options> {
    let Convert {
        mut files,
        record,
        transformation,
        wait_for_record,
        wkt,
        overwrite,
        sampling: Sampling::Grid,
        memory,
        temp_dir,
    } = arguments;
    if let Some(folder) = temp_dir.filter(|folder| !folder.is_dir()) {
        return Err(Error::option("TEMP_DIR", format!("{} is not a folder", folder.display())));
    }
    let output = files.pop().unwrap_or_default();
    let memory = memory.as_deref().map(memory::parse_size).transpose()?;
    Ok(Options { inputs: files, output, record, transformation, wait_for_record, wkt, overwrite, memory })
}

/// On SIGINT, SIGTERM and SIGHUP: nothing is left behind, and the exit status says what happened.
fn stop_cleanly(output: PathBuf) {
    let handler = move || {
        let _held = output::abandon_all();
        JsonLines::print(&Error::interrupted(&output, "the conversion was stopped").wire());
        std::process::exit(130);
    };
    // Without a handler the process ends as it would anyway, leaving the unfinished file.
    if let Err(error) = ctrlc::set_handler(handler) {
        eprintln!("signals are not handled: {error}");
    }
}

/// A command line that clap refuses, as an error like all others.
fn usage(error: &clap::Error) -> Error {
    let text = error.to_string();
    let cause = text.lines().next().unwrap_or_default().trim_start_matches("error: ").to_string();
    let option = error.get(clap::error::ContextKind::InvalidArg).map(ToString::to_string).unwrap_or_default();
    let name = ["sampling", "memory", "temp-dir", "wait-for-record", "record", "transformation", "wkt"]
        .into_iter()
        .find(|name| option.contains(name));
    match name {
        Some("sampling") => Error::option("SAMPLING", cause),
        Some("memory") => Error::option("MEMORY", cause),
        Some("temp-dir") => Error::option("TEMP_DIR", cause),
        Some("wait-for-record") => Error::option("WAIT_FOR_RECORD", cause),
        Some("transformation") => Error::option("TRANSFORMATION", cause),
        Some("record") => Error::option("RECORD", cause),
        Some("wkt") => Error::option("WKT", cause),
        _ => Error::option("USAGE", cause),
    }
}

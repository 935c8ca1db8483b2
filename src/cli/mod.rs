//! Arguments, messages, exit codes. Printing happens here only.

mod arguments;
mod check;
mod follow;
mod printer;
mod report;
mod show;
mod signals;
mod ticker;

use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use clap::{CommandFactory, Parser};

use arguments::{Arguments, Command, Of};
use printer::Printer;

use crate::error::{Error, Result, Stop};
use crate::files;
use crate::law::Integration;
use crate::law::path;
use crate::output;
use crate::run;
use crate::scene;
use crate::study;

/// Without a line that is read for so long the program ends: what is on disk is complete.
const PATIENCE: Duration = Duration::from_secs(10);

/// The program: reads the arguments, does what they say, prints the one error there may be.
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    // a table of `check` is all there is of it, so that whoever reads it page by page has time
    let patience = if matches!(arguments.command, Command::Check { .. }) { None } else { Some(PATIENCE) };
    let (printer, printing) = Printer::start();
    let code = match act(arguments, &printer) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            printer.coloured_error(&report::error(&error));
            ExitCode::from(error.exit_code())
        }
    };
    drop(printer);
    printing.finish(patience);
    code
}

fn act(arguments: Arguments, printer: &Printer) -> Result<()> {
    let stop = Stop::default();
    if arguments.command.is_long() {
        signals::watch(&stop);
    }
    match arguments.command {
        Command::Run { common, threads, resume, checkpoint } => {
            set_threads(threads)?;
            let mut show = show::Show::new(common.quiet, printer);
            let options = run::Options { resume, checkpoints: checkpoint, ..common.options(&stop) };
            let done = run::run(&options, &mut |event| show.event(event))?;
            show.done(&done);
            Ok(())
        }
        Command::Mesh { common } => {
            let mut show = show::Show::new(common.quiet, printer);
            run::mesh(&common.options(&stop), &mut |event| show.event(event))?;
            show.finish();
            Ok(())
        }
        Command::Check { common, plot } => {
            let mut show = show::Show::new(common.quiet, printer);
            let mut prepared = run::prepare(&common.options(&stop), &mut |event| show.event(event))?;
            prepared.folder.keep();
            check::print(&show, &prepared);
            if plot {
                let folder = output::write_geometry(
                    &prepared.folder.path().join("check"),
                    &prepared.name,
                    &prepared.problem.model,
                )?;
                show.line(&format!("wrote {}", folder.display()));
            }
            Ok(())
        }
        Command::Law { scene, interface, path, substeps, tolerance, settings } => {
            let integration = match (substeps, tolerance) {
                (Some(n), _) => Some(Integration::BackwardEuler(n.get())),
                (None, tolerance) => tolerance.map(Integration::Tolerance),
            };
            let (law, rows, ended) = run::point::drive(&scene, &settings, &interface, &path, integration)?;
            let mut csv = Vec::new();
            path::write_csv(&law, &rows, &mut csv).map_err(Error::io("write", "standard output"))?;
            print(&String::from_utf8_lossy(&csv))?;
            ended.map_or(Ok(()), Err)
        }
        Command::Study { file, out, jobs, threads, point, shard, collect, count, once, mesher, quiet } => {
            let all_or_shard = shard.map_or(study::Selection::All, study::Selection::Shard);
            let selection = point.map_or(all_or_shard, study::Selection::Point);
            let plan = study::StudyPlan::read(&file, selection)?;
            if count {
                return print(&format!("{}\n", plan.len()));
            }
            let out = out.unwrap_or_else(|| Path::new("results").join(&plan.name));
            let options = mesher.options(&plan.scene, &stop);
            let cores = std::thread::available_parallelism().map_or(1, usize::from);
            let threads = threads.map_or((cores / jobs.get()).max(1), usize::from);
            let means = study::StudyMeans { out, file, options, jobs: jobs.get(), threads };
            let follow = follow::Follow::new(&plan, &means, quiet, printer);
            if collect { follow.collect() } else { follow.run(once.as_deref()) }
        }
        Command::Schema { of, write } => {
            let schema = match of {
                Of::Scene => scene::scene_schema(),
                Of::Study => study::study_schema(),
            };
            let text = format!("{schema:#}\n");
            match write {
                None => print(&text),
                Some(file) => files::write_whole(&file.unwrap_or_else(|| of.file().into()), text.as_bytes()),
            }
        }
        Command::Manual { folder } => {
            std::fs::create_dir_all(&folder).map_err(Error::io("create", &folder))?;
            clap_mangen::generate_to(Arguments::command(), &folder).map_err(Error::io("write", &folder))
        }
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Arguments::command(), "midplane", &mut script);
            print(&String::from_utf8_lossy(&script))
        }
    }
}

/// Writes data to standard output; a reader that has gone away is no error.
fn print(text: &str) -> Result<()> {
    use std::io::Write;
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Error::io("write", "standard output")(error))
        }
        _ => Ok(()),
    }
}

fn set_threads(threads: Option<std::num::NonZeroUsize>) -> Result<()> {
    let Some(threads) = threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new().num_threads(threads.get()).build_global().map_err(|error| {
        Error::Program {
            program: "midplane".into(),
            what: format!("cannot start {threads} threads: {error}"),
            help: "ask for fewer with --threads".into(),
        }
    })
}

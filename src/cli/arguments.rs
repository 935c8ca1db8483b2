//! Arguments of the command line.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::error::Stop;
use crate::run::{Every, Options};
use crate::study::Shard;

/// Finite elements of solids whose parts are meshed separately and joined along interfaces.
#[derive(Debug, Parser)]
#[command(
    name = "midplane",
    version,
    after_help = "\
Examples:
  midplane run geo/compression            mesh, solve and write results/compression
  midplane run geo/compression -o out --set steps.0.load.upper.top.pressure=5
  midplane check geo/cantilever           sizes, edges, segments, warnings
  midplane law geo/shear joint path.json  one point of a law along a path, as CSV
  midplane schema --write                 scene.schema.json, by which editors complete and check scenes

Exit codes: 0 done; 2 bad input; 3 no equilibrium (what converged is on disk); 4 environment (no gmsh, disk full);\n128 + signal after Ctrl-C, SIGTERM or SIGHUP (what converged is on disk; a second one ends at once)."
)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Mesh what is stale, solve, write fields, history and summary
    #[command(after_help = "\
Examples:
  midplane run geo/compression
  midplane run geo/compression/scene.json -o out
  midplane run geo/compression --set subdomains.lower.parameters.n=12 --set interfaces.joint.coupling=pointwise
  midplane run geo/shear_box --resume     go on from the last checkpoint, after a kill, Ctrl-C, a full disk, or with more steps

A key of --set is a path with dots or a JSON pointer; its value is JSON, or else a string.")]
    Run {
        #[command(flatten)]
        common: Common,
        /// Threads to use; all cores if absent
        #[arg(long, value_name = "N", value_parser = |text: &str| at_most(text, 4096))]
        threads: Option<NonZeroUsize>,
        /// Go on from the last checkpoint of the folder; begin if there is none
        #[arg(long)]
        resume: bool,
        /// Keep a checkpoint after so many seconds ("60s") or increments ("10"), and at the ends of steps; or "never"
        #[arg(long, value_name = "EVERY", default_value = "60s", value_parser = every)]
        checkpoint: Every,
    },
    /// Mesh the subdomains of a scene, those whose input changed
    #[command(after_help = "\
Example:
  midplane mesh geo/compression           writes results/compression/mesh/<subdomain>-<hash>.msh")]
    Mesh {
        #[command(flatten)]
        common: Common,
    },
    /// Do everything short of solving: sizes, edges, segments, gaps, stiffness number, warnings
    #[command(after_help = "\
Example:
  midplane check geo/cantilever --set interfaces.joint.law.normal_stiffness=1e9
  midplane check geo/four_blocks --plot   writes results/four_blocks/check/*.vtu

The ratio is that of the numbers of edges, the kink the largest turn between two edges of a side.")]
    Check {
        #[command(flatten)]
        common: Common,
        /// Write chains, projections, segments, grid and normals as VTU; midplane_pipeline.draw.check draws them
        #[arg(long)]
        plot: bool,
    },
    /// Drive one point of an interface's law along a path, CSV on standard output
    #[command(after_help = "\
Examples:
  midplane law geo/shear joint path.json                  error control by the scene's law_tolerance
  midplane law geo/shear joint path.json --tolerance 1e-6
  midplane law geo/shear joint path.json --substeps 10    plain backward Euler

A path prescribes displacement or stress, segment by segment and component by component:
  { \"program\": [ { \"n\": { \"control\": \"stress\", \"start\": 0, \"end\": -5 },
                   \"t\": { \"control\": \"displacement\", \"start\": 0, \"end\": 0 }, \"points\": 2 } ] }")]
    Law {
        /// A scene file, or the folder of a scene.json; no mesh is read
        scene: PathBuf,
        /// Name of the interface whose law is driven
        interface: String,
        /// The path, JSON
        path: PathBuf,
        /// Backward Euler with N steps between two stored points
        #[arg(long, value_name = "N", conflicts_with = "tolerance", value_parser = |text: &str| at_most(text, 1_000_000))]
        substeps: Option<NonZeroUsize>,
        /// Error control, relative to the larger of tensile strength and cohesion
        #[arg(long, value_name = "T", value_parser = tolerance)]
        tolerance: Option<f64>,
        /// Replace a value of the scene
        #[arg(long = "set", value_name = "KEY=VALUE")]
        settings: Vec<String>,
    },
    /// Run a scene at many points of its keys and measure time and error
    #[command(after_help = "\
Examples:
  midplane study geo/strip/study.json               results/strip_study/study.csv; goes on where it was
  midplane study geo/strip/study.json --jobs 4      four points side by side
  midplane study geo/strip/study.json --count       number of points, after a look at the scene of each
  midplane study geo/strip/study.json --shard 0/4   points 0, 4, 8, ..., for one of 4 jobs of a cluster (docs/CLUSTER.md)
  midplane study geo/strip/study.json --collect     study.csv of the points that are there, after the last shard
  midplane study geo/strip/study.json --point 7     that point only, again if it is there

What a study may hold: midplane schema study")]
    Study {
        /// The study, JSON
        file: PathBuf,
        /// Folder of the results; results/<folder>_<file> if absent
        #[arg(short, long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Points side by side
        #[arg(long, value_name = "N", default_value = "1", value_parser = |text: &str| at_most(text, 4096))]
        jobs: NonZeroUsize,
        /// Threads of every point; its share of all cores if absent
        #[arg(long, value_name = "N", value_parser = |text: &str| at_most(text, 4096))]
        threads: Option<NonZeroUsize>,
        /// Run this point only, counted from 0
        #[arg(long, value_name = "K")]
        point: Option<usize>,
        /// Run the points of shard K of N only, K from 0: those whose number leaves the rest K when divided by N
        #[arg(long, value_name = "K/N", allow_hyphen_values = true, conflicts_with = "point")]
        shard: Option<Shard>,
        /// Run nothing: write the table of the points that are there and say how many are missing
        #[arg(long, conflicts_with_all = ["point", "shard"])]
        collect: bool,
        /// Print the number of points and do nothing
        #[arg(long, conflicts_with_all = ["point", "shard", "collect"])]
        count: bool,
        /// Run the point once and write its outcome here
        #[arg(long, value_name = "FILE", requires = "point", hide = true)]
        once: Option<PathBuf>,
        #[command(flatten)]
        mesher: Mesher,
        /// Print errors only
        #[arg(short, long)]
        quiet: bool,
    },
    /// Print or write the JSON Schema of scenes or studies
    #[command(after_help = "\
Examples:
  midplane schema --write                        scene.schema.json, for editors: \"$schema\": \"scene.schema.json\" in the scene
  midplane schema study --write geo/study.schema.json
  midplane schema > geo/scene.schema.json")]
    Schema {
        /// File whose schema is meant
        #[arg(value_enum, default_value_t = Of::Scene)]
        of: Of,
        /// Write it to a file, scene.schema.json or study.schema.json if none is named
        #[arg(long, value_name = "FILE")]
        write: Option<Option<PathBuf>>,
    },
    /// Write the manual pages of all commands into a folder
    #[command(hide = true)]
    Manual {
        /// The folder
        folder: PathBuf,
    },
    /// Print a completion script for a shell
    #[command(after_help = "\
Example:
  midplane completions bash > ~/.local/share/bash-completion/completions/midplane")]
    Completions {
        /// bash, elvish, fish, powershell or zsh
        shell: clap_complete::Shell,
    },
}

impl Command {
    /// True for what meshes or solves, and ends in order where it is asked to.
    pub(super) fn is_long(&self) -> bool {
        matches!(
            self,
            Command::Run { .. } | Command::Mesh { .. } | Command::Check { .. } | Command::Study { .. }
        )
    }
}

/// Files that have a schema.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum Of {
    Scene,
    Study,
}

impl Of {
    /// The file that a schema is written to where none is named.
    pub(super) fn file(self) -> &'static str {
        match self {
            Of::Scene => "scene.schema.json",
            Of::Study => "study.schema.json",
        }
    }
}

fn at_most(text: &str, most: usize) -> Result<NonZeroUsize, String> {
    match text.parse::<NonZeroUsize>() {
        Ok(value) if value.get() <= most => Ok(value),
        _ => Err(format!("a number from 1 to {most}")),
    }
}

fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value < 1.0 => Ok(value),
        _ => Err("it lies between 0 and 1, such as 1e-6".into()),
    }
}

fn every(text: &str) -> Result<Every, String> {
    let seconds = text.strip_suffix('s').and_then(|number| number.trim().parse::<f64>().ok());
    match (text, seconds, text.parse::<usize>()) {
        ("never", _, _) => Ok(Every::Never),
        (_, Some(seconds), _) if seconds >= 0.0 && seconds.is_finite() => Ok(Every::Seconds(seconds)),
        (_, _, Ok(increments)) if increments > 0 => Ok(Every::Increments(increments)),
        _ => Err("seconds such as 60s, a number of increments such as 10, or never".into()),
    }
}

/// Arguments of the mesher.
#[derive(Debug, Args)]
pub(super) struct Mesher {
    /// The mesher
    #[arg(long, value_name = "PROGRAM", default_value = "gmsh")]
    pub gmsh: PathBuf,
    /// Seconds that one run of the mesher may take
    #[arg(long, value_name = "SECONDS", default_value_t = 600)]
    pub gmsh_limit: u64,
    /// Gigabytes that one run of the mesher may take; three quarters of all memory if absent
    #[arg(long, value_name = "GB", value_parser = gigabytes)]
    pub gmsh_memory: Option<u64>,
    /// A folder that geometries may read, beside that of the scene
    #[arg(long = "geo-path", value_name = "DIR")]
    pub geo_paths: Vec<PathBuf>,
    /// Let geometries do what you may: start programs, read and write anywhere
    #[arg(long)]
    pub trust_geo: bool,
}

impl Mesher {
    /// These options.
    pub(super) fn options(&self, scene: &Path, stop: &Stop) -> Options {
        Options {
            gmsh: self.gmsh.clone(),
            gmsh_limit: Duration::from_secs(self.gmsh_limit),
            gmsh_memory: self.gmsh_memory,
            geo_paths: self.geo_paths.clone(),
            trust_geo: self.trust_geo,
            stop: stop.clone(),
            ..Options::of(scene)
        }
    }
}

fn gigabytes(text: &str) -> Result<u64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value < 1e6 => Ok((value * f64::from(1 << 30)) as u64),
        _ => Err("a number of gigabytes, such as 4".into()),
    }
}

/// Arguments of all commands on a scene.
#[derive(Debug, Args)]
pub(super) struct Common {
    /// A scene file, or the folder of a scene.json
    pub scene: PathBuf,
    /// Folder of the results; results/<scene> if absent
    #[arg(short, long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace a value of the scene
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub settings: Vec<String>,
    /// Preset of refinement, order, tolerances and increments
    #[arg(long, value_name = "PRESET", value_parser = ["draft", "normal", "fine"])]
    pub accuracy: Option<String>,
    #[command(flatten)]
    pub mesher: Mesher,
    /// Print errors only
    #[arg(short, long)]
    pub quiet: bool,
}

impl Common {
    pub(super) fn options(&self, stop: &Stop) -> Options {
        let accuracy = self.accuracy.iter().map(|preset| format!("accuracy={preset}"));
        Options {
            out: self.out.clone(),
            settings: accuracy.chain(self.settings.iter().cloned()).collect(),
            ..self.mesher.options(&self.scene, stop)
        }
    }
}

//! A study that is ready to be run: its points, validated, and the runs of its reference.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::design::{DesignPoints, StudyPoint, setting};
use super::file::{Field, Measure, Process, Study};
use super::gauge::column_of;
use super::selection::Selection;
use crate::error::{Result, name_help};
use crate::mesh;
use crate::run::{Shared, read_scene};
use crate::scene::probe::Probe;
use crate::scene::{Scene, Source, document, text_of};

/// A study with its points.
#[derive(Debug)]
pub struct StudyPlan {
    /// The file of the study.
    pub study: Study,
    /// Its name: that of its folder and file.
    pub name: String,
    /// The scene.
    pub scene: PathBuf,
    /// Points that are checked and run.
    pub selection: Selection,
    /// Points of the design, before those of the reference.
    design: DesignPoints,
    /// Settings of all points for what is measured.
    probes: Vec<String>,
    /// Digests of all that files decide of the selected points; none where more than files decides.
    keys: HashMap<usize, u64>,
    /// True if the mesher has a part in it.
    meshed: bool,
}

/// Most runs of every point.
const MOST_REPEATS: usize = 10_000;

impl StudyPlan {
    /// Reads a study and checks the scene of every selected point; nothing is meshed.
    pub fn read(file: &Path, selection: Selection) -> Result<StudyPlan> {
        StudyPlan::parse(file, text_of(file, "give the file of a study")?, selection)
    }

    /// The same for the text of a study; `file` is for messages and for the scene it names.
    pub fn parse(file: &Path, text: String, selection: Selection) -> Result<StudyPlan> {
        let (study, source) = document::<Study>(file.into(), text, "a study", |_, _| Ok(()))?;
        let scene = source.folder().join(&study.scene);
        if !scene.exists() {
            let help = format!("files are named relative to {}", source.folder().display());
            return Err(source.error_at(&["scene"], format!("there is no {}", scene.display()), help));
        }
        if study.repeat == 0 {
            return Err(source.error_at(&["repeat"], "0 runs of every point", "run it once or more"));
        }
        if study.repeat > MOST_REPEATS {
            let what = format!("{} runs of every point", study.repeat);
            return Err(source.error_at(&["repeat"], what, format!("{MOST_REPEATS} are enough")));
        }
        let design = DesignPoints::new(&study, &source)?;
        let ratio = study.reference.as_ref().map(|reference| reference.ratio);
        if let Some(ratio) = ratio.filter(|ratio| !(*ratio > 1.0 && ratio.is_finite())) {
            let what = format!("a ratio of {ratio}");
            return Err(source.error_at(&["reference", "ratio"], what, "every run is finer than the last"));
        }
        let plain = read_scene(&scene, &[])?;
        check_measures(&study, &source, &plain)?;
        let probes = probes(&study, &plain);
        let mut meshed = false;
        for part in plain.subdomains.values() {
            let old = |msh: &String| mesh::is_earlier_format(&plain.source.folder().join(msh));
            meshed |= part.geo.is_some() || part.msh.as_ref().is_some_and(|msh| old(msh).unwrap_or(false));
        }
        let keys = HashMap::new();
        let mut plan = StudyPlan { name: name(file), study, scene, selection, design, probes, keys, meshed };
        for k in plan.selected() {
            let point = plan.point(k);
            let scene = read_scene(&plan.scene, &point.settings)?;
            plan.keys.extend(key(&plan.study, &point, &scene).map(|key| (k, key)));
        }
        Ok(plan)
    }

    /// Number of all points, those of the reference included.
    pub fn len(&self) -> usize {
        let references = self.study.reference.as_ref().map_or(0, |reference| reference.runs.len());
        self.designed() + references
    }

    /// True without points.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of points in the design; those of the reference follow them.
    pub(super) fn designed(&self) -> usize {
        self.design.count
    }

    /// Numbers of the selected points.
    pub(super) fn selected(&self) -> impl Iterator<Item = usize> + use<> {
        self.selection.of(self.len())
    }

    /// A point of the design or of the reference.
    pub(super) fn point(&self, point: usize) -> StudyPoint {
        let study = &self.study;
        let run = point.checked_sub(self.designed()).zip(study.reference.as_ref());
        let mut point = match run {
            None => self.design.point(study, point),
            Some((run, reference)) => {
                let mut settings = vec!["/output/fields=none".to_string()];
                settings.extend(study.set.iter().chain(&reference.runs[run]).map(setting));
                StudyPoint { values: vec![serde_json::Value::Null; study.axes.len()], settings }
            }
        };
        point.settings.extend_from_slice(&self.probes);
        point
    }

    /// Digest of all that decides a point that was checked, the mesher's version among it; none where more decides, so
    /// that an outcome is good once.
    pub(super) fn key(&self, shared: &Shared, point: usize) -> Result<Option<String>> {
        let Some(key) = self.keys.get(&point) else { return Ok(None) };
        Ok(Some(match self.meshed {
            true => format!("{key:016x} gmsh {}", shared.mesher()?),
            false => format!("{key:016x}"),
        }))
    }
}

/// Columns of the history for the probes of the measures.
fn probes(study: &Study, scene: &Scene) -> Vec<String> {
    let mut settings = Vec::new();
    for (name, measure) in &study.measures {
        for of in measure.columns() {
            if !scene.output.history.contains_key(of) && !of.starts_with("reaction:") {
                let column = column_of(name, of).replace('~', "~0").replace('/', "~1");
                settings.push(format!("/output/history/{column}={of}"));
            }
        }
    }
    settings
}

fn check_measures(study: &Study, source: &Source, scene: &Scene) -> Result<()> {
    for (name, measure) in &study.measures {
        for of in measure.columns() {
            if scene.output.history.contains_key(of) || of.starts_with("reaction:") {
                continue;
            }
            if name.contains('=') || of.contains('=') {
                let what = format!("\"=\" in the measure \"{name}\" of \"{of}\"");
                let help =
                    "give it a column of the scene's \"output.history\" without \"=\" and measure that";
                return Err(source.error_at(&["measures", name, "of"], what, help));
            }
            Probe::parse(of, scene)
                .map_err(|(what, help)| source.error_at(&["measures", name, "of"], what, help))?;
        }
        if let Measure::Error { field, of, .. } = measure {
            let known = match field {
                Field::Displacement => scene.subdomains.contains_key(of),
                _ => scene.entry(of).is_some(),
            };
            if !known {
                let names = match field {
                    Field::Displacement => scene.subdomains.keys().map(String::as_str).collect::<Vec<_>>(),
                    _ => scene.interfaces.keys().map(String::as_str).collect(),
                };
                let help = name_help(of, names);
                return Err(source.error_at(&["measures", name, "of"], format!("no \"{of}\""), help));
            }
        }
    }
    Ok(())
}

/// Settings, measures, the program's version, the scene's text and those of the files it names, with all they include.
fn key(study: &Study, point: &StudyPoint, scene: &Scene) -> Option<u64> {
    let mut hash = Sha256::new();
    let mut add = |part: &[u8]| {
        hash.update((part.len() as u64).to_le_bytes()); // so that parts cannot run into each other
        hash.update(part);
    };
    add(env!("CARGO_PKG_VERSION").as_bytes());
    add(if study.process == Process::Own { b"own" } else { b"shared" });
    add(&study.repeat.to_le_bytes());
    add(serde_json::to_string(&study.measures).unwrap_or_default().as_bytes());
    add(serde_json::to_string(scene).unwrap_or_default().as_bytes());
    point.settings.iter().for_each(|setting| add(setting.as_bytes()));
    for part in scene.subdomains.values() {
        for file in part.geo.iter().chain(&part.msh) {
            // a file that cannot be read is refused by the run
            let digest = mesh::digest(&scene.source.folder().join(file)).unwrap_or(Some(String::new()));
            add(digest?.as_bytes());
        }
    }
    Some(hash.finalize().iter().take(8).fold(0, |key, byte| key << 8 | u64::from(*byte)))
}

/// `geo/strip/study.json` is "strip_study".
fn name(file: &Path) -> String {
    let stem = file.file_stem().map_or("study".into(), |stem| stem.to_string_lossy().into_owned());
    let folder = std::path::absolute(file).ok();
    let folder = folder.as_deref().and_then(Path::parent).and_then(Path::file_name);
    folder.map_or(stem.clone(), |folder| format!("{}_{stem}", folder.to_string_lossy()))
}

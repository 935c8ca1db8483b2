//! The results folder of one run.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::growing::{Growing, TextLength, beginning};
use super::manifest::{MANIFEST, Manifest};
use super::{RowData, Snapshot, fields, files, pvd};
use crate::assembly::Model;
use crate::error::{Error, Result};
use crate::files::write_whole;
use crate::law::LawVariable;
use crate::problem::Problem;

const HISTORY: &str = "history.csv";
const SUMMARY: &str = "summary.json";

/// Writes one run's results as they come.
#[derive(Debug)]
pub struct Writer {
    folder: PathBuf,
    name: String,
    manifest: Manifest,
    /// None before the first row, and before the first fields.
    history: Option<Growing>,
    collection: Option<Growing>,
    /// The first line of the history.
    head: String,
}

/// TextLengths that the growing files had at some row.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct TextLengths {
    manifest: TextLength,
    history: Option<TextLength>,
    collection: Option<TextLength>,
}

impl TextLengths {
    /// Without the fields that came after others.
    pub fn without_fields_since(self, before: &TextLengths) -> TextLengths {
        TextLengths { history: self.history, ..*before }
    }
}

/// Names of the files that a run writes once.
pub fn files_once(name: &str, model: &Model) -> Vec<String> {
    let mut names = vec![HISTORY.into(), SUMMARY.into(), collection(name)];
    names.extend(model.interfaces.iter().map(|interface| format!("midplane/{}.vtu", interface.name)));
    names
}

/// Name of the collection of fields.
pub fn collection(name: &str) -> String {
    format!("{name}.pvd")
}

/// A row of history.csv.
#[derive(Debug, Clone, Default)]
pub struct HistoryRow {
    /// Name of the step.
    pub step: String,
    /// Number of the increment over all steps, from 1.
    pub increment: usize,
    /// Load factor in the step, 0 to 1.
    pub load_factor: f64,
    /// Newton iterations; 0 where none was needed.
    pub iterations: usize,
    /// Out-of-balance force that is left, relative.
    pub residual: f64,
    /// work − stored − dissipated energy over the largest of them so far.
    pub energy_balance: f64,
    /// Probes, then reactions.
    pub values: Vec<f64>,
}

impl Writer {
    /// Begins the results of a run named `name` in a folder that holds none. `columns` are the names of probes and reactions.
    pub fn create(folder: &Path, name: &str, columns: &[String]) -> Result<Writer> {
        std::fs::create_dir_all(folder).map_err(Error::io("create", folder))?;
        let manifest = Manifest::create(folder, name)?;
        let (history, collection, head) = (None, None, head(columns));
        Ok(Writer { folder: folder.into(), name: name.into(), manifest, history, collection, head })
    }

    /// True if the files of a folder begin as they were at these lengths.
    pub fn is_continued(folder: &Path, name: &str, lengths: &TextLengths) -> Result<bool> {
        let texts = [
            (folder.join(MANIFEST), Some(lengths.manifest)),
            (folder.join(HISTORY), lengths.history),
            (folder.join(collection(name)), lengths.collection),
        ];
        for (path, length) in texts {
            if let Some(length) = length
                && beginning(&path, length)?.is_none()
            {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Goes back to lengths that the files have had; what was written later is removed.
    pub fn reopen(folder: &Path, name: &str, columns: &[String], lengths: &TextLengths) -> Result<Writer> {
        let at = |file: &str, length: Option<TextLength>, end| {
            let path = folder.join(file);
            length.map(|length| Growing::reopen(&path, length, end)).transpose()
        };
        let history = at(HISTORY, lengths.history, "")?;
        let listed = collection(name);
        let collection = at(&listed, lengths.collection, pvd::END)?;
        if collection.is_none() {
            let _ = std::fs::remove_file(folder.join(listed)); // it may not be there
        }
        let manifest = Manifest::reopen(folder, lengths.manifest)?;
        let (folder, name, head) = (folder.into(), name.into(), head(columns));
        Ok(Writer { folder, name, manifest, history, collection, head })
    }

    /// TextLengths of the growing files so far.
    pub fn lengths(&self) -> TextLengths {
        TextLengths {
            manifest: self.manifest.length(),
            history: self.history.as_ref().map(Growing::length),
            collection: self.collection.as_ref().map(Growing::length),
        }
    }

    /// Lists files that are about to be written.
    pub fn list<'n>(&mut self, files: impl IntoIterator<Item = &'n str>) -> Result<()> {
        self.manifest.add(files)
    }

    /// Writes the geometry of every interface once; all that is written once is listed.
    pub fn midplanes(&mut self, model: &Model) -> Result<()> {
        let names = files_once(&self.name, model);
        self.list(names.iter().map(String::as_str))?;
        for interface in &model.interfaces {
            let path = self.folder.join("midplane").join(format!("{}.vtu", interface.name));
            write_whole(&path, &fields::midplane(interface).encode())?;
        }
        Ok(())
    }

    /// Writes the fields of one state and lists them in the collection.
    pub fn fields(&mut self, problem: &Problem, snapshot: &Snapshot, row: &RowData) -> Result<()> {
        let number = row.row;
        let Problem { model, interfaces, .. } = problem;
        let names = model
            .subdomains
            .iter()
            .map(|subdomain| &subdomain.name)
            .chain(model.interfaces.iter().map(|interface| &interface.name));
        let entries: Vec<(usize, String, String)> =
            names.map(|name| (number, name.clone(), file_name(name, number))).collect();
        self.list(entries.iter().map(|(_, _, file)| file.as_str()))?;
        let subdomains = model.subdomains.len();
        let variables: Vec<&LawVariable> = problem.variables().collect();
        entries.par_iter().enumerate().try_for_each(|(i, (_, _, file))| {
            let grid = if i < subdomains {
                fields::subdomain(model, i, snapshot, row)
            } else {
                let k = i - subdomains;
                let water = problem.water_in(k);
                let laws = &interfaces[k].laws;
                fields::interface(&model.interfaces[k], (laws, &variables), water, k, snapshot, row)
            };
            write_whole(&self.folder.join(file), &grid.encode())
        })?;
        let text = pvd::entries(&entries);
        match &mut self.collection {
            Some(collection) => collection.add(&text)?,
            None => {
                let path = self.folder.join(collection(&self.name));
                self.collection = Some(Growing::create(&path, &format!("{}{text}", pvd::HEAD), pvd::END)?);
            }
        }
        Ok(())
    }

    /// Adds a row to the history.
    pub fn row(&mut self, row: &HistoryRow) -> Result<()> {
        let HistoryRow { step, increment, load_factor, iterations, residual, energy_balance, values } = row;
        let step = files::csv_field(step);
        let mut text = format!("{step},{increment},{load_factor},{iterations},{residual:e}");
        for value in values {
            let _ = write!(text, ",{value:e}");
        }
        let _ = writeln!(text, ",{energy_balance:e}");
        match &mut self.history {
            Some(history) => history.add(&text)?,
            None => {
                let path = self.folder.join(HISTORY);
                self.history = Some(Growing::create(&path, &format!("{}{text}", self.head), "")?);
            }
        }
        Ok(())
    }

    /// Goes on in another folder, into which all that is written so far is moved by `moving`.
    pub fn move_to(&mut self, folder: &Path, moving: impl FnOnce() -> Result<()>) -> Result<()> {
        self.history.iter_mut().chain(&mut self.collection).for_each(|text| text.moves_to(folder));
        moving()?;
        self.manifest.moved_to(folder);
        self.folder = folder.into();
        Ok(())
    }

    /// Writes summary.json.
    pub fn summary(&self, summary: &impl Serialize) -> Result<()> {
        files::write_json(&self.folder.join(SUMMARY), summary)
    }
}

/// The first line of the history.
fn head(columns: &[String]) -> String {
    let mut head = String::from("step,increment,load_factor,iterations,residual");
    for column in columns {
        let _ = write!(head, ",{}", files::csv_field(column));
    }
    head.push_str(",energy_balance\n");
    head
}

fn file_name(name: &str, number: usize) -> String {
    format!("fields/{name}_{number:04}.vtu")
}

//! The results folder of one run.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde::Serialize;

use super::{RowData, Snapshot, earlier, fields, files, pvd};
use crate::assembly::Model;
use crate::error::{Error, Result};
use crate::law::LawVariable;
use crate::problem::Problem;

/// Writes one run's results as they come.
#[derive(Debug)]
pub struct Writer {
    folder: PathBuf,
    name: String,
    collection: Vec<(usize, String, String)>,
    history: String,
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
    /// Opens a folder for a run named `name`; results of earlier runs there are removed, whatever their names. `columns` are the names of
    /// probes and reactions.
    pub fn create(folder: &Path, name: &str, columns: &[String]) -> Result<Writer> {
        earlier::remove_results(folder)?;
        std::fs::create_dir_all(folder).map_err(Error::io("create", folder))?;
        let mut history = String::from("step,increment,load_factor,iterations,residual");
        for column in columns {
            let _ = write!(history, ",{}", files::csv_field(column));
        }
        history.push_str(",energy_balance\n");
        Ok(Writer { folder: folder.into(), name: name.into(), collection: Vec::new(), history })
    }

    /// Writes the geometry of every interface once.
    pub fn midplanes(&self, model: &Model) -> Result<()> {
        for interface in &model.interfaces {
            let path = self.folder.join("midplane").join(format!("{}.vtu", interface.name));
            files::write_whole(&path, &fields::midplane(interface).encode())?;
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
        let names: Vec<&String> = names.collect();
        let subdomains = model.subdomains.len();
        let variables: Vec<&LawVariable> = problem.variables().collect();
        names.par_iter().enumerate().try_for_each(|(i, name)| {
            let grid = if i < subdomains {
                fields::subdomain(model, i, snapshot, row)
            } else {
                let k = i - subdomains;
                let water = problem.water_in(k);
                let laws = &interfaces[k].laws;
                fields::interface(&model.interfaces[k], (laws, &variables), water, k, snapshot, row)
            };
            files::write_whole(&self.folder.join(file_name(name, number)), &grid.encode())
        })?;
        for name in names {
            self.collection.push((number, name.clone(), file_name(name, number)));
        }
        let text = pvd::collection(&self.collection);
        files::write_whole(&self.folder.join(format!("{}.pvd", self.name)), text.as_bytes())
    }

    /// Adds a row to the history.
    pub fn row(&mut self, row: &HistoryRow) -> Result<()> {
        let HistoryRow { step, increment, load_factor, iterations, residual, energy_balance, values } = row;
        let _ = write!(
            self.history,
            "{},{increment},{load_factor},{iterations},{residual:e}",
            files::csv_field(step)
        );
        for value in values {
            let _ = write!(self.history, ",{value:e}");
        }
        let _ = writeln!(self.history, ",{energy_balance:e}");
        files::write_whole(&self.folder.join("history.csv"), self.history.as_bytes())
    }

    /// Writes summary.json.
    pub fn summary(&self, summary: &impl Serialize) -> Result<()> {
        files::write_json(&self.folder.join("summary.json"), summary)
    }
}

fn file_name(name: &str, number: usize) -> String {
    format!("fields/{name}_{number:04}.vtu")
}

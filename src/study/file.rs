//! The study: what its file says, as types that reject unknown keys.

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::scene::{self, OneOrMany, schema_of};
use crate::shape::Ends;

/// Settings on top of a scene: keys as of `--set`, and what they are set to.
pub type Settings = IndexMap<String, Value>;

/// A parametric study: a scene, what varies, what is measured, and against what.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Study {
    /// The JSON Schema of this file, so that editors complete and check it.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// One line for people.
    #[serde(default)]
    pub title: String,
    /// The scene file or its folder, relative to this file.
    #[serde(default = "beside")]
    pub scene: String,
    /// Settings of all points. Fields are written only where `output.fields` is set here or by an axis.
    #[serde(default)]
    pub set: Settings,
    /// Axes by name.
    #[serde(default)]
    pub axes: IndexMap<String, Axis>,
    /// Which points of the axes are run.
    #[serde(default)]
    pub design: Design,
    /// Measures besides sizes, counts, time and memory, by name.
    #[serde(default)]
    pub measures: IndexMap<String, Measure>,
    /// Runs that stand for the exact answer of the measures that have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<Reference>,
    /// Number of runs of every point, for its time.
    #[serde(default = "once")]
    pub repeat: usize,
    /// Process in which points are run.
    #[serde(default)]
    pub process: Process,
}

/// One thing that varies: a key or `.geo` parameter with values, or settings of several keys at a time.
#[derive(Debug, Clone, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// Key or keys of the scene, paths with dots or JSON pointers; several get the same value. Without `key` and
    /// `parameter` every value is an object of settings.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub key: Option<OneOrMany>,
    /// `.geo` parameter or parameters, `<subdomain>.<name>`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parameter: Option<OneOrMany>,
    /// The values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub values: Option<Vec<Value>>,
    /// First and last of `count` values in equal steps.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<Ends>,
    /// First and last of `count` values in equal ratios; both positive.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub log_range: Option<Ends>,
    /// Number of values of a range; a Latin hypercube takes its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<usize>,
    /// Values of a range are rounded to whole numbers.
    #[serde(default)]
    pub whole: bool,
}

/// Which points of the axes are run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Design {
    /// Every combination, the last axis fastest.
    #[default]
    Grid,
    /// The scene as it is, then one axis after the other with the rest as it is.
    OneAtATime,
    /// Every axis in as many strata as points, each taken once, in an order that the seed decides.
    LatinHypercube {
        /// Number of points.
        points: usize,
        /// Any number; the same gives the same points.
        seed: u64,
    },
}

/// Kinds of measures.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(tag = "take", rename_all = "snake_case", deny_unknown_fields)]
pub enum Measure {
    /// A column of the history at the end.
    Last {
        /// A probe, a column of the scene's `output.history`, or a reaction `reaction:<group>:x`.
        of: String,
        /// Its exact value.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        reference: Option<f64>,
    },
    /// A column of the history where its magnitude is largest.
    Peak {
        /// As for `last`.
        of: String,
        /// Its exact value.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        reference: Option<f64>,
    },
    /// A column of the history where the magnitude of another is largest: at the vertex of the parabola through its row and those beside.
    AtPeak {
        /// As for `last`.
        of: String,
        /// The column that has the peak.
        peak_of: String,
        /// Its exact value.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        reference: Option<f64>,
    },
    /// Load factor at the end of the run, where it has a limit: a point that ends without equilibrium has reached it and is none that
    /// failed.
    Reached {
        /// Its exact value.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        reference: Option<f64>,
    },
    /// ‖field − exact‖ / ‖exact‖ in L2 at the end.
    Error {
        /// The field.
        field: Field,
        /// The interface of `traction` and `jump`, the subdomain of `displacement`.
        of: String,
        /// The exact field: (n, t) or (x, y), numbers or formulas in x, y and, on an interface, s.
        exact: [scene::Value; 2],
    },
}

/// A field that has an exact one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Field {
    /// Tractions at the law points.
    Traction,
    /// Jumps at the law points.
    Jump,
    /// Displacements of a body.
    Displacement,
}

/// Runs that stand for the exact answer: the last, extrapolated by Richardson if there are three or more.
#[derive(Debug, Clone, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// Settings of every run, from coarse to fine.
    pub runs: Vec<Settings>,
    /// Factor by which each is finer than the one before.
    #[serde(default = "two")]
    pub ratio: f64,
}

/// Process in which points are run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Process {
    /// In one process, where points use what others have left; each has the time that it took beside them.
    #[default]
    Shared,
    /// Each in a process of its own, for times and memory as of a run of its own; meshes are still shared.
    Own,
}

impl Measure {
    /// The columns of the history that it looks at.
    pub(super) fn columns(&self) -> Vec<&str> {
        match self {
            Measure::Last { of, .. } | Measure::Peak { of, .. } => vec![of],
            Measure::AtPeak { of, peak_of, .. } => vec![of, peak_of],
            Measure::Reached { .. } | Measure::Error { .. } => Vec::new(),
        }
    }

    /// Its exact value, if the file says it.
    pub(super) fn reference(&self) -> Option<f64> {
        match self {
            Measure::Last { reference, .. }
            | Measure::Peak { reference, .. }
            | Measure::AtPeak { reference, .. }
            | Measure::Reached { reference } => *reference,
            Measure::Error { .. } => None,
        }
    }
}

/// The schema of a study file.
pub fn study_schema() -> Value {
    schema_of::<Study>()
}

fn beside() -> String {
    "scene.json".into()
}

fn once() -> usize {
    1
}

fn two() -> f64 {
    2.0
}

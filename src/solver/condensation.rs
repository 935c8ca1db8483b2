//! All bodies condensed under one set of supports.

use std::sync::Arc;

use faer::Mat;

use super::CondensedSubdomain;

/// The interiors' factors under one set of supports.
#[derive(Debug)]
pub struct Condensation {
    pub(super) constrained: Vec<bool>,
    pub(super) subdomains: Vec<Arc<CondensedSubdomain>>,
    /// S of every body in its own axes, its lower triangle.
    pub(super) schurs: Vec<Arc<Mat<f64>>>,
}

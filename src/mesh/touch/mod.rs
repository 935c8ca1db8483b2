//! Contacts of bodies: pairs of boundary edges that lie on each other, gathered into connected lines.
//!
//! ```text
//!   b   ●──────●────────●──●        two edges touch if they run against each other, share some length, and are as
//!   a   ●───●──────●───────●        close there as their sizes and the curvature of the boundary explain
//! ```
//!
//! All lengths are relative to the edges concerned. An R-tree finds the neighbours: O(n log n) for n boundary edges.

mod gather;
mod line;

use rayon::prelude::*;
use rstar::{AABB, Envelope, RTree, RTreeObject};

use super::{Facet, Mesh};
use crate::error::Result;
pub use gather::Touch;
use gather::gather;
use line::{BoundaryLine, SharedLength, lines};

/// The lines along which bodies touch. `wanted` is asked with two bodies and an edge of each whether the first is to
/// be side A and the second side B. By pair of bodies; several lines of one pair by their corner with smallest x and y.
pub fn touching(
    meshes: &[&Mesh],
    wanted: &(dyn Fn([usize; 2], [&Facet; 2]) -> bool + Sync),
) -> Result<Vec<Touch>> {
    let different = |pair: [usize; 2], edges: [&Facet; 2]| pair[0] != pair[1] && wanted(pair, edges);
    let lines = within_reach(all_lines(meshes)?);
    let shared = shared(&lines, &|[a, b]| {
        different([lines[a].subdomain, lines[b].subdomain], [&lines[a].edge, &lines[b].edge])
    });
    Ok(gather(&lines, &shared))
}

/// The lines along which boundaries lie on each other, those of one body among them, wherever `wanted` says so of two
/// bodies, the first no later than the second, and an edge of each.
pub fn coinciding(
    meshes: &[&Mesh],
    wanted: &(dyn Fn([usize; 2], [&Facet; 2]) -> bool + Sync),
) -> Result<Vec<Touch>> {
    let lines = all_lines(meshes)?.concat(); // by body, so that the first of two is of the first body
    let shared = shared(&lines, &|[a, b]| {
        a < b && wanted([lines[a].subdomain, lines[b].subdomain], [&lines[a].edge, &lines[b].edge])
    });
    Ok(gather(&lines, &shared))
}

/// The boundaries of all bodies.
fn all_lines(meshes: &[&Mesh]) -> Result<Vec<Vec<BoundaryLine>>> {
    let lines: Vec<Result<Vec<BoundaryLine>>> =
        meshes.par_iter().enumerate().map(|(b, mesh)| lines(b, mesh)).collect();
    lines.into_iter().collect()
}

/// The lengths that pairs of lines share; `wanted` is asked with the numbers of both.
fn shared(lines: &[BoundaryLine], wanted: &(dyn Fn([usize; 2]) -> bool + Sync)) -> Vec<SharedLength> {
    let numbered = lines.iter().enumerate().map(|(i, line)| Numbered(i, line.surroundings()));
    let tree = RTree::bulk_load(numbered.collect());
    let of_line = |a: usize| {
        let near = tree.locate_in_envelope_intersecting(lines[a].surroundings()).map(|found| found.0);
        near.filter(|&b| b != a && wanted([a, b]))
            .filter_map(|b| lines[a].share(&lines[b]).map(|part| SharedLength { lines: [a, b], part }))
            .collect::<Vec<_>>()
    };
    (0..lines.len()).into_par_iter().flat_map_iter(of_line).collect()
}

/// A line with its number, as the tree keeps it.
struct Numbered(usize, AABB<[f64; 2]>);

impl RTreeObject for Numbered {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> AABB<[f64; 2]> {
        self.1
    }
}

/// The lines of all bodies that reach into the box around another body.
fn within_reach(subdomains: Vec<Vec<BoundaryLine>>) -> Vec<BoundaryLine> {
    let around = |lines: &Vec<BoundaryLine>| {
        let boxes = lines.iter().map(BoundaryLine::surroundings);
        boxes.fold(AABB::new_empty(), |all: AABB<[f64; 2]>, one| all.merged(&one))
    };
    let boxes: Vec<AABB<[f64; 2]>> = subdomains.iter().map(around).collect();
    let mut near = subdomains.concat();
    near.retain(|line| {
        let own = line.surroundings();
        (0..boxes.len()).any(|subdomain| subdomain != line.subdomain && boxes[subdomain].intersects(&own))
    });
    near
}

//! `between`: an interface of every pair of subdomains that touch and whose names fit the two patterns.
//!
//! Its name is `<entry>~<A>~<B>`; where a pair touches along several lines they are `…~1`, `…~2`, in the order of the
//! corners with smallest x, then y. A fits the first pattern and B the second; where both fit both, A comes first in
//! the scene, and which of them is side A follows from the geometry (`orient`).

use std::collections::HashMap;

use wildmatch::WildMatch;

use super::curve::{Curve, PlannedInterface};
use super::orient::{Pair, turned};
use crate::assembly::Model;
use crate::error::Result;
use crate::mesh::{Facet, Mesh, Touch, touching};
use crate::scene::{Interface, JOINED, Scene};
use crate::shape::vector::{cross, minus, plus};

/// An interface and the side of it.
type InterfaceSide = (usize, usize);

/// Edges that interfaces with named sides join already: of every edge (body, ends) the interfaces, and the side it is on.
#[derive(Default)]
pub(super) struct JoinedEdges {
    edges: HashMap<(usize, [usize; 2]), Vec<InterfaceSide>>,
    interfaces: usize,
}

impl JoinedEdges {
    /// Takes the sides of one interface.
    pub(super) fn add(&mut self, sides: &[Vec<Curve>; 2]) {
        for (side, curves) in sides.iter().enumerate() {
            for (curve, edge) in
                curves.iter().flat_map(|curve| curve.edges.iter().map(move |edge| (curve, edge)))
            {
                self.edges.entry((curve.subdomain, ends(edge))).or_default().push((self.interfaces, side));
            }
        }
        self.interfaces += 1;
    }

    /// True if one interface has both edges, on different sides.
    pub(super) fn both(&self, subdomains: [usize; 2], edges: [&Facet; 2]) -> bool {
        let of = |i: usize| self.edges.get(&(subdomains[i], ends(edges[i]))).map_or(&[][..], Vec::as_slice);
        of(0).iter().any(|one| of(1).iter().any(|two| one.0 == two.0 && one.1 != two.1))
    }
}

/// The interfaces of one entry of the scene.
pub(super) fn pairs<'a>(
    scene: &'a Scene,
    model: &Model,
    (entry, stated): (&'a str, &'a Interface),
    patterns: &[String; 2],
    taken: &JoinedEdges,
) -> Result<Vec<PlannedInterface<'a>>> {
    let fits: Vec<[bool; 2]> = scene.subdomains.keys().map(|name| fit(patterns, name)).collect();
    let subdomains: Vec<usize> = (0..fits.len()).filter(|&subdomain| fits[subdomain] != [false; 2]).collect();
    let meshes: Vec<&Mesh> = subdomains.iter().map(|&subdomain| &model.subdomains[subdomain].mesh).collect();
    let is_pair = |[a, b]: [usize; 2]| fits[a][0] && fits[b][1] && (a < b || !(fits[b][0] && fits[a][1]));
    let wanted = |pair: [usize; 2], edges: [&Facet; 2]| {
        let pair = pair.map(|i| subdomains[i]);
        is_pair(pair) && !taken.both(pair, edges)
    };
    let touches = touching(&meshes, &wanted)?;
    if touches.is_empty() {
        let what = format!("no subdomain like \"{}\" touches another like \"{}\"", patterns[0], patterns[1]);
        let help = "boundaries touch where they lie on each other, up to a thousandth of an edge";
        return Err(scene.source.error_at(&["interfaces", entry, "between"], what, help));
    }
    let pair_of = |touch: &Touch| touch.subdomains.map(|subdomain| subdomains[subdomain]);
    let is_open = |touch: &&Touch| pair_of(touch).iter().all(|&subdomain| fits[subdomain] == [true; 2]);
    let open: Vec<Pair> = touches
        .iter()
        .filter(is_open)
        .map(|touch| {
            let mesh = meshes[touch.subdomains[0]];
            Pair { bodies: pair_of(touch), outward: outward(mesh, touch), ends: free_ends(mesh, touch) }
        })
        .collect();
    let mut turns = turned(&open, &|subdomain| centre(&model.subdomains[subdomain].mesh)).into_iter();
    let mut plans = Vec::new();
    for lines in touches.chunk_by(|one, two| one.subdomains == two.subdomains) {
        for (i, touch) in lines.iter().enumerate() {
            let pair = pair_of(touch);
            let [a, b] = pair.map(|subdomain| model.subdomains[subdomain].name.as_str());
            let mut name = [entry, a, b].join(&JOINED.to_string());
            if lines.len() > 1 {
                name.push_str(&format!("{JOINED}{}", i + 1));
            }
            let side = |i: usize, own: &str, other: &str| {
                let (subdomain, edges) = (pair[i], touch.edges[i].clone());
                vec![Curve { subdomain, name: format!("{own} where it touches {other}"), edges }]
            };
            let mut sides = [side(0, a, b), side(1, b, a)];
            if is_open(&touch) && turns.next() == Some(true) {
                sides.reverse();
            }
            plans.push(PlannedInterface { name, entry, stated, sides });
        }
    }
    Ok(plans)
}

/// The area vector of the first body's boundary where it touches the second, outwards.
fn outward(mesh: &Mesh, touch: &Touch) -> [f64; 3] {
    let edge = |facet: &Facet| {
        let [start, end] = ends(facet).map(|node| mesh.points[node]);
        cross(minus(end, start), [0.0, 0.0, 1.0]) // its cell is on its left
    };
    touch.edges[0].iter().map(edge).fold([0.0; 3], plus)
}

/// The ends of edges of the first body that no other edge of the line has.
fn free_ends(mesh: &Mesh, touch: &Touch) -> Vec<[f64; 3]> {
    let mut nodes: Vec<usize> = touch.edges[0].iter().flat_map(ends).collect();
    nodes.sort_unstable();
    nodes.chunk_by(|a, b| a == b).filter(|same| same.len() == 1).map(|same| mesh.points[same[0]]).collect()
}

/// The mean of the points of a mesh.
fn centre(mesh: &Mesh) -> [f64; 3] {
    mesh.points.iter().copied().fold([0.0; 3], plus).map(|sum| sum / mesh.points.len() as f64)
}

fn fit(patterns: &[String; 2], name: &str) -> [bool; 2] {
    [0, 1].map(|i| WildMatch::new(&patterns[i]).matches(name))
}

/// Start and end of an edge: no other of its body has both, in this order.
fn ends(edge: &Facet) -> [usize; 2] {
    [edge.nodes()[0], edge.nodes()[1]]
}

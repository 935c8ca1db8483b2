//! Connectivity: the pieces of every subdomain, and coincident boundaries with nothing to join them.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::between::JoinedEdges;
use super::curve::PlannedInterface;
use crate::assembly::{BoundSubdomain, Model};
use crate::error::{Code, Result, Warning};
use crate::mesh::{Facet, Mesh, Pieces, Touch, coinciding};

/// Boundaries that lie on each other along less only meet at a point. Of the shortest edge there.
const MEETING: f64 = 1e-2;
/// Hinges that a message names.
const NAMED: usize = 3;
/// Digits of a place or a length in a message, of the extent of the mesh.
const DIGITS: f64 = 5.0;

/// Connectivity of a subdomain.
#[derive(Debug)]
pub(super) struct Connectivity {
    /// Its pieces.
    pub(super) pieces: Pieces,
    /// Length and middle of the lines along which different pieces lie on each other.
    lines: Option<ContactLine>,
}

/// Length and middle of lines of contact.
type ContactLine = (f64, [f64; 3]);

/// Connectivity of every subdomain; warnings of boundaries that lie on each other at one of the times and that nothing joins.
pub(super) fn look(
    model: &Model,
    plans: &[PlannedInterface],
    times: &[Vec<bool>],
) -> Result<(Vec<Connectivity>, Vec<Warning>)> {
    let pieces: Vec<Result<Pieces>> =
        model.subdomains.par_iter().map(|subdomain| subdomain.mesh.pieces()).collect();
    let pieces = pieces.into_iter().collect::<Result<Vec<Pieces>>>()?;
    let mut taken = JoinedEdges::default();
    plans.iter().for_each(|plan| taken.add(&plan.sides));
    let meshes: Vec<&Mesh> = model.subdomains.iter().map(|subdomain| &subdomain.mesh).collect();
    let free = |subdomains: [usize; 2], edges: [&Facet; 2]| !taken.both(subdomains, edges);
    let touches = coinciding(&meshes, &free)?;
    let mut apart: BTreeMap<[usize; 2], ContactLine> = BTreeMap::new();
    let mut within: BTreeMap<(usize, bool), ContactLine> = BTreeMap::new();
    for touch in touches.iter().filter(|touch| is_line(model, touch)) {
        let [a, b] = touch.subdomains;
        if a == b {
            let [one, two] = [0, 1].map(|side| pieces[a].of_cell[touch.edges[side][0].cell]);
            add(within.entry((a, one != two)).or_default(), touch);
        } else {
            add(apart.entry([a, b]).or_default(), touch);
        }
    }
    let lines = |subdomain: usize| within.get(&(subdomain, true)).copied();
    let found: Vec<Connectivity> = pieces
        .into_iter()
        .enumerate()
        .map(|(subdomain, pieces)| Connectivity { pieces, lines: lines(subdomain) })
        .collect();
    let unconnected = within.iter().map(|(&(subdomain, pieces), line)| {
        let own = &model.subdomains[subdomain];
        let what = match found[subdomain].told(own).filter(|_| pieces) {
            Some(told) => format!("the mesh of {told}"),
            None => format!("boundaries of {} {} and share no nodes", own.name, on_each_other(own, line)),
        };
        let help = "is `Coherence` or `BooleanFragments` missing in its .geo? fine if a slit is meant";
        Warning::new(Code::Unconnected, what, help)
    });
    let together = |[a, b]: &[usize; 2]| times.iter().any(|there| there[*a] && there[*b]);
    let unjoined = apart.iter().filter(|(pair, _)| together(pair)).map(|(&[a, b], (length, middle))| {
        let [a, b] = [&model.subdomains[a], &model.subdomains[b]];
        let (length, place) = (short(a, *length), near(a, *middle));
        let what = format!("{} and {} touch along {length} near {place} and no interface joins them", a.name, b.name);
        let help = "pressed there they would pass through each other: add an interface, or look which curves those name that there are; a free \
                    notch needs none";
        Warning::new(Code::Unjoined, what, help)
    });
    let warnings = unconnected.chain(unjoined).collect();
    Ok((found, warnings))
}

impl Connectivity {
    /// Nodes of the pieces of a subdomain; none if it is in one.
    pub(super) fn nodes(&self, subdomain: &BoundSubdomain) -> Vec<Vec<usize>> {
        let Pieces { count, of_cell, .. } = &self.pieces;
        let mut nodes = vec![Vec::new(); if *count < 2 { 0 } else { *count }];
        for (cell, &piece) in of_cell.iter().enumerate().filter(|_| *count > 1) {
            nodes[piece].extend_from_slice(subdomain.mesh.cells.nodes(cell));
        }
        for piece in &mut nodes {
            piece.sort_unstable();
            piece.dedup();
        }
        nodes
    }

    /// "up falls into 2 pieces that share only the node at (1, 0.5)"; nothing of a subdomain in one piece.
    pub(super) fn told(&self, subdomain: &BoundSubdomain) -> Option<String> {
        let Pieces { count, hinges, .. } = &self.pieces;
        if *count < 2 {
            return None;
        }
        let places: Vec<String> = hinges
            .iter()
            .take(NAMED)
            .map(|(node, _)| near(subdomain, subdomain.mesh.points[*node]))
            .collect();
        let mut text = format!("{} falls into {count} pieces that share ", subdomain.name);
        match hinges.len() {
            0 => text.push_str("no node"),
            1 => text.push_str(&format!("only the node at {}", places[0])),
            n if n <= NAMED => text.push_str(&format!("only the nodes at {}", places.join(" and "))),
            n => text.push_str(&format!("only {n} nodes, such as those at {}", places.join(", "))),
        }
        if let Some(line) = &self.lines {
            text.push_str(&format!(" and {}", on_each_other(subdomain, line)));
        }
        Some(text)
    }
}

/// "lie on each other along 2 near (1, 0.5)".
fn on_each_other(subdomain: &BoundSubdomain, (length, middle): &ContactLine) -> String {
    format!("lie on each other along {} near {}", short(subdomain, *length), near(subdomain, *middle))
}

/// True unless the boundaries only meet at a point.
fn is_line(model: &Model, touch: &Touch) -> bool {
    let length = |subdomain: usize, edge: &Facet| {
        let [p, q] = [0, 1].map(|i| model.subdomains[subdomain].mesh.points[edge.nodes()[i]]);
        (q[0] - p[0]).hypot(q[1] - p[1])
    };
    let sides = touch.subdomains.iter().zip(&touch.edges);
    let lengths = sides.flat_map(|(&subdomain, edges)| edges.iter().map(move |edge| length(subdomain, edge)));
    touch.length > MEETING * lengths.fold(f64::INFINITY, f64::min)
}

/// Adds a line; the middle is that of the longest.
fn add((length, middle): &mut ContactLine, touch: &Touch) {
    if touch.length > *length {
        *middle = touch.middle;
    }
    *length += touch.length;
}

/// "(1, 0.5)".
fn near(subdomain: &BoundSubdomain, [x, y, _]: [f64; 3]) -> String {
    format!("({}, {})", short(subdomain, x), short(subdomain, y))
}

/// A length with as many decimals as the extent of the mesh asks for, and no zeros behind them.
fn short(subdomain: &BoundSubdomain, value: f64) -> String {
    let extent = subdomain.mesh.points.iter().flatten().fold(0.0_f64, |extent, x| extent.max(x.abs()));
    let decimals = (DIGITS - 1.0 - extent.log10().floor()).clamp(0.0, 30.0) as usize;
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".into() } else { text.into() }
}

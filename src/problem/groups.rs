//! Names to groups, with an error that lists what there is.

use std::collections::HashSet;

use wildmatch::WildMatch;

use crate::assembly::Model;
use crate::error::{Error, Result, name_help};
use crate::mesh::{Facet, Group};
use crate::scene::{Scene, Subdomain, is_pattern, split_group};
use crate::shape::LINE_NODES;

/// Groups that a refusal names at most.
const SHOWN: usize = 12;

/// A group of a body, or the whole body; one that is no use, or the name of several, is refused.
pub(super) fn find<'a>(
    scene: &Scene,
    model: &'a Model,
    path: &[&str],
    name: &str,
) -> Result<(usize, Option<&'a Group>)> {
    match named(scene, model, path, name)? {
        (_, Some(Group::Namesakes(all))) => {
            let kinds: Vec<&str> = all.iter().map(Group::kind).collect();
            let what = format!("\"{name}\" is the name of a {}", kinds.join(" and of a "));
            Err(scene.source.error_at(path, what, "give each physical group a name of its own"))
        }
        (subdomain, Some(fault @ Group::Unusable { .. })) => {
            Err(refusal(scene, path, (subdomain, name), fault))
        }
        found => Ok(found),
    }
}

/// All groups of a name, or the whole body.
fn named<'a>(
    scene: &Scene,
    model: &'a Model,
    path: &[&str],
    name: &str,
) -> Result<(usize, Option<&'a Group>)> {
    let (subdomain, group) = split_group(name);
    // the scene's door has checked that the subdomain exists
    let subdomain = scene.subdomains.get_index_of(subdomain).unwrap_or(0);
    let Some(group) = group else {
        return Ok((subdomain, None));
    };
    let mesh = &model.subdomains[subdomain].mesh;
    match mesh.groups.get(group) {
        Some(found) => Ok((subdomain, Some(found))),
        None => {
            let subdomain = &scene.subdomains[subdomain];
            let file = file(subdomain);
            let place = match &subdomain.surface {
                Some(surface) => format!("on surface \"{surface}\" of {file}"),
                None => format!("in {file}"),
            };
            let help = name_help(group, mesh.groups.keys().map(String::as_str));
            Err(scene.source.error_at(path, format!("no group \"{group}\" {place}"), help))
        }
    }
}

/// The refusal of a group, of a body, that is no use.
pub(super) fn refusal(
    scene: &Scene,
    path: &[&str],
    (subdomain, name): (usize, &str),
    group: &Group,
) -> Error {
    match group {
        Group::Unusable { what, help, .. } => {
            let what = format!("\"{name}\" is no use: {what} in {}", file(&scene.subdomains[subdomain]));
            scene.source.error_at(path, what, help.clone())
        }
        other => scene.source.error_at(path, format!("\"{name}\" is a {}", other.kind()), "name another"),
    }
}

/// The file of a subdomain, as the scene names it.
pub(super) fn file(subdomain: &Subdomain) -> &str {
    subdomain.geo.as_ref().or(subdomain.msh.as_ref()).map_or("the mesh", String::as_str)
}

/// A group that must be a curve.
pub(super) fn curve<'a>(
    scene: &Scene,
    model: &'a Model,
    path: &[&str],
    name: &str,
) -> Result<(usize, &'a [Facet])> {
    let (subdomain, group) = named(scene, model, path, name)?;
    let all = group.map_or(&[][..], Group::each);
    if let Some(curve) = all.iter().find(|group| group.kind() == "curve") {
        return match curve {
            Group::Edges(edges) => Ok((subdomain, edges)),
            fault => Err(refusal(scene, path, (subdomain, name), fault)),
        };
    }
    let kind = group.map_or("body", Group::kind);
    let mesh = &model.subdomains[subdomain].mesh;
    let curves = mesh.groups.iter().filter(|(_, group)| group.each().iter().any(|one| one.kind() == "curve"));
    let curves: Vec<&str> = curves.map(|(name, _)| name.as_str()).collect();
    let what = format!("\"{name}\" is a {kind}, not a curve");
    Err(scene.source.error_at(path, what, format!("its curves are {}", curves.join(", "))))
}

/// A group that must be of points.
pub(super) fn points<'a>(
    scene: &Scene,
    model: &'a Model,
    path: &[&str],
    name: &str,
) -> Result<(usize, &'a [usize])> {
    let (subdomain, group) = named(scene, model, path, name)?;
    let all = group.map_or(&[][..], Group::each);
    match all.iter().find(|group| group.kind() == "point") {
        Some(Group::Points(points)) => Ok((subdomain, points)),
        Some(fault) => Err(refusal(scene, path, (subdomain, name), fault)),
        None => {
            let kind = group.map_or("body", Group::kind);
            let what = format!("a force on \"{name}\", which is a {kind}");
            Err(scene.source.error_at(path, what, "name a physical point, or give a \"traction\""))
        }
    }
}

/// The groups and bodies that a name or a pattern stands for, of which there must be one; of a `kind` if one is asked for.
pub(super) fn matching(
    scene: &Scene,
    model: &Model,
    path: &[&str],
    name: &str,
    kind: Option<&str>,
) -> Result<Vec<String>> {
    if !is_pattern(name) {
        return Ok(vec![name.into()]);
    }
    let (subdomain, group) = split_group(name);
    let matcher = WildMatch::new(subdomain);
    let bodies = model.subdomains.iter().filter(|body| matcher.matches(&body.name));
    let Some(group) = group else { return Ok(bodies.map(|body| body.name.clone()).collect()) };
    let fits = |of: &Group| kind.is_none_or(|kind| of.each().iter().any(|one| one.kind() == kind));
    let all: Vec<(String, &String)> = bodies
        .flat_map(|body| {
            let groups = body.mesh.groups.iter().filter(|(_, of)| fits(of));
            groups.map(|(group, _)| (format!("{}.{group}", body.name), group))
        })
        .collect();
    let matcher = WildMatch::new(group);
    let found: Vec<String> =
        all.iter().filter(|(_, group)| matcher.matches(group)).map(|(name, _)| name.clone()).collect();
    if found.is_empty() {
        let what = format!("no {} is called like \"{name}\"", kind.unwrap_or("group"));
        let shown = all.iter().take(SHOWN).map(|(name, _)| name.as_str());
        let more = if all.len() > SHOWN { ", …" } else { "" };
        return Err(scene.source.error_at(path, what, format!("{}{more}", name_help(name, shown))));
    }
    Ok(found)
}

/// Model nodes of the groups and bodies of a name or pattern, ascending, each once.
pub(super) fn nodes(scene: &Scene, model: &Model, path: &[&str], name: &str) -> Result<Vec<usize>> {
    let mut all = Vec::new();
    for name in matching(scene, model, path, name, None)? {
        let (subdomain, group) = find(scene, model, path, &name)?;
        let subdomain = &model.subdomains[subdomain];
        let nodes = match group {
            Some(group) => group.points(&subdomain.mesh),
            None => (0..subdomain.mesh.points.len()).collect(),
        };
        all.extend(nodes.into_iter().map(|node| subdomain.first_node + node));
    }
    all.sort_unstable();
    all.dedup();
    Ok(all)
}

/// Weights of the model nodes in the mean over a group, or over the union of those of a pattern: by length, by area, or each the
/// same for points.
pub(super) fn mean(scene: &Scene, model: &Model, path: &[&str], name: &str) -> Result<Vec<(usize, f64)>> {
    use crate::continuum::{cell_coordinates, cell_weights, edge_weights};
    let mut weights: Vec<(usize, f64)> = Vec::new();
    let (mut seen, mut kind) = (HashSet::new(), None);
    for own in matching(scene, model, path, name, None)? {
        let (index, group) = find(scene, model, path, &own)?;
        let subdomain = &model.subdomains[index];
        let mesh = &subdomain.mesh;
        let this = group.map_or("body", Group::kind);
        if *kind.get_or_insert(this) != this {
            let what = format!("\"{name}\" fits groups of several kinds");
            return Err(scene.source.error_at(
                path,
                what,
                "a mean is over points, curves, surfaces or bodies alone",
            ));
        }
        let node = |node: usize| subdomain.first_node + node;
        let mut new = |nodes: &[usize]| {
            let mut nodes: Vec<usize> = nodes.iter().map(|&place| node(place)).collect();
            nodes.sort_unstable();
            seen.insert(nodes)
        };
        let mut add = |nodes: &[usize], own: &[f64]| {
            weights.extend(nodes.iter().map(|&place| node(place)).zip(own.iter().copied()));
        };
        let cells: Vec<usize> = match group {
            None => (0..mesh.cells.len()).collect(),
            Some(Group::Cells(cells)) => cells.clone(),
            _ => Vec::new(),
        };
        for c in cells {
            if new(mesh.cells.nodes(c)) {
                add(mesh.cells.nodes(c), &cell_weights(mesh.cells.shapes[c], &cell_coordinates(mesh, c)));
            }
        }
        match group {
            Some(Group::Points(points)) => {
                points.iter().filter(|point| new(&[**point])).for_each(|&point| add(&[point], &[1.0]));
            }
            Some(Group::Edges(edges)) => {
                for edge in edges.iter().filter(|edge| new(edge.nodes())) {
                    add(edge.nodes(), &edge_weights(&edge_coordinates(&mesh.points, edge), edge.shape));
                }
            }
            _ => {} // cells are counted, faults refused above
        }
    }
    let total: f64 = weights.iter().map(|(_, w)| w).sum();
    weights.sort_by_key(|&(node, _)| node);
    weights.dedup_by(|later, kept| {
        let same = later.0 == kept.0;
        if same {
            kept.1 += later.1;
        }
        same
    });
    Ok(weights.into_iter().map(|(node, w)| (node, w / total)).collect())
}

/// Coordinates of start, end and mid-node of an edge, relative to its start; the end again where it has none.
pub(super) fn edge_coordinates(points: &[[f64; 3]], edge: &Facet) -> [[f64; 2]; LINE_NODES] {
    let origin = points[edge.nodes()[0]];
    let at = |node: usize| [points[node][0] - origin[0], points[node][1] - origin[1]];
    let nodes = edge.nodes();
    std::array::from_fn(|i| at(nodes[i.min(nodes.len() - 1)]))
}

//! Names to groups, with an error that lists what there is.

use crate::assembly::Model;
use crate::error::{Error, Result, name_help};
use crate::mesh::{Facet, Group};
use crate::scene::{Scene, Subdomain, split_group};
use crate::shape::LINE_NODES;

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

/// Model nodes of a group or body, ascending, each once.
pub(super) fn nodes(scene: &Scene, model: &Model, path: &[&str], name: &str) -> Result<Vec<usize>> {
    let (subdomain, group) = find(scene, model, path, name)?;
    let subdomain = &model.subdomains[subdomain];
    let nodes = match group {
        Some(group) => group.points(&subdomain.mesh),
        None => (0..subdomain.mesh.points.len()).collect(),
    };
    Ok(nodes.into_iter().map(|node| subdomain.first_node + node).collect())
}

/// Weights of the model nodes in the mean over a group: by length, by area, or each the same for points.
pub(super) fn mean(scene: &Scene, model: &Model, path: &[&str], name: &str) -> Result<Vec<(usize, f64)>> {
    use crate::continuum::{cell_coordinates, cell_weights, edge_weights};
    let (index, group) = find(scene, model, path, name)?;
    let subdomain = &model.subdomains[index];
    let mesh = &subdomain.mesh;
    let mut weights: Vec<(usize, f64)> = Vec::new();
    let mut add_cell = |c: usize| {
        let of_cell = cell_weights(mesh.cells.shapes[c], &cell_coordinates(mesh, c));
        weights.extend(mesh.cells.nodes(c).iter().copied().zip(of_cell));
    };
    match group {
        None => (0..mesh.cells.len()).for_each(&mut add_cell),
        Some(Group::Cells(cells)) => cells.iter().copied().for_each(&mut add_cell),
        Some(Group::Namesakes(_) | Group::Unusable { .. }) => {} // refused above
        Some(Group::Points(points)) => weights.extend(points.iter().map(|&point| (point, 1.0))),
        Some(Group::Edges(edges)) => {
            for edge in edges {
                let of_edge = edge_weights(&edge_coordinates(&mesh.points, edge), edge.shape);
                weights.extend(edge.nodes().iter().copied().zip(of_edge));
            }
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
    Ok(weights.into_iter().map(|(node, w)| (subdomain.first_node + node, w / total)).collect())
}

/// Coordinates of start, end and mid-node of an edge, relative to its start; the end again where it has none.
pub(super) fn edge_coordinates(points: &[[f64; 3]], edge: &Facet) -> [[f64; 2]; LINE_NODES] {
    let origin = points[edge.nodes()[0]];
    let at = |node: usize| [points[node][0] - origin[0], points[node][1] - origin[1]];
    let nodes = edge.nodes();
    std::array::from_fn(|i| at(nodes[i.min(nodes.len() - 1)]))
}

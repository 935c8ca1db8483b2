//! Physical groups: their names, and which points, edges and cells each of them holds.

use indexmap::IndexMap;

use super::edges::EdgeTable;
use super::msh::{Content, Declared, KINDS, MeshFault};
use super::{Cells, Facet, Group};

type GroupResult<T> = Result<T, MeshFault>;

/// Number of a node that no cell uses.
pub(super) const UNUSED: u32 = u32::MAX;

/// The groups of the mesh by name, those with a fault among them; `numbers` leads from the nodes of the file to the points of the mesh.
pub(super) fn gather(
    content: &Content,
    cells: &Cells,
    edges: &EdgeTable,
    numbers: &[u32],
) -> GroupResult<IndexMap<String, Group>> {
    let mut members = vec![Vec::new(); content.declared.len()];
    let mut order: Vec<usize> = (0..content.declared.len()).collect();
    let key = |group: &usize| (content.declared[*group].dim, content.declared[*group].tag);
    order.sort_by_key(key);
    for block in &content.blocks {
        for &tag in &block.groups {
            if let Ok(found) = order.binary_search_by_key(&(block.dim, tag), key) {
                members[order[found]].extend(block.members.clone());
            }
        }
    }
    let mut groups: IndexMap<String, Group> = IndexMap::new();
    for (i, (declared, members)) in content.declared.iter().zip(members).enumerate() {
        let group = match declared.dim {
            _ if members.is_empty() => Err(declared.empty()),
            0 => points(declared, &members, content, numbers).map(Group::Points),
            1 => curve(declared, &members, content, cells, edges, numbers).map(Group::Edges),
            _ => Ok(Group::Cells(ascending(members))),
        };
        let group = clash(&content.declared, i).map_or(group, Err);
        // a group with a fault is no reason to refuse a mesh whose scene does not name it
        let kind = KINDS[declared.dim];
        let group = group.unwrap_or_else(|MeshFault { what, help }| Group::Unusable { kind, what, help });
        match groups.get_mut(&declared.name) {
            None => drop(groups.insert(declared.name.clone(), group)),
            Some(Group::Namesakes(all)) => all.push(group),
            Some(one) if one.kind() != group.kind() => *one = Group::Namesakes(vec![one.clone(), group]),
            Some(_) => {} // of two curves of one name the first says that there are two
        }
    }
    Ok(groups)
}

/// The fault of a group that shares its name with another of its dimension, or has two names.
fn clash(declared: &[Declared], group: usize) -> Option<MeshFault> {
    let one = &declared[group];
    let title = |group: &Declared| format!("physical {} {}", KINDS[group.dim], group.tag);
    let others = || declared.iter().enumerate().filter(|(i, other)| *i != group && other.dim == one.dim);
    if let Some((i, other)) = others().find(|(_, other)| other.name == one.name) {
        let [first, second] = if i < group { [other, one] } else { [one, other] };
        return Some(MeshFault {
            what: format!("{} and {} are both called \"{}\"", title(first), title(second), one.name),
            help: "give each physical group a name of its own".into(),
        });
    }
    others().find(|(_, other)| other.tag == one.tag).map(|(i, other)| {
        let [first, second] = if i < group { [other, one] } else { [one, other] };
        MeshFault {
            what: format!("{} is called \"{}\" and \"{}\"", title(one), first.name, second.name),
            help: "give each physical group one name".into(),
        }
    })
}

fn ascending(mut members: Vec<usize>) -> Vec<usize> {
    members.sort_unstable();
    members
}

fn points(
    group: &Declared,
    members: &[usize],
    content: &Content,
    numbers: &[u32],
) -> GroupResult<Vec<usize>> {
    let mut points = Vec::with_capacity(members.len());
    for &member in members {
        let node = content.vertices[member] as usize;
        if numbers[node] == UNUSED {
            return Err(loose(group, &format!("node {}", content.node_tags[node])));
        }
        points.push(numbers[node] as usize);
    }
    points.sort_unstable();
    match points.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(pair) => Err(twice(group, &format!("the point at {:?}", content.points[pair[0]]))),
        None => Ok(points),
    }
}

fn curve(
    group: &Declared,
    members: &[usize],
    content: &Content,
    cells: &Cells,
    table: &EdgeTable,
    numbers: &[u32],
) -> GroupResult<Vec<Facet>> {
    let mut edges = Vec::with_capacity(members.len());
    let mut keys = Vec::with_capacity(members.len());
    for &member in members {
        let shape = content.edge_shapes[member];
        let nodes = &content.edges[member][..shape.nodes()];
        let tag = content.tags[1][member];
        let number = |i: usize| numbers[nodes[i] as usize];
        let (start, end) = (number(0), number(1));
        let found = (start != UNUSED && end != UNUSED)
            .then(|| table.find(cells, start as usize, end as usize))
            .flatten()
            .ok_or_else(|| loose(group, &format!("element {tag}")))?;
        // inner nodes of the element, in the direction of the facet
        let order = if found.nodes()[0] == start as usize { None } else { Some(shape.turned_line()) };
        let inner = (2..shape.nodes()).map(|i| number(order.map_or(i, |order| order[i])) as usize);
        if shape != found.shape || !inner.eq(found.nodes()[2..].iter().copied()) {
            return Err(MeshFault {
                what: format!(
                    "element {tag} of curve \"{}\" and element {} beside it do not have the same mid-node",
                    group.name, content.tags[2][found.cell]
                ),
                help: "mesh the whole body with one Mesh.ElementOrder".into(),
            });
        }
        keys.push(([start.min(end), start.max(end)], tag));
        edges.push(found);
    }
    keys.sort_unstable();
    match keys.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        Some(pair) => Err(twice(group, &format!("the edge of elements {} and {}", pair[0].1, pair[1].1))),
        None => Ok(edges),
    }
}

fn loose(group: &Declared, what: &str) -> MeshFault {
    let kind = KINDS[group.dim];
    MeshFault {
        what: format!("physical {kind} \"{}\": {what} lies on no cell", group.name),
        help: format!(
            "a physical {kind} must belong to a meshed surface (in a Physical Surface, embedded if inside)"
        ),
    }
}

fn twice(group: &Declared, what: &str) -> MeshFault {
    MeshFault {
        what: format!("physical {} \"{}\" holds {what} twice", KINDS[group.dim], group.name),
        help: "list each point and curve once, and no two that coincide".into(),
    }
}

//! Physical groups: their names, and which points, edges and cells each of them holds.

use indexmap::IndexMap;

use super::edges::EdgeTable;
use super::msh::{Content, Declared, Fault, KINDS};
use super::{Cells, Edge, Group};

type Found<T> = Result<T, Fault>;

/// Number of a node that no cell uses.
pub(super) const UNUSED: u32 = u32::MAX;

/// The groups of the mesh by name; `numbers` leads from the nodes of the file to the points of the mesh.
pub(super) fn gather(
    content: &Content,
    cells: &Cells,
    edges: &EdgeTable,
    numbers: &[u32],
) -> Found<IndexMap<String, Group>> {
    distinct_names(&content.declared)?;
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
    let mut groups = IndexMap::new();
    for (declared, members) in content.declared.iter().zip(members) {
        if members.is_empty() {
            return Err(declared.empty());
        }
        let group = match declared.dim {
            0 => Group::Points(points(declared, &members, content, numbers)?),
            1 => Group::Edges(curve(declared, &members, content, cells, edges, numbers)?),
            _ => Group::Cells(ascending(members)),
        };
        groups.insert(declared.name.clone(), group);
    }
    Ok(groups)
}

fn distinct_names(declared: &[Declared]) -> Found<()> {
    let title = |group: &Declared| format!("physical {} {}", KINDS[group.dim], group.tag);
    let mut by_name: Vec<&Declared> = declared.iter().collect();
    by_name.sort_by(|a, b| a.name.cmp(&b.name));
    if let Some(pair) = by_name.windows(2).find(|pair| pair[0].name == pair[1].name) {
        return Err(Fault {
            what: format!("{} and {} are both called \"{}\"", title(pair[0]), title(pair[1]), pair[0].name),
            cure: "give each physical group a name of its own".into(),
        });
    }
    by_name.sort_by_key(|group| (group.dim, group.tag));
    let same = by_name.windows(2).find(|pair| (pair[0].dim, pair[0].tag) == (pair[1].dim, pair[1].tag));
    match same {
        Some(pair) => Err(Fault {
            what: format!("{} is called \"{}\" and \"{}\"", title(pair[0]), pair[0].name, pair[1].name),
            cure: "give each physical group one name".into(),
        }),
        None => Ok(()),
    }
}

fn ascending(mut members: Vec<usize>) -> Vec<usize> {
    members.sort_unstable();
    members
}

fn points(group: &Declared, members: &[usize], content: &Content, numbers: &[u32]) -> Found<Vec<usize>> {
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
) -> Found<Vec<Edge>> {
    let mut edges = Vec::with_capacity(members.len());
    let mut keys = Vec::with_capacity(members.len());
    for &member in members {
        let nodes = content.edges[member];
        let tag = content.tags[1][member];
        let number = |node: u32| if node == u32::MAX { UNUSED } else { numbers[node as usize] };
        let [start, end, mid] = nodes.map(number);
        let found = (start != UNUSED && end != UNUSED)
            .then(|| table.find(cells, start as usize, end as usize))
            .flatten()
            .ok_or_else(|| loose(group, &format!("element {tag}")))?;
        let has_mid = nodes[2] != u32::MAX;
        if has_mid != cells.shapes[found.cell].is_quadratic() || has_mid && found.nodes[2] != mid as usize {
            return Err(Fault {
                what: format!(
                    "element {tag} of curve \"{}\" and element {} beside it do not have the same mid-node",
                    group.name, content.tags[2][found.cell]
                ),
                cure: "mesh the whole body with one Mesh.ElementOrder".into(),
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

fn loose(group: &Declared, what: &str) -> Fault {
    let kind = KINDS[group.dim];
    Fault {
        what: format!("physical {kind} \"{}\": {what} lies on no cell", group.name),
        cure: format!(
            "a physical {kind} must belong to a meshed surface (in a Physical Surface, embedded if inside)"
        ),
    }
}

fn twice(group: &Declared, what: &str) -> Fault {
    Fault {
        what: format!("physical {} \"{}\" holds {what} twice", KINDS[group.dim], group.name),
        cure: "list each point and curve once, and no two that coincide".into(),
    }
}

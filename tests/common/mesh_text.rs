//! Small MSH 4.1 files written by hand, text or binary, and the promises that a mesh read from any file must keep.

use midplane::mesh::{Facet, Group, Mesh};

/// Contents of an MSH file; every field may be made wrong on purpose.
#[derive(Debug, Clone)]
pub struct MeshText {
    /// Dimension, number and name of the named groups.
    pub names: Vec<(i32, i32, String)>,
    /// Dimension, tag and physical tags of the entities, ascending by dimension.
    pub entities: Vec<(i32, i32, Vec<i32>)>,
    /// Tag and coordinates.
    pub nodes: Vec<(u64, [f64; 3])>,
    pub blocks: Vec<Block>,
}

/// Elements of one type on one entity: tags and nodes.
#[derive(Debug, Clone)]
pub struct Block {
    pub dim: i32,
    pub entity: i32,
    pub gmsh_type: i32,
    pub elements: Vec<(u64, Vec<u64>)>,
}

/// The form in which numbers are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    Text,
    Little,
    Big,
}

pub fn block(dim: i32, entity: i32, gmsh_type: i32, elements: &[(u64, &[u64])]) -> Block {
    let elements = elements.iter().map(|(tag, nodes)| (*tag, nodes.to_vec())).collect();
    Block { dim, entity, gmsh_type, elements }
}

/// A strip of one quadrilateral and two triangles, 2 × 1, with a body, its bottom and one corner.
///
/// ```text
///   4 ── 5 ── 6
///   │    │ ╲  │      surface 1 "body", curve 1 "bottom" (1-2-3), point 1 "corner" (1)
///   1 ── 2 ── 3
/// ```
pub fn strip() -> MeshText {
    MeshText {
        names: vec![(0, 3, "corner".into()), (1, 2, "bottom".into()), (2, 1, "body".into())],
        entities: vec![(0, 1, vec![3]), (1, 1, vec![2]), (2, 1, vec![1])],
        nodes: (1..=6)
            .map(|tag| (tag, [f64::from((tag as i32 - 1) % 3), f64::from((tag as i32 - 1) / 3), 0.0]))
            .collect(),
        blocks: vec![
            block(0, 1, 15, &[(1, &[1])]),
            block(1, 1, 1, &[(2, &[1, 2]), (3, &[2, 3])]),
            block(2, 1, 3, &[(4, &[1, 2, 5, 4])]),
            block(2, 1, 2, &[(5, &[2, 3, 5]), (6, &[3, 6, 5])]),
        ],
    }
}

impl MeshText {
    /// Gives every node another tag.
    pub fn retag(&mut self, tag: impl Fn(u64) -> u64) {
        for node in &mut self.nodes {
            node.0 = tag(node.0);
        }
        let elements = self.blocks.iter_mut().flat_map(|block| &mut block.elements);
        elements.flat_map(|(_, nodes)| nodes).for_each(|node| *node = tag(*node));
    }

    /// The file.
    pub fn bytes(&self, form: Form) -> Vec<u8> {
        let mut out = Out { bytes: Vec::new(), form };
        out.line(&format!("$MeshFormat\n4.1 {} 8", i32::from(form != Form::Text)));
        if form != Form::Text {
            out.int(1);
        }
        out.line("\n$EndMeshFormat");
        if !self.names.is_empty() {
            out.line(&format!("$PhysicalNames\n{}", self.names.len()));
            for (dim, tag, name) in &self.names {
                out.line(&format!("{dim} {tag} \"{name}\""));
            }
            out.line("$EndPhysicalNames");
        }
        if !self.entities.is_empty() {
            self.put_entities(&mut out);
        }
        self.put_nodes(&mut out);
        self.put_elements(&mut out);
        out.bytes
    }

    fn put_entities(&self, out: &mut Out) {
        out.line("$Entities");
        for dim in 0..4 {
            out.size(self.entities.iter().filter(|entity| entity.0 == dim).count() as u64);
        }
        for (dim, tag, groups) in &self.entities {
            out.int(*tag);
            for _ in 0..if *dim == 0 { 3 } else { 6 } {
                out.float(0.0);
            }
            out.size(groups.len() as u64);
            groups.iter().for_each(|group| out.int(*group));
            if *dim > 0 {
                out.size(0);
            }
        }
        out.line("\n$EndEntities");
    }

    fn put_nodes(&self, out: &mut Out) {
        out.line("$Nodes");
        let tags = self.nodes.iter().map(|node| node.0);
        let count = self.nodes.len() as u64;
        for value in [1, count, tags.clone().min().unwrap_or(1), tags.clone().max().unwrap_or(1)] {
            out.size(value);
        }
        for value in [2, 1, 0] {
            out.int(value);
        }
        out.size(count);
        tags.for_each(|tag| out.size(tag));
        self.nodes.iter().flat_map(|node| node.1).for_each(|x| out.float(x));
        out.line("\n$EndNodes");
    }

    fn put_elements(&self, out: &mut Out) {
        out.line("$Elements");
        let tags: Vec<u64> =
            self.blocks.iter().flat_map(|block| &block.elements).map(|element| element.0).collect();
        let range = [tags.iter().copied().min().unwrap_or(1), tags.iter().copied().max().unwrap_or(1)];
        for value in [self.blocks.len() as u64, tags.len() as u64, range[0], range[1]] {
            out.size(value);
        }
        for block in &self.blocks {
            for value in [block.dim, block.entity, block.gmsh_type] {
                out.int(value);
            }
            out.size(block.elements.len() as u64);
            for (tag, nodes) in &block.elements {
                out.size(*tag);
                nodes.iter().for_each(|node| out.size(*node));
            }
        }
        out.line("\n$EndElements");
    }
}

struct Out {
    bytes: Vec<u8>,
    form: Form,
}

impl Out {
    fn line(&mut self, text: &str) {
        let blank_is_enough = self.form == Form::Text && text.starts_with('\n');
        self.bytes.extend(if blank_is_enough { &text[1..] } else { text }.as_bytes());
        self.bytes.push(b'\n');
    }

    fn word(&mut self, text: String) {
        self.bytes.extend(text.as_bytes());
        self.bytes.push(b' ');
    }

    fn size(&mut self, value: u64) {
        match self.form {
            Form::Text => self.word(value.to_string()),
            Form::Little => self.bytes.extend(value.to_le_bytes()),
            Form::Big => self.bytes.extend(value.to_be_bytes()),
        }
    }

    fn int(&mut self, value: i32) {
        match self.form {
            Form::Text => self.word(value.to_string()),
            Form::Little => self.bytes.extend(value.to_le_bytes()),
            Form::Big => self.bytes.extend(value.to_be_bytes()),
        }
    }

    fn float(&mut self, value: f64) {
        match self.form {
            Form::Text => self.word(format!("{value:?}")),
            Form::Little => self.bytes.extend(value.to_le_bytes()),
            Form::Big => self.bytes.extend(value.to_be_bytes()),
        }
    }
}

/// Asserts that two numbers agree to rounding.
pub fn close(value: f64, expected: f64) {
    assert!((value - expected).abs() <= 1e-12 * expected.abs(), "{value} instead of {expected}");
}

/// Area of the body, ∫ det J over every cell.
pub fn area(mesh: &Mesh) -> f64 {
    (0..mesh.cells.len()).flat_map(|c| jacobians(mesh, c)).map(|[weight, jacobian]| weight * jacobian).sum()
}

/// Weight and Jacobian at the points of the load rule.
fn jacobians(mesh: &Mesh, c: usize) -> Vec<[f64; 2]> {
    let shape = mesh.cells.shapes[c];
    let at = |q: &[f64; 3]| {
        let values = shape.values(q[0], q[1]);
        let mut j = [[0.0; 2]; 2];
        for (i, &node) in mesh.cells.nodes(c).iter().enumerate() {
            for (a, row) in j.iter_mut().enumerate() {
                row[0] += mesh.points[node][a] * values.dn[i][0];
                row[1] += mesh.points[node][a] * values.dn[i][1];
            }
        }
        [q[2], j[0][0] * j[1][1] - j[0][1] * j[1][0]]
    };
    shape.load_rule().iter().map(at).collect()
}

/// Edges of a curve group.
pub fn edges<'a>(mesh: &'a Mesh, group: &str) -> &'a [Facet] {
    match mesh.groups.get(group) {
        Some(Group::Edges(edges)) => edges,
        _ => &[],
    }
}

/// Length of a curve group, as a sum of chords.
pub fn length(mesh: &Mesh, group: &str) -> f64 {
    let chord = |a: usize, b: usize| {
        let [p, q] = [mesh.points[a], mesh.points[b]];
        (p[0] - q[0]).hypot(p[1] - q[1])
    };
    edges(mesh, group).iter().map(|edge| chord(edge.nodes()[0], edge.nodes()[1])).sum()
}

/// Checks every promise of the mesh room.
pub fn keeps_its_promises(mesh: &Mesh) {
    let mut used = vec![false; mesh.points.len()];
    assert_eq!(mesh.cells.offsets.len(), mesh.cells.len() + 1);
    assert!(!mesh.cells.is_empty());
    for c in 0..mesh.cells.len() {
        assert_eq!(mesh.cells.nodes(c).len(), mesh.cells.shapes[c].nodes());
        mesh.cells.nodes(c).iter().for_each(|&node| used[node] = true);
        assert!(jacobians(mesh, c).iter().all(|[_, jacobian]| *jacobian > 0.0), "cell {c} folds over");
    }
    assert!(used.iter().all(|&used| used), "a point belongs to no cell");
    assert!(mesh.points.iter().flatten().all(|x| x.is_finite()));
    for (name, group) in
        mesh.groups.iter().flat_map(|(name, all)| all.each().iter().map(move |one| (name, one)))
    {
        if matches!(group, Group::Unusable { .. }) {
            continue;
        }
        assert!(!group.points(mesh).is_empty(), "{name} is empty");
        match group {
            Group::Points(points) => assert!(points.iter().all(|&point| point < mesh.points.len())),
            Group::Cells(cells) => assert!(cells.iter().all(|&cell| cell < mesh.cells.len())),
            Group::Namesakes(_) | Group::Unusable { .. } => unreachable!(),
            Group::Edges(edges) => {
                for edge in edges {
                    let (shape, nodes) = (mesh.cells.shapes[edge.cell], mesh.cells.nodes(edge.cell));
                    let on_left = (0..shape.corners()).any(|e| {
                        let [start, end, mid] = shape.edge(e);
                        let local = [start, end, mid].map(|i| nodes.get(i).copied());
                        let count = if shape.is_quadratic() { 3 } else { 2 };
                        edge.nodes().iter().map(|&node| Some(node)).eq(local[..count].iter().copied())
                    });
                    assert!(on_left, "{name}: the cell is not on the left of its edge");
                }
            }
        }
    }
}

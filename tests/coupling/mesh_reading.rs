//! Claim: what an MSH 4.1 file says is what the mesh holds, in every encoding and numbering; what cannot be a plane mesh is refused by
//! name.

use std::path::Path;

use crate::common::mesh_text::{
    Form, MeshText, area, block, close, edges, keeps_its_promises, length, strip,
};
use midplane::mesh::{Group, Mesh, from_bytes};
use midplane::shape::Shape;
use midplane::shape::vector::in_plane;

const FORMS: [Form; 3] = [Form::Text, Form::Little, Form::Big];

fn read(text: &MeshText) -> Mesh {
    let mesh = from_bytes(Path::new("strip.msh"), &text.bytes(Form::Text)).expect("the file is sound");
    keeps_its_promises(&mesh);
    mesh
}

/// The message of the refusal, the same in text and binary.
fn refusal(text: &MeshText) -> String {
    let messages = FORMS.map(|form| {
        let error =
            from_bytes(Path::new("strip.msh"), &text.bytes(form)).expect_err("the file must be refused");
        assert_eq!(error.exit_code(), 2);
        error.to_string()
    });
    assert!(messages[0] == messages[1] && messages[0] == messages[2], "{messages:?}");
    assert!(messages[0].starts_with("strip.msh: "), "{}", messages[0]);
    messages[0].clone()
}

/// Start and end of the edges of a curve, as coordinates.
fn ends(mesh: &Mesh, name: &str) -> Vec<[[f64; 2]; 2]> {
    edges(mesh, name).iter().map(|edge| [0, 1].map(|end| in_plane(mesh.points[edge.nodes()[end]]))).collect()
}

const BOTTOM: [[[f64; 2]; 2]; 2] = [[[0.0, 0.0], [1.0, 0.0]], [[1.0, 0.0], [2.0, 0.0]]];

#[test]
fn the_strip_is_read_in_every_encoding() {
    for form in FORMS {
        let mesh = from_bytes(Path::new("strip.msh"), &strip().bytes(form)).unwrap();
        keeps_its_promises(&mesh);
        assert_eq!(mesh.file, Path::new("strip.msh"));
        assert_eq!(mesh.points.len(), 6);
        assert_eq!(mesh.cells.shapes, [Shape::Quadrilateral4, Shape::Triangle3, Shape::Triangle3]);
        assert_eq!(mesh.groups.keys().collect::<Vec<_>>(), ["corner", "bottom", "body"]);
        close(area(&mesh), 2.0);
        assert_eq!(ends(&mesh, "bottom"), BOTTOM);
        assert!(
            matches!(&mesh.groups["corner"], Group::Points(points) if mesh.points[points[0]] == [0.0; 3])
        );
        assert!(matches!(&mesh.groups["body"], Group::Cells(cells) if *cells == [0, 1, 2]));
        let edges = edges(&mesh, "bottom");
        assert!(edges.iter().all(|edge| edge.boundary) && edges[0].cell == 0 && edges[1].cell == 1);
    }
}

#[test]
fn node_tags_may_be_permuted_sparse_or_huge() {
    let permuted = |tag: u64| [0, 4, 2, 6, 1, 3, 5][tag as usize];
    for retag in
        [permuted, |tag| 7 - tag, |tag| 10 * tag, |tag| 1_u64 << (10 * tag), |tag| u64::MAX - tag * tag]
    {
        let mut text = strip();
        text.retag(retag);
        for form in FORMS {
            let mesh = from_bytes(Path::new("strip.msh"), &text.bytes(form)).unwrap();
            keeps_its_promises(&mesh);
            assert_eq!(ends(&mesh, "bottom"), BOTTOM);
            close(area(&mesh), 2.0);
        }
    }
}

#[test]
fn clockwise_cells_and_reversed_curves_give_the_same_edges() {
    for flip in [[true, false], [false, true], [true, true]] {
        let mut text = strip();
        for block in &mut text.blocks {
            if flip[usize::from(block.dim == 1)] {
                block.elements.iter_mut().for_each(|(_, nodes)| nodes.reverse());
            }
        }
        let mesh = read(&text);
        assert_eq!(ends(&mesh, "bottom"), BOTTOM);
        close(area(&mesh), 2.0);
    }
}

#[test]
fn quadratic_cells_keep_their_mid_nodes_when_turned() {
    // one T6 counted clockwise, mid-nodes 4 (1-2), 5 (2-3), 6 (3-1)
    let points = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [0.0, 0.5], [0.5, 0.5], [0.5, 0.0]];
    let text = MeshText {
        names: vec![],
        entities: vec![(1, 1, vec![5]), (2, 1, vec![9])],
        nodes: (1..).zip(points.map(|p| [p[0], p[1], 0.0])).collect(),
        blocks: vec![block(1, 1, 8, &[(1, &[1, 3, 6])]), block(2, 1, 9, &[(2, &[1, 2, 3, 4, 5, 6])])],
    };
    let mesh = read(&text);
    close(area(&mesh), 0.5);
    let edges = edges(&mesh, "5");
    let places: Vec<[f64; 2]> = edges[0].nodes().iter().map(|&node| in_plane(mesh.points[node])).collect();
    assert_eq!(places, [[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]]);
}

#[test]
fn a_curve_inside_the_subdomain_has_a_cell_on_either_side() {
    let mut text = strip();
    text.entities.insert(2, (1, 2, vec![8]));
    text.blocks.insert(2, block(1, 2, 1, &[(7, &[2, 5])]));
    let mesh = read(&text);
    let edges = edges(&mesh, "8");
    assert!(!edges[0].boundary && edges[0].cell == 0);
    assert_eq!(length(&mesh, "8"), 1.0);
}

#[test]
fn a_curve_may_be_in_two_groups_and_a_group_may_be_reversed() {
    let mut text = strip();
    text.names.push((1, 4, "support".into()));
    text.entities[1].2 = vec![-2, 4];
    let mesh = read(&text);
    assert_eq!(ends(&mesh, "bottom"), ends(&mesh, "support"));
}

#[test]
fn names_may_hold_anything_and_a_group_without_name_answers_to_its_number() {
    let mut text = strip();
    text.names[1].2 = "bord inférieur, 界面 1".into();
    text.names.pop();
    assert_eq!(read(&text).groups.keys().collect::<Vec<_>>(), ["corner", "bord inférieur, 界面 1", "1"]);
}

#[test]
fn without_groups_everything_is_read() {
    let mut text = strip();
    text.names.clear();
    text.entities.clear();
    let mesh = read(&text);
    assert!(mesh.groups.is_empty());
    close(area(&mesh), 2.0);
}

#[test]
fn what_gmsh_would_not_have_saved_is_left_out_with_its_points() {
    let mut text = strip();
    text.entities.push((2, 2, vec![]));
    text.blocks[3].entity = 2;
    text.blocks[1].elements.pop();
    let mesh = read(&text);
    assert_eq!((mesh.cells.len(), mesh.points.len()), (1, 4));
    close(area(&mesh), 1.0);
}

/// The fault of a group of a mesh that is read all the same.
fn fault(text: &MeshText, name: &str) -> String {
    match &read(text).groups[name] {
        Group::Unusable { what, help, .. } => format!("{what}; {help}"),
        other => panic!("{name} is usable: {other:?}"),
    }
}

#[test]
fn groups_of_one_name_are_told_by_their_dimension() {
    let mut text = strip();
    text.names[1].2 = "body".into();
    let mesh = read(&text);
    let [Group::Edges(edges), Group::Cells(cells)] = mesh.groups["body"].each() else {
        panic!("{:?}", mesh.groups["body"])
    };
    assert_eq!((edges.len(), cells.len()), (2, 3));
    text.names[1] = (2, 1, "other".into());
    for name in ["body", "other"] {
        assert!(fault(&text, name).contains("physical surface 1 is called \"other\" and \"body\""));
    }
    text = strip();
    text.names.push((1, 3, "bottom".into()));
    assert!(
        fault(&text, "bottom").contains("physical curve 2 and physical curve 3 are both called \"bottom\"")
    );
}

#[test]
fn groups_without_elements_are_unusable() {
    let mut text = strip();
    text.names.push((1, 9, "top".into()));
    assert!(fault(&text, "top").contains("physical curve \"top\" has no elements"));
    text.names[3] = (3, 9, "solid".into());
    assert!(fault(&text, "solid").contains("physical volume \"solid\""));
}

#[test]
fn curves_and_points_that_hang_on_no_cell_are_unusable() {
    let mut text = strip();
    text.blocks[1].elements[0].1 = vec![1, 5];
    assert!(fault(&text, "bottom").contains("physical curve \"bottom\": element 2 lies on no cell"));
    let mut text = strip();
    text.nodes.push((7, [5.0, 0.0, 0.0]));
    text.blocks[0].elements[0].1 = vec![7];
    assert!(fault(&text, "corner").contains("physical point \"corner\": node 7 lies on no cell"));
    text.blocks[0].elements[0].1 = vec![1];
    assert_eq!(read(&text).points.len(), 6);
}

#[test]
fn repeated_members_are_refused() {
    let mut text = strip();
    text.blocks[1].elements[1].1 = vec![2, 1];
    assert!(
        fault(&text, "bottom").contains("physical curve \"bottom\" holds the edge of elements 2 and 3 twice")
    );
    let mut text = strip();
    text.blocks[0].elements.push((9, vec![1]));
    assert!(fault(&text, "corner").contains("physical point \"corner\" holds the point at [0.0, 0.0] twice"));
    let mut text = strip();
    text.blocks[3].elements.push((9, vec![5, 2, 3]));
    assert!(refusal(&text).contains("elements 5 and 9 lie on the same side of one edge"));
    let mut text = strip();
    text.blocks[3].elements[1].0 = 2;
    assert!(refusal(&text).contains("has element 2 twice"));
    let mut text = strip();
    text.nodes[5].0 = 2;
    assert!(refusal(&text).contains("has node 2 twice"));
}

#[test]
fn nodes_that_do_not_exist_or_lie_nowhere_are_refused() {
    let mut text = strip();
    text.blocks[3].elements[0].1[1] = 77;
    assert!(refusal(&text).contains("element 5 has node 77, which does not exist"));
    for x in [f64::NAN, f64::INFINITY] {
        let mut text = strip();
        text.nodes[3].1[1] = x;
        let binary = from_bytes(Path::new("a.msh"), &text.bytes(Form::Little)).unwrap_err().to_string();
        assert!(binary.contains("node 4 is at 0"), "{binary}");
        assert!(from_bytes(Path::new("a.msh"), &text.bytes(Form::Text)).is_err());
    }
}

#[test]
fn nodes_off_the_plane_are_refused_beyond_rounding() {
    let mut text = strip();
    text.nodes[4].1[2] = -1e-12;
    read(&text);
    text.nodes[4].1[2] = -1e-3;
    assert!(refusal(&text).contains("node 5 is off the plane, |z| = 1e-3"));
}

#[test]
fn cells_without_a_positive_jacobian_are_refused_by_tag() {
    let mut text = strip();
    text.nodes[5].1 = [1.5, 0.5, 0.0]; // onto the edge 3-5
    assert!(refusal(&text).contains("element 6 (T3) near 2, 0 has no area"));
    let mut text = strip();
    text.nodes[1].1 = [0.2, 0.9, 0.0]; // the quadrilateral becomes concave
    assert!(refusal(&text).contains("element 4 (Q4) near 0, 0 is concave or crossed"));
    let mut text = strip();
    text.blocks[2].elements[0].1 = vec![1, 5, 2, 4];
    assert!(refusal(&text).contains("element 4 (Q4)"));
    let mut text = strip();
    text.blocks[2].elements[0].1 = vec![1, 2, 2, 4];
    assert!(refusal(&text).contains("element 4 (Q4) has a node twice"));
}

#[test]
fn other_element_types_are_refused_by_name() {
    for (dim, gmsh_type, nodes, name) in [
        (3, 4, 4, "tetrahedra"),
        (3, 5, 8, "hexahedra"),
        (2, 21, 10, "cubic triangles"),
        (1, 26, 4, "cubic lines"),
        (2, 140, 1, "type 140"),
    ] {
        let mut text = strip();
        let (first, nodes) = (text.nodes[0].0, nodes);
        text.blocks.push(block(dim, 1, gmsh_type, &[(7, &vec![first; nodes])]));
        assert!(refusal(&text).contains(name), "{}", refusal(&text));
    }
    let mut text = strip();
    text.blocks.truncate(2);
    text.names.pop();
    text.entities.pop();
    assert!(refusal(&text).contains("no triangles or quadrilaterals"));
}

#[test]
fn linear_and_quadratic_cells_do_not_meet() {
    let mut text = strip();
    text.nodes.extend([(7, [1.5, 0.0, 0.0]), (8, [1.5, 0.5, 0.0]), (9, [1.0, 0.5, 0.0])]);
    text.blocks[1].elements.pop();
    text.blocks[3] = block(2, 1, 9, &[(5, &[2, 3, 5, 7, 8, 9])]);
    assert!(refusal(&text).contains("elements 4 and 5 share an edge but not its mid-node"));
}

#[test]
fn other_formats_are_refused_with_the_way_out() {
    let change = |from: &str, to: &str| {
        let text = String::from_utf8(strip().bytes(Form::Text)).unwrap().replace(from, to);
        from_bytes(Path::new("old.msh"), text.as_bytes()).unwrap_err().to_string()
    };
    assert_eq!(change("4.1 0 8", "2.2 0 8"), "old.msh: is MSH 2.2; write MSH 4.1 (gmsh -format msh41)");
    assert!(change("4.1 0 8", "4.1 0 4").contains("counts of 4 bytes"));
    assert!(change("$MeshFormat", "solid").contains("is not an MSH file"));
    assert!(change("$Entities", "$PartitionedEntities").contains("is partitioned"));
    assert!(change("2 1 0 6", "2 1 1 6").contains("parametric"));
    assert!(change("4 6 1 6", "4 7 1 6").contains("claims 7 elements and holds 6"));
    assert!(change("1 6 1 6", "1 5 1 6").contains("claims 5 nodes and holds 6"));
    assert!(change("1 6 1 6", "1 9223372036854775808 1 6").contains("more than the file can hold"));
    assert!(change("2 1 3 1 ", "2 1 3 18446744073709551615 ").contains("more than the file can hold"));
}

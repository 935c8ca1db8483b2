//! The element types of gmsh: which shape each number stands for, and the names of those that have no place here.

use super::content::MeshFault;
use crate::shape::Shape;

/// The part of an element in a plane mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ElementKind {
    /// A point.
    Point,
    /// An edge.
    Edge(Shape),
    /// A cell.
    Cell(Shape),
}

impl ElementKind {
    /// The kind of gmsh element type `number`; its name in the refusal if a plane mesh cannot hold it.
    pub(super) fn of(number: i32) -> Result<ElementKind, MeshFault> {
        Ok(match number {
            15 => ElementKind::Point,
            1 => ElementKind::Edge(Shape::Line2),
            8 => ElementKind::Edge(Shape::Line3),
            2 => ElementKind::Cell(Shape::Triangle3),
            9 => ElementKind::Cell(Shape::Triangle6),
            3 => ElementKind::Cell(Shape::Quadrilateral4),
            16 => ElementKind::Cell(Shape::Quadrilateral8),
            10 => ElementKind::Cell(Shape::Quadrilateral9),
            _ => return Err(error_at(number)),
        })
    }

    /// Number of nodes.
    pub(super) fn nodes(self) -> usize {
        match self {
            ElementKind::Point => 1,
            ElementKind::Edge(shape) | ElementKind::Cell(shape) => shape.nodes(),
        }
    }

    /// Dimension of the entities that hold such elements.
    pub(super) fn dim(self) -> i32 {
        match self {
            ElementKind::Point => 0,
            ElementKind::Edge(_) => 1,
            ElementKind::Cell(_) => 2,
        }
    }
}

fn error_at(number: i32) -> MeshFault {
    let (name, solid) = match number {
        4 => ("tetrahedra", true),
        5 => ("hexahedra", true),
        6 => ("prisms", true),
        7 => ("pyramids", true),
        11 => ("10-node tetrahedra", true),
        12 => ("27-node hexahedra", true),
        13 => ("18-node prisms", true),
        14 => ("14-node pyramids", true),
        17 => ("20-node hexahedra", true),
        18 => ("15-node prisms", true),
        19 => ("13-node pyramids", true),
        20 => ("incomplete cubic triangles (9 nodes)", false),
        21 => ("cubic triangles (10 nodes)", false),
        22 => ("incomplete triangles of order 4 (12 nodes)", false),
        23 => ("triangles of order 4 (15 nodes)", false),
        26 => ("cubic lines (4 nodes)", false),
        27 => ("lines of order 4 (5 nodes)", false),
        28 => ("lines of order 5 (6 nodes)", false),
        36 => ("cubic quadrilaterals (16 nodes)", false),
        37 => ("quadrilaterals of order 4 (25 nodes)", false),
        39 => ("incomplete cubic quadrilaterals (12 nodes)", false),
        _ => {
            return MeshFault {
                what: format!("has elements of gmsh type {number}"),
                help: "a plane mesh has triangles and quadrilaterals of order 1 or 2".into(),
            };
        }
    };
    let help = if solid { "mesh the surfaces only (gmsh -2)" } else { "use Mesh.ElementOrder = 1 or 2" };
    MeshFault { what: format!("has {name}"), help: help.into() }
}

//! The element types of gmsh: which shape each number stands for, and the names of those that have no place here.

use super::Fault;
use crate::shape::Shape;

/// What an element is to a plane mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A point.
    Point,
    /// An edge.
    Edge(Shape),
    /// A cell.
    Cell(Shape),
}

impl Kind {
    /// The kind of gmsh element type `number`; its name in the refusal if a plane mesh cannot hold it.
    pub(super) fn of(number: i32) -> Result<Kind, Fault> {
        Ok(match number {
            15 => Kind::Point,
            1 => Kind::Edge(Shape::Line2),
            8 => Kind::Edge(Shape::Line3),
            2 => Kind::Cell(Shape::Triangle3),
            9 => Kind::Cell(Shape::Triangle6),
            3 => Kind::Cell(Shape::Quadrilateral4),
            16 => Kind::Cell(Shape::Quadrilateral8),
            10 => Kind::Cell(Shape::Quadrilateral9),
            _ => return Err(refuse(number)),
        })
    }

    /// Number of nodes.
    pub(super) fn nodes(self) -> usize {
        match self {
            Kind::Point => 1,
            Kind::Edge(shape) | Kind::Cell(shape) => shape.nodes(),
        }
    }

    /// Dimension of the entities that hold such elements.
    pub(super) fn dim(self) -> i32 {
        match self {
            Kind::Point => 0,
            Kind::Edge(_) => 1,
            Kind::Cell(_) => 2,
        }
    }
}

fn refuse(number: i32) -> Fault {
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
            return Fault {
                what: format!("has elements of gmsh type {number}"),
                cure: "a plane mesh has triangles and quadrilaterals of order 1 or 2".into(),
            };
        }
    };
    let cure = if solid { "mesh the surfaces only (gmsh -2)" } else { "use Mesh.ElementOrder = 1 or 2" };
    Fault { what: format!("has {name}"), cure: cure.into() }
}

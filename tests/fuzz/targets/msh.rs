//! Bytes as an MSH file, and what is asked of every mesh.

#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use midplane::mesh;

fuzz_target!(|data: &[u8]| {
    let Ok(mesh) = mesh::from_bytes(Path::new("part.msh"), data) else { return };
    let cells = mesh.cells.len();
    assert!((0..cells).all(|cell| mesh.cells.nodes(cell).iter().all(|&node| node < mesh.points.len())));
    assert!(mesh.points.iter().flatten().all(|x| x.is_finite()));
    for group in mesh.groups.values() {
        assert!(group.points(&mesh).iter().all(|&node| node < mesh.points.len()));
    }
    for cell in 0..cells {
        mesh.quality(cell);
    }
    let _ = mesh.boundary();
    let _ = mesh.pieces();
    let _ = mesh.part(&(0..cells).step_by(2).collect::<Vec<_>>());
});

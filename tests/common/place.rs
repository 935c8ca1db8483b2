//! A folder with a .geo, and programs that stand in for gmsh.

use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

use midplane::error::{Error, Result};
use midplane::mesh::{Gmsh, Job, Meshed, mesh_all};

/// A block 2 × 1 with n × m divisions; the right half may be recombined into quadrilaterals, and the cells quadratic.
///
/// ```text
///   4 ── top ─ 5 ─ top ── 6      physical surface "body", curves "bottom", "top", "left side"
///   │          │          │      and "middle" (2-5), point "corner" (1)
///   1 ─ bottom 2 ─ bottom 3
/// ```
pub const BLOCK: &str = r#"
DefineConstant[ n = {3, Name "Block/n"}, m = 2, order = 1, incomplete = 0, left = 0, right = 0 ];
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {2, 0, 0};
Point(4) = {0, 1, 0}; Point(5) = {1, 1, 0}; Point(6) = {2, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 6}; Line(4) = {6, 5}; Line(5) = {5, 4}; Line(6) = {4, 1};
Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6}; Curve Loop(2) = {2, 3, 4, -7};
Plane Surface(1) = {1}; Plane Surface(2) = {2};
Transfinite Curve{1, 2, 4, 5} = n + 1; Transfinite Curve{3, 6, 7} = m + 1; Transfinite Surface{1, 2};
If (left) Recombine Surface{1}; EndIf
If (right) Recombine Surface{2}; EndIf
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = incomplete;
Physical Surface("body") = {1, 2}; Physical Curve("bottom") = {1, 2}; Physical Curve("top") = {4, 5};
Physical Curve("left side") = {-6}; Physical Curve("middle") = {7}; Physical Point("corner") = {1};
"#;

/// A folder with a .geo in it.
pub struct Place {
    pub folder: tempfile::TempDir,
    pub geo: PathBuf,
}

impl Place {
    pub fn new(name: &str, text: &str) -> Place {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let geo = folder.path().join(name);
        fs::write(&geo, text).expect("a .geo");
        Place { folder, geo }
    }

    pub fn cache(&self) -> PathBuf {
        self.folder.path().join("cache")
    }

    pub fn job(&self, parameters: &[(&str, f64)]) -> Job {
        let parameters = parameters.iter().map(|(name, value)| (name.to_string(), *value)).collect();
        Job { name: "block".into(), geo: self.geo.clone(), parameters }
    }

    pub fn mesh_with(&self, gmsh: &Gmsh, parameters: &[(&str, f64)]) -> Result<Meshed> {
        Ok(mesh_all(gmsh, &self.cache(), &[self.job(parameters)])?.remove(0))
    }

    pub fn mesh(&self, parameters: &[(&str, f64)]) -> Result<Meshed> {
        self.mesh_with(&Gmsh::default(), parameters)
    }

    /// The error of meshing, with nothing left in the cache.
    pub fn refusal(&self, gmsh: &Gmsh, parameters: &[(&str, f64)]) -> Error {
        let error = self.mesh_with(gmsh, parameters).expect_err("meshing must fail");
        let left = fs::read_dir(self.cache()).map_or(0, |entries| entries.count());
        assert_eq!(left, 0, "the cache holds files after {error}");
        error
    }

    pub fn write(&self, name: &str, text: &str) {
        fs::write(self.folder.path().join(name), text).expect("a file beside the .geo");
    }
}

/// A program that stands in for gmsh: answers --version, else runs the script.
pub fn impostor(place: &Place, script: &str) -> Gmsh {
    impostor_of(place, "4.8.4", script)
}

pub fn impostor_of(place: &Place, version: &str, script: &str) -> Gmsh {
    let (draft, program) = (place.folder.path().join("draft"), place.folder.path().join("impostor"));
    let text =
        format!("#!/bin/sh\nif [ \"$1\" = --version ]; then echo {version} >&2; exit 0; fi\n{script}\n");
    fs::write(&draft, text).expect("a script");
    // written by another process: while a program is open for writing here, no thread may start it
    let installed = Command::new("install").args(["-m", "755"]).args([&draft, &program]).status();
    assert!(installed.is_ok_and(|status| status.success()));
    Gmsh::new(program, Duration::from_secs(20))
}

//! Claim: nothing is meshed twice, everything that changes a mesh is noticed, and jobs keep their order.

use std::fs;
use std::path::Path;

use crate::common::mesh_text::edges;
use crate::common::place::{BLOCK, Place, impostor, impostor_of};
use midplane::mesh::{Gmsh, Job, Meshed, mesh_all, read};

#[test]
fn only_what_has_changed_is_meshed_again() {
    let place = Place::new("block.geo", &format!("Include \"sizes.geo\";\n{BLOCK}"));
    place.write("sizes.geo", "Include \"deep.geo\"; // nested");
    place.write("deep.geo", "a = 1;");
    let first = place.mesh(&[]).unwrap();
    assert!(!first.reused);
    assert_eq!(place.mesh(&[]).unwrap(), Meshed { path: first.path.clone(), reused: true });
    let name = first.path.file_name().unwrap().to_str().unwrap();
    let hex = name.strip_prefix("block-").and_then(|rest| rest.strip_suffix(".msh")).unwrap();
    assert!(hex.len() == 12 && hex.chars().all(|c| c.is_ascii_hexdigit()), "{name}");

    let fresh = |what: &str, parameters: &[(&str, f64)]| {
        let meshed = place.mesh(parameters).unwrap();
        assert!(!meshed.reused && meshed.path != first.path, "{what}");
        assert!(place.mesh(parameters).unwrap().reused, "{what}");
    };
    fresh("another parameter", &[("n", 4.0)]);
    fresh("another value, in its last digit", &[("n", 4.000000000000001)]);
    place.write("deep.geo", "a = 2;");
    fresh("a nested include", &[]);
    place.write("deep.geo", "a = 1;");
    assert_eq!(place.mesh(&[]).unwrap(), Meshed { path: first.path.clone(), reused: true });
    place.write("block.geo.opt", "Mesh.Algorithm = 5;");
    fresh("options beside the .geo", &[]);
    fs::remove_file(place.folder.path().join("block.geo.opt")).unwrap();
    fs::write(&place.geo, format!("Include \"sizes.geo\";\n{BLOCK}\n")).unwrap();
    fresh("the .geo", &[]);
    let files = fs::read_dir(place.cache()).unwrap().map(|entry| entry.unwrap().file_name());
    assert!(
        files
            .map(|name| name.into_string().unwrap())
            .all(|name| name.ends_with(".msh") || name.ends_with(".msh.sha256"))
    );
}

#[test]
fn a_mesh_that_is_damaged_is_made_again() {
    let place = Place::new("block.geo", BLOCK);
    let first = place.mesh(&[]).unwrap();
    let good = fs::read(&first.path).unwrap();
    let mut one_bit = good.clone();
    one_bit[good.len() / 2] ^= 1;
    for damaged in [&good[..good.len() / 2], &one_bit, b""] {
        fs::write(&first.path, damaged).unwrap();
        assert_eq!(place.mesh(&[]).unwrap(), Meshed { path: first.path.clone(), reused: false });
        assert!(fs::read(&first.path).unwrap() == good);
        assert!(place.mesh(&[]).unwrap().reused);
    }
}

#[test]
fn a_hit_does_not_start_the_mesher_and_another_version_does() {
    let place = Place::new("block.geo", BLOCK);
    let through = impostor(&place, "exec gmsh \"$@\"");
    assert!(!place.mesh_with(&through, &[]).unwrap().reused);
    let closed = impostor(&place, "exit 9");
    assert!(place.mesh_with(&closed, &[]).unwrap().reused);
    let newer = impostor_of(&place, "4.13.1", "exec gmsh \"$@\"");
    assert_eq!(newer.version().unwrap(), "4.13.1");
    assert!(!place.mesh_with(&newer, &[]).unwrap().reused);
}

#[test]
fn what_a_geo_fetches_from_elsewhere_is_meshed_every_time() {
    let place =
        Place::new("block.geo", &format!("name = Str(\"sizes\"); Include StrCat(name, \".geo\");\n{BLOCK}"));
    place.write("sizes.geo", "a = 1;");
    assert!(!place.mesh(&[]).unwrap().reused);
    assert!(!place.mesh(&[]).unwrap().reused);
}

#[test]
fn jobs_keep_their_order_and_the_first_error_counts() {
    let place = Place::new("block.geo", BLOCK);
    let jobs: Vec<Job> = (1..=6).map(|n| place.job(&[("n", f64::from(n))])).collect();
    let meshed = mesh_all(&Gmsh::default(), &place.cache(), &jobs).unwrap();
    for (n, meshed) in (1..).zip(&meshed) {
        let mesh = read(&meshed.path).unwrap();
        assert_eq!(edges(&mesh, "bottom").len(), 2 * n);
    }
    let mut jobs = jobs;
    jobs[2].geo = Path::new("first.geo").into();
    jobs[4].geo = Path::new("second.geo").into();
    let error = mesh_all(&Gmsh::default(), &place.cache(), &jobs).unwrap_err();
    assert!(error.to_string().contains("first.geo"), "{error}");
}

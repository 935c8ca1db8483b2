//! Claim: the real gmsh makes every kind of cell that is read, whatever the options of the user, and each way in which it fails is told
//! with its own words.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::mesh_text::{area, close, edges, keeps_its_promises, length};
use crate::common::place::{BLOCK, Place, impostor};
use midplane::error::Error;
use midplane::mesh::{Gmsh, Group, Job, Mesh, is_earlier_format, mesh_all, read};
use midplane::shape::Shape;

fn check_block(mesh: &Mesh, quadratic: bool) {
    keeps_its_promises(mesh);
    close(area(mesh), 2.0);
    let sides = [("bottom", 2.0, true), ("top", 2.0, true), ("left side", 1.0, true), ("middle", 1.0, false)];
    for (name, expected, boundary) in sides {
        // gmsh places nodes along a curve to about 1e-12
        assert!((length(mesh, name) - expected).abs() < 1e-10, "{name}");
        let edges = edges(mesh, name);
        for edge in edges {
            assert_eq!(edge.boundary, boundary, "{name}");
            assert_eq!(edge.shape.is_quadratic(), quadratic);
        }
    }
    // with the body on its left the bottom runs along +x and the top along -x
    for (name, direction) in [("bottom", 1.0), ("top", -1.0)] {
        let edges = edges(mesh, name);
        assert!(
            edges
                .iter()
                .all(|e| direction * (mesh.points[e.nodes()[1]][0] - mesh.points[e.nodes()[0]][0]) > 0.0)
        );
    }
    assert!(matches!(&mesh.groups["corner"], Group::Points(points) if mesh.points[points[0]] == [0.0; 3]));
}

#[test]
fn every_kind_of_cell_is_meshed_and_read() {
    use Shape::{Quadrilateral4, Quadrilateral8, Quadrilateral9, Triangle3, Triangle6};
    const N: usize = 5;
    const M: usize = 3;
    // points of a transfinite block with 2 n × m divisions, of order 1 and 2; Q8 has none at its centres
    let (linear, quadratic) = ((2 * N + 1) * (M + 1), (4 * N + 1) * (2 * M + 1));
    let (quads, triangles) = (N * M, 2 * N * M);
    let cases = [
        ([1.0, 0.0, 0.0, 0.0], Triangle3, Triangle3, linear),
        ([2.0, 0.0, 0.0, 0.0], Triangle6, Triangle6, quadratic),
        ([1.0, 0.0, 1.0, 1.0], Quadrilateral4, Quadrilateral4, linear),
        ([2.0, 1.0, 1.0, 1.0], Quadrilateral8, Quadrilateral8, quadratic - 2 * quads),
        ([2.0, 0.0, 1.0, 1.0], Quadrilateral9, Quadrilateral9, quadratic),
        ([1.0, 0.0, 0.0, 1.0], Triangle3, Quadrilateral4, linear),
        ([2.0, 0.0, 0.0, 1.0], Triangle6, Quadrilateral9, quadratic),
        ([2.0, 1.0, 0.0, 1.0], Triangle6, Quadrilateral8, quadratic - quads),
    ];
    let place = Place::new("block.geo", BLOCK);
    let jobs: Vec<Job> = cases
        .iter()
        .map(|([order, incomplete, left, right], ..)| {
            let kind = [("order", *order), ("incomplete", *incomplete), ("left", *left), ("right", *right)];
            place.job(&[&kind[..], &[("n", N as f64), ("m", M as f64)]].concat())
        })
        .collect();
    let meshed = mesh_all(&Gmsh::default(), &place.cache(), &jobs).unwrap();
    for ((_, left, right, points), meshed) in cases.iter().zip(&meshed) {
        let mesh = read(&meshed.path).unwrap();
        check_block(&mesh, left.is_quadratic());
        assert_eq!(mesh.points.len(), *points, "{left:?} and {right:?}");
        let count = |shape: &Shape| mesh.cells.shapes.iter().filter(|s| *s == shape).count();
        let expected = |shape: &Shape| if shape.corners() == 3 { triangles } else { quads };
        assert_eq!(
            count(left) + if left == right { 0 } else { count(right) },
            expected(left) + expected(right)
        );
        assert!(count(left) >= expected(left) && count(right) >= expected(right));
    }
}

#[test]
fn text_and_sparsely_numbered_files_of_gmsh_are_read() {
    let place = Place::new("block.geo", BLOCK);
    for (order, right) in [("1", "0"), ("2", "1")] {
        for options in [&[][..], &["-bin"], &["-setnumber", "Mesh.Renumber", "0"], &["-save_all"]] {
            let path = place.folder.path().join("mesh.msh");
            let ended = Command::new("gmsh")
                .arg(&place.geo)
                .args([
                    "-2",
                    "-format",
                    "msh41",
                    "-setnumber",
                    "order",
                    order,
                    "-setnumber",
                    "right",
                    right,
                    "-o",
                ])
                .arg(&path)
                .args(options)
                .stdout(Stdio::null())
                .status()
                .unwrap();
            assert!(ended.success());
            check_block(&read(&path).unwrap(), order == "2");
        }
    }
}

#[test]
fn curved_edges_follow_the_circle() {
    // a quarter disc of radius 1: with k quadratic edges on the arc the area misses π/4 by the fourth power of the edge
    let geo = r#"
        DefineConstant[ k = 4 ];
        Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {0, 1, 0};
        Line(1) = {1, 2}; Circle(2) = {2, 1, 3}; Line(3) = {3, 1}; Curve Loop(1) = {1:3}; Plane Surface(1) = {1};
        Transfinite Curve{1:3} = k + 1; Mesh.ElementOrder = 2;
        Physical Surface("disc") = {1}; Physical Curve("arc") = {2};
    "#;
    let place = Place::new("disc.geo", geo);
    let miss = |k: f64| {
        let mesh = read(&place.mesh(&[("k", k)]).unwrap().path).unwrap();
        keeps_its_promises(&mesh);
        (area(&mesh) - std::f64::consts::FRAC_PI_4).abs()
    };
    let (coarse, fine) = (miss(4.0), miss(8.0));
    assert!(coarse < 1e-4 && fine < coarse / 12.0, "{coarse} {fine}");
}

#[test]
fn awkward_file_names_are_only_names() {
    for name in
        ["-a b.geo", "it's.geo", "say \"a\".geo", "two\nlines.geo", "a;b $HOME `x` *.geo", "größe 界.geo"]
    {
        let place = Place::new(name, BLOCK);
        let mut job = place.job(&[]);
        job.name = "../odd name".into();
        let meshed = mesh_all(&Gmsh::default(), &place.cache(), &[job]).unwrap();
        check_block(&read(&meshed[0].path).unwrap(), false);
        assert_eq!(meshed[0].path.parent().unwrap(), place.cache());
    }
}

#[test]
fn what_gmsh_refuses_is_bad_input_with_its_own_words() {
    let gmsh = Gmsh::default();
    let cases = [
        ("a syntax error", BLOCK.replace("Line(7)", "Lime(7)"), "gmsh ended with exit code 1"),
        (
            "an unknown variable",
            BLOCK.replace("Point(1) = {0, 0", "Point(1) = {0, zero"),
            "Unknown variable 'zero'",
        ),
        ("a missing include", format!("Include \"none.geo\";{BLOCK}"), "none.geo"),
        ("a missing merge", format!("Merge \"none.step\";{BLOCK}"), "none.step"),
        ("an error of its own", format!("Error(\"not like this\");{BLOCK}"), "not like this"),
        ("an early end", format!("Exit;{BLOCK}"), "wrote no mesh"),
        (
            "crossing lines",
            BLOCK.replace("Point(5) = {1, 1", "Point(5) = {3, 0.5").replace("Transfinite", "//"),
            "gmsh ended with exit code 1",
        ),
    ];
    for (case, text, expected) in cases {
        let place = Place::new("bad.geo", &text);
        let error = place.refusal(&gmsh, &[]);
        assert!(matches!(error, Error::Gmsh { .. }) && error.exit_code() == 2, "{case}: {error}");
        let message = error.to_string();
        assert!(message.contains("bad.geo: gmsh ") && message.contains(expected), "{case}: {message}");
    }
}

#[test]
fn what_gmsh_passes_over_in_silence_is_refused() {
    let gmsh = Gmsh::default();
    let cases = [
        (
            "a surface that does not exist",
            BLOCK.replace("\"body\") = {1, 2}", "\"body\") = {3}"),
            "\"body\" has no elements",
        ),
        (
            "no surface",
            BLOCK.replace("Physical Surface(\"body\") = {1, 2};", ""),
            "no triangles or quadrilaterals",
        ),
        ("nothing", String::new(), "no triangles or quadrilaterals"),
        ("an abort", format!("Abort;{BLOCK}"), "no triangles or quadrilaterals"),
        (
            "the third dimension",
            BLOCK.replace("Point(6) = {2, 1, 0}", "Point(6) = {2, 1, 1}"),
            "off the plane",
        ),
        ("cubic cells", BLOCK.replace("= order;", "= 3;"), "cubic"),
    ];
    for (case, text, expected) in cases {
        let place = Place::new("silent.geo", &text);
        let error = place.refusal(&gmsh, &[]);
        let message = error.to_string();
        assert!(error.exit_code() == 2 && message.contains("silent.geo: "), "{case}: {message}");
        assert!(message.contains(expected), "{case}: {message}");
    }
}

#[test]
fn a_parameter_that_the_geo_does_not_know_is_refused() {
    let place = Place::new("block.geo", BLOCK);
    let gmsh = Gmsh::default();
    let message = place.refusal(&gmsh, &[("ordre", 2.0)]).to_string();
    assert!(
        message.contains("no parameter \"ordre\"") && message.contains("Did you mean \"order\"?"),
        "{message}"
    );
    assert!(place.refusal(&gmsh, &[("n", f64::NAN)]).to_string().contains("cannot take n = NaN"));
    assert!(place.refusal(&gmsh, &[("Mesh.Binary", 0.0)]).to_string().contains("no parameter"));
    let place = Place::new("block.geo", &format!("size = 1;{BLOCK}"));
    assert!(place.refusal(&gmsh, &[("size", 2.0)]).to_string().contains("DefineConstant[ size = ... ]"));
}

#[test]
fn parameters_reach_gmsh_with_every_digit() {
    let geo = BLOCK.replace("Point(3) = {2, 0, 0}", "DefineConstant[ x = 2 ]; Point(3) = {x, 0, 0}");
    let place = Place::new("block.geo", &geo);
    for x in [0.1 + 0.2 + 1.0, 1.0 + 1.0 / 3.0, 1e3] {
        let mesh = read(&place.mesh(&[("x", x)]).unwrap().path).unwrap();
        assert!(mesh.points.contains(&[x, 0.0, 0.0]), "{x}");
    }
}

#[test]
fn a_missing_geo_is_bad_input() {
    let place = Place::new("block.geo", BLOCK);
    fs::remove_file(&place.geo).unwrap();
    let error = place.refusal(&Gmsh::default(), &[]);
    assert!(matches!(error, Error::Io { action: "read", .. }) && error.exit_code() == 2, "{error}");
}

#[test]
fn a_missing_gmsh_is_a_fault_of_the_environment() {
    let place = Place::new("block.geo", BLOCK);
    for program in [PathBuf::from("no-such-gmsh"), place.folder.path().join("gmsh"), place.geo.clone()] {
        let error = place.refusal(&Gmsh::new(&program, Duration::from_secs(20)), &[]);
        assert!(matches!(error, Error::Program { .. }) && error.exit_code() == 4, "{error}");
    }
}

#[test]
fn a_gmsh_that_hangs_is_stopped() {
    let place = Place::new("block.geo", BLOCK);
    impostor(&place, "echo 'Info    : Meshing surface 1'; exec sleep 600");
    let start = Instant::now();
    let error =
        place.refusal(&Gmsh::new(place.folder.path().join("impostor"), Duration::from_millis(500)), &[]);
    assert!(start.elapsed() < Duration::from_secs(60));
    assert!(error.exit_code() == 4, "{error}");
    assert!(
        error.to_string().contains("still running after 0.5 s")
            && error.to_string().contains("Meshing surface 1"),
        "{error}"
    );
}

#[test]
fn a_gmsh_that_is_killed_or_talks_without_end_is_no_danger() {
    let place = Place::new("block.geo", BLOCK);
    let error = place.refusal(&impostor(&place, "kill -9 $$"), &[]);
    assert!(error.exit_code() == 4 && error.to_string().contains("was killed by signal 9"), "{error}");
    // far more than a pipe holds
    let error = place.refusal(&impostor(&place, "seq 1 100000; seq 1 100000 >&2; exit 3"), &[]);
    assert!(error.exit_code() == 2 && error.to_string().contains("exit code 3"), "{error}");
    let error = place.refusal(&impostor(&place, "exit 0"), &[]);
    assert!(error.to_string().contains("wrote no mesh"), "{error}");
}

#[test]
fn options_of_the_user_do_not_change_the_mesh() {
    let place = Place::new("block.geo", BLOCK);
    let home = place.folder.path();
    place.write(".gmshrc", "Mesh.ElementOrder = 2; Mesh.Binary = 0; Error(\"read\");");
    let through = impostor(&place, &format!("export HOME='{}'; exec gmsh \"$@\"", home.display()));
    check_block(&read(&place.mesh_with(&through, &[]).unwrap().path).unwrap(), false);
}

#[test]
fn options_of_the_geo_do_not_change_the_format() {
    // every one of them makes the file unreadable, or the mesh another one, if it is in force when gmsh writes
    for option in [
        "Mesh.MshFileVersion = 2.2;",
        "Mesh.Format = 2;",
        "Mesh.Binary = 0;",
        "Mesh.SaveAll = 1;",
        "Mesh.SaveParametric = 1;",
        "Mesh.Renumber = 0;",
        "General.NumThreads = 4;",
    ] {
        let half = BLOCK
            .replace("\"body\") = {1, 2}", "\"body\") = {1}")
            .replace("\"top\") = {4, 5}", "\"top\") = {5}");
        let half = half.replace("\"bottom\") = {1, 2}", "\"bottom\") = {1}");
        let place = Place::new("block.geo", &format!("{option}\n{half}{option}\n"));
        let path = place.mesh(&[]).unwrap_or_else(|error| panic!("{option}: {error}")).path;
        let bytes = fs::read(&path).unwrap();
        assert!(bytes.starts_with(b"$MeshFormat\n4.1 1 8\n"), "{option}");
        let mesh = read(&path).unwrap();
        close(area(&mesh), 1.0); // the half that the group "body" holds
        let bare = Place::new("block.geo", &half);
        assert!(fs::read(bare.mesh(&[]).unwrap().path).unwrap() == bytes, "{option} changes the mesh");
    }
}

#[test]
fn the_last_line_is_executed_without_its_newline() {
    // gmsh 4.8 skips all but the first statement of such a line, in the .geo and in what it includes
    let split = BLOCK.find("Mesh.ElementOrder").unwrap();
    let (shape, rest) = (&BLOCK[..split], BLOCK[split..].trim_end().replace('\n', " "));
    let nested = "Include \"sub/../tail.geo\"; Physical Point(\"corner\") = {1};";
    let tail = rest.replace("Physical Point(\"corner\") = {1};", "");
    for (main, include) in [
        (format!("{shape}{rest}"), String::new()),
        (format!("{shape}\nn = n; Include \"tail.geo\";\n"), rest.clone()),
        (format!("{shape}\nn = n; {nested}"), tail.clone()),
        (format!("{shape}\nn = n; {}", nested.replace("sub/..", "../FOLDER")), tail.clone()),
        (format!("{shape}\nn = n; Include StrCat(\"ta\", \"il.geo\"); Mesh 2;"), format!("{rest}\n")),
    ] {
        let place = Place::new("block.geo", "");
        fs::create_dir(place.folder.path().join("sub")).unwrap();
        let own = place.folder.path().file_name().unwrap().to_string_lossy().into_owned();
        let main = main.replace("FOLDER", &own);
        place.write("block.geo", &main);
        place.write("tail.geo", &include);
        let mesh =
            read(&place.mesh(&[("order", 2.0)]).unwrap_or_else(|e| panic!("{main}: {e}")).path).unwrap();
        check_block(&mesh, true);
        assert_eq!(fs::read_to_string(&place.geo).unwrap(), main, "the user's file is left alone");
        assert_eq!(fs::read_to_string(place.folder.path().join("tail.geo")).unwrap(), include);
    }
    // and what gmsh says of a copy names the file itself
    let place = Place::new("bad.geo", &format!("{shape}\nn = n; Point(9) = {{0, zero, 0}};"));
    let message = place.refusal(&Gmsh::default(), &[]).to_string();
    let named = format!("'{}', line", place.geo.display());
    assert!(message.contains(&named) && message.contains("Unknown variable 'zero'"), "{message}");
}

#[test]
fn the_first_error_is_shown_and_its_echoes_counted() {
    let points: String = (20..60).map(|i| format!("Point({i}) = {{{i}, 9, 0, lc}};\n")).collect();
    let place = Place::new("block.geo", &format!("Include \"params.geo\";\n{points}{BLOCK}"));
    let message = place.refusal(&Gmsh::default(), &[]).to_string();
    let first = format!("Unable to open file '{}'", place.folder.path().join("params.geo").display());
    assert!(message.contains(&first), "{message}");
    assert_eq!(message.matches("Unknown variable 'lc'").count(), 1, "{message}");
}

#[test]
fn a_crash_names_the_file_the_stage_and_the_signal() {
    let place = Place::new("block.geo", BLOCK);
    for (signal, name, help) in [
        (11, "segmentation fault", "another Mesh.Algorithm may work"),
        (6, "abort", "another Mesh.Algorithm may work"),
        (9, "kill", "was it short of memory?"),
        (15, "termination", "something else ended it"),
    ] {
        let script = format!("echo 'Info    : Meshing surface 1 (Plane, Frontal)'; kill -{signal} $$");
        let error = place.refusal(&impostor(&place, &script), &[]);
        let program = place.folder.path().join("impostor");
        let expected = format!(
            "{}: {} was killed by signal {signal} ({name}) while \"Meshing surface 1 (Plane, Frontal)\"; ",
            place.geo.display(),
            program.display()
        );
        let message = error.to_string();
        assert!(
            error.exit_code() == 4 && message.starts_with(&expected) && message.contains(help),
            "{message}"
        );
    }
}

#[test]
fn meshes_of_earlier_formats_are_converted() {
    for (order, incomplete) in [(1.0, 0.0), (2.0, 0.0), (2.0, 1.0)] {
        let place = Place::new("block.geo", BLOCK);
        let kind = [("order", order), ("incomplete", incomplete), ("right", 1.0)];
        let direct = read(&place.mesh(&kind).unwrap().path).unwrap();
        for (format, options) in [("msh22", &[][..]), ("msh22", &["-bin"]), ("msh40", &[])] {
            let old = place.folder.path().join("old.msh");
            let mut gmsh = Command::new("gmsh");
            gmsh.arg(&place.geo).args(["-2", "-format", format, "-o"]).arg(&old).args(options);
            for (name, value) in kind {
                gmsh.args(["-setnumber", name, &value.to_string()]);
            }
            assert!(gmsh.stdout(Stdio::null()).status().unwrap().success());
            assert!(is_earlier_format(&old).unwrap());
            assert!(read(&old).unwrap_err().to_string().contains("is MSH "));
            let job = Job { name: "old".into(), geo: old.clone(), parameters: Vec::new() };
            let path = mesh_all(&Gmsh::default(), &place.cache(), &[job]).unwrap().remove(0).path;
            assert!(!is_earlier_format(&path).unwrap());
            let mesh = read(&path).unwrap();
            check_block(&mesh, order == 2.0);
            assert_eq!(mesh.points.len(), direct.points.len(), "{format}");
            assert_eq!(mesh.groups.len(), direct.groups.len(), "{format}");
        }
    }
}

#[test]
fn groups_with_a_fault_are_no_reason_to_refuse_the_mesh() {
    let cases = [
        ("bottom", BLOCK.replace("\"bottom\") = {1, 2}", "\"bottom\") = {8}"), "\"bottom\" has no elements"),
        ("top", format!("{BLOCK} Physical Curve(\"later\") = {{}};\n"), ""),
        (
            "bottom",
            BLOCK.replace("{1, 2}; Physical Curve(\"bottom\")", "{1}; Physical Curve(\"bottom\")"),
            "\"bottom\": element",
        ),
        (
            "sensor",
            format!("{BLOCK} Point(9) = {{1, 5, 0}}; Physical Point(\"sensor\") = {{9}};\n"),
            "lies on no cell",
        ),
        ("7", format!("{BLOCK} Physical Curve(7) = {{3}}; Physical Surface(7) = {{1}};\n"), ""),
    ];
    for (name, text, expected) in cases {
        let place = Place::new("block.geo", &text);
        let mesh = read(&place.mesh(&[]).unwrap_or_else(|e| panic!("{name}: {e}")).path).unwrap();
        keeps_its_promises(&mesh);
        match &mesh.groups[name] {
            Group::Unusable { what, .. } => {
                assert!(!expected.is_empty() && what.contains(expected), "{what}")
            }
            other => assert!(expected.is_empty(), "{name} is usable: {other:?}"),
        }
    }
}

//! Claim: Coulomb friction on a mesh agrees with its closed forms: a uniform block in cycles, a rigid block pushed above
//! its base, a bar pulled over a frictional base, and what cannot be held is not.

use crate::common::*;
use midplane::error::Error;
use midplane::history::ModelState;
use midplane::mesh::Mesh;
use midplane::problem::Problem;
use midplane::shape::Shape;

const SLIP: u8 = 2;

/// A block from `y` to `y` + `height` above x from 0 to `width`.
fn block(width: f64, y: f64, height: f64, n: usize, rows: usize, shape: Shape) -> Mesh {
    even_block([0.0, width], [y, y + height], [n, rows], shape)
}

/// Two bodies with friction; `young` of the lower and upper one, `law` [K_N, K_T, μ].
fn scene(young: [f64; 2], [kn, kt, mu]: [f64; 3], coupling: &str, steps: &[Step]) -> Scene {
    Scene::new("strain")
        .subdomain("lower", "base")
        .subdomain("upper", "block")
        .material("base", young[0], 0.0)
        .material("block", young[1], 0.0)
        .interface("joint", faces("lower.top", "upper.bottom").coupling(coupling).law(coulomb(kn, kt, mu)))
        .steps(steps.to_vec())
}

/// Length that slides, over the whole.
fn sliding(problem: &Problem, state: &ModelState) -> f64 {
    let points = problem.model.interfaces[0].coupling.points.iter().zip(&state.snapshot.states[0]);
    let slides = points.filter(|(_, state)| state.status == SLIP).map(|(point, _)| point.weight);
    slides.sum::<f64>() / problem.model.interfaces[0].coupling.midplane.length
}

#[test]
fn a_uniform_block_in_cycles() {
    let (kt, mu) = (1e4, 0.6);
    let slide = |name: &str, x: f64| step(name).increments(7).displace("upper", "x", x);
    let press = step("press").fix("lower", "x").fix("lower.bottom", "y");
    let steps = [
        press.displace("upper", "x", 0).pressure("upper.top", 2),
        slide("right", 3e-4),
        slide("left", -3e-4),
        slide("right again", 3e-4),
        slide("lift", 3e-4).pressure("upper.top", 1),
        slide("left again", -1e-4),
    ];
    // (σ, τ, slip, dissipated) at the ends of the steps
    let exact = [
        (-2.0, 1.2, 1.8e-4, 2.16e-4),
        (-2.0, -1.2, -1.8e-4, 6.48e-4),
        (-2.0, 1.2, 1.8e-4, 1.08e-3),
        (-1.0, 0.6, 2.4e-4, 1.134e-3),
        (-1.0, -0.6, -4e-5, 1.302e-3),
    ];
    for (shape, coupling) in [(Shape::Quadrilateral4, "projected"), (Shape::Triangle3, "pointwise")] {
        let scene = scene([1e5, 1e5], [2e4, kt, mu], coupling, &steps);
        let width = 0.6;
        let meshes = vec![block(width, -0.2, 0.2, 3, 2, shape), block(width, 0.0, 0.2, 4, 2, shape)];
        let problem = scene.bind(meshes).unwrap();
        let (states, totals) = solve(&problem);
        assert!(totals.energy_balance < 5e-3, "balance {:e}", totals.energy_balance);
        assert_eq!(totals.factorisations, 1);
        for (i, (sigma, tau, slip, dissipated)) in exact.into_iter().enumerate() {
            let state = &states[7 * (i + 1)];
            let what = format!("{shape:?} {coupling}, end of step {}", i + 1);
            for point in &state.snapshot.states[0] {
                close(point.traction.x, sigma, 1e-10, sigma, &what);
                close(point.traction.y, tau, 1e-10, tau, &what);
                close(point.jump_plastic.y, slip, 1e-10, slip, &what);
            }
            close(state.dissipated / width, dissipated, 1e-9, dissipated, &what);
        }
    }
}

#[test]
fn a_rigid_block_pushed_above_its_base() {
    let (n, h, arm, length) = (4.0, 1.6, 0.25, 2.0);
    let (kn, kt, mu) = (2000.0, 1000.0, 0.5);
    let steps = [
        step("press").fix("lower", "xy").pressure("upper.top", n / length),
        step("push").increments(16).traction("upper.left", h / (2.0 * arm), 0),
    ];
    for (stiff, tolerance) in [(1e3, 1e-3), (1e5, 2e-5)] {
        for coupling in ["projected", "pointwise"] {
            let young = stiff * kn * length;
            let scene = scene([young, young], [kn, kt, mu], coupling, &steps);
            let edges = 200;
            let shape = Shape::Quadrilateral4;
            let meshes = vec![
                block(length, -0.1, 0.1, edges * 4 / 5, 1, shape),
                block(length, 0.0, 2.0 * arm, edges, 4, shape),
            ];
            let problem = scene.bind(meshes).unwrap();
            let (states, totals) = solve(&problem);
            let what = format!("E = {stiff} K_N L, {coupling}");
            assert!(totals.energy_balance < 5e-3, "{what}: balance {:e}", totals.energy_balance);
            let state = &states[16];
            let points = &problem.model.interfaces[0].coupling.points;
            let sum = |c: usize| {
                points.iter().zip(&state.snapshot.tractions[0]).map(|(p, t)| p.weight * t[c]).sum::<f64>()
            };
            close(sum(0), -n, 1e-9, n, &what);
            close(sum(1), h, 1e-9, h, &what);
            let jump = points.iter().zip(&state.snapshot.jumps[0]).map(|(p, r)| p.weight * r[1]).sum::<f64>()
                / length;
            close(jump, 0.0008101020514, tolerance, jump, &what);
            close(sliding(&problem, state), 0.1835034191, 1.0, 1.0 / (edges * 4 / 5) as f64, &what);
            // first slip at the heel
            let first = 1.454545455;
            for (i, state) in states.iter().enumerate().skip(1) {
                let push = h * i as f64 / 16.0;
                assert_eq!(sliding(&problem, state) > 0.0, push > first, "{what} at H = {push}");
            }
        }
    }
}

#[test]
fn a_bar_pulled_over_a_frictional_base() {
    let (young, height, length, kt, mu, p, force) = (1e4, 0.01, 0.5, 1000.0, 0.5, 2.0, 0.42);
    let kn = 1e5;
    let steps = [
        step("press").fix("lower", "xy").displace("upper", "y", -p / kn),
        step("pull").increments(21).traction("upper.right", force / height, 0),
    ];
    for coupling in ["projected", "pointwise"] {
        let scene = scene([young, young], [kn, kt, mu], coupling, &steps);
        let edges = 160;
        let shape = Shape::Quadrilateral4;
        let meshes = vec![
            block(length, -0.01, 0.01, edges * 3 / 4, 1, shape),
            block(length, 0.0, height, edges, 2, shape),
        ];
        let problem = scene.bind(meshes).unwrap();
        let (states, totals) = solve(&problem);
        assert!(totals.energy_balance < 5e-3, "{coupling}: balance {:e}", totals.energy_balance);
        let state = &states[21];
        let end = group(&problem, 1, "right");
        let u =
            end.iter().map(|&node| displacement(&problem, state, 1, node)[0]).sum::<f64>() / end.len() as f64;
        close(u, 0.001584153054, 2e-3, u, coupling);
        close(
            sliding(&problem, state) * length,
            0.1759315891,
            1.0,
            length / (edges * 3 / 4) as f64,
            coupling,
        );
        let first = 0.2905436073;
        let slid = states.iter().skip(1).position(|state| sliding(&problem, state) > 0.0).unwrap();
        // the first law point lies a little inside the end
        close(force * (slid + 1) as f64 / 21.0, first, 1.0, 1.5 * force / 21.0, coupling);
    }
}

#[test]
fn more_than_friction_can_hold_is_no_equilibrium() {
    let (width, mu, pressure) = (0.6, 0.6, 2.0);
    let limit = mu * pressure * width;
    for (push, holds) in [(0.999, true), (1.001, false)] {
        let steps = [
            step("press").fix("lower", "xy").pressure("upper.top", pressure),
            step("push").increments(4).traction("upper.bottom", push * limit / width, 0),
        ];
        for coupling in ["projected", "pointwise"] {
            let scene = scene([1e5, 1e5], [2e4, 1e4, mu], coupling, &steps);
            let shape = Shape::Quadrilateral4;
            let meshes = vec![block(width, -0.2, 0.2, 3, 2, shape), block(width, 0.0, 0.2, 4, 2, shape)];
            let problem = scene.bind(meshes).unwrap();
            let march = try_solve(&problem);
            match march.end {
                Ok(_) => assert!(holds, "{coupling}: holds {push} of the limit"),
                Err(Error::NoEquilibrium { step, increment, reason, kept }) => {
                    assert!(!holds, "{coupling}: {reason}");
                    assert_eq!((step.as_str(), increment), ("push", 4));
                    assert_eq!(kept, march.states.len());
                    assert!(reason.contains("joint at ("), "{reason}");
                    // what converged: all below the limit, up to a thousandth of the increment short of it
                    let reached = march.load_factors[march.load_factors.len() - 1] * push;
                    assert!(reached <= 1.0 && reached > 1.0 - 1e-3, "{coupling}: {reached}");
                }
                Err(other) => panic!("{other}"),
            }
        }
    }
}

/// A block that is carried off stores, dissipates and works nothing: rounding over rounding is no error of the energies.
#[test]
fn energies_of_nothing_are_in_balance() {
    let turn = rotation(30.0);
    let blocks = [(-0.2, 3), (0.0, 4)]
        .map(|(y, n)| rectangle(&even(0.0, 0.6, n), &even(y, y + 0.2, 2), Shape::Quadrilateral4, turn));
    let steps = [step("away")
        .increments(3)
        .fix("lower.bottom", "xy")
        .displace("upper.top", "x", 3e-4)
        .displace("upper.top", "y", 7e-4)];
    let scene = scene([3e4, 3e4], [1e5, 1e5, 0.5], "projected", &steps);
    let (states, _) = solve(&scene.bind(blocks.to_vec()).unwrap());
    for state in states {
        assert!(state.stored + state.dissipated + state.work.abs() < 1e-15, "{}", state.work);
        assert!(state.energy_balance().abs() < 1e-2, "{}", state.energy_balance());
    }
}

/// All points slide at once at T = μ N, whatever the increments: the last equilibrium is at most a thousandth of one below it.
#[test]
fn the_limit_of_an_interface_that_slides_at_once_is_met_in_any_increments() {
    let (width, mu, pressure, push) = (0.6, 0.6, 2.0, 2.9);
    for increments in [1, 3, 4, 7, 9] {
        let steps = [
            step("press").fix("lower", "xy").pressure("upper.top", pressure),
            step("push").increments(increments).traction("upper.bottom", push * mu * pressure, 0),
        ];
        let scene = scene([1e5, 1e5], [2e4, 1e4, mu], "projected", &steps);
        let shape = Shape::Quadrilateral4;
        let problem = scene
            .bind(vec![block(width, -0.2, 0.2, 3, 2, shape), block(width, 0.0, 0.2, 4, 2, shape)])
            .unwrap();
        let march = try_solve(&problem);
        assert!(matches!(march.end, Err(Error::NoEquilibrium { .. })), "{increments}");
        let short = (1.0 / push - march.load_factors[march.load_factors.len() - 1]) * increments as f64;
        assert!((0.0..1e-3).contains(&short), "{increments} increments: {short} of one short");
    }
}

#[test]
fn a_block_that_slides_away_is_no_equilibrium_however_far_it_gets() {
    // the block of the gallery weighs 4 MN and holds a push of 2 MN
    for strategy in ["condensed", "plain"] {
        let folder = tempfile::tempdir().unwrap();
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_midplane"));
        command.arg("run").arg(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("geo/friction_block"));
        command.args(["--set", "/steps/1/load/block.left/traction=[4.2, 0]", "--set"]);
        command.arg(format!("/solution/strategy={strategy}")).arg("-o").arg(folder.path().join("out"));
        let output = command.output().unwrap();
        assert_eq!(output.status.code(), Some(3), "{strategy}: {}", String::from_utf8_lossy(&output.stderr));
        let text = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
        let names: Vec<&str> = text.lines().next().unwrap().split(',').collect();
        let at = |name: &str| names.iter().position(|&column| column == name).unwrap();
        let last: Vec<&str> = text.lines().last().unwrap().split(',').collect();
        let value = |name: &str| last[at(name)].parse::<f64>().unwrap();
        assert!(value("push") > 1.999 && value("push") < 2.0 * (1.0 + 1e-9), "{strategy}: {}", value("push"));
        assert!(value("energy_balance").abs() < 5e-3, "{strategy}");
    }
}

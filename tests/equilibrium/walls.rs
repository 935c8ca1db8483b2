//! Claim: walls of many bricks, each a mesh of its own, come out the same on the displacements of condensed bricks and on all displacements,
//! to 1e-10 of the largest value; bricks that are equal up to a motion are condensed once; under little pressure the wall is pushed to
//! its end.

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use crate::common::*;
use midplane::history::{Clock, Equations, History, Means, ModelState};
use midplane::problem::Problem;
use midplane::run::{Options, prepare};
use midplane::solver::{Continuum, Form, JoinedSubdomains};

fn friction() -> Law {
    coulomb(1e5, 4e4, 0.6)
}

fn mortar() -> Law {
    cracking(1e5, 4e4, [0.05, 0.1, 0.6], [1e-4, 1e-3])
}

/// Nodes of bricks that count as equal are apart by 2e-11 of their size at most, five times as much of a cell's: so much of its stiffness.
const APART: f64 = 1e-10;

/// A block of a geometry: its corners counter-clockwise, and its cells along the first and the second side.
struct Block {
    corners: [[f64; 2]; 4],
    cells: [usize; 2],
}

/// A geometry of blocks `b1`, `b2`, … with sides `b1_1` … `b1_4`.
fn geometry(blocks: &[Block]) -> String {
    let mut geo = String::new();
    for (b, Block { corners, cells }) in (1..).zip(blocks) {
        let n = 4 * b;
        for (i, [x, y]) in corners.iter().enumerate() {
            writeln!(geo, "Point({}) = {{{x}, {y}, 0}};", n + i).unwrap();
        }
        for i in 0..4 {
            writeln!(geo, "Line({}) = {{{}, {}}};", n + i, n + i, n + (i + 1) % 4).unwrap();
            writeln!(geo, "Transfinite Curve {{{}}} = {};", n + i, cells[i % 2] + 1).unwrap();
            writeln!(geo, "Physical Curve(\"b{b}_{}\") = {{{}}};", i + 1, n + i).unwrap();
        }
        writeln!(geo, "Curve Loop({b}) = {{{n}:{}}}; Plane Surface({b}) = {{{b}}};", n + 3).unwrap();
        writeln!(geo, "Transfinite Surface {{{b}}}; Recombine Surface {{{b}}};").unwrap();
        writeln!(geo, "Physical Surface(\"b{b}\") = {{{b}}};").unwrap();
    }
    geo
}

/// Bricks of 0.25 by 0.1 in running bond, half ones at the ends of every second course; those of the lowest and of the top course.
fn wall(courses: usize, bricks: usize) -> (Vec<Block>, [Vec<usize>; 2]) {
    let (mut blocks, mut ends) = (Vec::new(), [Vec::new(), Vec::new()]);
    for course in 0..courses {
        let shift = if course % 2 == 0 { 0.0 } else { 0.125 };
        let edges =
            (0..=bricks + course % 2).map(|k| (0.25 * k as f64 - shift).clamp(0.0, 0.25 * bricks as f64));
        let edges: Vec<f64> = edges.collect();
        let (low, high) = (0.1 * course as f64, 0.1 * (course + 1) as f64);
        for pair in edges.windows(2) {
            let along = if pair[1] - pair[0] > 0.2 { 4 + course % 2 } else { 2 };
            blocks.push(Block {
                corners: [[pair[0], low], [pair[1], low], [pair[1], high], [pair[0], high]],
                cells: [along, 2],
            });
            for (end, there) in [course == 0, course + 1 == courses].into_iter().enumerate() {
                if there {
                    ends[end].push(blocks.len());
                }
            }
        }
    }
    (blocks, ends)
}

/// Writes the scene of blocks that touch.
fn write(folder: &Path, blocks: &[Block], law: &Law, steps: &[Step]) {
    std::fs::write(folder.join("blocks.geo"), geometry(blocks)).unwrap();
    let mut scene = Scene::new("strain").material("brick", 1e4, 0.15).density("brick", 2e-3);
    for b in 1..=blocks.len() {
        let name = format!("b{b}");
        let body = scene::geometry("blocks.geo", "brick").with("surface", name.as_str());
        scene = scene.body(&name, body);
    }
    let joints = between("b*", "b*").law(law.clone());
    scene.interface("joints", joints).steps(steps.to_vec()).with_in("output", "fields", "none").write(folder);
}

/// A side of some blocks.
fn sides(blocks: &[usize], side: usize) -> impl Iterator<Item = String> {
    blocks.iter().map(move |b| format!("b{b}.b{b}_{side}"))
}

/// The weight, with the lower sides of some blocks held.
fn weight(low: &[usize]) -> Step {
    sides(low, 1).fold(step("weight").gravity(0, -9.81), |step, side| step.fix(&side, "xy"))
}

/// A pressure on the upper sides of some blocks.
fn pressed(step: Step, top: &[usize], pressure: f64) -> Step {
    sides(top, 3).fold(step, |step, side| step.pressure(&side, pressure))
}

fn bound(folder: &Path, strategy: &str) -> Problem {
    let options = Options {
        out: Some(folder.join(strategy)),
        settings: vec![format!("solution.strategy={strategy}")],
        ..Options::of(&folder.join("scene.json"))
    };
    prepare(&options, &mut |_| ()).unwrap().problem
}

/// The state after every increment.
fn states(folder: &Path, strategy: &str) -> Vec<ModelState> {
    let problem = bound(folder, strategy);
    let mut clock = Clock::new("test");
    let equations = Equations::new(&problem, Means::default(), &mut clock).unwrap();
    let mut history = History::new(&problem, &equations, clock);
    let mut states = Vec::new();
    while let Some(increment) = history.next().unwrap() {
        if increment.number > 0 {
            states.push(history.state().clone());
        }
    }
    states
}

/// Largest differences of displacements and of tractions, over the largest values.
fn apart(a: &ModelState, b: &ModelState) -> [f64; 2] {
    let largest = |a: &mut dyn Iterator<Item = (f64, f64)>| {
        let (difference, largest) = a.fold((0.0_f64, f64::MIN_POSITIVE), |(difference, largest), (a, b)| {
            (difference.max((a - b).abs()), largest.max(a.abs()))
        });
        difference / largest
    };
    let u = |state: &ModelState| state.snapshot.u.clone();
    let t = |state: &ModelState| -> Vec<f64> {
        state.snapshot.tractions.iter().flatten().flatten().copied().collect()
    };
    [largest(&mut u(a).into_iter().zip(u(b))), largest(&mut t(a).into_iter().zip(t(b)))]
}

#[test]
fn condensed_bricks_and_all_displacements_find_the_same() {
    let (blocks, [low, top]) = wall(10, 10);
    assert_eq!(blocks.len(), 105);
    for (name, law, shear) in [("friction", friction(), 0.07), ("cracking", mortar(), 0.09)] {
        let folder = tempfile::tempdir().unwrap();
        let push = step("push").increments(5);
        let push = sides(&top, 3).fold(push, |step, side| step.traction(&side, shear, -0.2));
        write(folder.path(), &blocks, &law, &[pressed(weight(&low), &top, 0.2), push]);
        let [one, other] = ["blocks", "plain"].map(|strategy| states(folder.path(), strategy));
        assert_eq!((one.len(), other.len()), (6, 6));
        let last = &one[5];
        assert!(last.dissipated > 0.0, "{name}: nothing slides or cracks");
        for (a, b) in one.iter().zip(&other) {
            let apart = apart(a, b);
            assert!(apart.iter().all(|apart| *apart <= APART), "{name}: {apart:?}");
        }
    }
}

#[test]
fn voussoirs_of_an_arch_are_condensed_once_and_turned() {
    // seven of one size, turned against each other; the first and the last are held, and the fourth is loaded
    let voussoirs = 7;
    let at = |k: usize, r: f64| {
        let angle = std::f64::consts::PI * (0.1 + 0.8 * k as f64 / voussoirs as f64);
        [r * angle.cos(), r * angle.sin()]
    };
    let block =
        |k: usize| Block { corners: [at(k, 1.0), at(k, 1.3), at(k + 1, 1.3), at(k + 1, 1.0)], cells: [6, 5] };
    let blocks: Vec<Block> = (0..voussoirs).map(block).collect();
    let folder = tempfile::tempdir().unwrap();
    let weight = sides(&[voussoirs], 3).fold(weight(&[1]), |step, side| step.fix(&side, "xy"));
    let load = step("load").increments(3);
    let load = sides(&[4], 2).fold(load, |step, side| step.traction(&side, 0.0, -0.02));
    write(folder.path(), &blocks, &friction(), &[weight, load]);
    let problem = bound(folder.path(), "blocks");
    let held: Vec<bool> = problem.steps[0].constrained.clone();
    // 2 to 6 are one; 1 and 7 have interfaces on one side only, and supports
    assert_eq!(Continuum::new(&problem.model, &held, None).unwrap().distinct().0, 3);
    // supports are along the axes: a held one is like none that is turned
    let held = vec![true; problem.model.dofs()];
    assert_eq!(Continuum::new(&problem.model, &held, None).unwrap().distinct().0, voussoirs);
    let [one, other] = ["blocks", "plain"].map(|strategy| states(folder.path(), strategy));
    for (a, b) in one.iter().zip(&other) {
        let apart = apart(a, b);
        assert!(apart.iter().all(|apart| *apart <= APART), "{apart:?}");
    }
}

#[test]
fn bricks_of_another_size_or_material_are_not_equal() {
    let (mut blocks, [low, _]) = wall(4, 3);
    let folder = tempfile::tempdir().unwrap();
    let distinct = |blocks: &[Block], stiffer: Option<usize>| {
        write(folder.path(), blocks, &friction(), &[weight(&low)]);
        let mut problem = bound(folder.path(), "blocks");
        if let Some(brick) = stiffer {
            problem.model.subdomains[brick].elasticity.c33 *= 1.0 + f64::EPSILON;
        }
        Continuum::new(&problem.model, &[], None).unwrap().distinct().0
    };
    let before = distinct(&blocks, None);
    assert!(before < blocks.len(), "{before}");
    // a brick in the middle, of which there is another: stiffer in the last digit; longer, with as many cells
    let middle = blocks.iter().position(|block| block.corners[0] == [0.125, 0.1]).unwrap();
    assert_eq!(distinct(&blocks, Some(middle)), before + 1);
    for corner in [1, 2] {
        blocks[middle].corners[corner][0] += 1e-3;
        blocks[middle + 1].corners[[0, 3][corner - 1]][0] += 1e-3;
    }
    assert!(distinct(&blocks, None) > before);
}

#[test]
fn bodies_that_move_as_a_whole_make_no_forces() {
    // not to 1e-16 of S x, but none: what is taken are differences
    let (blocks, [low, _]) = wall(2, 2);
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &blocks, &friction(), &[weight(&low)]);
    let problem = bound(folder.path(), "blocks");
    let free = vec![false; problem.model.dofs()];
    let continuum = Continuum::new(&problem.model, &free, None).unwrap();
    let condensation = Arc::new(continuum.condense(&free).unwrap());
    let interfaces = &problem.model.interfaces;
    let form = JoinedSubdomains::new(&continuum, condensation, interfaces, &free);
    let x: Vec<f64> = (0..continuum.separator()).map(|k| [0.3, -0.7][k % 2]).collect();
    let forces: Vec<Vec<f64>> = interfaces.iter().map(|interface| vec![0.0; interface.size()]).collect();
    assert!(form.residual(&x, &forces, &vec![0.0; x.len()]).iter().all(|force| *force == 0.0));
    let turned: Vec<f64> = x.iter().enumerate().map(|(k, x)| x * k as f64).collect();
    assert!(form.residual(&turned, &forces, &vec![0.0; x.len()]).iter().any(|force| *force != 0.0));
}

#[test]
fn a_wall_under_little_pressure_is_pushed_to_its_end() {
    let (blocks, [low, top]) = wall(6, 4);
    for (law, pressure) in [(mortar(), 0.01), (mortar(), 0.002), (friction(), 0.002)] {
        for increments in [5, 40] {
            let folder = tempfile::tempdir().unwrap();
            let push = step("push").increments(increments);
            let push = sides(&top, 3).fold(push, |step, side| step.displace(&side, "x", 2e-4));
            write(folder.path(), &blocks, &law, &[pressed(weight(&low), &top, pressure), push]);
            let states = states(folder.path(), "blocks");
            assert_eq!(states.len(), 1 + increments);
            assert!(states[increments].dissipated > 0.0);
        }
    }
}

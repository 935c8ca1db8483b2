//! Cost of the kernels of a run with friction, at 10 000 and 100 000 dofs: `cargo bench --bench kernels`.
//!
//! What to compare: `newton_step` with `condensation` and `whole_factor`. An iteration must not cost what a factor costs.
#![allow(missing_docs)]

use std::sync::Arc;

use divan::{Bencher, black_box};
use midplane::assembly::{InterfaceTangent, add_stiffness};
use midplane::coupling::{Coupling, Gap, JumpScheme, Points, Scheme, Side, Surroundings};
use midplane::law::{Integration, Local, State};
use midplane::mesh::{Group, Mesh};
use midplane::problem::Problem;
use midplane::solver::{Base, Condensation, Condensed, Continuum, FactorPlan, Form};

mod layers;
use layers::layers;

const SIZES: [usize; 2] = [10_000, 100_000];
/// Springs of the base system [MPa/m], of the size of E/h.
const SPRINGS: [f64; 4] = [1e6, 0.0, 0.0, 1e6];
const SCENE: &str = r#"{ "plane": "strain",
  "subdomains": { "lower": { "msh": "lower", "material": "rock" }, "upper": { "msh": "upper", "material": "rock" } },
  "materials": { "rock": { "young": 1e4, "poisson": 0.2 } },
  "interfaces": { "joint": { "side_a": "lower.top", "side_b": "upper.bottom", "law": { "type": "coulomb",
    "normal_stiffness": 1e7, "tangential_stiffness": 1e7, "friction_coefficient": 0.8785 } } },
  "steps": [ { "name": "shear", "fix": { "lower.bottom": ["x", "y"], "upper.left": ["x"] },
    "load": { "upper.top": { "pressure": 10.0 } } } ] }"#;

fn main() {
    divan::main();
}

fn problem(dofs: usize) -> Problem {
    let scene = midplane::run::parse_scene("scene.json".into(), SCENE.into(), &[]);
    let bound = scene.and_then(|scene| Problem::bind(&scene, layers(dofs)));
    bound.unwrap_or_else(|error| unreachable!("{error}"))
}

fn constrained(problem: &Problem) -> &[bool] {
    &problem.steps[0].constrained
}

fn condense(continuum: &Continuum, constrained: &[bool]) -> Condensation {
    continuum.condense(constrained).unwrap_or_else(|error| unreachable!("{error:?}"))
}

fn continuum(problem: &Problem) -> Continuum {
    Continuum::new(&problem.model, &[], None).unwrap_or_else(|error| unreachable!("{error:?}"))
}

#[divan::bench(args = SIZES, sample_count = 10)]
fn assembly(bencher: Bencher, dofs: usize) {
    let model = problem(dofs).model;
    let pattern = model.pattern();
    bencher.bench_local(|| black_box(&model).continuum(&pattern));
}

#[divan::bench(args = SIZES, sample_count = 10)]
fn pairing(bencher: Bencher, dofs: usize) {
    let meshes = layers(dofs);
    let edges = |mesh: &Mesh, name: &str| match &mesh.groups[name] {
        Group::Edges(edges) => edges.clone(),
        _ => Vec::new(),
    };
    let (top, bottom) = (edges(&meshes[0], "top"), edges(&meshes[1], "bottom"));
    let side =
        |name, of: usize, edges| Side { name, points: &meshes[of].points, edges, corners: &[], first: 0 };
    let scheme = Scheme { kind: JumpScheme::Projected, points: Points::Gauss, gap: Gap::Closed };
    bencher.bench_local(|| {
        Coupling::build(
            "joint",
            &[side("top", 0, &top)],
            &[side("bottom", 1, &bottom)],
            scheme,
            Surroundings::default(),
        )
        .unwrap_or_else(|error| unreachable!("{error}"))
    });
}

/// Every law point of the interface once: tractions and stiffness.
fn law_points(problem: &Problem, tractions: &mut Vec<f64>, stiffness: &mut Vec<f64>) {
    tractions.clear();
    stiffness.clear();
    let law = problem.interfaces[0].laws.kind();
    let points = problem.model.interfaces[0].coupling.points.len();
    for p in 0..points {
        let slip = 2e-6 * p as f64 / points as f64; // half of them slide
        let jump = black_box(Local::new(-1e-6, slip, 0.0));
        let answer = law.respond(jump, &State::default(), Integration::Tolerance(1e-4));
        let answer = answer.unwrap_or_else(|unresolved| unreachable!("{unresolved}"));
        tractions.extend_from_slice(answer.traction.as_slice());
        stiffness.extend_from_slice(answer.stiffness.transpose().as_slice());
    }
}

#[divan::bench(args = SIZES)]
fn law(bencher: Bencher, dofs: usize) {
    let problem = problem(dofs);
    let (mut tractions, mut stiffness) = (Vec::new(), Vec::new());
    bencher.bench_local(|| law_points(&problem, &mut tractions, &mut stiffness));
}

/// One factor of the whole matrix: the measure of everything else.
#[divan::bench(args = SIZES, sample_count = 5)]
fn whole_factor(bencher: Bencher, dofs: usize) {
    let problem = problem(dofs);
    let model = &problem.model;
    let pattern = model.pattern();
    let mut matrix = model.continuum(&pattern);
    let springs = SPRINGS.repeat(model.interfaces[0].coupling.points.len());
    add_stiffness(&model.interfaces[0], &pattern, &springs, &mut matrix);
    matrix.hold(&pattern, constrained(&problem));
    let plan =
        FactorPlan::analyse(&pattern, &model.coordinates()).unwrap_or_else(|error| unreachable!("{error:?}"));
    bencher.bench_local(|| {
        plan.factor(&pattern, black_box(&matrix)).unwrap_or_else(|error| unreachable!("{error:?}"))
    });
}

#[divan::bench(args = SIZES, sample_count = 5)]
fn condensation(bencher: Bencher, dofs: usize) {
    let problem = problem(dofs);
    let continuum = continuum(&problem);
    bencher.bench_local(|| condense(black_box(&continuum), constrained(&problem)));
}

/// Law, forces, tangent, factor, solve and residual, with every tangent new.
#[divan::bench(args = SIZES, sample_count = 10)]
fn newton_step(bencher: Bencher, dofs: usize) {
    let problem = problem(dofs);
    let (constrained, interfaces) = (constrained(&problem), &problem.model.interfaces);
    let springs = [SPRINGS.repeat(interfaces[0].coupling.points.len())];
    let continuum = continuum(&problem);
    let base =
        Base::new(&continuum, Arc::new(condense(&continuum, constrained)), interfaces, &springs, constrained);
    let mut form =
        Condensed::new(base.unwrap_or_else(|error| unreachable!("{error:?}")), &[0], &springs, &springs);
    let mut tangents = [InterfaceTangent::new(&interfaces[0])];
    let (mut tractions, mut stiffness) = (Vec::new(), Vec::new());
    let mut x = vec![1e-6; interfaces[0].size()];
    let target = x.clone();
    let mut turn = 0.0;
    bencher.bench_local(|| {
        turn += 1.0;
        law_points(&problem, &mut tractions, &mut stiffness);
        stiffness.iter_mut().for_each(|d| *d *= 1.0 + 1e-9 * turn); // the last tangent would be used again
        let forces = [interfaces[0].gather(&tractions)];
        tangents[0].fill(&interfaces[0], &stiffness);
        let mut correction = form.residual(&x, &forces, &target);
        form.factor(&tangents);
        form.solve(&mut correction);
        x.iter_mut().zip(&correction).for_each(|(x, d)| *x -= 1e-9 * d);
    });
}

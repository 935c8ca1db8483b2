//! What an elastic scene pays for all that the program knows besides: `cargo bench --bench elastic`.
//!
//! Its march is timed against the shortest way from a bound scene to stresses and tractions that knows of no law, no
//! history and no iteration: assemble, factor, solve, recover. Both take turns; the processor's time counts, not the
//! clock's.

use std::sync::Arc;

use midplane::continuum::recover;
use midplane::history::{Clock, Equations, History, Means, processor};
use midplane::problem::Problem;
use midplane::solver::{FactorPlan, Linear, System};

mod layers;
use layers::layers;

const SPRINGS: [f64; 4] = [1e7, 0.0, 0.0, 1e7];
const SCENE: &str = r#"{ "plane": "strain",
  "subdomains": { "lower": { "msh": "lower", "material": "rock" }, "upper": { "msh": "upper", "material": "rock" } },
  "materials": { "rock": { "young": 1e4, "poisson": 0.3 } },
  "interfaces": { "joint": { "side_a": "lower.top", "side_b": "upper.bottom",
    "law": { "type": "elastic", "normal_stiffness": 1e7, "tangential_stiffness": 1e7 } } },
  "steps": [ { "name": "bending", "fix": { "lower.left": ["x", "y"], "upper.left": ["x", "y"] },
    "load": { "lower.right": { "traction": [0.0, -1.0] }, "upper.right": { "traction": [0.0, -1.0] } } } ] }"#;
const REPEATS: usize = 9;

fn main() {
    for dofs in [10_000, 40_000] {
        if let Err(error) = measure(dofs) {
            eprintln!("{dofs} dofs: {error}");
        }
    }
}

fn measure(dofs: usize) -> Result<(), String> {
    let scene =
        midplane::run::parse_scene("scene.json".into(), SCENE.into(), &[]).map_err(|e| e.to_string())?;
    let problem = Problem::bind(&scene, layers(dofs)).map_err(|e| e.to_string())?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(|e| e.to_string())?;
    let problem = Arc::new(problem);
    let mut times = [Vec::new(), Vec::new()];
    let mut answers = [0.0; 2];
    for _ in 0..REPEATS {
        for (k, way) in [whole, bare].into_iter().enumerate() {
            let before = processor().ok_or("the system does not tell the processor's time")?;
            answers[k] = pool.install(|| way(&problem))?;
            times[k].push(processor().unwrap_or(f64::NAN) - before);
        }
    }
    let [whole, bare] = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        (times[0], times[REPEATS / 2])
    });
    println!(
        "{} dofs: the program {:.4} s, bare {:.4} s (medians); ratio {:.3}, of the fastest {:.3}; energies differ by {:.0e}",
        problem.model.dofs(),
        whole.1,
        bare.1,
        whole.1 / bare.1,
        whole.0 / bare.0,
        (answers[0] / answers[1] - 1.0).abs()
    );
    Ok(())
}

/// As the program does it; returns the elastic energy.
fn whole(problem: &Problem) -> Result<f64, String> {
    let mut clock = Clock::new("march");
    let equations = Equations::new(problem, Means::default(), &mut clock).map_err(|e| e.to_string())?;
    let mut history = History::new(problem, &equations, clock);
    while history.next().map_err(|e| e.to_string())?.is_some() {}
    Ok(history.state().stored)
}

/// With nothing but elastic bodies and springs.
fn bare(problem: &Problem) -> Result<f64, String> {
    let model = &problem.model;
    let pattern = model.pattern();
    let continuum = model.continuum(&pattern);
    let stiffness: Vec<Vec<f64>> =
        model.interfaces.iter().map(|interface| SPRINGS.repeat(interface.coupling.points.len())).collect();
    let system = System {
        interfaces: &model.interfaces,
        stiffness: &stiffness,
        pattern: &pattern,
        continuum: &continuum,
    };
    let plan = FactorPlan::analyse(&pattern, &model.coordinates()).map_err(|e| format!("{e:?}"))?;
    let step = &problem.steps[0];
    let linear = Linear::new(system, &plan, &step.constrained).map_err(|e| format!("{e:?}"))?;
    let force = step.force(model, 1.0).map_err(|e| e.to_string())?;
    let u = linear.solve(&force, &vec![0.0; model.dofs()]).u;
    let mut stored = 0.0;
    for (b, subdomain) in model.subdomains.iter().enumerate() {
        stored +=
            recover(&subdomain.mesh, &u[model.dofs_of(b)], &subdomain.elasticity, model.thickness, None)
                .energy;
    }
    for interface in &model.interfaces {
        let jumps = interface.jumps(&u);
        for (point, r) in interface.coupling.points.iter().zip(jumps.chunks_exact(2)) {
            stored += 0.5 * model.thickness * point.weight * SPRINGS[0] * (r[0] * r[0] + r[1] * r[1]);
        }
    }
    Ok(stored)
}

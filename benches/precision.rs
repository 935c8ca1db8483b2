//! Would a factor in single precision, refined in double, be faster? `cargo bench --bench precision`.
//!
//! ```text
//!   f64: one factor, two substitutions (a solve and its refinement)      f32: one factor, as many as the residual asks for
//! ```
//!
//! The strip of two layers in one body's place: no interface, so that the matrix is as well conditioned as it gets.

use std::time::Instant;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::traits::ComplexField;
use faer::{Conj, MatMut, Par, Side};
use midplane::assembly::{Pattern, Symmetric};
use midplane::problem::Problem;
use midplane::solver::nested_dissection;

mod layers;
use layers::layers;

const SCENE: &str = r#"{ "plane": "strain",
  "subdomains": { "lower": { "msh": "lower", "material": "rock" }, "upper": { "msh": "upper", "material": "rock" } },
  "materials": { "rock": { "young": 1e4, "poisson": 0.3 } },
  "steps": [ { "name": "bending", "fix": { "lower.left": ["x", "y"], "upper.left": ["x", "y"] },
    "load": { "lower.right": { "traction": [0.0, -1.0] }, "upper.right": { "traction": [0.0, -1.0] } } } ] }"#;
/// Repeats, of which the fastest counts.
const REPEATS: usize = 5;

fn main() {
    for dofs in [10_000, 100_000, 400_000] {
        if let Err(error) = measure(dofs) {
            eprintln!("{dofs} dofs: {error}");
        }
    }
}

fn measure(dofs: usize) -> Result<(), String> {
    let scene =
        midplane::run::parse_scene("scene.json".into(), SCENE.into(), &[]).map_err(|e| e.to_string())?;
    let problem = Problem::bind(&scene, layers(dofs)).map_err(|e| e.to_string())?;
    let model = &problem.model;
    let pattern = model.pattern();
    let mut matrix = model.continuum(&pattern);
    matrix.hold(&pattern, &problem.steps[0].constrained);
    let f = problem.steps[0].force(model, 1.0).map_err(|e| e.to_string())?;
    let order = nested_dissection(&pattern, &model.coordinates());
    let threshold = SupernodalThreshold::FORCE_SUPERNODAL;
    let params = CholeskySymbolicParams { supernodal_flop_ratio_threshold: threshold, ..Default::default() };
    let permutation = PermRef::new_checked(&order.forward, &order.inverse, pattern.size());
    let custom = SymmetricOrdering::Custom(permutation);
    let plan = factorize_symbolic_cholesky(structure(&pattern), Side::Lower, custom, params);
    let plan = plan.map_err(|e| format!("{e:?}"))?;
    let double = best::<f64>(&plan, &pattern, &matrix, &f)?;
    let single = best::<f32>(&plan, &pattern, &matrix, &f)?;
    println!("{} dofs", pattern.size());
    for (name, [factor, solve, passes, error]) in [("f64", double), ("f32", single)] {
        println!(
            "    {name}  factor {factor:.4} s  a pass {solve:.4} s  {passes} passes to {error:.1e}  in all {:.4} s",
            factor + passes * solve
        );
    }
    Ok(())
}

/// Seconds of the factor and of a pass (residual and substitution), passes, backward error reached.
fn best<T: Number>(
    plan: &SymbolicCholesky<u32>,
    pattern: &Pattern,
    matrix: &Symmetric,
    f: &[f64],
) -> Result<[f64; 4], String> {
    let values: Vec<T> = matrix.values.iter().map(|&v| T::of(v)).collect();
    let lower = SparseColMatRef::new(structure(pattern), values.as_slice());
    let mut fastest = [f64::INFINITY, f64::INFINITY, 0.0, 0.0];
    for _ in 0..REPEATS {
        let start = Instant::now();
        let mut l = vec![T::of(0.0); plan.len_val()];
        let mut memory =
            MemBuffer::new(plan.factorize_numeric_llt_scratch::<T>(Par::Seq, Default::default()));
        let stack = MemStack::new(&mut memory);
        let regular = Default::default();
        plan.factorize_numeric_llt(&mut l, lower, Side::Lower, regular, Par::Seq, stack, Default::default())
            .map_err(|e| format!("{e:?}"))?;
        fastest[0] = fastest[0].min(start.elapsed().as_secs_f64());
        let (mut u, mut passes, mut error) = (vec![0.0; f.len()], 0, 1.0);
        let start = Instant::now();
        // the refinement of the program ends where it no longer gains
        while passes < 12 {
            let residual = residual(pattern, matrix, &u, f);
            let now = norm(&residual) / norm(f);
            if passes >= 2 && now > 0.05 * error {
                break;
            }
            error = now;
            let mut x: Vec<T> = residual.iter().map(|&r| T::of(r)).collect();
            let n = x.len();
            let mut memory = MemBuffer::new(plan.solve_in_place_scratch::<T>(1, Par::Seq));
            LltRef::new(plan, &l).solve_in_place_with_conj(
                Conj::No,
                MatMut::from_column_major_slice_mut(&mut x, n, 1),
                Par::Seq,
                MemStack::new(&mut memory),
            );
            u.iter_mut().zip(&x).for_each(|(u, x)| *u += x.double());
            passes += 1;
        }
        fastest[1] = fastest[1].min(start.elapsed().as_secs_f64() / f64::from(passes));
        fastest[2] = f64::from(passes);
        fastest[3] = error;
    }
    Ok(fastest)
}

/// f − A u for the lower triangle of A.
fn residual(pattern: &Pattern, matrix: &Symmetric, u: &[f64], f: &[f64]) -> Vec<f64> {
    let mut r = f.to_vec();
    for j in 0..pattern.size() {
        for at in pattern.column(j) {
            let (i, value) = (pattern.rows[at] as usize, matrix.values[at]);
            r[i] -= value * u[j];
            if i != j {
                r[j] -= value * u[i];
            }
        }
    }
    r
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

fn structure(pattern: &Pattern) -> SymbolicSparseColMatRef<'_, u32> {
    let n = pattern.size();
    SymbolicSparseColMatRef::new_checked(n, n, &pattern.offsets, None, &pattern.rows)
}

/// Single or double precision.
trait Number: ComplexField<Real = Self> + faer::traits::RealField + Copy {
    fn of(value: f64) -> Self;
    fn double(self) -> f64;
}

impl Number for f64 {
    fn of(value: f64) -> f64 {
        value
    }
    fn double(self) -> f64 {
        self
    }
}

impl Number for f32 {
    fn of(value: f64) -> f32 {
        value as f32
    }
    fn double(self) -> f64 {
        f64::from(self)
    }
}

//! Claim: supports come and go between steps without a trace of their own; an increment that is rejected leaves none; a
//! scene pays for what it uses.

use crate::common::*;
use midplane::history::ModelState;
use midplane::law;
use midplane::mesh::Mesh;
use midplane::problem::Problem;
use midplane::shape::Shape;

fn scene(law: Law) -> Scene {
    Scene::new("strain")
        .subdomains(["lower", "upper"], "m")
        .material("m", 1e4, 0.2)
        .interface("joint", faces("lower.top", "upper.bottom").law(law))
        .probe("x", "upper.top.displacement_x")
        .probe("n", "joint.traction_n@0.5")
}

fn springs() -> Law {
    elastic(1e6, 1e6)
}

fn friction() -> Law {
    coulomb(1e6, 1e6, 0.5)
}

fn rock() -> Law {
    cracking(1e6, 1e6, [3.0, 4.0, 0.8785], [2e-4, 2e-3])
}

fn blocks() -> Vec<Mesh> {
    let block = |n: usize, y: f64| even_block([0.0, 0.4], [y, y + 0.2], [n, 2], Shape::Quadrilateral4);
    vec![block(3, -0.2), block(4, 0.0)]
}

fn problem(law: Law, steps: &[Step]) -> Problem {
    scene(law).steps(steps.to_vec()).bind(blocks()).unwrap()
}

fn press() -> Step {
    step("press").fix("lower.bottom", "xy").pressure("upper.top", 2)
}

/// Both ends of the upper block moved in x.
fn shear(step: Step, x: f64) -> Step {
    step.displace("upper.left", "x", x).displace("upper.right", "x", x)
}

#[test]
fn a_constrained_group_stays_and_a_released_one_gives_back_its_reaction() {
    // pushed by a load, held there, the load taken away, released: with elastic interfaces back where it came from
    let steps = [
        press(),
        step("push").increments(2).traction("upper.left", 0.5, 0),
        step("hold").increments(2).hold("upper.top", "x").traction("upper.left", 0, 0),
        step("release").increments(4).release("upper.top", "x"),
    ];
    for law in [springs(), rock()] {
        let problem = problem(law.clone(), &steps);
        let (states, totals) = solve(&problem);
        let at = |i: usize| states[i].probes(&problem)[0];
        let top: Vec<usize> = problem.reactions.iter().find(|r| r.group == "upper.top").unwrap().dofs.clone();
        let reaction = |i: usize| top.iter().map(|&dof| states[i].reactions[dof]).sum::<f64>();
        assert!(at(2) > 1e-6);
        for i in [3, 4] {
            for &dof in &top {
                assert_eq!(states[i].snapshot.u[dof], states[2].snapshot.u[dof], "{law}: held");
            }
        }
        // the support takes over what the load gave
        assert!(reaction(4) > 0.05);
        for (i, left) in [(5, 0.75), (6, 0.5), (7, 0.25), (8, 0.0)] {
            close(reaction(i), left * reaction(4), 1e-12, reaction(4), &law.to_string());
        }
        for (free, first) in states[8].snapshot.u.iter().zip(&states[0].snapshot.u) {
            close(*free, *first, 1e-9, at(2), &law.to_string());
        }
        assert!(totals.energy_balance < 5e-3, "{law}: {:e}", totals.energy_balance);
        // all the work of the push has been given back
        close(states[8].work, states[0].work, 1e-9, states[2].work, &law.to_string());
    }
}

#[test]
fn what_holds_nothing_or_twice_is_refused() {
    let next = || step("next");
    for (step, expected) in [
        (next().release("upper.top", "x"), "nothing holds \"upper.top\" in x"),
        (next().hold("upper.top", "x").fix("upper.right", "x"), "meets the prescribed \"upper.right\""),
        (next().hold("lower.bottom", "x").release("lower.bottom", "x"), "meets hold lower.bottom"),
        (next().release("lower.bottom", "x"), "lower"), // then nothing holds the body
    ] {
        let error = scene(springs()).step(press()).step(step).bind(blocks()).unwrap_err().to_string();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn increments_that_were_cut_leave_no_trace() {
    // too few iterations for the whole, enough for its parts: as if the scene had asked for these
    let laws = [(friction(), 1e-3), (rock(), 3.5e-4)];
    for (strategy, (law, x)) in
        ["condensed", "blocks", "plain"].into_iter().flat_map(|of| laws.clone().map(|law| (of, law)))
    {
        let solve = |steps: &[Step], iterations: usize| {
            let scene = scene(law.clone())
                .solution("strategy", strategy)
                .solution("iterations", iterations)
                .solution("path_tolerance", 1)
                .steps(steps.to_vec());
            try_solve(&scene.bind(blocks()).unwrap())
        };
        // the ends stay in the press, so that a quarter of their way is a quarter of where they go
        let press = shear(press(), 0.0);
        let whole = [press.clone(), shear(step("shear"), x)];
        // the one cut is in the shear, not in the press before it
        let once = |iterations: usize| {
            let march = solve(&whole, iterations);
            let cut = march.end.as_ref().is_ok_and(|totals| (totals.rejected, totals.parts) == (1, 3));
            (cut && march.iterations[0] <= iterations).then_some(march)
        };
        let cut = (2..20).find_map(once).unwrap_or_else(|| panic!("cut once: {strategy}, {law}"));
        let parts = [press, shear(step("quarter"), 0.25 * x), shear(step("shear"), x)];
        let parts = solve(&parts, 50);
        assert_eq!(cut.states.len(), 2, "one row per increment of the scene");
        let (a, b) = (&cut.states[1], &parts.states[2]);
        assert!(b.dissipated > 0.0);
        let same = |a: Vec<f64>, b: Vec<f64>, what: &str| {
            assert_eq!(a.len(), b.len());
            let largest = b.iter().map(|value| value.abs()).fold(0.0, f64::max);
            a.iter().zip(&b).for_each(|(a, b)| close(*a, *b, 1e-9, largest, &format!("{strategy}: {what}")));
        };
        same(a.snapshot.u.clone(), b.snapshot.u.clone(), "u");
        let slip = |point: &law::State| vec![point.jump_plastic.y];
        let work = |point: &law::State| vec![point.own[law::WORK]];
        let traction = |point: &law::State| vec![point.traction.x, point.traction.y];
        same(of_points(a, slip), of_points(b, slip), "slip");
        same(of_points(a, work), of_points(b, work), "fracture work");
        same(of_points(a, traction), of_points(b, traction), "traction");
        for (a, b) in [(a.work, b.work), (a.stored, b.stored), (a.dissipated, b.dissipated)] {
            close(a, b, 1e-9, b, "energies");
        }
    }
}

/// Values of the states of the law points of the interface.
fn of_points<T>(state: &ModelState, what: impl Fn(&law::State) -> Vec<T>) -> Vec<T> {
    state.snapshot.states[0].iter().flat_map(what).collect()
}

#[test]
fn an_elastic_scene_has_no_history_and_no_iteration() {
    let steps = [press(), step("push").increments(5).traction("upper.left", 0.5, 0)];
    let elastic = problem(springs(), &steps);
    let (linear, totals) = solve(&elastic);
    assert!(elastic.interfaces[0].states.is_empty() && linear[5].snapshot.states[0].is_empty());
    assert_eq!((totals.factorisations, totals.iterations, totals.rejected), (1, 0, 0));
    // below its surface the cracking law gives the same, with one iteration an increment
    let below = problem(rock(), &steps);
    let march = try_solve(&below);
    assert_eq!(march.end.unwrap().factorisations, 1);
    assert_eq!(march.iterations, [1; 6]);
    for (a, b) in linear.iter().zip(&march.states) {
        let largest = a.snapshot.u.iter().map(|u| u.abs()).fold(0.0, f64::max);
        a.snapshot.u.iter().zip(&b.snapshot.u).for_each(|(a, b)| close(*b, *a, 1e-11, largest, "u"));
        let [a, b] = [a, b].map(|state| state.snapshot.tractions[0].iter().flatten());
        a.zip(b).for_each(|(a, b)| close(*b, *a, 1e-10, 2.0, "traction"));
    }
}

#[test]
fn units_change_nothing_but_the_numbers() {
    // MPa and m, Pa and m, N/mm² and mm: (stress, length)
    let run = |stress: f64, length: f64| {
        let block = |n: usize, y: f64| {
            rectangle(&even(0.0, 0.4, n), &even(y, y + 0.2, 2), Shape::Quadrilateral4, |x, y| {
                [x * length, y * length]
            })
        };
        let (k, slip) = (1e6 * stress / length, 4e-4 * length);
        let law = cracking(
            k,
            k,
            [3.0 * stress, 4.0 * stress, 0.8785],
            [2e-4 * stress * length, 2e-3 * stress * length],
        );
        let scene = Scene::new("strain")
            .with("thickness", length)
            .subdomains(["lower", "upper"], "m")
            .material("m", 1e4 * stress, 0.2)
            .interface("joint", faces("lower.top", "upper.bottom").law(law))
            .step(step("press").fix("lower.bottom", "xy").pressure("upper.top", 2.0 * stress))
            .step(shear(step("shear").increments(8), slip));
        try_solve(&scene.bind(vec![block(3, -0.2), block(4, 0.0)]).unwrap())
    };
    let one = run(1.0, 1.0);
    for (stress, length) in [(1e6, 1.0), (1.0, 1e3)] {
        let other = run(stress, length);
        assert_eq!(one.iterations, other.iterations);
        for (a, b) in one.states.iter().zip(&other.states) {
            let largest = a.snapshot.u.iter().map(|u| u.abs()).fold(0.0, f64::max);
            let u = a.snapshot.u.iter().zip(&b.snapshot.u);
            u.for_each(|(a, b)| close(b / length, *a, 1e-12, largest, "u"));
            let [a, b] = [a, b].map(|state| state.snapshot.tractions[0].iter().flatten());
            a.zip(b).for_each(|(a, b)| close(b / stress, *a, 1e-9, 2.0, "traction"));
        }
    }
}

#[test]
fn increments_without_stored_fields_have_the_same_history() {
    let steps = [
        press(),
        step("push").increments(24).traction("upper.left", 0.9, 0),
        step("hold").increments(24).hold("upper.top", "x").traction("upper.left", 0, 0),
        step("release").increments(24).release("upper.top", "x"),
        shear(step("shear").increments(24), 4e-4),
        step("sway").increments(3).displace("upper.left", "x", "4e-4*cos(load_factor)"),
    ];
    for law in [springs(), friction(), rock()] {
        let run = |fields: &str| {
            let scene = scene(law.clone()).steps(steps.to_vec()).with_in("output", "fields", fields);
            let problem = scene.bind(blocks()).unwrap();
            (try_solve(&problem), problem)
        };
        let ((all, _), (last, problem)) = (run("every"), run("last"));
        assert_eq!(all.states.len(), last.states.len());
        assert!(last.states[30].snapshot.u.is_empty() && !all.states[30].snapshot.u.is_empty());
        assert!(last.end.unwrap().energy_balance < 5e-3);
        let largest =
            |f: &dyn Fn(&midplane::history::ModelState) -> f64| all.states.iter().map(f).fold(0.0, f64::max);
        let (work, force) = (largest(&|s| s.work.abs()), 2.0 * 0.4);
        for (i, (a, b)) in all.states.iter().zip(&last.states).enumerate() {
            close(b.work, a.work, 1e-10, work, &format!("{law}: work {i}"));
            close(b.stored, a.stored, 1e-10, work, &format!("{law}: stored {i}"));
            close(b.dissipated, a.dissipated, 1e-10, work, &format!("{law}: dissipated {i}"));
            let columns = a.probes(&problem).into_iter().zip(b.probes(&problem));
            columns.for_each(|(a, b)| close(b, a, 1e-9, force, &format!("{law}: column, increment {i}")));
        }
        let (a, b) = (&all.states[99].snapshot.u, &last.states[99].snapshot.u);
        a.iter().zip(b).for_each(|(a, b)| close(*b, *a, 1e-10, 4e-4, "u at the end"));
    }
}

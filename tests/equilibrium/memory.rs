//! Claim: a run that does not fit in memory is refused before its first factor, with the estimate.

use crate::common::*;
use midplane::error::Result;
use midplane::history::{Clock, Equations, History, Means, memory};
use midplane::shape::Shape;

#[test]
fn a_run_that_does_not_fit_is_refused_with_dofs_estimate_and_what_there_is() {
    let sides = even(0.0, 1.0, 40);
    let plate = rectangle(&sides, &sides, Shape::Quadrilateral4, |x, y| [x, y]);
    let scene = Scene::new("strain")
        .subdomain("plate", "rock")
        .material("rock", 1e4, 0.3)
        .step(step("pull").fix("plate.left", "xy").traction("plate.right", 1.0, 0.0));
    let problem = scene.bind(vec![plate]).unwrap();
    let run = |available| -> Result<(usize, usize)> {
        let mut clock = Clock::new("test");
        let means = Means { memory: available, ..Means::default() };
        let equations = Equations::new(&problem, means, &mut clock)?;
        let mut history = History::new(&problem, &equations, clock);
        let mut given = 0;
        while history.next()?.is_some() {
            given += 1;
        }
        Ok((history.totals().increments, given))
    };
    let error = run(Some(1_000_000)).unwrap_err();
    println!("{error}");
    assert_eq!(error.exit_code(), 4);
    let text = error.to_string();
    assert!(text.contains("3362 dofs need another ") && text.contains("1.0 MB are available"), "{text}");
    // with plenty, and where the system does not tell
    for available in [Some(1 << 40), None] {
        assert_eq!(run(available).unwrap(), (1, 2));
    }
}

#[test]
fn the_system_tells_what_it_has() {
    if cfg!(target_os = "linux") {
        let (available, peak) = (memory::available().unwrap(), memory::peak().unwrap());
        assert!(available > 1 << 20 && peak > 1 << 20);
    }
}

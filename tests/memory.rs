//! Claim: a run that does not fit in memory is refused before its first factor, with the estimate.

mod common;

use common::*;
use midplane::history::{Clock, Means, march_within, memory};
use midplane::shape::Shape;

const SCENE: &str = r#"{ "plane": "strain",
  "subdomains": { "plate": { "msh": "p", "material": "rock" } },
  "materials": { "rock": { "young": 1e4, "poisson": 0.3 } },
  "steps": [ { "name": "pull", "fix": { "plate.left": ["x", "y"] },
    "load": { "plate.right": { "traction": [1.0, 0.0] } } } ] }"#;

#[test]
fn a_run_that_does_not_fit_is_refused_with_dofs_estimate_and_what_there_is() {
    let sides = even(0.0, 1.0, 40);
    let plate = rectangle(&sides, &sides, Shape::Quadrilateral4, |x, y| [x, y]);
    let problem = bind(SCENE, vec![plate]).unwrap();
    let run = |available| {
        let mut increments = 0;
        let mut clock = Clock::new("test");
        let result = march_within(
            Means { memory: available, shelf: None },
            &problem,
            &mut clock,
            &mut |_| (),
            &mut |_, _, _, _| {
                increments += 1;
                Ok(())
            },
        );
        (result, increments)
    };
    let (refused, visited) = run(Some(1_000_000));
    let error = refused.unwrap_err();
    println!("{error}");
    assert_eq!((visited, error.exit_code()), (0, 4));
    let text = error.to_string();
    assert!(text.contains("3362 dofs need another ") && text.contains("1.0 MB are available"), "{text}");
    // with plenty, and where the system does not tell
    for available in [Some(1 << 40), None] {
        let (done, visited) = run(available);
        assert_eq!((done.unwrap().increments, visited), (1, 2));
    }
}

#[test]
fn the_system_tells_what_it_has() {
    if cfg!(target_os = "linux") {
        let (available, peak) = (memory::available().unwrap(), memory::peak().unwrap());
        assert!(available > 1 << 20 && peak > 1 << 20);
    }
}

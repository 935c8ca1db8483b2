//! Your own loop over increments: stop when a crack has run far enough. `cargo run --release --example own_loop -- geo/tension`.

use std::path::PathBuf;

use midplane::history::{Equations, History, Means};
use midplane::run::{Options, prepare};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = PathBuf::from(std::env::args().nth(1).unwrap_or("geo/tension".into()));
    let options = Options { out: Some("results/example_loop".into()), ..Options::of(&scene) };
    let mut prepared = prepare(&options, &mut |_| ())?;
    let equations = Equations::new(&prepared.problem, Means::default(), &mut prepared.clock)?;
    let mut history = History::new(&prepared.problem, &equations, prepared.clock);
    while let Some(increment) = history.next()? {
        let state = history.state();
        let opening = state.snapshot.jumps.iter().flatten().map(|jump| jump.x).fold(0.0, f64::max);
        println!("{} {:.3}: largest opening {opening:.3e}", increment.step.name, increment.load_factor);
        if opening > 1e-4 {
            break;
        }
    }
    println!("{} increments, {:.3e} dissipated", history.totals().increments, history.state().dissipated);
    Ok(())
}

//! Run a scene and read what came out: `cargo run --release --example run_scene -- geo/compression`.

use std::path::PathBuf;

use midplane::run::{Event, Options, run};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = PathBuf::from(std::env::args().nth(1).unwrap_or("geo/compression".into()));
    let options = Options {
        out: Some("results/example".into()),
        settings: vec!["output.fields=last".into()],
        ..Options::of(&scene)
    };
    let done = run(&options, &mut |event| match event {
        Event::Warning(warning) => eprintln!("{warning}"),
        Event::Increment { row, .. } => println!("{} {}: {:?}", row.step, row.load_factor, row.values),
        _ => {}
    })?;
    println!("{} iterations; open {}", done.totals.iterations, done.collection.display());
    Ok(())
}

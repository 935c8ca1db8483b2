//! Text as a scene, in a folder where no file is.

#![no_main]

use libfuzzer_sys::fuzz_target;
use midplane::error::short_message;
use midplane::run;

fuzz_target!(|text: &str| {
    let file = "no such folder/scene.json";
    if let Err(error) = run::parse_scene(file.into(), text.into(), &[]) {
        let said = short_message(&error.to_string());
        assert!(
            !said.is_empty() && !said.chars().any(|c| c.is_control() && !matches!(c, '\n' | '\t')),
            "{said:?}"
        );
    }
});

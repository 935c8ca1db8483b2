//! Text as a study of the scene in the folder of this run.

#![no_main]

use std::path::PathBuf;

use libfuzzer_sys::fuzz_target;
use midplane::study::{Selection, StudyPlan};

fuzz_target!(|text: &str| {
    let file = PathBuf::from(std::env::var_os("FUZZ_FOLDER").unwrap_or_default()).join("study.json");
    if let Ok(plan) = StudyPlan::parse(&file, text.into(), Selection::All) {
        assert!(!plan.is_empty());
    }
});

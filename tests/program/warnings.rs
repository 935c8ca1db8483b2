//! Claim: every code of a warning has its section in docs/WARNINGS.md, and every section its code.

use midplane::error::Code;

#[test]
fn every_code_has_its_section_with_reason_and_help() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/WARNINGS.md");
    let text = std::fs::read_to_string(path).unwrap();
    let sections: Vec<&str> = text.split("\n## ").skip(1).collect();
    assert_eq!(sections.len(), Code::ALL.len());
    for (i, (code, section)) in Code::ALL.iter().zip(&sections).enumerate() {
        assert_eq!(*code as usize, i, "{code:?} stands at its place");
        assert!(section.starts_with(&format!("{code}: ")), "{code} has no section: {section}");
        for part in ["\n**Why.** ", "\n**Help.** "] {
            assert!(section.contains(part), "{code}: no {part:?}");
        }
    }
}

#[test]
fn every_code_is_used_once() {
    fn sources(folder: &std::path::Path, text: &mut String) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                sources(&path, text);
            } else if !path.ends_with("warning.rs") {
                text.push_str(&std::fs::read_to_string(&path).unwrap());
            }
        }
    }
    let mut text = String::new();
    sources(&std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut text);
    for code in Code::ALL {
        assert_eq!(text.matches(&format!("Code::{code:?}")).count(), 1, "{code}");
    }
}

//! The door: text to scene, every refusal with its line and key.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::{Scene, Source, set};
use crate::error::{At, Error, Result, name_cure};

/// Reads a scene file, or the `scene.json` of a folder, applies `--set` settings and checks it.
pub fn read(path: &Path, settings: &[String]) -> Result<Scene> {
    let file: PathBuf = if path.is_dir() { path.join("scene.json") } else { path.into() };
    let text = std::fs::read_to_string(&file).map_err(Error::io("read", &file))?;
    parse(file, text, settings)
}

/// Reads a scene from its text; `file` is for messages and for the files it names.
pub fn parse(file: PathBuf, text: String, settings: &[String]) -> Result<Scene> {
    let mut value: Value = serde_json::from_str(&text).map_err(|error| syntax(&file, &text, &error))?;
    let source = Source::new(file, text);
    if let Some(path) = &source.duplicate {
        let key = path.last().map_or("", String::as_str);
        return Err(source.refuse(path, format!("the key \"{key}\" occurs twice"), "keep one of them"));
    }
    for setting in settings {
        set::apply(&mut value, setting, &source.file)?;
    }
    let mut scene: Scene = serde_path_to_error::deserialize(value).map_err(|error| {
        let path: Vec<String> =
            error.path().iter().map(|part| part.to_string()).filter(|part| part != "?").collect();
        let (what, cure) = explain(&error.inner().to_string());
        source.refuse(&path, what, cure)
    })?;
    scene.source = source;
    scene.check()?;
    Ok(scene)
}

/// A text that is not JSON.
fn syntax(file: &Path, text: &str, error: &serde_json::Error) -> Error {
    let start: usize = text.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
    let mut offset = (start + error.column().saturating_sub(1)).min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    let at = At {
        file: file.into(),
        line: error.line(),
        key: String::new(),
        text: text.into(),
        span: offset..offset + text[offset..].chars().next().map_or(0, char::len_utf8),
    };
    let message = error.to_string();
    let what = message.split(" at line ").next().unwrap_or(&message).to_string();
    Error::Text { at: Box::new(at), what, cure: "a scene is one JSON object".into() }
}

/// serde's message as (what is wrong, what would have been right).
fn explain(message: &str) -> (String, String) {
    let quoted =
        |text: &str| -> Vec<String> { text.split('`').skip(1).step_by(2).map(str::to_string).collect() };
    for (kind, noun) in [("unknown field ", "key"), ("unknown variant ", "value")] {
        if let Some(rest) = message.strip_prefix(kind) {
            let names = quoted(rest);
            if let Some((wrong, right)) = names.split_first() {
                return (
                    format!("unknown {noun} \"{wrong}\""),
                    name_cure(wrong, right.iter().map(String::as_str)),
                );
            }
        }
    }
    if message.starts_with("missing field ") {
        let name = quoted(message).pop().unwrap_or_default();
        return (format!("the key \"{name}\" is missing"), "add it".into());
    }
    match message.split_once(", expected ") {
        Some((what, expected)) => (what.into(), format!("expected {expected}")),
        None => (message.into(), "`midplane schema` prints what a scene may hold".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = r#"{
  "plane": "strain",
  "subdomains": {
    "lower": { "geo": "lower.geo", "material": "rock" },
    "upper": { "geo": "upper.geo", "material": "rock", "parameters": { "n": 8 } }
  },
  "materials": { "rock": { "young": 1.0e4, "poisson": 0.0 } },
  "interfaces": {
    "joint": {
      "side_a": "lower.top", "side_b": "upper.bottom",
      "law": { "type": "elastic", "normal_stiffness": 1.0e7, "tangential_stiffness": 1.0e7 }
    }
  },
  "steps": [
    { "name": "compression",
      "fix": { "lower.bottom": ["y"], "lower.corner": ["x"] },
      "load": { "upper.top": { "traction": [0.0, -1.0] } } }
  ],
  "output": { "history": { "tau": "joint.traction_t@0.5" } }
}"#;

    fn refusal(from: &str, to: &str) -> String {
        assert!(SCENE.contains(from), "{from}");
        parse("scene.json".into(), SCENE.replacen(from, to, 1), &[]).unwrap_err().to_string()
    }

    #[test]
    fn a_good_scene_is_read() {
        let scene = parse("scene.json".into(), SCENE.into(), &["thickness=0.5".into()]).unwrap();
        assert_eq!(scene.thickness, 0.5);
        assert_eq!(scene.interfaces["joint"].side_b.names(), ["upper.bottom"]);
        assert_eq!(scene.steps[0].increments, 1);
    }

    #[test]
    fn every_refusal_names_line_and_key_and_what_would_have_been_right() {
        for (from, to, expected) in [
            (
                "\"strain\"",
                "\"axisymmetric\"",
                "scene.json:2 plane: unknown value \"axisymmetric\"; there is strain, stress",
            ),
            (
                "\"side_a\"",
                "\"side_c\"",
                "interfaces.joint.side_c: unknown key \"side_c\"; there is side_a, side_b",
            ),
            (
                "normal_stiffness",
                "normal_stifness",
                "scene.json:11 interfaces.joint.law: unknown key \"normal_stifness\"",
            ),
            (
                "{ \"n\": 8 }",
                "{ \"n\": \"eight\" }",
                "scene.json:5 subdomains.upper.parameters.n: invalid type: string \"eight\"; expected f64",
            ),
            ("\"poisson\": 0.0", "\"poisson\": 0.5", "scene.json:7 materials.rock.poisson: "),
            ("1.0e4", "-1.0e4", "scene.json:7 materials.rock.young: "),
            ("1.0e4", "1e400", "scene.json:7"),
            ("1.0e4", "NaN", "scene.json:7"),
            (
                "\"material\": \"rock\"",
                "\"material\": \"rok\"",
                "scene.json:4 subdomains.lower.material: no material \"rok\"; there is rock. Did you mean \"rock\"?",
            ),
            (
                "\"lower.bottom\": [",
                "\"lowr.bottom\": [",
                "no subdomain \"lowr\"; there is lower, upper. Did you mean \"lower\"?",
            ),
            ("\"traction\"", "\"tracton\"", "unknown value \"tracton\"; there is traction, pressure, force"),
            ("\"name\": \"compression\",", "", "the key \"name\" is missing"),
            ("\"geo\": \"lower.geo\", ", "", "subdomains.lower: neither \"geo\" nor \"msh\""),
            ("\"upper\": {", "\"lower\": {", "scene.json:5 subdomains.lower: the key \"lower\" occurs twice"),
            ("traction_t@0.5", "traction_q@0.5", "output.history.tau: "),
        ] {
            let message = refusal(from, to);
            assert!(message.contains(expected), "{message}\n  should contain\n{expected}");
        }
    }

    #[test]
    fn no_text_makes_the_door_panic() {
        for n in 0..SCENE.len() {
            let _ = parse("scene.json".into(), SCENE[..n].to_string(), &[]);
            let _ = parse("scene.json".into(), format!("{}é{}", &SCENE[..n], &SCENE[n + 1..]), &[]);
        }
        for text in ["", "[]", "null", "{}", "\u{feff}{}"] {
            assert!(parse("scene.json".into(), text.into(), &[]).is_err());
        }
    }
}

//! Validation: text to scene, every error with its line and key.

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde_json::Value;
use serde_path_to_error::Segment;

use super::explain::{explain, syntax};
use super::plain::plain;
use super::text::text_of;
use super::{Accuracy, Scene, Source, expression::Expression, set};
use crate::error::Result;

/// Reads a scene file, or the `scene.json` of a folder, applies its preset and `--set` settings and checks it. `preset` changes
/// the document to a preset.
pub fn read(
    path: &Path,
    settings: &[String],
    preset: impl FnOnce(&mut Value, &Source, Accuracy) -> Result<()>,
) -> Result<Scene> {
    let file: PathBuf = if path.is_dir() { path.join("scene.json") } else { path.into() };
    let text = text_of(&file, "give a scene file, or the folder of a scene.json")?;
    parse(file, text, settings, preset)
}

/// Reads a scene from its text; `file` is for messages and for the files it names.
pub fn parse(
    file: PathBuf,
    text: String,
    settings: &[String],
    preset: impl FnOnce(&mut Value, &Source, Accuracy) -> Result<()>,
) -> Result<Scene> {
    let set_all = |value: &mut Value, source: &Source| {
        settings.iter().try_for_each(|setting| set::apply(value, setting, &source.file))
    };
    let set = |value: &mut Value, source: &Source| {
        if value.get("density").is_some() {
            let help = "call it \"refinement\": \"density\" is that of a material";
            return Err(source.error_at(&["density"], "a mesh has no density", help));
        }
        // the preset may come by a setting, and settings come on top of it
        let mut wanted = value.clone();
        set_all(&mut wanted, source)?;
        let accuracy = wanted.get("accuracy").cloned().and_then(|name| serde_json::from_value(name).ok());
        if let Some(accuracy) = accuracy {
            preset(value, source, accuracy)?;
        }
        set_all(value, source)
    };
    let checked = || {
        let (mut scene, source) = document::<Scene>(file, text, "a scene", set)?;
        scene.source = source;
        scene.name_parts()?;
        scene.check()?;
        Ok(scene)
    };
    checked().map_err(|error| set::blamed(error, settings))
}

/// Reads what a JSON text says, after `change`; `noun` is what it is called, such as "a scene".
pub fn document<T: DeserializeOwned>(
    file: PathBuf,
    text: String,
    noun: &str,
    change: impl FnOnce(&mut Value, &Source) -> Result<()>,
) -> Result<(T, Source)> {
    let parsed = serde_json::from_str(&plain(&text));
    let mut value: Value = parsed.map_err(|error| syntax(&file, &text, noun, &error))?;
    let source = Source::new(file, text);
    if let Some(path) = &source.duplicate {
        let key = path.last().map_or("", String::as_str);
        return Err(source.error_at(path, format!("the key \"{key}\" occurs twice"), "keep one of them"));
    }
    change(&mut value, &source)?;
    let read = serde_path_to_error::deserialize(&value).map_err(|error| {
        let part = |part: &Segment| match part {
            Segment::Seq { index } => Some(index.to_string()),
            Segment::Unknown => None,
            named => Some(named.to_string()),
        };
        let mut path: Vec<String> = error.path().iter().filter_map(part).collect();
        let message = error.inner().to_string();
        // a kind that there is none of stands under "type"
        let kind = [path.clone(), vec!["type".into()]].concat();
        if message.starts_with("unknown variant") && text_at(&value, &kind).is_some() {
            path = kind;
        }
        // a formula speaks for itself, with its position
        if let Some(text) = text_at(&value, &path)
            && let Err(fault) = Expression::parse(text)
            && message == fault.what
        {
            return source.error_within(&path, text, fault.span, fault.what, fault.help);
        }
        let (what, help) = explain(&message, noun);
        source.error_at(&path, what, help)
    })?;
    Ok((read, source))
}

/// The string at a path.
fn text_at<'a>(value: &'a Value, path: &[String]) -> Option<&'a str> {
    let below = |value: &'a Value, part: &String| match value {
        Value::Array(list) => list.get(part.parse::<usize>().ok()?),
        other => other.get(part),
    };
    path.iter().try_fold(value, below)?.as_str()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;

    fn parsed(file: PathBuf, text: String, settings: &[String]) -> Result<Scene> {
        parse(file, text, settings, |_, _, _| Ok(()))
    }

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
        parsed("scene.json".into(), SCENE.replacen(from, to, 1), &[]).unwrap_err().to_string()
    }

    #[test]
    fn a_good_scene_is_read() {
        let scene = parsed("scene.json".into(), SCENE.into(), &["thickness=0.5".into()]).unwrap();
        assert_eq!(scene.thickness, 0.5);
        assert_eq!(scene.interfaces["joint"].sides().unwrap()[1].names(), ["upper.bottom"]);
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
                "interfaces.joint.side_c: unknown key \"side_c\"; did you mean \"side_a\"? There is side_a, side_b",
            ),
            (
                "normal_stiffness",
                "normal_stifness",
                "scene.json:11 interfaces.joint.law: unknown key \"normal_stifness\"",
            ),
            (
                "{ \"n\": 8 }",
                "{ \"n\": \"eight\" }",
                "scene.json:5 subdomains.upper.parameters.n: it is the text \"eight\"; it takes a number",
            ),
            ("\"poisson\": 0.0", "\"poisson\": 0.5", "scene.json:7 materials.rock.poisson: "),
            ("1.0e4", "-1.0e4", "scene.json:7 materials.rock.young: "),
            ("1.0e4", "1e400", "scene.json:7"),
            ("1.0e4", "NaN", "scene.json:7"),
            ("1.0e4", "1,0", "scene.json:7: \"1,0\" is no number; decimals take a point, as in 1.0"),
            (
                "[\"y\"], \"lower.corner\"",
                "[\"Y\"], \"lower.corner\"",
                "steps.0.fix.lower.bottom.0: unknown value \"Y\"; there is x, y. Did you mean \"y\"?",
            ),
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
            (
                "-1.0] }",
                "\"5*cos(pi*w)\"] }",
                "scene.json:17 steps.0.load.upper.top.traction.1: unknown name \"w\" at character 10 of \"5*cos(pi*w)\"; there is x, y, z, s, load_factor, opening, damage, pi, e, abs",
            ),
            ("-1.0] }", "\"1+sinn(x)\"] }", "did you mean \"sin\"?"),
            ("-1.0] }", "\"(1 + 2\"] }", "\"(\" is not closed at character 1 of \"(1 + 2\"; add \")\""),
            (
                "-1.0] }",
                "\"2 x\"] }",
                "an operator is missing at character 3 of \"2 x\"; write one of + - * / ^",
            ),
            ("-1.0] }", "\"2**x\"] }", "a value is missing at character 3 of \"2**x\"; a power is written ^"),
            ("-1.0] }", "\"0,5\"] }", "\",\" stands outside of a function at character 2"),
            ("-1.0] }", "\"if(x, 1)\"] }", "if takes 3, not 2, at character 3"),
            ("-1.0] }", "\"cos\"] }", "\"cos\" is a function at character 1 of \"cos\"; write cos( … )"),
            ("-1.0] }", "\"1/0\"] }", "\"1/0\" is inf; a number of a scene is finite"),
            ("-1.0] }", "\"\"] }", "a value is missing at character 1 of \"\""),
            ("-1.0] }", "true] }", "it is true; it takes a number or a formula such as"),
            (
                "\"law\":",
                "\"initial_traction\": [\"load_factor\", 0], \"law\":",
                "interfaces.joint.initial_traction.0: load_factor in \"load_factor\"; an initial traction",
            ),
        ] {
            let message = refusal(from, to);
            assert!(message.contains(expected), "{message}\n  should contain\n{expected}");
        }
    }

    #[test]
    fn a_wrong_formula_is_underlined_where_it_is_wrong() {
        let text = SCENE.replace("-1.0]", "\"2*(x+ß)\"]");
        let Err(Error::Text { at, .. }) = parsed("scene.json".into(), text.clone(), &[]) else {
            panic!("accepted");
        };
        assert_eq!(&text[at.span], "ß");
    }

    #[test]
    fn a_byte_order_mark_and_comments_keep_positions() {
        let twice = "\"upper\": {";
        for (from, to, expected) in [
            ("\"young\": 1.0e4", "\"young\": -1.0", "scene.json:8 materials.rock.young"),
            (twice, "\"lower\": {", "scene.json:6 subdomains.lower: the key \"lower\" occurs twice"),
        ] {
            let text = format!("\u{feff}// a note\n{}", SCENE.replacen(from, to, 1));
            let error = parsed("scene.json".into(), text, &[]).unwrap_err();
            assert!(error.to_string().contains(expected), "{error}\n  should contain\n{expected}");
        }
    }

    #[test]
    fn no_text_makes_the_door_panic() {
        for n in 0..SCENE.len() {
            let _ = parsed("scene.json".into(), SCENE[..n].to_string(), &[]);
            let _ = parsed("scene.json".into(), format!("{}é{}", &SCENE[..n], &SCENE[n + 1..]), &[]);
        }
        for text in ["", "[]", "null", "{}", "\u{feff}{}", "// {}", "/*"] {
            assert!(parsed("scene.json".into(), text.into(), &[]).is_err());
        }
    }
}

//! From axes to points: grid, one at a time, Latin hypercube.

use serde_json::Value;

use super::file::{Axis, Design, Study};
use crate::error::Result;
use crate::scene::Source;

/// A point: what its axes are set to, as shown, and all its settings in order.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StudyPoint {
    /// One value per axis, null where the scene rules.
    pub(super) values: Vec<Value>,
    /// KEY=VALUE.
    pub(super) settings: Vec<String>,
}

/// More points are a mistake.
const MOST: usize = 1_000_000;

/// The points of a study in order; `source` is for refusals.
pub(super) fn points(study: &Study, source: &Source) -> Result<Vec<StudyPoint>> {
    for (name, axis) in &study.axes {
        check(name, axis, source)?;
    }
    let lists: Vec<Vec<Value>> = study.axes.values().map(values).collect();
    let choices: Vec<Vec<Option<Value>>> = match study.design {
        Design::Grid => {
            let total = lists.iter().try_fold(1_usize, |n, list| n.checked_mul(list.len()));
            if total.is_none_or(|total| total > MOST) {
                return Err(source.error_at(&["axes"], "more than a million points", "shorten the axes"));
            }
            lists.iter().fold(vec![Vec::new()], |points, list| {
                let longer = |point: &Vec<Option<Value>>| {
                    let point = point.clone();
                    list.iter().map(move |value| [&point[..], &[Some(value.clone())]].concat())
                };
                points.iter().flat_map(longer).collect()
            })
        }
        Design::OneAtATime => {
            let as_it_is = vec![None; lists.len()];
            let mut points = vec![as_it_is.clone()];
            for (a, list) in lists.iter().enumerate() {
                for value in list {
                    let mut point = as_it_is.clone();
                    point[a] = Some(value.clone());
                    points.push(point);
                }
            }
            points
        }
        Design::LatinHypercube { points, seed } => {
            if points == 0 || points > MOST {
                return Err(source.error_at(&["design"], format!("{points} points"), "ask for some"));
            }
            latin_hypercube(study, &lists, points, seed)
        }
    };
    let point = |values: Vec<Option<Value>>| {
        let mut settings = vec!["/output/fields=none".to_string()];
        settings.extend(study.set.iter().map(setting));
        for (axis, value) in study.axes.values().zip(&values) {
            value.iter().for_each(|value| settings.extend(axis_settings(axis, value)));
        }
        StudyPoint { values: values.into_iter().map(Option::unwrap_or_default).collect(), settings }
    };
    Ok(choices.into_iter().map(point).collect())
}

/// KEY=VALUE.
pub(super) fn setting((key, value): (&String, &Value)) -> String {
    format!("{key}={value}")
}

fn axis_settings(axis: &Axis, value: &Value) -> Vec<String> {
    let keys = axis.key.iter().flat_map(|key| key.names()).cloned();
    let parameters = axis.parameter.iter().flat_map(|parameter| parameter.names());
    let parameters = parameters.filter_map(|name| name.split_once('.'));
    let parameters = parameters.map(|(subdomain, name)| format!("/subdomains/{subdomain}/parameters/{name}"));
    let keys: Vec<String> = keys.chain(parameters).collect();
    match value {
        Value::Object(settings) if keys.is_empty() => {
            settings.iter().map(|(key, value)| format!("{key}={value}")).collect()
        }
        value => keys.iter().map(|key| format!("{key}={value}")).collect(),
    }
}

fn check(name: &str, axis: &Axis, source: &Source) -> Result<()> {
    let path = ["axes", name];
    let given = [axis.values.is_some(), axis.range.is_some(), axis.log_range.is_some()];
    if given.iter().filter(|given| **given).count() != 1 {
        let what = "an axis has one of values, range and log_range";
        return Err(source.error_at(&path, what, "such as \"values\": [4, 8, 16]"));
    }
    if axis.values.as_ref().is_some_and(Vec::is_empty) {
        return Err(source.error_at(&["axes", name, "values"], "no values", "list some"));
    }
    if axis.values.is_none() && axis.count.is_none_or(|count| count == 0 || count > MOST) {
        return Err(source.error_at(&path, "a range without \"count\"", "say how many values it has"));
    }
    let finite = |range: &[f64; 2]| range.iter().all(|end| end.is_finite());
    if !axis.range.iter().chain(&axis.log_range).all(finite) {
        return Err(source.error_at(&path, "a range that does not end", "its ends are numbers"));
    }
    if axis.log_range.is_some_and(|[a, b]| a <= 0.0 || b <= 0.0) {
        let what = "a log_range that touches zero";
        return Err(source.error_at(&["axes", name, "log_range"], what, "both ends are positive"));
    }
    let mut parameters = axis.parameter.iter().flat_map(|names| names.names());
    if let Some(wrong) = parameters.find(|name| !name.contains('.')) {
        let what = format!("\"{wrong}\" names no subdomain");
        let help = "write <subdomain>.<parameter>, such as lower.edges";
        return Err(source.error_at(&["axes", name, "parameter"], what, help));
    }
    if axis.key.is_none() && axis.parameter.is_none() {
        let objects = axis.values.as_ref().is_some_and(|values| values.iter().all(Value::is_object));
        if !objects {
            let help = "name one, or make every value an object of settings";
            return Err(source.error_at(&path, "neither \"key\" nor \"parameter\"", help));
        }
    }
    Ok(())
}

/// The values of an axis.
fn values(axis: &Axis) -> Vec<Value> {
    match (&axis.values, axis.count.unwrap_or(1)) {
        (Some(values), _) => values.clone(),
        (None, 1) => vec![at(axis, 0.0)],
        (None, count) => (0..count).map(|i| at(axis, i as f64 / (count - 1) as f64)).collect(),
    }
}

/// The value at a fraction of a range.
fn at(axis: &Axis, fraction: f64) -> Value {
    let between = |[a, b]: [f64; 2]| if fraction == 1.0 { b } else { a + fraction * (b - a) };
    let value = match (axis.range, axis.log_range) {
        (Some(range), _) => between(range),
        (None, Some([a, _])) if fraction == 0.0 => a,
        (None, Some([_, b])) if fraction == 1.0 => b,
        (None, Some(range)) => between(range.map(f64::ln)).exp(),
        (None, None) => 0.0,
    };
    if axis.whole { Value::from(value.round() as i64) } else { Value::from(value) }
}

fn latin_hypercube(study: &Study, lists: &[Vec<Value>], points: usize, seed: u64) -> Vec<Vec<Option<Value>>> {
    let mut random = Random(seed);
    let columns: Vec<Vec<Value>> = study
        .axes
        .values()
        .zip(lists)
        .map(|(axis, list)| {
            let mut strata: Vec<usize> = (0..points).collect();
            for i in (1..points).rev() {
                strata.swap(i, (random.unit() * (i + 1) as f64) as usize);
            }
            let value = |stratum: usize| {
                let fraction = (stratum as f64 + random.unit()) / points as f64;
                match axis.values {
                    Some(_) => list[((fraction * list.len() as f64) as usize).min(list.len() - 1)].clone(),
                    None => at(axis, fraction),
                }
            };
            strata.into_iter().map(value).collect()
        })
        .collect();
    (0..points).map(|p| columns.iter().map(|column| Some(column[p].clone())).collect()).collect()
}

/// SplitMix64: small, the same on every machine.
struct Random(u64);

impl Random {
    /// A number from 0 to below 1.
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::document;

    fn of(text: &str) -> Result<Vec<StudyPoint>> {
        let (study, source) = document::<Study>("study.json".into(), text.into(), "a study", |_, _| Ok(()))?;
        points(&study, &source)
    }

    #[test]
    fn a_grid_has_every_combination_and_one_at_a_time_the_sum() {
        let axes = r#""axes": { "a": { "key": "x", "values": [1, 2, 3] },
            "b": { "parameter": ["l.n", "u.n"], "log_range": [1, 100], "count": 3 } }"#;
        let grid = of(&format!("{{ {axes} }}")).unwrap();
        assert_eq!(grid.len(), 9);
        let expected = ["/output/fields=none", "x=1", "/subdomains/l/parameters/n=10.0"];
        let near: Vec<&str> = grid[1].settings.iter().map(String::as_str).take(2).collect();
        assert_eq!(near, expected[..2]);
        assert!((grid[1].values[1].as_f64().unwrap() - 10.0).abs() < 1e-12);
        let swept = of(&format!("{{ {axes}, \"design\": \"one_at_a_time\" }}")).unwrap();
        assert_eq!(swept.len(), 1 + 3 + 3);
        assert_eq!((swept[0].settings.len(), &swept[0].values[0]), (1, &Value::Null));
    }

    #[test]
    fn a_latin_hypercube_takes_every_stratum_once_and_repeats() {
        let text = r#"{ "axes": { "a": { "key": "x", "range": [0, 8], "count": 2 },
            "b": { "key": "y", "values": ["p", "q"] } },
            "design": { "latin_hypercube": { "points": 8, "seed": 3 } } }"#;
        let points = of(text).unwrap();
        let mut strata: Vec<usize> =
            points.iter().map(|point| point.values[0].as_f64().unwrap() as usize).collect();
        strata.sort_unstable();
        assert_eq!(strata, (0..8).collect::<Vec<_>>());
        assert_eq!(points.iter().filter(|point| point.values[1] == "p").count(), 4);
        assert_eq!(points, of(text).unwrap());
        assert_ne!(points, of(&text.replace("\"seed\": 3", "\"seed\": 4")).unwrap());
    }

    #[test]
    fn a_wrong_axis_is_refused_with_its_line_and_help() {
        for (axis, expected) in [
            (r#"{ "key": "x" }"#, "study.json:2 axes.a: an axis has one of values, range and log_range"),
            (r#"{ "key": "x", "values": [] }"#, "axes.a.values: no values; list some"),
            (r#"{ "key": "x", "range": [0, 1] }"#, "a range without \"count\""),
            (r#"{ "key": "x", "log_range": [0, 1], "count": 2 }"#, "touches zero; both ends are positive"),
            (r#"{ "values": [1] }"#, "neither \"key\" nor \"parameter\""),
            (r#"{ "parameter": "n", "values": [1] }"#, "\"n\" names no subdomain"),
            (r#"{ "keys": "n", "values": [1] }"#, "unknown key \"keys\"; there is key, parameter"),
        ] {
            let message = of(&format!("{{ \"axes\": {{\n \"a\": {axis} }} }}")).unwrap_err().to_string();
            assert!(message.contains(expected), "{message}\n  should contain\n{expected}");
        }
    }
}

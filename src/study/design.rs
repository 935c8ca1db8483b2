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

/// Points of the axes, each made when it is asked for.
#[derive(Debug)]
pub(super) struct DesignPoints {
    /// Number of points.
    pub(super) count: usize,
    /// Strata of a Latin hypercube: one of every point, by axis.
    strata: Vec<Vec<u32>>,
}

impl DesignPoints {
    /// The points of a study; `source` is for refusals.
    pub(super) fn new(study: &Study, source: &Source) -> Result<DesignPoints> {
        for (name, axis) in &study.axes {
            check(name, axis, source)?;
        }
        let lengths = || study.axes.values().map(length);
        let mut strata = Vec::new();
        let count = match study.design {
            Design::Grid => {
                let total = lengths().try_fold(1_usize, usize::checked_mul);
                total.filter(|total| *total <= MOST).ok_or_else(|| {
                    source.error_at(&["axes"], "more than a million points", "shorten the axes")
                })?
            }
            Design::OneAtATime => 1 + lengths().sum::<usize>(),
            Design::LatinHypercube { points, seed } => {
                if points == 0 || points > MOST {
                    return Err(source.error_at(&["design"], format!("{points} points"), "ask for some"));
                }
                strata.extend((0..study.axes.len()).map(|axis| shuffled(axis, points, seed)));
                points
            }
        };
        Ok(DesignPoints { count, strata })
    }

    /// A point of the study.
    pub(super) fn point(&self, study: &Study, point: usize) -> StudyPoint {
        let mut settings = vec!["/output/fields=none".to_string()];
        settings.extend(study.set.iter().map(setting));
        let values = self.values(study, point);
        for (axis, value) in study.axes.values().zip(&values) {
            value.iter().for_each(|value| settings.extend(axis_settings(axis, value)));
        }
        StudyPoint { values: values.into_iter().map(Option::unwrap_or_default).collect(), settings }
    }

    /// A value per axis; none where the scene rules.
    fn values(&self, study: &Study, point: usize) -> Vec<Option<Value>> {
        let axes = study.axes.values();
        match study.design {
            Design::Grid => {
                let mut rest = point;
                let mut values: Vec<Option<Value>> = axes
                    .rev()
                    .map(|axis| {
                        let i = rest % length(axis);
                        rest /= length(axis);
                        Some(value(axis, i))
                    })
                    .collect();
                values.reverse();
                values
            }
            Design::OneAtATime => {
                let mut begin = 1;
                axes.map(|axis| {
                    let i = point.checked_sub(begin).filter(|i| *i < length(axis));
                    begin += length(axis);
                    i.map(|i| value(axis, i))
                })
                .collect()
            }
            Design::LatinHypercube { points, seed } => {
                let place = |(a, axis): (usize, &Axis)| {
                    let within = unit(seed, first(a, points) + points - 1 + point);
                    let fraction = (f64::from(self.strata[a][point]) + within) / points as f64;
                    Some(match &axis.values {
                        Some(list) => {
                            list[((fraction * list.len() as f64) as usize).min(list.len() - 1)].clone()
                        }
                        None => at(axis, fraction),
                    })
                };
                axes.enumerate().map(place).collect()
            }
        }
    }
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

/// Number of values of an axis.
fn length(axis: &Axis) -> usize {
    axis.values.as_ref().map_or(axis.count.unwrap_or(1), Vec::len)
}

/// A value of an axis.
fn value(axis: &Axis, i: usize) -> Value {
    match (&axis.values, axis.count.unwrap_or(1)) {
        (Some(values), _) => values[i].clone(),
        (None, 1) => at(axis, 0.0),
        (None, count) => at(axis, i as f64 / (count - 1) as f64),
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

/// Strata of a Latin hypercube's axis in the order of the points.
fn shuffled(axis: usize, points: usize, seed: u64) -> Vec<u32> {
    let mut strata: Vec<u32> = (0..points as u32).collect();
    for (n, i) in (1..points).rev().enumerate() {
        strata.swap(i, (unit(seed, first(axis, points) + n) * (i + 1) as f64) as usize);
    }
    strata
}

/// First of an axis' random numbers: those that shuffle its strata, then one per point.
fn first(axis: usize, points: usize) -> usize {
    axis * (2 * points - 1)
}

/// Number n of a random sequence, from 0 to below 1. SplitMix64: small, the same on every machine, its numbers in any order.
fn unit(seed: u64, n: usize) -> f64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(n as u64 + 1));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::document;

    fn of(text: &str) -> Result<Vec<StudyPoint>> {
        let (study, source) = document::<Study>("study.json".into(), text.into(), "a study", |_, _| Ok(()))?;
        let points = DesignPoints::new(&study, &source)?;
        Ok((0..points.count).map(|k| points.point(&study, k)).collect())
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

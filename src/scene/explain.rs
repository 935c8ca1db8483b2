//! Faults of a text that is no JSON, or whose values are not of their types, in the words of a user.

use std::path::Path;

use super::plain::plain;
use crate::error::{At, Error, name_help};

/// A text that is not JSON.
pub(super) fn syntax(file: &Path, text: &str, noun: &str, error: &serde_json::Error) -> Error {
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
        stated: false,
        span: offset..offset + text[offset..].chars().next().map_or(0, char::len_utf8),
    };
    if text.trim().is_empty() {
        let at = At { text: String::new(), line: 0, ..at };
        return Error::Text {
            at: Box::new(at),
            what: "the file is empty".into(),
            help: format!("{noun} is one JSON object"),
        };
    }
    if error.to_string().starts_with("expected `,`")
        && let Some(end) = end_before(text, offset)
    {
        let line = 1 + text[..end].matches('\n').count();
        let at = At { line, span: end..end + text[end..].chars().next().map_or(0, char::len_utf8), ..at };
        return Error::Text {
            at: Box::new(at),
            what: "a comma is missing after this".into(),
            help: "put one there".into(),
        };
    }
    let decimal = decimal_comma(&text[..offset], &text[offset..]);
    if let Some(number) = decimal {
        let (what, help) = (format!("\"{number}\" is no number"), "decimals take a point, as in 1.0");
        return Error::Text { at: Box::new(at), what, help: help.into() };
    }
    let message = error.to_string();
    let what = message.split(" at line ").next().unwrap_or(&message).to_string();
    Error::Text { at: Box::new(at), what, help: format!("{noun} is one JSON object") }
}

/// The last character of the value before a place, if what follows there begins another: a quote, digit or bracket.
fn end_before(text: &str, offset: usize) -> Option<usize> {
    let begins = text[offset..].starts_with(['"', '{', '[', '-'])
        || text[offset..].starts_with(|c: char| c.is_ascii_digit());
    let plain = plain(text); // comments are blanks there
    let before = plain.get(..offset)?.trim_end();
    let (end, _) = before.char_indices().next_back().filter(|_| begins)?;
    text.is_char_boundary(end).then_some(end)
}

/// A number with a comma for its point, around a place where JSON wants something else.
fn decimal_comma(before: &str, after: &str) -> Option<String> {
    let digits = |c: char| c.is_ascii_digit();
    let decimals: String = after.chars().take_while(|c| digits(*c)).collect();
    let whole: String = before.strip_suffix(',')?.chars().rev().take_while(|c| digits(*c)).collect();
    if decimals.is_empty() || whole.is_empty() {
        return None;
    }
    Some(format!("{},{decimals}", whole.chars().rev().collect::<String>()))
}

/// serde's message as (what is wrong, what would have been right).
pub(super) fn explain(message: &str, noun: &str) -> (String, String) {
    let quoted =
        |text: &str| -> Vec<String> { text.split('`').skip(1).step_by(2).map(str::to_string).collect() };
    for (kind, noun) in [("unknown field ", "key"), ("unknown variant ", "value")] {
        if let Some(rest) = message.strip_prefix(kind) {
            let names = quoted(rest);
            if let Some((wrong, right)) = names.split_first() {
                return (
                    format!("unknown {noun} \"{wrong}\""),
                    name_help(wrong, right.iter().map(String::as_str)),
                );
            }
        }
    }
    if message.starts_with("missing field ") {
        let name = quoted(message).pop().unwrap_or_default();
        return (format!("the key \"{name}\" is missing"), "add it".into());
    }
    if let Some((_, kind)) = message.split_once("any variant of untagged enum ") {
        let help = match kind {
            "OneOrMany" => "it takes a name in quotes, or a list [ ] of names".into(),
            _ => format!("`midplane schema` prints what {noun} may hold"),
        };
        return ("it has none of the forms that it may have".into(), help);
    }
    match message.split_once(", expected ") {
        Some((what, expected)) => (found(what), format!("it takes {}", wanted(expected))),
        None => (message.into(), format!("`midplane schema` prints what {noun} may hold")),
    }
}

/// serde's words for what stands there, as a user calls it.
fn found(what: &str) -> String {
    let value = what.split('`').nth(1);
    let kind = what.strip_prefix("invalid type: ").or(what.strip_prefix("invalid value: "));
    match (kind, value) {
        (Some(kind), Some(value)) if kind.starts_with("floating point") || kind.starts_with("integer") => {
            format!("it is the number {value}")
        }
        (Some(kind), Some(value)) if kind.starts_with("boolean") => format!("it is {value}"),
        (Some(kind), _) if kind.starts_with("string") => {
            format!("it is the text {}", &kind["string ".len()..])
        }
        (Some("map"), _) => "it is an object { }".into(),
        (Some("sequence"), _) => "it is a list [ ]".into(),
        (Some("null"), _) => "it is null".into(),
        _ => what.into(),
    }
}

/// serde's words for what would have been right.
fn wanted(expected: &str) -> &str {
    match expected {
        "f64" => "a number",
        "usize" | "u64" | "u32" => "a whole number",
        "a map" => "an object { }",
        "a sequence" => "a list [ ]",
        "a string" => "a text in quotes",
        "a boolean" => "true or false",
        "string or map" | "map with a single key" | "variant identifier" => "a name in quotes",
        other if other.starts_with("internally tagged enum ") => "an object { } with a \"type\"",
        other if other.starts_with("struct ") => "an object { }",
        other => other,
    }
}

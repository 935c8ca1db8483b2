//! Positions of the keys of a scene in its file, so that every message can name the line.

use std::{collections::HashMap, ops::Range, path::PathBuf};

use jsonc_parser::{
    CollectOptions, ParseOptions,
    ast::{ObjectPropName, Value},
    common::Ranged,
};

use super::plain::plain;
use crate::error::{At, Error};

/// The text of the scene and the place of every key in it.
#[derive(Debug, Clone, Default)]
pub struct Source {
    /// The scene file.
    pub file: PathBuf,
    text: String,
    places: HashMap<Vec<String>, Range<usize>>,
    /// First key that occurs twice in one object.
    pub(super) duplicate: Option<Vec<String>>,
}

impl Source {
    /// Indexes a text that is valid JSON, but for a byte order mark and comments.
    pub(super) fn new(file: PathBuf, text: String) -> Source {
        let mut source = Source { file, text, ..Source::default() };
        let (plain, options) = (plain(&source.text), CollectOptions::default());
        if let Ok(parsed) = jsonc_parser::parse_to_ast(&plain, &options, &ParseOptions::default())
            && let Some(root) = parsed.value
        {
            let (mut places, mut duplicate) = (HashMap::new(), None);
            index(&root, &mut Vec::new(), &mut places, &mut duplicate);
            (source.places, source.duplicate) = (places, duplicate);
        }
        source
    }

    /// Folder of the scene, against which its files are named.
    pub fn folder(&self) -> PathBuf {
        match self.file.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder.to_path_buf(),
            _ => PathBuf::from("."),
        }
    }

    /// The place of a key, or of its nearest parent that is in the file.
    pub fn at<S: AsRef<str>>(&self, path: &[S]) -> At {
        let path: Vec<String> = path.iter().map(|part| part.as_ref().to_string()).collect();
        let span = (0..=path.len()).rev().find_map(|n| self.places.get(&path[..n])).cloned();
        let line = span.as_ref().map_or(0, |span| 1 + self.text[..span.start].matches('\n').count());
        At {
            file: self.file.clone(),
            line,
            key: path.join("."),
            text: self.text.clone(),
            span: span.unwrap_or(0..0),
            stated: self.places.contains_key(&path),
        }
    }

    /// True if the file itself has a key, no default and no `--set`.
    pub fn states(&self, path: &[&str]) -> bool {
        let path: Vec<String> = path.iter().map(|part| part.to_string()).collect();
        self.places.contains_key(&path)
    }

    /// A refusal that points into a string: at the bytes `span` of `text`, which stands below the key.
    pub fn error_within<S: AsRef<str>>(
        &self,
        path: &[S],
        text: &str,
        span: Range<usize>,
        what: impl Into<String>,
        help: impl Into<String>,
    ) -> Error {
        let mut at = self.at(path);
        // a text that came by --set or is escaped in the file is not found: the key must do
        if let Some(found) = self.text[at.span.clone()].rfind(&format!("\"{text}\"")) {
            let start = at.span.start + found + 1;
            at.line = 1 + self.text[..start].matches('\n').count();
            at.span = start + span.start..start + span.end;
        }
        Error::Text { at: Box::new(at), what: what.into(), help: help.into() }
    }

    /// A refusal that points at a key.
    pub fn error_at<S: AsRef<str>>(
        &self,
        path: &[S],
        what: impl Into<String>,
        help: impl Into<String>,
    ) -> Error {
        Error::Text { at: Box::new(self.at(path)), what: what.into(), help: help.into() }
    }
}

/// Records the place of every key below `value`: from the key to the end of its value, or of the value's first line.
fn index(
    value: &Value,
    path: &mut Vec<String>,
    places: &mut HashMap<Vec<String>, Range<usize>>,
    duplicate: &mut Option<Vec<String>>,
) {
    match value {
        Value::Object(object) => {
            for property in &object.properties {
                let name = match &property.name {
                    ObjectPropName::String(name) => name.value.to_string(),
                    ObjectPropName::Word(word) => word.value.to_string(),
                };
                path.push(name);
                let range = property.range();
                if places.insert(path.clone(), range.start..range.end).is_some() {
                    duplicate.get_or_insert_with(|| path.clone());
                }
                index(&property.value, path, places, duplicate);
                path.pop();
            }
        }
        Value::Array(array) => {
            for (i, element) in array.elements.iter().enumerate() {
                path.push(i.to_string());
                let range = element.range();
                places.insert(path.clone(), range.start..range.end);
                index(element, path, places, duplicate);
                path.pop();
            }
        }
        _ => {}
    }
}

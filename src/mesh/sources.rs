//! The sources of a .geo file: the files it includes, the names it mentions, the parameters it declares.

use std::path::{Path, PathBuf};

use super::confine::SYSTEM;
use crate::error::{Error, Result, name_help};

/// A .geo file with everything it reads.
#[derive(Debug, Default)]
pub(super) struct Sources {
    /// Path and content of the file itself and of every file it includes, in the order they are met.
    pub(super) files: Vec<(PathBuf, Option<Vec<u8>>)>,
    /// False if what gmsh makes of it depends on more than these files.
    pub(super) closed: bool,
    /// True if the file is no geometry but a mesh.
    pub(super) is_mesh: bool,
    /// Every name in it.
    mentioned: Vec<String>,
    /// Names it declares with DefineConstant, and their values where those are plain numbers.
    pub(super) declared: Vec<(String, Option<f64>)>,
    /// Names it assigns a value.
    assigned: Vec<String>,
}

/// Commands that start other programs.
const STARTING: [&str; 3] = ["SystemCall", "NonBlockingSystemCall", "OnelabRun"];
/// A file that a geometry reads is followed up to this size [bytes].
const LARGEST: u64 = 1 << 30;
/// Commands and options whose value is the name of a file.
const READING: [&str; 4] = ["Include", "Merge", "ShapeFromFile", "FileName"];
/// The first bytes of a mesh file.
const MESH: &[u8] = b"$MeshFormat";
/// Commands whose result does not come from the files alone.
const OUTSIDE: [&str; 8] = [
    "System",
    "SystemCall",
    "NonBlockingSystemCall",
    "OnelabRun",
    "GetEnv",
    "FileExists",
    "Rand",
    "CurrentDirectory",
];

impl Sources {
    /// Reads a .geo file and, nested, all it includes. `geo` is absolute.
    pub(super) fn read(geo: &Path) -> Result<Sources> {
        let content = contents(geo)?.ok_or_else(|| {
            let help = "it would be a regular file of a few megabytes";
            Error::mesh(geo, "is no geometry", help)
        })?;
        let is_mesh = content.starts_with(MESH);
        let mut sources = Sources { closed: true, is_mesh, ..Sources::default() };
        sources.add(geo.to_path_buf(), Some(content));
        if is_mesh {
            return Ok(sources);
        }
        let mut next = 0;
        while let Some((path, content)) = sources.files.get(next) {
            let (path, tokens) = (path.clone(), tokens(content.as_deref().unwrap_or(&[])));
            sources.scan(&path, &tokens);
            next += 1;
        }
        Ok(sources)
    }

    /// Hands out the names and contents of all files, part by part.
    pub(super) fn digest(&self, add: &mut dyn FnMut(&[u8])) {
        for (path, content) in &self.files {
            add(path.file_name().unwrap_or_default().as_encoded_bytes());
            add(&[u8::from(content.is_some())]);
            add(content.as_deref().unwrap_or_default());
        }
    }

    /// Refuses a parameter that this .geo would not listen to.
    pub(super) fn accepts(&self, geo: &Path, parameter: &str) -> Result<()> {
        let has = |names: &[String]| names.iter().any(|name| name == parameter);
        let declared = || name_help(parameter, self.declared.iter().map(|(name, _)| name.as_str()));
        let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        if parameter.is_empty() || !parameter.chars().all(word) || !has(&self.mentioned) {
            return Err(Error::mesh(
                geo,
                format!("has no parameter \"{parameter}\""),
                format!("of the names it declares with DefineConstant {}", declared()),
            ));
        }
        let is_declared = self.declared.iter().any(|(name, _)| name == parameter);
        if has(&self.assigned) && !is_declared && !self.mentions("Exists") {
            return Err(Error::mesh(
                geo,
                format!("sets \"{parameter}\" itself, whatever value it is given"),
                format!("declare it instead: DefineConstant[ {parameter} = ... ]"),
            ));
        }
        Ok(())
    }

    /// Refuses what a geometry from a stranger may not do: start programs, or read beyond these folders.
    pub(super) fn check_confined(&self, geo: &Path, readable: &[PathBuf]) -> Result<()> {
        if let Some(command) = STARTING.iter().find(|name| self.mentions(name)) {
            let what = format!("asks for {command}, which starts other programs");
            let help = "write its result into the geometry, or trust it with --trust-geo";
            return Err(Error::mesh(geo, what, help));
        }
        for (path, _) in &self.files {
            let Ok(whole) = std::fs::canonicalize(path) else { continue }; // gmsh says that it is not there
            let inside = readable.iter().map(PathBuf::as_path).chain(SYSTEM.iter().map(Path::new));
            if !inside.into_iter().any(|folder| whole.starts_with(folder)) {
                let what = format!("reads {}, which is outside the folder of its scene", whole.display());
                let help = "list its folder with --geo-path, or trust the geometry with --trust-geo";
                return Err(Error::mesh(geo, what, help));
            }
        }
        Ok(())
    }

    fn mentions(&self, name: &str) -> bool {
        self.mentioned.iter().any(|mentioned| mentioned == name)
    }

    fn add(&mut self, path: PathBuf, content: Option<Vec<u8>>) {
        if !self.files.iter().any(|(known, _)| *known == path) {
            self.files.push((path, content));
        }
    }

    fn scan(&mut self, path: &Path, tokens: &[Token]) {
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        // gmsh merges the options beside a model without being asked
        let mut options = path.as_os_str().to_owned();
        options.push(".opt");
        if let Ok(Some(content)) = contents(Path::new(&options)) {
            self.add(options.into(), Some(content));
        }
        for (i, token) in tokens.iter().enumerate() {
            let Token::Name(name) = token else { continue };
            if READING.contains(&name.as_str()) {
                match file_argument(&tokens[i + 1..]) {
                    Some(file) => {
                        let file = folder.join(file);
                        let content = contents(&file).ok().flatten();
                        self.closed &= content.is_some() || !file.exists();
                        self.add(file, content);
                    }
                    None => self.closed = false,
                }
            }
            self.closed &= !OUTSIDE.contains(&name.as_str());
            if name == "DefineConstant" {
                self.declared.extend(declared(&tokens[i + 1..]));
            }
            if tokens.get(i + 1) == Some(&Token::Sign('=')) && tokens.get(i + 2) != Some(&Token::Sign('=')) {
                let after_dot = i > 0 && tokens[i - 1] == Token::Sign('.');
                if !after_dot {
                    self.assigned.push(name.clone());
                }
            }
            self.mentioned.push(name.clone());
        }
        for names in [&mut self.mentioned, &mut self.assigned] {
            let mut seen = std::collections::HashSet::new();
            names.retain(|name| seen.insert(name.clone()));
        }
        let mut seen = std::collections::HashSet::new();
        self.declared.retain(|(name, _)| seen.insert(name.clone()));
    }
}

/// The contents of a regular file; none of any other, or of one that is too large to be followed.
fn contents(file: &Path) -> Result<Option<Vec<u8>>> {
    let data = std::fs::metadata(file).map_err(Error::io("read", file))?;
    if !data.is_file() || data.len() > LARGEST {
        return Ok(None);
    }
    std::fs::read(file).map(Some).map_err(Error::io("read", file))
}

/// The literal file name that follows a reading command: `"file" ;`, `= "file" ;`, `( "file" )`.
fn file_argument(tokens: &[Token]) -> Option<&str> {
    let tokens = match tokens {
        [Token::Sign('=' | '(' | '['), rest @ ..] => rest,
        all => all,
    };
    match tokens {
        [Token::Text(file), Token::Sign(';' | ')' | ']'), ..] => Some(file),
        _ => None,
    }
}

/// Names declared by `[ a = 1, b = {2, Name "B"}, c ]`, with their numbers.
fn declared(tokens: &[Token]) -> Vec<(String, Option<f64>)> {
    let mut names = Vec::new();
    let (mut depth, mut fresh) = (0, false);
    for (i, token) in tokens.iter().enumerate() {
        match token {
            Token::Sign('[' | '{' | '(') => {
                depth += 1;
                fresh = depth == 1;
            }
            Token::Sign(']' | '}' | ')') => {
                depth -= 1;
                if depth <= 0 {
                    break;
                }
            }
            Token::Sign(',') => fresh = depth == 1,
            Token::Sign(';') if depth == 0 => break,
            Token::Name(name) if fresh => {
                names.push((name.clone(), number(&tokens[i + 1..])));
                fresh = false;
            }
            _ => fresh = false,
        }
    }
    names
}

/// The number of `= 1`, `= {2, …}` or `= -3`, if nothing is done to it.
fn number(tokens: &[Token]) -> Option<f64> {
    let [Token::Sign('='), rest @ ..] = tokens else { return None };
    let rest = if let [Token::Sign('{'), rest @ ..] = rest { rest } else { rest };
    let (sign, rest) = match rest {
        [Token::Sign('-'), rest @ ..] => (-1.0, rest),
        rest => (1.0, rest),
    };
    match rest {
        [Token::Number(text), Token::Sign(',' | ']' | '}'), ..] => Some(sign * text.parse::<f64>().ok()?),
        _ => None,
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Token {
    Name(String),
    Text(String),
    Number(String),
    Sign(char),
}

/// Names, strings, numbers and signs, without comments. Bytes that are not UTF-8 stand for themselves as signs.
fn tokens(content: &[u8]) -> Vec<Token> {
    let text = String::from_utf8_lossy(content);
    let mut tokens = Vec::new();
    let mut rest: &str = &text;
    while let Some(c) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if let Some(comment) = rest.strip_prefix("/*") {
            comment.find("*/").map_or(rest.len(), |end| end + 4)
        } else if c == '"' || c == '\'' {
            let end = rest[1..].find(c).map_or(rest.len(), |end| end + 1);
            tokens.push(Token::Text(rest[1..end].to_string()));
            (end + 1).min(rest.len())
        } else if c.is_ascii_alphabetic() || c == '_' {
            let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
            tokens.push(Token::Name(rest[..end].to_string()));
            end
        } else if c.is_ascii_digit() {
            // 1e-3 holds no name and one number
            let word = |text: &str| {
                text.find(|c: char| !(c.is_ascii_alphanumeric() || c == '.')).unwrap_or(text.len())
            };
            let mut end = word(rest);
            if rest[..end].ends_with(['e', 'E']) && rest[end..].starts_with(['+', '-']) {
                end += 1 + word(&rest[end + 1..]);
            }
            tokens.push(Token::Number(rest[..end].to_string()));
            end
        } else {
            if !c.is_whitespace() {
                tokens.push(Token::Sign(c));
            }
            c.len_utf8()
        };
        rest = &rest[length..];
    }
    tokens
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Sources {
        let folder = tempfile::tempdir().unwrap();
        let geo = folder.path().join("a.geo");
        std::fs::write(&geo, text).unwrap();
        Sources::read(&geo).unwrap()
    }

    #[test]
    fn declared_constants_are_found_among_their_options() {
        let geo = of(
            "DefineConstant[ n = {4, Name \"Param/n\", Choices{1, 2}}, length = 2*n, open ]; Point(1) = {0, 0, 0, lc};",
        );
        let names: Vec<&str> = geo.declared.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["n", "length", "open"]);
        assert!(geo.accepts(Path::new("a.geo"), "n").is_ok());
        assert!(geo.accepts(Path::new("a.geo"), "lc").is_ok());
        let message = geo.accepts(Path::new("a.geo"), "lenght").unwrap_err().to_string();
        assert!(message.contains("Did you mean \"length\"?"), "{message}");
    }

    #[test]
    fn plain_numbers_of_declared_constants_are_read() {
        let geo =
            of("DefineConstant[ n = {12, Min 1}, a = 1.5e-3, b = -2, c = 2*n, d = {n, Name \"d\"}, e ];");
        let numbers: Vec<Option<f64>> = geo.declared.iter().map(|(_, value)| *value).collect();
        assert_eq!(numbers, [Some(12.0), Some(1.5e-3), Some(-2.0), None, None, None]);
    }

    #[test]
    fn a_value_the_file_sets_itself_is_no_parameter() {
        assert!(of("n = 4; Point(n) = {0, 0, 0};").accepts(Path::new("a.geo"), "n").is_err());
        assert!(of("If (!Exists(n)) n = 4; EndIf").accepts(Path::new("a.geo"), "n").is_ok());
        assert!(of("// n\n/* n */ Printf(\"n\");").accepts(Path::new("a.geo"), "n").is_err());
        assert!(of("If (n == 1) EndIf").accepts(Path::new("a.geo"), "n").is_ok());
    }

    #[test]
    fn what_is_computed_or_comes_from_outside_is_not_closed() {
        assert!(of("Merge \"b.step\"; Field[1].FileName = \"f.pos\";").closed);
        assert!(!of("Include StrCat(\"a\", \"b\");").closed);
        assert!(!of("SystemCall \"date\";").closed);
        assert!(of("// SystemCall \"date\";").closed);
        assert!(of("Point(1) = {\"").closed);
    }
}

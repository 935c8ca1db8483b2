//! Physical names, which mshio drops: lines `dimension tag "name"`, text also in binary files.

use super::content::{Declared, MeshFault, damaged};

/// The groups that have names, from the content of `$PhysicalNames`.
pub(super) fn read(content: &[u8]) -> Result<Vec<Declared>, MeshFault> {
    let text = std::str::from_utf8(content).map_err(|_| MeshFault {
        what: "a physical name is not UTF-8 text".into(),
        help: "save the .geo as UTF-8".into(),
    })?;
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let claimed = lines.next().and_then(|line| line.trim().parse::<u64>().ok());
    let claimed = claimed.ok_or_else(|| damaged("$PhysicalNames does not begin with a count"))?;
    let mut names = Vec::new();
    for line in lines {
        names.push(one(line).ok_or_else(|| damaged(format!("\"{}\" is not a physical name", line.trim())))?);
    }
    if names.len() as u64 != claimed {
        return Err(damaged(format!("$PhysicalNames claims {claimed} names and holds {}", names.len())));
    }
    Ok(names)
}

fn one(line: &str) -> Option<Declared> {
    let (dim, rest) = line.trim().split_once(char::is_whitespace)?;
    let (tag, rest) = rest.trim_start().split_once(char::is_whitespace)?;
    let dim = dim.parse().ok().filter(|&dim| dim <= 3)?;
    let tag: u32 = tag.parse().ok().filter(|&tag| tag > 0)?;
    let name = rest.trim().strip_prefix('"')?.strip_suffix('"')?;
    let name = if name.is_empty() { tag.to_string() } else { name.to_string() };
    Some(Declared { dim, tag, name })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_keep_their_spaces_and_letters() {
        let names = read("2\n1 7 \"bord gauche é\"\n2 1 \"rock\"\n".as_bytes()).unwrap();
        assert_eq!(names[0], Declared { dim: 1, tag: 7, name: "bord gauche é".into() });
        assert_eq!(names[1].name, "rock");
    }

    #[test]
    fn a_wrong_count_and_a_broken_line_are_refused() {
        assert!(read(b"3\n1 7 \"a\"\n").is_err());
        assert!(read(b"1\n1 7 \"a\n").is_err());
        assert!(read(b"1\n1 \"a\"\n").is_err());
        assert!(read(b"").is_err());
    }
}

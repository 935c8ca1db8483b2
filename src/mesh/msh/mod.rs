//! MSH 4.1: from the bytes of a file to nodes, elements and declared groups, before any question of geometry.
//!
//! The walk reads the heads of sections and blocks and all tags itself, checks every count against the bytes that
//! are there, and has mshio decode the rest in pieces (`pieces`). Nothing is allocated for a count that the file
//! merely claims.

mod content;
mod cursor;
mod element;
mod elements;
mod entities;
mod names;
mod nodes;
mod pieces;
mod tags;

pub(super) use content::{Content, Declared, KINDS, MeshFault, damaged};
use cursor::{Cursor, Encoding};
use entities::Entities;
use pieces::Decoder;
use tags::Tags;

/// Reads the content of an MSH 4.1 file.
pub(super) fn content(bytes: &[u8]) -> Result<Content, MeshFault> {
    let (mut cursor, encoding) = header(bytes)?;
    let mut decoder = Decoder::new(encoding);
    let mut entities = Entities::default();
    let mut numbers: Option<Tags> = None;
    let mut content = Content::default();
    let mut seen: Vec<&[u8]> = Vec::new();
    cursor.skip_space();
    while cursor.left() > 0 {
        let name = cursor
            .section()
            .ok_or_else(|| damaged("expected a section such as $Nodes, found something else"))?;
        let title = String::from_utf8_lossy(name);
        let known: [&[u8]; 4] = [b"PhysicalNames", b"Entities", b"Nodes", b"Elements"];
        if known.contains(&name) && seen.contains(&name) {
            return Err(damaged(format!("has ${title} twice")));
        }
        match name {
            b"Nodes" => numbers = Some(nodes::read(&mut cursor, &mut decoder, &mut content)?),
            b"Elements" => {
                let numbers = numbers.take().ok_or_else(|| damaged("has no $Nodes before $Elements"))?;
                elements::read(&mut cursor, &mut decoder, &entities, &numbers, &mut content)?;
            }
            b"PartitionedEntities" => {
                return Err(MeshFault {
                    what: "is partitioned".into(),
                    help: "save it without partitions".into(),
                });
            }
            _ => {}
        }
        let subdomain = if matches!(name, b"Nodes" | b"Elements") {
            cursor.at_end(name).then_some(&[][..])
        } else {
            cursor.until_end(name)
        };
        let subdomain = subdomain
            .ok_or_else(|| damaged(format!("has ${title} without $End{title} where it should be")))?;
        match name {
            b"PhysicalNames" => content.declared = names::read(subdomain)?,
            b"Entities" => {
                let parsed =
                    decoder.entities(subdomain).ok_or_else(|| damaged("$Entities cannot be read"))?;
                entities = Entities::new(parsed)?;
            }
            _ => {}
        }
        if known.contains(&name) {
            seen.push(name);
        }
        cursor.skip_space();
    }
    entities.declare(&mut content.declared);
    if content.shapes.is_empty() {
        return Err(match content.declared.iter().find(|group| group.dim == 2) {
            Some(surface) => surface.empty(),
            None => MeshFault {
                what: "has no triangles or quadrilaterals".into(),
                help: "give the .geo a Physical Surface that covers the body".into(),
            },
        });
    }
    Ok(content)
}

/// Checks the first lines; the position is then behind them.
fn header(bytes: &[u8]) -> Result<(Cursor<'_>, Encoding), MeshFault> {
    let help = "write MSH 4.1 (gmsh -format msh41)";
    let error_at = |what: &str| MeshFault { what: what.into(), help: help.into() };
    let rest = bytes.strip_prefix(b"$MeshFormat").ok_or_else(|| MeshFault {
        what: "is not an MSH file".into(),
        help: "make it with gmsh -2 -format msh41 part.geo".into(),
    })?;
    let mut lines = rest.splitn(3, |&b| b == b'\n').skip(1);
    let line = lines.next().and_then(|line| std::str::from_utf8(line).ok()).unwrap_or("");
    let subdomain = lines.next().ok_or_else(|| damaged("ends in its first lines"))?;
    let words: Vec<&str> = line.split_whitespace().collect();
    let &[version, mode, width] = words.as_slice() else {
        return Err(damaged(format!("\"{}\" is not an MSH format", line.trim())));
    };
    if version != "4.1" {
        return Err(error_at(&format!("is MSH {version}")));
    }
    if width != "8" {
        return Err(error_at(&format!("has counts of {width} bytes instead of 8")));
    }
    let encoding = match (mode, subdomain.first_chunk::<4>()) {
        ("0", _) => Encoding::Text,
        ("1", Some(&one)) if i32::from_le_bytes(one) == 1 => Encoding::Little,
        ("1", Some(&one)) if i32::from_be_bytes(one) == 1 => Encoding::Big,
        _ => return Err(damaged("is neither text nor binary")),
    };
    let skipped = bytes.len() - subdomain.len() + if encoding == Encoding::Text { 0 } else { 4 };
    let mut cursor = Cursor::new(bytes, skipped, encoding);
    if !cursor.at_end(b"MeshFormat") {
        return Err(damaged("has $MeshFormat without $EndMeshFormat"));
    }
    Ok((cursor, encoding))
}

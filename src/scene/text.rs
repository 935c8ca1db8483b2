//! Text of a file that a user names.

use std::io::Read;
use std::path::Path;

use crate::error::{At, Error, Result};

/// The largest text that is read [bytes].
const LARGEST: u64 = 64 << 20;

/// The text of a file that a user names, and `help` where there is none; one that is no text is told as what it is.
pub fn text_of(file: &Path, help: &str) -> Result<String> {
    let refused = |what: &str, help: &str| Error::Text {
        at: Box::new(At { file: file.into(), ..At::default() }),
        what: what.into(),
        help: help.into(),
    };
    let read = || -> std::io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        std::fs::File::open(file)?.take(LARGEST + 1).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    let bytes = match read() {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let here = std::path::absolute(file).unwrap_or_else(|_| file.into());
            let what = format!("there is no such file ({})", here.display());
            return Err(refused(&what, help));
        }
        read => read.map_err(Error::io("read", file))?,
    };
    let kind = file.extension().and_then(|kind| kind.to_str()).unwrap_or("");
    if kind == "geo" || kind == "msh" {
        return Err(refused("it is a file of gmsh", help));
    }
    if bytes.len() as u64 > LARGEST {
        return Err(refused(&format!("it is larger than {} MB", LARGEST >> 20), help));
    }
    match bytes.as_slice() {
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => {
            Err(refused("it is saved as UTF-16", "save it as UTF-8 (in an editor: Save as, Encoding)"))
        }
        _ => String::from_utf8(bytes).map_err(|error| {
            let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
            let line = 1 + good.iter().filter(|byte| **byte == b'\n').count();
            Error::Text {
                at: Box::new(At { file: file.into(), line, ..At::default() }),
                what: "it has bytes that are no UTF-8 text".into(),
                help: "save it as UTF-8 (in an editor: Save as, Encoding)".into(),
            }
        }),
    }
}

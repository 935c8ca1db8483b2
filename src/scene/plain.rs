//! Texts as people write them: a byte order mark and comments are no part of JSON and become spaces, so that positions stay.

/// The text without a byte order mark and comments (`//` to the end of the line, `/* */`), as many bytes long.
pub(super) fn plain(text: &str) -> String {
    let mut plain: Vec<u8> = text.as_bytes().to_vec();
    if text.starts_with('\u{feff}') {
        plain[..3].fill(b' ');
    }
    let (mut at, mut quoted) = (0, false);
    while at < plain.len() {
        match (plain[at], plain.get(at + 1)) {
            (b'\\', _) if quoted => at += 1,
            (b'"', _) => quoted = !quoted,
            (b'/', Some(b'/')) if !quoted => {
                while at < plain.len() && plain[at] != b'\n' {
                    plain[at] = b' ';
                    at += 1;
                }
            }
            (b'/', Some(b'*')) if !quoted => {
                let end = text[at + 2..].find("*/").map_or(plain.len(), |end| at + 2 + end + 2);
                plain[at..end].iter_mut().filter(|byte| **byte != b'\n').for_each(|byte| *byte = b' ');
                at = end;
                continue;
            }
            _ => {}
        }
        at += 1;
    }
    // whole characters have become spaces, so that it is text still
    String::from_utf8(plain).unwrap_or_else(|_| text.into())
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn comments_become_spaces_and_strings_stay() {
        for (text, expected) in [
            ("{ \"a\": 1 } // b\n", "{ \"a\": 1 }     \n"),
            ("{ // ä\n \"a\": \"//\" }", "{      \n \"a\": \"//\" }"),
            ("{ /* x\n y */ \"a\\\"\": \"/* */\" }", "{     \n      \"a\\\"\": \"/* */\" }"),
            ("\u{feff}{}", "   {}"),
            ("1 /* open", "1        "),
            ("\"a // b", "\"a // b"),
            ("/", "/"),
        ] {
            assert_eq!(plain(text), expected, "{text}");
            assert_eq!(plain(text).len(), text.len());
        }
    }
}

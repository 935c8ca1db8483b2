//! Text from files and other programs, made fit for a terminal or a page.

use std::borrow::Cow;

/// Messages are shown up to this length, and lines of other programs [characters].
const LONGEST: usize = 2000;
const LONGEST_LINE: usize = 300;

/// Text without control characters and those that turn the direction of writing; lines and tabs stay. What goes is replaced by a
/// character of the same number of bytes, so that places in the text are those of the original.
pub fn clean(text: &str) -> Cow<'_, str> {
    let bad = |c: char| {
        let invisible = matches!(c, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}');
        invisible || c.is_control() && c != '\n' && c != '\t'
    };
    if !text.contains(bad) {
        return Cow::Borrowed(text);
    }
    let replaced = |c: char| match (bad(c), c.len_utf8()) {
        (false, _) => c,
        (true, 1) => '?',
        (true, 2) => '¿',
        (true, _) => '\u{fffd}',
    };
    Cow::Owned(text.chars().map(replaced).collect())
}

/// A message that is not too long to be read, and clean.
pub fn short_message(text: &str) -> String {
    shortened(&clean(text), LONGEST)
}

/// A line of another program, not too long and clean.
pub fn short_line(text: &str) -> String {
    shortened(&clean(text), LONGEST_LINE)
}

/// The beginning and the end of a text that is longer than so many characters.
fn shortened(text: &str, most: usize) -> String {
    let count = text.chars().count();
    if count <= most {
        return text.into();
    }
    let part = |from: usize, many: usize| text.chars().skip(from).take(many).collect::<String>();
    let tail = most / 4;
    format!("{} … {}", part(0, most - tail), part(count - tail, tail))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_terminal_gets_no_orders() {
        let text = "red\x1b[31m \u{9b}2J\r\nname\t\u{202e}txt.exe\u{0}";
        let cleaned = clean(text);
        assert_eq!(cleaned, "red?[31m ¿2J?\nname\t\u{fffd}txt.exe?");
        assert_eq!(cleaned.len(), text.len(), "places are the same");
        assert!(matches!(clean("Größe λ\n"), Cow::Borrowed(_)));
    }

    #[test]
    fn a_long_message_keeps_its_ends() {
        let long = format!("begin{}end", "é".repeat(1_000_000));
        let short = short_message(&long);
        assert!(short.starts_with("begin") && short.ends_with("end") && short.chars().count() < 2010);
        assert_eq!(short_line("as it is"), "as it is");
    }
}

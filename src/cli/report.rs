//! The one error, with an excerpt of the file it points into.

use std::io::IsTerminal;

use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteDiagnostic, NamedSource, Report};

use crate::error::{At, Error, clean, short_message};

/// Lines about a place, and the longest that is shown [bytes].
const ABOUT: usize = 4;
const WIDEST: usize = 1000;

/// The text for standard error: a line that says everything, and the place in its file.
pub(super) fn error(error: &Error) -> String {
    let text = short_message(&format!("error: {error}"));
    match error {
        Error::Text { at, .. } if !at.text.is_empty() && is_readable(at) => {
            format!("{text}\n\n{}", excerpt(at))
        }
        _ => text,
    }
}

/// True if the lines about a place are not too long to be shown.
fn is_readable(at: &At) -> bool {
    let before = at.text[..at.span.start].rsplit('\n').take(ABOUT).map(str::len);
    let after = at.text[at.span.start..].split('\n').take(ABOUT).map(str::len);
    before.chain(after).all(|length| length <= WIDEST)
}

/// The lines about a place, underlined; what is wrong there is said above.
fn excerpt(at: &At) -> String {
    // the first line only: a key whose value spans many lines would hide the place
    let line = at.text[at.span.clone()].lines().next().map_or(0, str::len);
    let label = LabeledSpan::new(None, at.span.start, line);
    let diagnostic = MietteDiagnostic::new("").with_label(label);
    let name = clean(&at.file.display().to_string()).into_owned();
    let source = NamedSource::new(name, clean(&at.text).into_owned());
    let report = Report::new(diagnostic).with_source_code(source);
    let theme = if std::io::stderr().is_terminal() {
        GraphicalTheme::unicode()
    } else {
        GraphicalTheme::unicode_nocolor()
    };
    let handler = GraphicalReportHandler::new_themed(theme).with_wrap_lines(false);
    let mut rendered = String::new();
    if handler.render_report(&mut rendered, report.as_ref()).is_err() {
        return String::new(); // the message stands without
    }
    // the head is that of an empty message
    let lines: Vec<&str> = rendered.lines().skip_while(|line| !line.contains('╭')).collect();
    lines.join("\n").trim_end().into()
}

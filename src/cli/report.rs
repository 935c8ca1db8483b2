//! The one error, with an excerpt of the file it points into.

use std::io::IsTerminal;

use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteDiagnostic, NamedSource, Report};

use crate::error::Error;

/// The text for standard error.
pub(super) fn error(error: &Error) -> String {
    let mut text = format!("error: {error}");
    if let Error::Text { at, what, help } = error
        && !at.text.is_empty()
    {
        // the label covers the first line only: a key whose value spans many lines would hide the place
        let line = at.text[at.span.clone()].lines().next().map_or(0, str::len);
        let label = LabeledSpan::new(Some(what.clone()), at.span.start, line);
        let diagnostic = MietteDiagnostic::new(at.to_string()).with_label(label).with_help(help.clone());
        let source = NamedSource::new(at.file.display().to_string(), at.text.clone());
        let report = Report::new(diagnostic).with_source_code(source);
        let theme = if std::io::stderr().is_terminal() {
            GraphicalTheme::unicode()
        } else {
            GraphicalTheme::unicode_nocolor()
        };
        let handler = GraphicalReportHandler::new_themed(theme).with_wrap_lines(false);
        let mut excerpt = String::new();
        if handler.render_report(&mut excerpt, report.as_ref()).is_ok() {
            text.push_str("\n\n");
            text.push_str(excerpt.trim_end());
        }
    }
    text
}

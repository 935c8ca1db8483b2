//! Tables of verification: printed, and kept for the documentation where `MIDPLANE_TABLES` names a folder.

use std::fmt::Write as _;

/// A Markdown table under a heading.
pub struct Table {
    name: &'static str,
    text: String,
}

impl Table {
    pub fn new(name: &'static str, heading: &str, claim: &str, columns: &[&str]) -> Table {
        let mut text = format!("### {heading}\n\n{claim}\n\n");
        let _ = writeln!(text, "| {} |", columns.join(" | "));
        let _ = writeln!(text, "|{}", "---|".repeat(columns.len()));
        Table { name, text }
    }

    pub fn row(&mut self, cells: &[String]) {
        let _ = writeln!(self.text, "| {} |", cells.join(" | "));
    }

    /// Prints the table; `make verify` collects it.
    pub fn finish(self) {
        println!("{}", self.text);
        if let Some(folder) = std::env::var_os("MIDPLANE_TABLES") {
            std::fs::write(std::path::Path::new(&folder).join(format!("{}.md", self.name)), self.text)
                .unwrap();
        }
    }
}

/// Mean rate over successive halvings.
pub fn rate(errors: &[f64]) -> f64 {
    (errors[0] / errors[errors.len() - 1]).log2() / (errors.len() - 1) as f64
}

/// "1.2e-3 5.6e-4" of a list of errors.
pub fn list(errors: &[f64]) -> String {
    errors.iter().map(|e| format!("{e:.1e}")).collect::<Vec<_>>().join(" ")
}

//! The words of gmsh: how it ended, its first errors, and the stage it was in.

use std::os::unix::process::ExitStatusExt;
use std::process::ExitStatus;

use crate::error::short_line;

/// Lines of gmsh's output that an error quotes.
const QUOTED: usize = 12;
/// Names of the signals that end a program by its own fault or by somebody else's.
const SIGNALS: [(i32, &str); 10] = [
    (2, "interrupt"),
    (4, "illegal instruction"),
    (6, "abort"),
    (7, "bus error"),
    (KILL, "kill"),
    (8, "arithmetic error"),
    (11, "segmentation fault"),
    (15, "termination"),
    (24, "processor time"),
    (FILE_SIZE, "file size"),
];
/// The signal at the limit of a file's size.
pub(super) const FILE_SIZE: i32 = 25;
/// The signal that the system sends where memory is short.
const KILL: i32 = 9;

/// "ended with exit code 1", "was killed by signal 11 (segmentation fault)".
pub(super) fn outcome(status: ExitStatus) -> String {
    match (status.code(), status.signal()) {
        (Some(code), _) => format!("ended with exit code {code}"),
        (None, Some(signal)) => match SIGNALS.iter().find(|(number, _)| *number == signal) {
            Some((_, name)) => format!("was killed by signal {signal} ({name})"),
            None => format!("was killed by signal {signal}"),
        },
        (None, None) => "ended without an exit code".into(),
    }
}

/// The signal that ended it, if one did.
pub(super) fn signal(status: ExitStatus) -> Option<i32> {
    status.signal()
}

/// Help for a gmsh that a signal ended.
pub(super) fn crash_help(status: ExitStatus) -> &'static str {
    match status.signal() {
        Some(KILL) => "was it short of memory?",
        Some(2 | 15 | 24) => "something else ended it: try again",
        _ => "the fault is gmsh's: another Mesh.Algorithm may work",
    }
}

/// The last stage that gmsh spoke of, such as "Meshing surface 1 (Plane, Frontal-Delaunay)".
pub(super) fn stage(lines: &[String]) -> &str {
    let last = lines.iter().rev().find(|line| !line.trim().is_empty());
    last.map_or("starting", |line| message(line).trim())
}

/// The part of gmsh's output that matters: its first errors if there are any, else its first warnings, else its last
/// lines. Lines that differ only in the place they name count once.
pub(super) fn quoted(lines: &[String]) -> Vec<String> {
    important(lines).iter().map(|line| short_line(line)).collect()
}

fn important(lines: &[String]) -> Vec<String> {
    for loud in ["Error", "Warning"] {
        let all: Vec<&String> = lines.iter().filter(|line| line.starts_with(loud)).collect();
        if all.is_empty() {
            continue;
        }
        let mut kept: Vec<&String> = Vec::new();
        for &line in &all {
            if kept.len() < QUOTED && !kept.iter().any(|one| without_place(one) == without_place(line)) {
                kept.push(line);
            }
        }
        let mut kept: Vec<String> = kept.into_iter().cloned().collect();
        if all.len() > kept.len() {
            kept.push(format!("and {} lines more of the kind", all.len() - kept.len()));
        }
        return kept;
    }
    let mut last = lines[lines.len().saturating_sub(QUOTED)..].to_vec();
    last.push("(a .geo that sets General.Terminal or General.Verbosity hides its errors)".into());
    last
}

/// A line without its loudness: "Info    : Meshing 2D..." is "Meshing 2D...".
fn message(line: &str) -> &str {
    match line.split_once(": ") {
        Some((loudness, rest)) if ["Info", "Warning", "Error", "Debug"].contains(&loudness.trim()) => rest,
        _ => line,
    }
}

/// A message without the file and line it begins with.
fn without_place(line: &str) -> &str {
    let message = message(line);
    match message.split_once(", line ").and_then(|(_, rest)| rest.split_once(": ")) {
        Some((number, rest)) if number.bytes().all(|b| b.is_ascii_digit()) => rest,
        _ => message,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<String> {
        text.lines().map(str::to_string).collect()
    }

    #[test]
    fn the_first_errors_are_quoted_and_echoes_once() {
        let mut text =
            String::from("Info    : Reading\nWarning : odd\nError   : Unable to open file 'p.geo'\n");
        for line in 2..40 {
            text.push_str(&format!("Error   : 'a.geo', line {line}: Unknown variable 'lc'\n"));
        }
        text.push_str("Error   : 'a.geo', line 40: Unknown variable 'h'\n");
        let expected = [
            "Error   : Unable to open file 'p.geo'",
            "Error   : 'a.geo', line 2: Unknown variable 'lc'",
            "Error   : 'a.geo', line 40: Unknown variable 'h'",
            "and 37 lines more of the kind",
        ];
        assert_eq!(quoted(&lines(&text)), expected);
    }

    #[test]
    fn a_signal_has_its_name_and_its_help() {
        let killed = |signal| ExitStatus::from_raw(signal);
        assert_eq!(outcome(killed(11)), "was killed by signal 11 (segmentation fault)");
        assert_eq!(outcome(killed(9)), "was killed by signal 9 (kill)");
        assert_eq!(outcome(killed(40)), "was killed by signal 40");
        assert!(
            crash_help(killed(9)).contains("memory") && crash_help(killed(11)).contains("Mesh.Algorithm")
        );
        assert_eq!(stage(&lines("Info    : Meshing 2D...\n\n")), "Meshing 2D...");
        assert_eq!(stage(&[]), "starting");
    }
}

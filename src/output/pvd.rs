//! Collections of grids by time, as ParaView opens them.

use std::fmt::Write as _;

/// The beginning of every collection, and its end.
pub(super) const HEAD: &str = "<?xml version=\"1.0\"?>\n\
    <VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
    <Collection>\n";
pub(super) const END: &str = "</Collection>\n</VTKFile>\n";

/// The text of entries: time, which is the number of the row, name of the part, file.
pub(super) fn entries(entries: &[(usize, String, String)]) -> String {
    let mut text = String::new();
    for (time, part, file) in entries {
        let _ = writeln!(text, "<DataSet timestep=\"{time}\" name=\"{part}\" part=\"0\" file=\"{file}\"/>");
    }
    text
}

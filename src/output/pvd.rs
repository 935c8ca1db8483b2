//! Collections of grids by time, as ParaView opens them.

use std::fmt::Write as _;

/// The beginning of every collection.
pub(super) const HEAD: &str = "<?xml version=\"1.0\"?>\n\
    <VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
    <Collection>\n";

/// The text of a collection: time, which is the number of the row, name of the part, file.
pub(super) fn collection(entries: &[(usize, String, String)]) -> String {
    let mut text = String::from(HEAD);
    for (time, part, file) in entries {
        let _ = writeln!(text, "<DataSet timestep=\"{time}\" name=\"{part}\" part=\"0\" file=\"{file}\"/>");
    }
    text.push_str("</Collection>\n</VTKFile>\n");
    text
}

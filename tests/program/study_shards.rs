//! Claim: shards of a study run in processes of their own and collected have the answers of one process; what is missing is told.

use std::collections::HashMap;

use crate::study::{Strip, meshes};
use serde_json::json;

/// Rows without times and without what points of one process share.
fn answers(strip: &Strip, out: &str) -> Vec<Vec<(String, String)>> {
    let measured = |column: &str| {
        column.contains("seconds") || ["peak_memory_bytes", "reused", "message"].contains(&column)
    };
    let row = |row: HashMap<String, String>| {
        let mut row: Vec<_> = row.into_iter().filter(|(column, _)| !measured(column)).collect();
        row.sort();
        row
    };
    strip.table(out).into_iter().map(row).collect()
}

fn strip() -> Strip {
    Strip::new(&meshes())
}

#[test]
fn shards_have_the_answers_of_one_process_and_run_nothing_twice() {
    let strip = strip();
    strip.study("whole", &[]);
    let head = |out: &str| {
        let text = std::fs::read_to_string(strip.path(out).join("study.csv")).unwrap();
        text.lines().next().unwrap().to_string()
    };
    for (out, count) in [("four", 4), ("eight", 8)] {
        for k in 0..count {
            let points = (k..6).step_by(count).count();
            let shard = ["--shard", &format!("{k}/{count}"), "--jobs", "2"];
            let printed = strip.study(out, &shard);
            let end = format!("shard {k} of {count}: {points} points, 0 of them failed");
            assert!(printed.contains(&end) && !printed.contains("are there"), "{printed}");
            assert!(!strip.path(out).join("study.csv").exists(), "a shard writes no table");
            let again = strip.study(out, &shard);
            assert!(again.contains(&end) && !again.contains("point "), "{again}");
        }
        assert!(strip.study(out, &["--collect"]).contains("6 points, 0 of them failed"));
        assert_eq!(head(out), head("whole"));
        assert_eq!(answers(&strip, out), answers(&strip, "whole"), "{count} shards");
    }
    assert!(strip.study("four", &[]).contains("6 of 6 points are there"), "nothing is left to run");
}

#[test]
fn a_missing_shard_is_told_and_not_run() {
    let strip = strip();
    for k in ["0/3", "2/3"] {
        strip.study("out", &["--shard", k, "-q"]);
    }
    let collected = strip.midplane(&["study", "study.json", "-o", "out", "--collect", "-q"]);
    let told = String::from_utf8_lossy(&collected.stderr).into_owned();
    assert!(collected.status.success(), "{told}");
    assert_eq!(told, "note: 2 of 6 points are missing, the first is 1\n");
    let points: Vec<String> = strip.table("out").iter().map(|row| row["point"].clone()).collect();
    assert_eq!(points, ["0", "2", "3", "5"]);
    assert!(!strip.path("out/points/0001.json").exists());
    let text = std::fs::read_to_string(strip.path("out/study.json")).unwrap();
    assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap()["missing"], 2);
    // outcomes of another scene are none of this study
    let scene = std::fs::read_to_string(strip.path("scene.json")).unwrap();
    std::fs::write(strip.path("scene.json"), scene.replace("\"young\": 4.0e3", "\"young\": 5.0e3")).unwrap();
    let stale = strip.midplane(&["study", "study.json", "-o", "out", "--collect"]);
    assert_eq!(stale.status.code(), Some(2));
    assert_eq!(std::fs::read_to_string(strip.path("out/study.json")).unwrap(), text, "the table stays");
}

#[test]
fn a_reference_stands_only_if_all_its_runs_are_there() {
    let edges = "subdomains.lower.parameters.edges";
    let strip = Strip::new(&json!({
        "measures": { "energy": { "take": "last", "of": "energy.stored" } },
        "reference": { "runs": [{ edges: 8 }, { edges: 16 }] },
    }));
    strip.study("out", &["--shard", "0/2"]); // the point and the second run
    let collect = || strip.study("out", &["--collect"]);
    assert!(!collect().contains("reference energy"));
    strip.study("out", &["--shard", "1/2"]);
    assert!(collect().contains("reference energy"));
}

#[test]
fn points_that_files_do_not_decide_are_collected_all_the_same() {
    let strip = strip();
    let geo = std::fs::read_to_string(strip.path("upper.geo")).unwrap();
    std::fs::write(strip.path("upper.geo"), format!("SystemCall \"true\";\n{geo}")).unwrap();
    strip.study("out", &["--shard", "0/1"]);
    assert!(strip.study("out", &["--collect"]).contains("6 points, "));
}

#[test]
fn bad_values_are_refused() {
    let strip = strip();
    for (arguments, expected) in [
        (&["--shard", "4/4"][..], "4 shards count from 0 to 3"),
        (&["--shard", "2"], "K/N, shard K of N, such as 0/4"),
        (&["--shard", "1/two"], "K/N, shard K of N, such as 0/4"),
        (&["--shard", "-1/4"], "K/N, shard K of N, such as 0/4"),
        (&["--shard", "0/0"], "from 1 to 1000000 shards"),
        (&["--shard", "0/2", "--point", "1"], "'--shard <K/N>' cannot be used with '--point <K>'"),
        (&["--shard", "0/2", "--collect"], "cannot be used with"),
        (&["--collect", "--count"], "cannot be used with"),
        (&["--collect"], "--collect: no point of the study as it is now is in out; run its shards first"),
    ] {
        let output = strip.midplane(&[&["study", "study.json", "-o", "out"], arguments].concat());
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(message.contains(expected), "{message}\n  should contain\n{expected}");
        assert!(!strip.path("out").exists(), "{arguments:?}");
    }
}

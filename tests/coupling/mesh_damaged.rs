//! Claim: whatever happens to the file of a mesh, reading it ends in a sound mesh or in one clear error, never in a panic and never in
//! memory that the file only claims to need.

use std::path::Path;

use crate::common::mesh_text::{Form, block, keeps_its_promises, strip};
use midplane::mesh::from_bytes;
use proptest::prelude::*;

/// The strip and one T6 beside it, in the three encodings.
fn sound() -> [Vec<u8>; 3] {
    let mut text = strip();
    let more = [[5.0, 0.0], [6.0, 0.0], [5.0, 1.0], [5.5, 0.0], [5.5, 0.5], [5.0, 0.5]];
    text.nodes.extend((11..).zip(more.map(|p| [p[0], p[1], 0.0])));
    text.blocks.push(block(2, 1, 9, &[(7, &[11, 12, 13, 14, 15, 16])]));
    text.blocks.push(block(1, 1, 8, &[(8, &[11, 12, 14])]));
    [Form::Text, Form::Little, Form::Big].map(|form| text.bytes(form))
}

/// Reads bytes that may be damaged; true if they still make a mesh.
fn survives(bytes: &[u8]) -> bool {
    match from_bytes(Path::new("damaged.msh"), bytes) {
        Ok(mesh) => {
            keeps_its_promises(&mesh);
            true
        }
        Err(error) => {
            assert_eq!(error.exit_code(), 2);
            let message = error.to_string();
            assert!(message.starts_with("damaged.msh: ") && message.contains("; "), "{message}");
            false
        }
    }
}

#[test]
fn sound_files_are_read() {
    assert!(sound().iter().all(|bytes| survives(bytes)));
}

#[test]
fn a_file_cut_anywhere_is_refused() {
    for bytes in sound() {
        for length in 0..bytes.trim_ascii_end().len() {
            assert!(!survives(&bytes[..length]), "cut at {length} of {}", bytes.len());
        }
    }
}

#[test]
fn a_file_that_lost_a_piece_is_no_danger() {
    for bytes in sound() {
        for start in 0..bytes.len() {
            for length in [1, 4, 8, 40] {
                let end = (start + length).min(bytes.len());
                survives(&[&bytes[..start], &bytes[end..]].concat());
                survives(&[&bytes[..end], &bytes[start..]].concat());
            }
        }
    }
}

#[test]
fn any_byte_may_be_wrong() {
    for mut bytes in sound() {
        for at in 0..bytes.len() {
            let right = bytes[at];
            for wrong in [0, 1, 2, 0x7f, 0x80, 0xff, b'$', b'-', b'9', b' ', b'\n', right ^ 1, right ^ 0x40] {
                bytes[at] = wrong;
                survives(&bytes);
            }
            bytes[at] = right;
        }
    }
}

#[test]
fn any_number_of_a_text_may_be_wrong() {
    let text = String::from_utf8(sound()[0].clone()).unwrap();
    let words: Vec<&str> = text.split_inclusive(char::is_whitespace).collect();
    let wrong = [
        "0",
        "1",
        "2",
        "-1",
        "3",
        "1000000",
        "2147483647",
        "2147483648",
        "-2147483648",
        "9223372036854775807",
        "9223372036854775808",
        "18446744073709551615",
        "18446744073709551616",
        "nan",
        "inf",
        "-inf",
        "1e999",
        "1e308",
        "-1e308",
        "1e-320",
        "0x1",
        "1.5.5",
        "1e",
        "$Nodes",
        "$EndNodes",
        "$",
        "\"",
        "é",
        "",
    ];
    for at in 0..words.len() {
        for wrong in wrong {
            let changed = [&words[..at].concat(), wrong, " ", &words[at + 1..].concat()].concat();
            survives(changed.as_bytes());
        }
    }
}

#[test]
fn any_number_of_a_binary_file_may_be_wrong() {
    let wrong = [
        0_u64,
        1,
        1 << 31,
        1 << 32,
        1 << 60,
        1 << 61,
        1 << 63,
        u64::MAX,
        f64::NAN.to_bits(),
        f64::MAX.to_bits(),
    ];
    for (mut bytes, big) in sound().into_iter().skip(1).zip([false, true]) {
        for at in 0..bytes.len() - 8 {
            let right: [u8; 8] = bytes[at..at + 8].try_into().unwrap();
            for wrong in wrong {
                let wrong = if big { wrong.to_be_bytes() } else { wrong.to_le_bytes() };
                bytes[at..at + 8].copy_from_slice(&wrong);
                survives(&bytes);
            }
            bytes[at..at + 8].copy_from_slice(&right);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 4000,
        rng_seed: prop::test_runner::RngSeed::Fixed(20),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn many_wrong_bytes_at_once_are_no_danger(
        form in 0_usize..3,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12),
    ) {
        let mut bytes = sound()[form].clone();
        for (at, wrong) in changes {
            let at = at.index(bytes.len());
            bytes[at] = wrong;
        }
        survives(&bytes);
    }

    #[test]
    fn noise_behind_a_sound_beginning_is_no_danger(
        form in 0_usize..3,
        keep in any::<prop::sample::Index>(),
        noise in prop::collection::vec(any::<u8>(), 0..400),
    ) {
        let bytes = &sound()[form];
        survives(&[&bytes[..keep.index(bytes.len())], &noise[..]].concat());
    }
}

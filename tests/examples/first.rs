//! The examples to begin with.
use crate::example;
use std::process::Command;

/// The output of an example.
fn printed(name: &str) -> String {
    let output = Command::new(example(name)).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn batch_prints_overlaps_that_grow() {
    let text = printed("batch");
    let numbers = |label: &str| -> Vec<f64> {
        let line = text.lines().find(|line| line.starts_with(label)).unwrap();
        let list = line[label.len()..].trim().trim_matches(['[', ']']);
        list.split(", ").map(|x| x.parse().unwrap()).collect()
    };
    let (before, after) = (numbers("pair by pair"), numbers("after ten steps"));
    assert_eq!(numbers("best match of each"), [0.0, 1.0, 2.0, 3.0]);
    assert!(
        before
            .iter()
            .zip(&after)
            .all(|(before, after)| before < after),
        "{text}"
    );
}

#[test]
fn own_function_prints_derivatives() {
    let text = printed("own_function");
    assert_eq!(text.lines().count(), 3);
    // At (10, 4) from each other and closing by (-2, 1) they are nearest after 3.2: at (3.6, 7.2).
    assert!(text.lines().nth(1).unwrap().starts_with("8.050"), "{text}");
}

#[test]
fn own_shape_is_checked() {
    let text = printed("own_shape");
    assert!(
        text.starts_with("2.000, by heading 0.000, by crown -1.000\n"),
        "{text}"
    );
}

//! The example with a shape and a function of the user's own.
use crate::{files, folder, run, status, stderr, stdout};

#[test]
fn a_batch() {
    let at = folder("custom_shape_batch");
    for (count, share) in [("40000", "26.8 % collide"), ("0", "0.0 % collide")] {
        let done = run("custom_shape", &at, &format!("--count {count}"));
        assert_eq!((status(&done), stderr(&done)), (0, ""));
        let told = stdout(&done);
        assert!(
            told.starts_with(&format!("{count} postures with derivatives in ")),
            "{told}"
        );
        assert!(told.contains(share), "{told}");
        assert!(!told.contains("NaN") && !told.contains("inf"), "{told}");
    }
    assert_eq!(files(&at), [""; 0]);
}

#[test]
fn a_check_in_both_formats() {
    let done = run("custom_shape", &folder("custom_shape_check"), "--check");
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    let checked = |line: &&str| line.starts_with("clearance") && line.ends_with("checked");
    let formats: Vec<_> = stdout(&done)
        .lines()
        .filter(checked)
        .filter_map(|line| line.split_whitespace().nth(1))
        .collect();
    assert_eq!(formats, ["f64", "f32"]);
}

#[test]
fn programs() {
    let at = folder("custom_shape_program");
    let done = run("custom_shape", &at, "--program");
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    for part in ["links[1]", "thickness", "result value", " roots, "] {
        assert!(stdout(&done).contains(part), "{part}: {}", stdout(&done));
    }
    let done = run("custom_shape", &at, "--wgsl");
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    let head = "fn clearance(x: array<f32, 15>) -> array<f32, 1> {";
    assert!(stdout(&done).contains(head), "{}", stdout(&done));
}

#[test]
fn a_picture() {
    let at = folder("custom_shape_picture");
    let done = run("custom_shape", &at, "--svg arm.svg");
    assert_eq!((status(&done), stderr(&done), stdout(&done)), (0, "", ""));
    let picture = std::fs::read_to_string(at.join("arm.svg")).unwrap();
    assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
    let done = run("custom_shape", &at, "--svg no/such/folder.svg");
    assert_eq!(status(&done), 1);
    assert!(
        stderr(&done).contains("no/such/folder.svg"),
        "{}",
        stderr(&done)
    );
    assert_eq!(files(&at), ["arm.svg"]);
}

//! The example `peg_in_hole`.
use crate::bodies::{Place, moving};
use crate::{files, folder, insertion, row, run, status, stderr, stdout};

#[test]
fn a_peg_finds_its_hole() {
    let at = folder("peg_in_hole");
    let done = run("peg_in_hole", &at, "--points 8 --steps 20");
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    let told = stdout(&done);
    let least = row(&done, "least clearance");
    // A millimetre is wanted, and more than two there is not.
    assert!(
        least[0] < -300.0 && (0.5..2.0).contains(&least[1]),
        "{told}"
    );
    assert!(told.contains("hits the block after 37 % of it"), "{told}");
    assert!(
        told.ends_with("over 6 points of the ground, 2.0 mm above it\n"),
        "{told}"
    );
    let picture = std::fs::read_to_string(at.join("peg_in_hole.svg")).unwrap();
    assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
    assert_eq!(files(&at), ["peg_in_hole.svg"]);
    for refused in ["--points 3", "--steps 19"] {
        assert_eq!(status(&run("peg_in_hole", &at, refused)), 2);
    }
}

/// Clearances along a path that nearly scrapes the rim, next to differences of clearances.
#[test]
fn clearances_have_the_derivatives_of_differences() {
    let path: [Place<f64>; 3] = [
        [-0.6, 0.1, 0.5, 0.3, 0.6, 0.4],
        [-0.1, 0.02, 0.36, 0.05, 0.1, 0.1],
        [0.001, 0.0, -0.1, 0.0, 0.001, 0.0],
    ];
    let found = insertion::clearances(&path).unwrap();
    assert_eq!(found.len(), 14);
    let (step, mut smooth) = (1e-5, 0);
    for number in 0..6 {
        let side = |step: f64| {
            let mut moved = path;
            moved[1][number] += step;
            insertion::clearances(&moved).unwrap()
        };
        let (above, below) = (side(step), side(-step));
        for (i, near) in found.iter().enumerate() {
            let up = (above[i].clearance - near.clearance) / step;
            let down = (near.clearance - below[i].clearance) / step;
            // Another time or another feature is nearest where both sides differ.
            if (up - down).abs() > 1e-2 {
                continue;
            }
            smooth += 1;
            let end = 1 - near.piece;
            let by = near.by_ends[end][number];
            assert!(
                (by - 0.5 * (up + down)).abs() < 1e-3,
                "{i} {number}: {by} {up} {down}"
            );
        }
    }
    assert!(smooth > 42, "{smooth}");
}

#[test]
fn the_peg_moves_from_place_to_place() {
    let [from, to] = [
        [0.1, 0.2, 0.3, 0.4, 0.5, 0.6],
        [0.7, 0.1, -0.2, 0.1, 0.3, 0.2],
    ];
    let peg = moving(from, to, 0.2);
    let end = moving(to, from, 0.2);
    for (start, end) in peg.corners.into_iter().zip(end.corners) {
        assert!((peg.motion.at(1.0) * start - end).length() < 1e-14);
        let center = geograd::Vec3::new(0.1, 0.2, 0.3);
        let radius = (0.04 / 0.75 + 0.09_f64).sqrt();
        assert!(((start - center).length() - radius).abs() < 1e-15);
    }
}

//! The example `grasp`.
use crate::closing::{self, Scene};
use crate::gripper::{self, GAPS};
use crate::{brute_force, files, folder, row, run, status, stderr, stdout};
use common::blend::{self, Faces};
use geograd::Vec3;
use geograd::mesh::{ClosedMesh, Mesh, MeshTree};

#[test]
fn two_fingers_take_hold() {
    let at = folder("grasp");
    let done = run("grasp", &at, "--body bone --starts 24 --steps 40 --cell 6");
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    let told = stdout(&done);
    // Faces, share, rate, what both judgements differ by, opening, two angles, lever, two gaps.
    let numbers = row(&done, "bone");
    assert_eq!(numbers.len(), 10, "{told}");
    assert!(numbers[1] > 4.0, "{told}");
    assert!(numbers[3] < 1e-6, "{told}");
    assert!((2.0..=80.0).contains(&numbers[4]), "{told}");
    assert!(numbers[5] < 26.6 && numbers[6] < 26.6, "{told}");
    assert!(
        (0.0..=5.0).contains(&numbers[8]) && (0.0..=5.0).contains(&numbers[9]),
        "{told}"
    );
    let word = told
        .lines()
        .last()
        .unwrap()
        .split_whitespace()
        .nth(4)
        .unwrap();
    let (agreed, all) = word.split_once('/').unwrap();
    assert_eq!(agreed, all, "{told}");
    let picture = std::fs::read_to_string(at.join("grasp.svg")).unwrap();
    assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
    assert_eq!(files(&at), ["grasp.svg"]);
    for refused in ["--body car", "--starts 0", "--cell 20", "--frobnicate"] {
        assert_eq!(status(&run("grasp", &at, refused)), 2, "{refused}");
    }
}

/// Calls a test with a body on a table.
fn with_scene(cell: f64, test: impl Fn(&Scene<'_>, &Faces)) {
    let body = Faces::of(&blend::mug(), cell);
    let mesh = Mesh::new(&body.vertices, &body.faces).unwrap();
    let (tree, closed) = (MeshTree::new(&mesh), ClosedMesh::new(&mesh).unwrap());
    test(&Scene::new(tree.on(&mesh).unwrap(), &closed), &body);
}

#[test]
fn squares_have_the_derivatives_of_differences() {
    with_scene(5e-3, |scene, _| {
        let guards = gripper::guards();
        let grasps = closing::starts(scene, 24, 3);
        let sum = |grasps: &[_]| -> Vec<f64> {
            let all = closing::squares(scene, &guards, grasps, 1.0).unwrap();
            all.iter().map(|squares| squares.sum).collect()
        };
        let found = closing::squares(scene, &guards, &grasps, 1.0).unwrap();
        let step = 1e-7;
        let mut smooth = 0;
        for number in 0..7 {
            let moved = |step: f64| {
                let moved = grasps.iter().map(|&grasp| {
                    let mut grasp: [f64; 7] = grasp;
                    grasp[number] += step;
                    grasp
                });
                sum(&moved.collect::<Vec<_>>())
            };
            let (above, below) = (moved(step), moved(-step));
            for (k, squares) in found.iter().enumerate() {
                let sides = [
                    (above[k] - squares.sum) / step,
                    (squares.sum - below[k]) / step,
                ];
                let size = 1.0 + sides[0].abs();
                // Both sides differ where a nearest face changes.
                if (sides[0] - sides[1]).abs() > 1e-2 * size {
                    continue;
                }
                smooth += 1;
                let (slope, difference) =
                    (2.0 * squares.slope[number], 0.5 * (sides[0] + sides[1]));
                assert!(
                    (slope - difference).abs() < 1e-2 * size,
                    "{k} {number}: {slope} {difference}"
                );
            }
        }
        assert!(smooth > 120, "{smooth}");
    });
}

#[test]
fn brute_force_agrees_with_the_tree() {
    with_scene(6e-3, |scene, body| {
        for (k, grasp) in closing::starts(scene, 16, 9).into_iter().enumerate() {
            // Smaller gaps bring fingers near to the body, and into it.
            let mut grasp = grasp;
            grasp[6] = GAPS[1] - 4e-3 * k as f64;
            let (a, b) = (
                closing::judged(scene, &[grasp]).unwrap()[0],
                brute_force::judged(body, gripper::parts(grasp)),
            );
            for (a, b) in a.gaps.into_iter().zip(b.gaps) {
                // Inside, the tree knows the depth; outside both know the gap.
                if a > -gripper::FINGER {
                    assert!((a - b).abs() < 1e-4, "{k}: {a} {b}");
                } else {
                    assert!(b < 0.0, "{k}: {a} {b}");
                }
            }
            assert!((a.height - b.height).abs() < 1e-12);
        }
    });
}

#[test]
fn settled_fingers_touch() {
    with_scene(6e-3, |scene, body| {
        // From above, along y: the handle is along x.
        let half = std::f64::consts::FRAC_1_SQRT_2 * std::f64::consts::PI;
        let above = [0.0, 0.0, 0.02, half, half, 0.0, 0.075];
        let settled = closing::settled(scene, vec![above]).unwrap()[0];
        let mut grasp = settled.expect("the cup is 72 mm wide");
        let judged = brute_force::judged(body, gripper::parts(grasp));
        assert!(
            judged.gaps[0].abs() < 5e-6 && judged.gaps[1].abs() < 5e-6,
            "{judged:?}"
        );
        assert!(closing::judged(scene, &[grasp]).unwrap()[0].gaps[2] > 0.0);
        // Far from the body nothing is settled.
        grasp[0] += 1.0;
        assert_eq!(closing::settled(scene, vec![grasp]).unwrap(), [None]);
        assert!(
            scene
                .normals
                .iter()
                .all(|normal| (normal.length() - 1.0).abs() < 1e-12)
        );
        assert!((scene.centroid - Vec3::new(0.0, 0.0, 0.0)).length() < 0.02);
    });
}

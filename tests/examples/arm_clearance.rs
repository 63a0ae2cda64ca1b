//! The example `arm_clearance`.
use crate::arm::{Joints, RADIUS, clearance, solids};
use crate::{files, folder, nearest, row, run, status, stderr, stdout};
use geograd::kernels::{Cpu, One, function};

#[test]
fn a_path_leaves_its_obstacles() {
    if !geograd_tests::is_due("a_path_leaves_its_obstacles") {
        return;
    }
    let at = folder("arm_clearance");
    let small = "--count 50 --points 17 --steps 120";
    let done = run("arm_clearance", &at, small);
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    let told = stdout(&done);
    assert!(
        told.starts_with("50 configurations of 39 pairs with derivatives in "),
        "{told}"
    );
    assert!(!told.contains("NaN") && !told.contains("inf"), "{told}");
    let least = row(&done, "least clearance");
    assert!(least[0] < -0.08 && least[1] > 0.0, "{told}");
    let length = row(&done, "length");
    assert!(
        length[0] < length[1] && length[1] < 1.5 * length[0],
        "{told}"
    );
    let picture = std::fs::read_to_string(at.join("arm_clearance.svg")).unwrap();
    assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
    run("arm_clearance", &at, &format!("{small} --svg again.svg"));
    assert!(picture == std::fs::read_to_string(at.join("again.svg")).unwrap());
    assert_eq!(files(&at), ["again.svg", "arm_clearance.svg"]);
}

/// Random angles between half turns.
fn random(count: u64) -> Vec<Joints<f64>> {
    let mut state = 1_u64;
    let mut turn = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5) * std::f64::consts::TAU
    };
    (0..count)
        .map(|_| std::array::from_fn(|_| turn()))
        .collect()
}

#[test]
fn the_lengths_are_those_published() {
    // Stretched out along -x, as all angles are zero: the forward kinematics of the maker.
    let arm = solids([0.0_f64; 6], RADIUS);
    let end = arm.links[4].end;
    assert!((end.x + 0.81725).abs() < 1e-12, "{end:?}");
    assert!((end.y + 0.10915).abs() < 1e-12, "{end:?}");
    assert!(
        (end.z - (0.35 + 0.089159 - 0.09465)).abs() < 1e-12,
        "{end:?}"
    );
    assert!((arm.hand.center.y + 0.10915 + 0.0823 + 0.06).abs() < 1e-12);
}

/// The recorded function in double precision, the nearest pairs in single precision, and differences of values agree.
#[test]
fn derivatives_agree_with_differences() {
    let joints = random(48);
    let columns = (&joints[..], One(RADIUS));
    let cpu = Cpu::new();
    let (values, (by_joints, by_radius)) = cpu
        .aligned(function(clearance).value_grad(), columns)
        .unwrap();
    let narrow: Vec<_> = joints.iter().map(|all| all.map(|x| x as f32)).collect();
    let found = nearest::clearances(&narrow, RADIUS as f32).unwrap();
    let (step, mut smooth) = (1e-6, 0);
    let at = |joints: &[Joints<f64>], radius| {
        cpu.aligned(function(clearance), (joints, One(radius)))
            .unwrap()
    };
    let slopes: Vec<_> = (0..7)
        .map(|k| {
            let side = |step: f64| {
                let moved = joints.iter().map(|&all| {
                    let mut all = all;
                    if k < 6 {
                        all[k] += step;
                    }
                    all
                });
                let radius = if k < 6 { RADIUS } else { RADIUS + step };
                at(&moved.collect::<Vec<_>>(), radius)
            };
            (side(step), side(-step))
        })
        .collect();
    for i in 0..joints.len() {
        assert!((f64::from(found.values[i]) - values[i]).abs() < 1e-5);
        // A place where both sides differ is a kink of the least or of the depth.
        let sides = slopes
            .iter()
            .map(|(up, down)| [(up[i] - values[i]) / step, (values[i] - down[i]) / step]);
        let sides: Vec<_> = sides.collect();
        if sides.iter().any(|[up, down]| (up - down).abs() > 1e-3) {
            continue;
        }
        smooth += 1;
        for (k, [up, down]) in sides.into_iter().enumerate() {
            let slope = 0.5 * (up + down);
            let (wide, narrow) = if k < 6 {
                (by_joints[i][k], found.by_joints[i][k])
            } else {
                (by_radius[i], found.by_radius[i])
            };
            assert!((wide - slope).abs() < 1e-6, "{i} {k}: {wide} {slope}");
            assert!(
                (f64::from(narrow) - slope).abs() < 1e-3,
                "{i} {k}: {narrow} {slope}"
            );
        }
    }
    assert!(smooth >= 44, "{smooth}");
}

//! The example `register`, and the bodies that it shares with `grasp`.
use crate::fitting::{self, Way, huber, registered, slopes};
use crate::scan::{self, Rules};
use crate::{files, folder, row, run, status, stderr, stdout};
use common::blend::{self, Blend, Faces, Part};
use common::positive::solved;
use geograd::kernels::Cpu;
use geograd::mesh::{ClosedMesh, FaceFeature, Mesh, MeshTree, distance_replay};
use geograd::{Capsule3, Cylinder, Obb3, Pose3, Rotation3, RoundBox3, Sphere, Vec3};
use std::collections::BTreeSet;

#[test]
fn scans_find_their_places() {
    let at = folder("register");
    let done = run(
        "register",
        &at,
        "--points 300 --starts 3 --steps 80 --cell 7 --turn 15 --shift 8",
    );
    assert_eq!((status(&done), stderr(&done)), (0, ""));
    let told = stdout(&done);
    assert!(told.contains("3 scans of 300 points"), "{told}");
    for way in Way::ALL {
        // Share, steps, steps to 1 µm, two times, angle, shift, loss.
        let numbers = row(&done, way.name());
        assert_eq!((numbers.len(), numbers[0]), (8, 100.0), "{told}");
        assert!(numbers[5] < 1.5 && numbers[6] < 1.5, "{told}");
    }
    let steps = |way: Way| row(&done, way.name())[2];
    assert!(steps(Way::Newton) <= 25.0, "{told}");
    assert!(2.0 * steps(Way::Newton) < steps(Way::Points), "{told}");
    let picture = std::fs::read_to_string(at.join("register.svg")).unwrap();
    assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
    assert_eq!(files(&at), ["register.svg"]);
    for refused in [
        "--points 19",
        "--outliers 60",
        "--starts 0",
        "--cell 0.5",
        "--frobnicate",
    ] {
        assert_eq!(status(&run("register", &at, refused)), 2, "{refused}");
    }
}

/// Closed meshes with as many handles as the bodies have, and every vertex on the surface. The bracket has three holes and
/// an opening under its rib.
#[test]
fn bodies_are_closed_meshes() {
    for (body, handles) in blend::all().iter().zip([1, 4, 1, 0, 0]) {
        let Faces { vertices, faces } = Faces::of(body, 5e-3);
        let mesh = Mesh::new(&vertices, &faces).unwrap();
        ClosedMesh::new(&mesh).unwrap_or_else(|fault| panic!("{}: {fault}", body.name));
        let euler = vertices.len() as i64 - mesh.edges().len() as i64 + faces.len() as i64;
        assert_eq!(euler, 2 - 2 * handles, "{}", body.name);
        let used: BTreeSet<u32> = faces.iter().flatten().copied().collect();
        assert_eq!(used.len(), vertices.len(), "{}", body.name);
        for &vertex in &vertices {
            let height: f64 = body.height(vertex);
            assert!(height.abs() < 2e-4, "{}: {height} at {vertex}", body.name);
        }
        // Outward: inside is where the function is negative.
        let tree = MeshTree::new(&mesh);
        let surface = tree.on(&mesh).unwrap();
        let (mut inside, mut wrong) = (0, 0);
        for k in 0..1000_u32 {
            let part = |by: u32| f64::from(k * by % 1009) / 1009.0 * 2.0 - 1.0;
            let [x, y, z] = [1, 29, 413].map(part);
            let point = Vec3::new(x * body.half.x, y * body.half.y, z * body.half.z);
            let height: f64 = body.height(point);
            inside += u32::from(height < 0.0);
            wrong += u32::from(height.abs() > 1e-3 && surface.encloses(point) != (height < 0.0));
        }
        assert!(inside > 50 && wrong == 0, "{}: {inside} {wrong}", body.name);
        assert!(mesh.volume() > 0.0);
    }
}

/// Heights of parts beside the library's distances.
#[test]
fn parts_are_solids() {
    let [start, end] = [Vec3::new(0.01, -0.02, 0.0), Vec3::new(0.03, 0.01, 0.02)];
    let inner = Obb3::new(start, Vec3::new(0.02, 0.03, 0.01), Rotation3::identity());
    let (ball, rod) = (Sphere::new(start, 0.01), Capsule3::new(start, end, 0.01));
    let (block, drum) = (
        RoundBox3::new(inner, 0.003),
        Cylinder::new(start, end, 0.01),
    );
    let height = |part: Part, point: Vec3<f64>| -> f64 {
        let body = Blend {
            name: "",
            parts: vec![part],
            cuts: vec![],
            width: 0.001,
            half: Vec3::zero(),
        };
        body.height(point)
    };
    for k in 0..500_u32 {
        let part = |by: u32| f64::from(k * by % 509) / 509.0 * 0.1 - 0.05;
        let [x, y, z] = [1, 29, 413].map(part);
        let point = Vec3::new(x, y, z);
        for (part, expected) in [
            (Part::Ball(ball), point.signed_distance(ball)),
            (Part::Rod(rod), point.signed_distance(rod)),
            (Part::Block(block), point.signed_distance(block)),
            // Its edges are round.
            (Part::Drum(drum), point.signed_distance(drum) - 0.0025),
        ] {
            let found = height(part, point);
            assert!(
                (found - expected).abs() < 1e-15,
                "{part:?}: {found} {expected} at {point}"
            );
        }
    }
}

/// A ball has the volume and the area of a ball.
#[test]
fn a_ball_is_round() {
    let body = Blend {
        name: "ball",
        parts: vec![Part::Ball(Sphere::new(Vec3::zero(), 0.05))],
        cuts: vec![],
        width: 0.001,
        half: Vec3::new(0.052, 0.052, 0.052),
    };
    let Faces { vertices, faces } = Faces::of(&body, 2.5e-3);
    let mesh = Mesh::new(&vertices, &faces).unwrap();
    let (volume, area) = (
        4.0 / 3.0 * std::f64::consts::PI * 0.05_f64.powi(3),
        4.0 * std::f64::consts::PI * 0.05_f64.powi(2),
    );
    assert!((mesh.volume() / volume - 1.0).abs() < 3e-3);
    assert!((mesh.area() / area - 1.0).abs() < 3e-3);
    for vertex in vertices {
        assert!((vertex.length() - 0.05).abs() < 1e-8);
    }
}

/// Derivatives of distances by a step beside differences of the same distances.
#[test]
fn derivatives_of_distances() {
    let Faces { vertices, faces } = Faces::of(&blend::kettle(), 8e-3);
    let mesh = Mesh::new(&vertices, &faces).unwrap();
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).unwrap();
    // Over faces, over edges, and over corners that stick out.
    let mut points = Vec::new();
    for k in (0..faces.len()).step_by(40) {
        let face = mesh.triangle(k as u32);
        for (at, out) in [
            (face.center(), 0.004),
            (face.a.lerp(face.b, 0.5), 0.01),
            (face.a, 0.02),
        ] {
            points.push(at + face.normal() * out);
        }
    }
    let records = Cpu::new().nearest_faces(&surface, &points).unwrap();
    let count =
        |wanted: fn(FaceFeature) -> bool| records.iter().filter(|x| wanted(x.feature)).count();
    let of_edges = count(|feature| matches!(feature, FaceFeature::Edge { .. }));
    let of_corners = count(|feature| matches!(feature, FaceFeature::Vertex { .. }));
    assert!(of_edges > 5 && of_corners > 0, "{of_edges} {of_corners}");
    let center = Vec3::new(0.01, -0.02, 0.03);
    let found = slopes(&surface, center, &points, &records, true).unwrap();
    let plain = slopes(&surface, center, &points, &records, false).unwrap();
    assert_eq!(
        (&found.distances, &found.first),
        (&plain.distances, &plain.first)
    );
    // In units in which the body is about as large as one.
    let distance = |i: usize, step: [f64; 6]| {
        let [a, b, c, x, y, z] = step;
        let turn = Rotation3::from_rotation_vector(Vec3::new(a, b, c));
        let point = turn * (points[i] - center) + center + Vec3::new(x, y, z);
        distance_replay(point, mesh.triangle(records[i].face), records[i].feature)
    };
    let step = 1e-4;
    for i in 0..points.len() {
        assert!((found.distances[i] - distance(i, [0.0; 6])).abs() < 1e-15);
        for j in 0..6 {
            let h = if j < 3 { step } else { 0.1 * step };
            let moved = |by: &[(usize, f64)]| {
                let mut all = [0.0; 6];
                for &(k, x) in by {
                    all[k] += x;
                }
                distance(i, all)
            };
            let slope = (moved(&[(j, h)]) - moved(&[(j, -h)])) / (2.0 * h);
            assert!((found.first[i][j] - slope).abs() < 1e-5, "{i} {j}");
            for k in 0..6 {
                let g = if k < 3 { step } else { 0.1 * step };
                let sides = [(h, g), (h, -g), (-h, g), (-h, -g)];
                let [a, b, c, d] = sides.map(|(x, y)| moved(&[(j, x), (k, y)]));
                let curvature = (a - b - c + d) / (4.0 * h * g);
                let error = (found.second[i][j][k] - curvature).abs();
                assert!(
                    error < 1e-3 * (1.0 + curvature.abs()),
                    "{i} {j} {k}: {error} {curvature}"
                );
            }
        }
    }
}

/// Without noise and outliers all ways end where the scan was taken.
#[test]
fn exact_scans_are_found_exactly() {
    let Faces { vertices, faces } = Faces::of(&blend::kettle(), 7e-3);
    let mesh = Mesh::new(&vertices, &faces).unwrap();
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).unwrap();
    let rules = Rules {
        points: 400,
        noise: 0.0,
        outliers: 0.0,
        seed: 5,
    };
    let scan = scan::taken(&surface, &rules).unwrap();
    for &point in &scan.points {
        assert!(surface.distance(scan.truth * point) < 1e-12);
    }
    let start = scan::start(scan.truth, 0.1, 0.004, 5);
    let [angle, shift] = scan::error(start, scan.truth);
    assert!((angle - 0.1).abs() < 1e-12 && (shift - 0.004).abs() < 1e-12);
    for way in Way::ALL {
        let course = registered(way, &surface, &scan.points, start, 1e-3, 400).unwrap();
        let [angle, shift] = scan::error(course.end(), scan.truth);
        let most = if way == Way::Points { 1e-5 } else { 1e-9 };
        assert!(angle < most && shift < most, "{way:?}: {angle} {shift}");
        let steps = course.steps_to(1e-6, &scan.points);
        assert!(steps > 0 && steps < course.poses.len(), "{way:?}: {steps}");
    }
    let same = fitting::registered(Way::Newton, &surface, &scan.points, start, 1e-3, 400).unwrap();
    let again = registered(Way::Newton, &surface, &scan.points, start, 1e-3, 400).unwrap();
    assert_eq!(same.poses, again.poses);
    assert_eq!(scan::error(Pose3::identity(), Pose3::identity()), [0.0; 2]);
}

#[test]
fn huber_and_cholesky() {
    for x in [-3.0, -1.0, -0.2, 0.0, 0.7, 1.5] {
        let [value, slope, curvature] = huber(x, 1.0);
        let h = 1e-6;
        let difference = (huber(x + h, 1.0)[0] - huber(x - h, 1.0)[0]) / (2.0 * h);
        assert!((slope - difference).abs() < 1e-6);
        assert_eq!(curvature, f64::from(u8::from(x.abs() <= 1.0)));
        assert!(value <= 0.5 * x * x);
    }
    let found = solved([[4.0, 2.0], [2.0, 3.0]], [2.0, 5.0]).unwrap();
    assert!((found[0] + 0.5).abs() < 1e-15 && (found[1] - 2.0).abs() < 1e-15);
    assert_eq!(solved([[1.0, 2.0], [2.0, 1.0]], [1.0, 1.0]), None);
    assert_eq!(solved([[f64::NAN]], [1.0]), None);
}

//! Closest points and distances against every face one by one, by formulas that the library does not use.
use super::mesh_shapes::{Owned, all, bumpy_sphere, cube, queries};
use crate::space::draw::Random;
use geograd::mesh::{ClosedMesh, FaceFeature, Mesh, MeshTree, distance_replay};
use geograd::{Pack, Triangle3, Vec3};

fn from_segment(p: Vec3<f64>, a: Vec3<f64>, b: Vec3<f64>) -> f64 {
    let (way, arm) = (b - a, p - a);
    let square = way.length_squared();
    let t = if square > 0.0 {
        (way.dot(arm) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (a + way * t - p).length()
}

/// The distance from a triangle as the least one from the segments between its corner c and the points of its edge ab.
/// It is convex along the edge.
fn by_segments(p: Vec3<f64>, t: Triangle3<f64>) -> f64 {
    let at = |s: f64| from_segment(p, t.a.lerp(t.b, s), t.c);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..90 {
        let third = (high - low) / 3.0;
        if at(low + third) < at(high - third) {
            high -= third;
        } else {
            low += third;
        }
    }
    at(0.5 * (low + high)).min(at(0.0)).min(at(1.0))
}

/// The distance from a triangle of ordinary form: from the plane if the point projects into it, else from the edges.
fn by_projection(p: Vec3<f64>, t: Triangle3<f64>) -> f64 {
    let (u, v, w) = (t.b - t.a, t.c - t.a, p - t.a);
    let (uu, uv, vv, wu, wv) = (u.dot(u), u.dot(v), v.dot(v), w.dot(u), w.dot(v));
    let over = uu * vv - uv * uv;
    let (s, r) = ((vv * wu - uv * wv) / over, (uu * wv - uv * wu) / over);
    if s >= 0.0 && r >= 0.0 && s + r <= 1.0 {
        return (t.a + u * s + v * r - p).length();
    }
    [(t.a, t.b), (t.b, t.c), (t.c, t.a)]
        .map(|(a, b)| from_segment(p, a, b))
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

fn oracle(owned: &Owned, p: Vec3<f64>) -> f64 {
    let mesh = owned.mesh();
    let faces = 0..owned.faces.len() as u32;
    let of = |face| match owned.name {
        "bumpy sphere" => by_projection(p, mesh.triangle(face)),
        _ => by_segments(p, mesh.triangle(face)),
    };
    faces.map(of).fold(f64::INFINITY, f64::min)
}

#[test]
fn distances_are_those_of_all_faces() {
    if !geograd_tests::is_due("distances_are_those_of_all_faces") {
        return;
    }
    let mut random = Random(0x51b2_99c0_7d3e_a1f5);
    for owned in all() {
        let mesh = owned.mesh();
        let tree = MeshTree::new(&mesh);
        let surface = tree.on(&mesh).unwrap();
        let count = if owned.faces.len() > 1000 { 60 } else { 400 };
        for p in queries(&owned, &mut random, count) {
            let (found, expected) = (surface.distance(p), oracle(&owned, p));
            let tolerance =
                4e-15 * (2.0 + p.length()) + 2e-9 * f64::from(expected < 1e-8) * expected;
            assert!(
                (found - expected).abs() <= tolerance,
                "{} at {p}: {found} for {expected}",
                owned.name
            );
            let closest = surface.closest_point(p);
            assert!(((closest - p).length() - expected).abs() <= tolerance);
            let square = surface.squared_distance(p);
            assert!(
                (square.sqrt() - expected).abs() <= tolerance,
                "{p}: {square}"
            );
        }
    }
}

/// The face is the lowest of those at the least distance, whatever else is near.
#[test]
fn ties_take_the_lowest_face() {
    let owned = cube();
    let mesh = owned.mesh();
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).unwrap();
    // Over every corner and the middle of every edge, where up to six faces tie.
    let mut ties = 0;
    for k in 0..27 {
        let at = [k % 3, k / 3 % 3, k / 9].map(f64::from);
        let p = Vec3::new(at[0] - 0.5, at[1] - 0.5, at[2] - 0.5) + Vec3::new(0.0, 0.0, 0.0);
        let record = surface.nearest_face(p);
        let of = |face: u32| {
            let alone = [mesh.faces()[face as usize]];
            let alone = Mesh::new(mesh.vertices(), &alone).unwrap();
            let tree = MeshTree::new(&alone);
            let feature = tree.on(&alone).unwrap().nearest_face(p).feature;
            distance_replay(p, mesh.triangle(face), feature)
        };
        let distances: Vec<f64> = (0..12).map(of).collect();
        let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
        let lowest = distances.iter().position(|&x| x == least).unwrap();
        ties += distances.iter().filter(|&&x| x == least).count() - 1;
        assert_eq!(record.face as usize, lowest, "{p}: {distances:?}");
    }
    assert!(ties > 30, "{ties}");
}

/// A mesh in another order of faces has the same closest points.
#[test]
fn order_of_faces_changes_no_point() {
    let mut random = Random(77);
    let owned = bumpy_sphere(3);
    let mesh = owned.mesh();
    let mut faces = owned.faces.clone();
    for k in (1..faces.len()).rev() {
        faces.swap(k, random.below(k + 1));
        faces[k].rotate_left(random.below(3));
    }
    let other = Mesh::new(&owned.vertices, &faces).unwrap();
    let trees = [MeshTree::new(&mesh), MeshTree::new(&other)];
    let (a, b) = (trees[0].on(&mesh).unwrap(), trees[1].on(&other).unwrap());
    for p in queries(&owned, &mut random, 500) {
        // In the middle of the sphere many faces are almost as near.
        let (x, y) = (a.closest_point(p), b.closest_point(p));
        assert!(
            (x - y).length() < 1e-13 * (1.0 + p.length()),
            "{p}: {x} {y}"
        );
    }
}

#[test]
fn signs_are_those_of_the_parity() {
    let mut random = Random(0x9d2c_5680_1234_5678);
    let mut sides = [0, 0];
    for owned in all().into_iter().filter(|owned| owned.is_closed) {
        let mesh = owned.mesh();
        let (tree, closed) = (MeshTree::new(&mesh), ClosedMesh::new(&mesh).unwrap());
        let surface = tree.on(&mesh).unwrap();
        for p in queries(&owned, &mut random, 400) {
            let signed = surface.signed_distance(&closed, p);
            let distance = surface.distance(p);
            let room = 1e-15 * f64::from(distance == 0.0);
            assert!(
                (signed.abs() - distance).abs() <= room,
                "{}: {p}",
                owned.name
            );
            // A wall between two cubes is inside of both.
            if signed.abs() > 1e-12 && owned.name != "touching cubes" {
                let inside = surface.encloses(p);
                assert_eq!(signed < 0.0, inside, "{}: {p} {signed}", owned.name);
                sides[usize::from(inside)] += 1;
            }
        }
    }
    assert!(sides.iter().all(|&count| count > 200), "{sides:?}");
}

/// Points over edges and vertices of sharp meshes, where the nearest face alone would give the wrong sign.
#[test]
fn signs_at_sharp_vertices() {
    let owned = super::mesh_shapes::tetrahedron();
    let mesh = owned.mesh();
    let (tree, closed) = (MeshTree::new(&mesh), ClosedMesh::new(&mesh).unwrap());
    let surface = tree.on(&mesh).unwrap();
    let mut random = Random(3);
    let (mut edges, mut vertices) = (0, 0);
    for _ in 0..2000 {
        let p = random.vector(2.0);
        let outside = p.x < 0.0 || p.y < 0.0 || p.z < 0.0 || p.x + p.y + p.z > 1.0;
        match surface.nearest_face(p).feature {
            FaceFeature::Interior => {}
            FaceFeature::Edge { .. } => edges += 1,
            FaceFeature::Vertex { .. } => vertices += 1,
        }
        assert_eq!(surface.signed_distance(&closed, p) > 0.0, outside, "{p}");
    }
    assert!(edges > 200 && vertices > 200, "{edges} {vertices}");
}

/// The size and the place of a mesh, and the format of its numbers, change results by their roundings alone.
#[test]
fn places_sizes_and_formats() {
    let mut random = Random(21);
    let owned = bumpy_sphere(2);
    let mesh = owned.mesh();
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).unwrap();
    let ps = queries(&owned, &mut random, 100);
    for (scale, shift) in [
        (1e-30, 0.0),
        (1e30, 0.0),
        (1.0, 1e5),
        (1e-3, 1e3),
        (1e-44, 0.0),
    ] {
        let moved = |v: Vec3<f64>| (v + Vec3::new(shift, -shift, 0.5 * shift)) * scale;
        let vertices: Vec<_> = owned.vertices.iter().map(|&v| moved(v)).collect();
        let other = Mesh::new(&vertices, &owned.faces).unwrap();
        let tree = MeshTree::new(&other);
        let other = tree.on(&other).unwrap();
        for &p in &ps {
            let (found, expected) = (other.distance(moved(p)) / scale, surface.distance(p));
            let tolerance = 1e-14 * (1.0 + p.length() + shift);
            assert!(
                (found - expected).abs() < tolerance,
                "{scale} {shift} {p}: {found} {expected}"
            );
        }
    }
    let vertices: Vec<Vec3<f32>> = owned.vertices.iter().map(Pack::cast).collect();
    let single = Mesh::new(&vertices, &owned.faces).unwrap();
    let tree = MeshTree::new(&single);
    let single = tree.on(&single).unwrap();
    for p in ps {
        let (found, expected) = (single.distance(p.cast()), surface.distance(p));
        let tolerance = 1e-6 * (1.0 + p.length());
        assert!(
            (f64::from(found) - expected).abs() < tolerance,
            "{p}: {found} {expected}"
        );
    }
}

#[test]
fn refitted_trees_answer_for_moved_vertices() {
    let mut random = Random(5);
    let owned = bumpy_sphere(2);
    let mesh = owned.mesh();
    let mut tree = MeshTree::new(&mesh);
    let vertices: Vec<_> = owned
        .vertices
        .iter()
        .map(|&v| v + random.vector(0.2))
        .collect();
    let moved = Owned {
        vertices,
        ..bumpy_sphere(2)
    };
    let mesh = moved.mesh();
    tree.refit(&mesh).unwrap();
    let surface = tree.on(&mesh).unwrap();
    for p in queries(&moved, &mut random, 100) {
        let (found, expected) = (surface.distance(p), oracle(&moved, p));
        assert!(
            (found - expected).abs() < 1e-14 * (2.0 + p.length()),
            "{p}: {found} {expected}"
        );
    }
}

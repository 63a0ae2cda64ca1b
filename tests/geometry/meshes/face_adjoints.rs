//! Cotangents of points, rays and vertices, by hand: against duals along records and against differences.
use super::mesh_shapes::{all, queries};
use crate::space::draw::Random;
use geograd::intersection3::first_hit_triangle;
use geograd::kernels::Cpu;
use geograd::kernels::cpu::mesh_batches::{MeshBars, MeshDistance};
use geograd::mesh::{
    ClosedMesh, FaceFeature, FaceRecord, Mesh, MeshTree, closest_replay, distance_replay,
    squared_distance_replay,
};
use geograd::{Jet, Ray3, Scalar, Triangle3, Vec3};

type Along = Jet<f64, 12>;

/// A point and a triangle, each number with a derivative of its own.
fn seeded(vectors: [Vec3<f64>; 4]) -> [Vec3<Along>; 4] {
    let mut k = 0;
    let mut seed = |value: f64| {
        let mut derivative = [0.0; 12];
        derivative[k] = 1.0;
        k += 1;
        Jet { value, derivative }
    };
    vectors.map(|v| Vec3::new(seed(v.x), seed(v.y), seed(v.z)))
}

/// The derivatives of a number by the four vectors, times a cotangent.
fn bars_of(number: Along, bar: f64) -> [Vec3<f64>; 4] {
    let d = number.derivative.map(|x| x * bar);
    [0, 3, 6, 9].map(|k| Vec3::new(d[k], d[k + 1], d[k + 2]))
}

/// Compares the cotangents of one query with those of a replay, and of all vertices with zero.
fn compare(
    (faces, vertices): (&[[u32; 3]], usize),
    face: u32,
    [own, corners @ ..]: [Vec3<f64>; 4],
    found: &MeshBars<Vec3<f64>, f64>,
    context: &str,
) {
    let mut expected = vec![Vec3::zero(); vertices];
    for (&vertex, bar) in faces[face as usize].iter().zip(corners) {
        expected[vertex as usize] += bar;
    }
    let size = 1.0
        + expected
            .iter()
            .fold(own.length(), |most, bar| most.max(bar.length()));
    let error = (found.queries[0] - own).length();
    assert!(
        error < 1e-9 * size,
        "{context}: {:?} {own:?}",
        found.queries
    );
    assert_eq!(found.vertices.len(), vertices);
    for (found, expected) in found.vertices.iter().zip(&expected) {
        let error = (*found - *expected).length();
        assert!(error < 1e-9 * size, "{context}: {found} {expected}");
    }
}

/// Slivers have derivatives as steep as they are thin, which duals round.
fn is_sliver([a, b, c]: [Vec3<f64>; 3]) -> bool {
    let size = (b - a).length().max((c - a).length());
    (b - a).cross(c - a).length() < 1e-3 * size * size
}

#[test]
fn cotangents_are_those_of_replays() {
    let (cpu, mut random) = (Cpu::new(), Random(0x00ad_5eed_0000_0001));
    let mut features = [0; 3];
    for owned in all() {
        let mesh = owned.mesh();
        let tree = MeshTree::new(&mesh);
        let surface = tree.on(&mesh).unwrap();
        let shape = (mesh.faces(), mesh.vertices().len());
        for point in queries(&owned, &mut random, 120) {
            let points = [point];
            let records = cpu.nearest_faces(&surface, &points).unwrap();
            let FaceRecord { face, feature } = records[0];
            let Triangle3 { a, b, c } = mesh.triangle(face);
            // On an edge, within rounding, the direction is one of many.
            let apart = distance_replay(point, mesh.triangle(face), feature);
            let is_over = feature == FaceFeature::Interior;
            if is_over && is_sliver([a, b, c]) || !is_over && apart < 1e-9 {
                continue;
            }
            features[match feature {
                FaceFeature::Interior => 0,
                FaceFeature::Edge { .. } => 1,
                FaceFeature::Vertex { .. } => 2,
            }] += 1;
            let [p, a, b, c] = seeded([point, a, b, c]);
            let triangle = Triangle3 { a, b, c };
            let context = format!("{}: {point} {feature:?}", owned.name);

            let bar = random.within(-2.0, 2.0);
            let expected = bars_of(distance_replay(p, triangle, feature), bar);
            let plain = MeshDistance::Plain;
            let found = cpu.mesh_distances_vjp(plain, &surface, &points, &records, &[bar]);
            compare(shape, face, expected, &found.unwrap(), &context);

            let expected = bars_of(squared_distance_replay(p, triangle, feature), bar);
            let squared = MeshDistance::Squared;
            let found = cpu.mesh_distances_vjp(squared, &surface, &points, &records, &[bar]);
            compare(shape, face, expected, &found.unwrap(), &context);

            let bar = random.vector(1.0);
            let at = closest_replay(p, triangle, feature);
            let [x, y, z] = [(at.x, bar.x), (at.y, bar.y), (at.z, bar.z)]
                .map(|(number, bar)| bars_of(number, bar));
            let expected = [0, 1, 2, 3].map(|k| x[k] + y[k] + z[k]);
            let found = cpu.closest_points_vjp(&surface, &points, &records, &[bar]);
            compare(shape, face, expected, &found.unwrap(), &context);
        }
    }
    assert!(features.iter().all(|&count| count > 50), "{features:?}");
}

/// The signed distances of points from moved vertices, and the sum of all, each times a weight.
fn loss(vertices: &[Vec3<f64>], faces: &[[u32; 3]], points: &[Vec3<f64>], by: &[f64]) -> f64 {
    let mesh = Mesh::new(vertices, faces).unwrap();
    let (tree, closed) = (MeshTree::new(&mesh), ClosedMesh::new(&mesh).unwrap());
    let surface = tree.on(&mesh).unwrap();
    let terms = points.iter().zip(by);
    terms.fold(0.0, |sum, (&point, by)| {
        sum + by * surface.signed_distance(&closed, point)
    })
}

#[test]
fn signed_distances_have_the_slopes_of_differences() {
    let (cpu, mut random) = (Cpu::new(), Random(0x00ad_5eed_0000_0002));
    for owned in all().into_iter().filter(|owned| owned.is_closed) {
        let mesh = owned.mesh();
        let (tree, closed) = (MeshTree::new(&mesh), ClosedMesh::new(&mesh).unwrap());
        let surface = tree.on(&mesh).unwrap();
        let kind = MeshDistance::Signed(&closed);
        let points: Vec<_> = (0..60).map(|_| random.vector(2.0)).collect();
        let by: Vec<_> = (0..60).map(|_| random.within(-1.0, 1.0)).collect();
        let records = cpu.nearest_faces(&surface, &points).unwrap();
        let values = cpu
            .mesh_distances(kind, &surface, &points, &records)
            .unwrap();
        let sum: f64 = values.iter().zip(&by).map(|(value, by)| value * by).sum();
        let direct = loss(&owned.vertices, &owned.faces, &points, &by);
        assert!((sum - direct).abs() < 1e-12, "{}", owned.name);
        let bars = cpu
            .mesh_distances_vjp(kind, &surface, &points, &records, &by)
            .unwrap();

        let ways: Vec<_> = owned.vertices.iter().map(|_| random.vector(1.0)).collect();
        let moves: Vec<_> = points.iter().map(|_| random.vector(1.0)).collect();
        let dot = |a: &[Vec3<f64>], b: &[Vec3<f64>]| -> f64 {
            a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
        };
        let slope = dot(&bars.vertices, &ways) + dot(&bars.queries, &moves);
        let step = 1e-6;
        let side = |step: f64| {
            let moved = |all: &[Vec3<f64>], ways: &[Vec3<f64>]| -> Vec<_> {
                all.iter().zip(ways).map(|(&v, &w)| v + w * step).collect()
            };
            let (vertices, points) = (moved(&owned.vertices, &ways), moved(&points, &moves));
            loss(&vertices, &owned.faces, &points, &by)
        };
        let difference = (side(step) - side(-step)) / (2.0 * step);
        assert!(
            (slope - difference).abs() < 1e-4 * (1.0 + slope.abs()),
            "{}: {slope} {difference}",
            owned.name
        );
    }
}

#[test]
fn hits_have_the_slopes_of_duals() {
    let (cpu, mut random) = (Cpu::new(), Random(0x00ad_5eed_0000_0003));
    let mut hits = 0;
    for owned in all() {
        let mesh = owned.mesh();
        let tree = MeshTree::new(&mesh);
        let surface = tree.on(&mesh).unwrap();
        for _ in 0..100 {
            let from = random.vector(3.0);
            let to = mesh.triangle(random.below(mesh.faces().len()) as u32);
            let rays = [Ray3::new(from, to.a * 0.3 + to.b * 0.3 + to.c * 0.4 - from)];
            let faces = cpu.hit_faces(&surface, &rays).unwrap();
            let bar = random.within(-2.0, 2.0);
            let bars = cpu.first_hits_vjp(&surface, &rays, &faces, &[bar]).unwrap();
            let Some(face) = faces[0] else {
                assert!(bars.vertices.iter().all(|&bar| bar == Vec3::zero()));
                assert_eq!(bars.queries[0].point, Vec3::zero());
                continue;
            };
            let Triangle3 { a, b, c } = mesh.triangle(face);
            let n = (b - a).cross(c - a);
            let slope = n.dot(rays[0].direction).abs();
            if is_sliver([a, b, c]) || slope < 1e-3 * n.length() * rays[0].direction.length() {
                continue;
            }
            hits += 1;
            let context = format!("{}: {:?}", owned.name, rays[0]);
            let still = |v: Vec3<f64>| {
                let [x, y, z] = [v.x, v.y, v.z].map(Along::from_primal);
                Vec3::new(x, y, z)
            };
            let [p, a, b, c] = seeded([from, a, b, c]);
            let ray = Ray3 {
                point: p,
                direction: still(rays[0].direction),
            };
            let hit = first_hit_triangle(ray, Triangle3 { a, b, c });
            let own = MeshBars {
                queries: vec![bars.queries[0].point],
                vertices: bars.vertices.clone(),
            };
            let shape = (mesh.faces(), mesh.vertices().len());
            compare(shape, face, bars_of(hit.parameter, bar), &own, &context);
            let turned = bars.queries[0].point * hit.parameter.value - bars.queries[0].direction;
            assert!(
                turned.length() < 1e-9 * (1.0 + turned.length()),
                "{context}"
            );
        }
    }
    assert!(hits > 300, "{hits}");
}

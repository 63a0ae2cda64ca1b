//! Batches of queries: the bits of one query at a time, on any number of threads and every level of vectors.
use super::mesh_shapes::{all, bumpy_sphere, cube, queries};
use crate::space::draw::Random;
use geograd::error::{Argument, Error};
use geograd::kernels::Cpu;
use geograd::kernels::cpu::mesh_batches::MeshDistance;
use geograd::kernels::cpu::simd::Simd;
use geograd::mesh::{ClosedMesh, FaceFeature, FaceRecord, Mesh, MeshTree};
use geograd::{Ray3, Vec3};
use geograd_tests::with_threads;

fn bits(v: Vec3<f64>) -> [u64; 3] {
    [v.x.to_bits(), v.y.to_bits(), v.z.to_bits()]
}

#[test]
fn batches_have_the_bits_of_single_queries() {
    if !geograd_tests::is_due("batches_have_the_bits_of_single_queries") {
        return;
    }
    let (cpu, mut random) = (Cpu::new(), Random(0xba7c_5eed_0000_0001));
    for owned in all() {
        let mesh = owned.mesh();
        let tree = MeshTree::new(&mesh);
        let surface = tree.on(&mesh).unwrap();
        let mut points = queries(&owned, &mut random, 300);
        // Beyond the range of single precision in the tree's frame, and neighbours of such points in the list.
        points.extend([Vec3::new(1e30, 0.0, 1.0), Vec3::new(0.0, -1e20, 0.0)]);
        for level in Simd::available() {
            Simd::limit(Some(level)).unwrap();
            let records = cpu.nearest_faces(&surface, &points).unwrap();
            for (&point, record) in points.iter().zip(&records) {
                assert_eq!(
                    *record,
                    surface.nearest_face(point),
                    "{} {point}",
                    owned.name
                );
            }
            let found = cpu.closest_points(&surface, &points, &records).unwrap();
            let apart = cpu
                .mesh_distances(MeshDistance::Plain, &surface, &points, &records)
                .unwrap();
            for (k, &point) in points.iter().enumerate() {
                assert_eq!(bits(found[k]), bits(surface.closest_point(point)));
                assert_eq!(apart[k].to_bits(), surface.distance(point).to_bits());
            }
            let rays: Vec<_> = points[..300]
                .iter()
                .map(|&point| Ray3::new(point, random.vector(1.0)))
                .collect();
            let faces = cpu.hit_faces(&surface, &rays).unwrap();
            let hits = cpu.first_hits(&surface, &rays, &faces).unwrap();
            let parameters = cpu.hit_parameters(&surface, &rays).unwrap();
            for ((&ray, hit), parameter) in rays.iter().zip(&hits).zip(parameters) {
                assert_eq!(*hit, surface.first_hit(ray), "{} {ray:?}", owned.name);
                let plain = hit.map(|own| (own.face, own.hit.parameter));
                assert_eq!(parameter, plain, "{} {ray:?}", owned.name);
            }
        }
        Simd::limit(None).unwrap();
    }
}

/// Far from the origin a closest point is off by more than neighbouring faces are apart.
#[test]
fn hints_lose_no_face_far_from_the_origin() {
    let (cpu, mut random) = (Cpu::new(), Random(0xba7c_5eed_0000_0004));
    let owned = bumpy_sphere(2);
    for far in [1e8, 1e11, 1e13, 1e14] {
        let away = Vec3::new(far, -0.7 * far, 0.3 * far);
        let vertices: Vec<_> = owned.vertices.iter().map(|&v| v + away).collect();
        let mesh = Mesh::new(&vertices, &owned.faces).unwrap();
        let tree = MeshTree::new(&mesh);
        let surface = tree.on(&mesh).unwrap();
        let points: Vec<_> = (0..500)
            .map(|k| mesh.triangle(k % 7).a + random.vector(0.1))
            .collect();
        let records = cpu.nearest_faces(&surface, &points).unwrap();
        for (&point, record) in points.iter().zip(&records) {
            assert_eq!(*record, surface.nearest_face(point), "{point}");
        }
    }
}

#[test]
fn signs_of_batches_are_those_of_single_queries() {
    let (cpu, mut random) = (Cpu::new(), Random(0xba7c_5eed_0000_0002));
    for owned in all().into_iter().filter(|owned| owned.is_closed) {
        let vertices: Vec<Vec3<f32>> = owned
            .vertices
            .iter()
            .map(|v| Vec3::new(v.x as f32, v.y as f32, v.z as f32))
            .collect();
        let mesh = Mesh::new(&vertices, &owned.faces).unwrap();
        let (tree, closed) = (MeshTree::new(&mesh), ClosedMesh::new(&mesh).unwrap());
        let surface = tree.on(&mesh).unwrap();
        let points: Vec<_> = queries(&owned, &mut random, 200)
            .into_iter()
            .map(|v| Vec3::new(v.x as f32, v.y as f32, v.z as f32))
            .collect();
        let records = cpu.nearest_faces(&surface, &points).unwrap();
        let kind = MeshDistance::Signed(&closed);
        let found = cpu.mesh_distances(kind, &surface, &points, &records);
        for (&point, found) in points.iter().zip(found.unwrap()) {
            let expected = surface.signed_distance(&closed, point);
            assert_eq!(
                found.to_bits(),
                expected.to_bits(),
                "{} {point}",
                owned.name
            );
        }
    }
}

#[test]
fn threads_change_no_bit() {
    let mut random = Random(0xba7c_5eed_0000_0003);
    let owned = bumpy_sphere(4);
    let mesh = owned.mesh();
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).unwrap();
    // Some thousand in one cell of the curve, and most vertices with many of them.
    let points: Vec<_> = (0..20_000)
        .map(|k| random.vector(if k % 3 == 0 { 1e-4 } else { 2.0 }))
        .collect();
    let upstream: Vec<_> = points.iter().map(|_| random.vector(1.0)).collect();
    let run = |threads: usize| {
        with_threads(threads, || {
            let cpu = Cpu::new();
            let records = cpu.nearest_faces(&surface, &points).unwrap();
            let bars = cpu.closest_points_vjp(&surface, &points, &records, &upstream);
            (records, bars.unwrap())
        })
    };
    let (records, bars) = run(1);
    for threads in [2, 5] {
        let (again, bars_again) = run(threads);
        assert!(records == again, "{threads} threads");
        let all = bars.vertices.iter().zip(&bars_again.vertices);
        let mut all = all.chain(bars.queries.iter().zip(&bars_again.queries));
        assert!(all.all(|(a, b)| bits(*a) == bits(*b)), "{threads} threads");
    }
    // Sums over queries: each vertex has the part of its own faces.
    let total = bars
        .vertices
        .iter()
        .fold(Vec3::zero(), |sum, &bar| sum + bar);
    let points = bars
        .queries
        .iter()
        .fold(Vec3::zero(), |sum, &bar| sum + bar);
    let upstream = upstream.iter().fold(Vec3::zero(), |sum, &bar| sum + bar);
    // A move of everything moves closest points with it.
    assert!((total + points - upstream).length() < 1e-9);
}

#[test]
fn faults_name_the_query() {
    let cpu = Cpu::new();
    let owned = cube();
    let mesh = owned.mesh();
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).unwrap();
    let mut points = vec![Vec3::new(0.1, 0.2, 3.0); 5];
    assert_eq!(cpu.nearest_faces(&surface, &points[..0]).unwrap(), []);
    let records = cpu.nearest_faces(&surface, &points).unwrap();
    let error = cpu
        .closest_points(&surface, &points[1..], &records)
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "`records` has 5 items where 4 are needed"
    );
    let mut wrong = records.clone();
    for feature in [
        FaceFeature::Vertex { corner: 3 },
        FaceFeature::Edge { from: 0, to: 7 },
    ] {
        wrong[2] = FaceRecord { face: 11, feature };
        let error = cpu.closest_points(&surface, &points, &wrong).unwrap_err();
        assert!(matches!(error, Error::Invalid { item: 2, .. }), "{error}");
    }
    wrong[2] = FaceRecord {
        face: 12,
        ..records[2]
    };
    let plain = MeshDistance::Plain;
    let error = cpu
        .mesh_distances_vjp(plain, &surface, &points, &wrong, &[1.0; 5])
        .unwrap_err();
    let said = "`records` item 2: value is not a feature of a face of the mesh";
    assert_eq!(error.to_string(), said);
    let error = cpu
        .mesh_distances_vjp(
            plain,
            &surface,
            &points,
            &records,
            &[1.0, f64::NAN, 1.0, 1.0, 1.0],
        )
        .unwrap_err();
    let upstream = Argument::Upstream;
    assert!(
        matches!(error, Error::Invalid { argument, item: 1, .. } if argument == upstream),
        "{error}"
    );
    points[3].y = f64::NAN;
    let error = cpu.nearest_faces(&surface, &points).unwrap_err();
    assert!(matches!(error, Error::Invalid { item: 3, .. }), "{error}");
    let rays = [Ray3::new(points[0], Vec3::new(0.0, 0.0, -1.0))];
    let error = cpu.first_hits(&surface, &rays, &[Some(12)]).unwrap_err();
    assert!(matches!(error, Error::Invalid { item: 0, .. }), "{error}");
}

//! Winding numbers against the sum over all faces, their derivatives against those of that sum and of differences.
use super::mesh_shapes::{Owned, all, bumpy_sphere, cube, queries, tetrahedron};
use crate::space::draw::Random;
use geograd::kernels::Cpu;
use geograd::kernels::cpu::mesh_batches::{MeshBars, MeshDistance};
use geograd::mesh::{ClosedMesh, Mesh, MeshBorder, MeshFault, MeshTree, WoundSurface, solid_angle};
use geograd::{Jet, Scalar, Triangle3, Vec3, hessian};
use geograd_tests::with_threads;
use std::f64::consts::PI;

/// A mesh, its tree and its border.
struct Wound<'a>(Mesh<'a, f64>, MeshTree, MeshBorder);

impl<'a> Wound<'a> {
    fn new(vertices: &'a [Vec3<f64>], faces: &'a [[u32; 3]]) -> Self {
        let mesh = Mesh::new(vertices, faces).unwrap();
        Wound(mesh, MeshTree::new(&mesh), MeshBorder::new(&mesh))
    }
    fn of(&self) -> WoundSurface<'_, f64> {
        self.2.of(&self.1.on(&self.0).unwrap()).unwrap()
    }
}

/// The sum over all faces, for numbers of any kind.
fn brute<S: Scalar<Mask = bool>>(vertices: &[Vec3<S>], faces: &[[u32; 3]], point: Vec3<S>) -> S {
    let mut sum = S::zero();
    for face in faces {
        let [a, b, c] = face.map(|i| vertices[i as usize]);
        sum += solid_angle(point, Triangle3 { a, b, c });
    }
    sum * S::lit(0.25 / PI)
}

/// The solid angle by l'Huilier's theorem, without its sign.
fn by_sides(point: Vec3<f64>, t: Triangle3<f64>) -> f64 {
    let [a, b, c] = t
        .corners()
        .map(|corner| (corner - point).normalize_or_zero());
    let side = |p: Vec3<f64>, q: Vec3<f64>| 2.0 * (0.5 * (p - q).length()).min(1.0).asin();
    let (x, y, z) = (side(b, c), side(c, a), side(a, b));
    let s = 0.5 * (x + y + z);
    let product =
        (0.5 * s).tan() * (0.5 * (s - x)).tan() * (0.5 * (s - y)).tan() * (0.5 * (s - z)).tan();
    4.0 * product.max(0.0).sqrt().atan()
}

#[test]
fn solid_angles_are_those_of_spherical_triangles() {
    let mut random = Random(0x0a11_5eed_0000_0001);
    for _ in 0..2000 {
        let [a, b, c, point] = [0; 4].map(|_| random.vector(1.0));
        let t = Triangle3 { a, b, c };
        let found = solid_angle(point, t);
        let is_behind = t.twice_area_normal().dot(a - point) > 0.0;
        assert_eq!(found > 0.0, is_behind);
        let expected = by_sides(point, t);
        assert!((found.abs() - expected).abs() < 1e-6, "{found} {expected}");
    }
}

/// The distance of a point from the edges of all faces.
fn from_edges(wound: &WoundSurface<'_, f64>, point: Vec3<f64>) -> f64 {
    let mesh = wound.surface().mesh();
    let mut least = f64::INFINITY;
    for [i, j] in mesh
        .faces()
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
    {
        let [p, q] = [i, j].map(|i| mesh.vertices()[i as usize]);
        let share = (point - p).dot(q - p) / (q - p).length_squared().max(1e-300);
        least = least.min((p.lerp(q, share.clamp(0.0, 1.0)) - point).length());
    }
    least
}

#[test]
fn numbers_are_the_sums_over_all_faces() {
    if !geograd_tests::is_due("numbers_are_the_sums_over_all_faces") {
        return;
    }
    let mut random = Random(0x0a11_5eed_0000_0002);
    let (mut on_faces, mut close) = (0, 0);
    for owned in all() {
        let own = Wound::new(&owned.vertices, &owned.faces);
        let wound = own.of();
        assert_eq!(wound.border().edges().is_empty(), owned.is_closed);
        let count = if owned.faces.len() > 1000 { 100 } else { 400 };
        for point in queries(&owned, &mut random, count) {
            let found = wound.winding_number(point);
            let expected = brute(&owned.vertices, &owned.faces, point);
            let apart = from_edges(&wound, point);
            on_faces += usize::from(wound.surface().distance(point) == 0.0);
            // Near an edge the parts of both faces turn with the direction to it, which roundings move.
            // Sums over slivers lose digits beside them, too.
            let near = if owned.name == "slivers" { 1e-4 } else { 1e-12 };
            let most = near + 1e-14 / apart.max(1e-15);
            let error = (found - expected).abs();
            close += usize::from(most < 1e-9);
            assert!(error < most, "{}: {point} {found} {expected}", owned.name);
        }
    }
    assert!(on_faces > 100 && close > 3000, "{on_faces} {close}");
}

/// Faces at random on a grid: points and borders in one line along all axes, faces seen edge-on, repeated, crossing.
#[test]
fn numbers_on_a_grid_are_the_sums_over_all_faces() {
    if !geograd_tests::is_due("numbers_on_a_grid_are_the_sums_over_all_faces") {
        return;
    }
    let mut random = Random(0x0a11_5eed_0000_0003);
    let mut on_faces = 0;
    for _ in 0..3000 {
        let mut place = |scale: f64| {
            let [x, y, z] = [0; 3].map(|_| scale * (random.below(5) as f64 - 2.0));
            Vec3::new(x, y, z)
        };
        let vertices = [0; 6].map(|_| place(1.0));
        let points = [0; 10].map(|_| place(0.5));
        let count = 1 + random.below(8);
        let face = |_: usize| [0; 3].map(|_| random.below(6) as u32);
        let faces: Vec<[u32; 3]> = (0..count).map(face).collect();
        let own = Wound::new(&vertices, &faces);
        let wound = own.of();
        for point in points {
            let found = wound.winding_number(point);
            let expected = brute(&vertices, &faces, point);
            on_faces += usize::from(wound.surface().distance(point) == 0.0);
            let context = format!("{vertices:?} {faces:?} {point}");
            assert!(
                (found - expected).abs() < 1e-12,
                "{found} {expected}: {context}"
            );
        }
    }
    assert!(on_faces > 500, "{on_faces}");
}

#[test]
fn closed_meshes_have_whole_numbers_and_shares_on_the_surface() {
    let owned = cube();
    let own = Wound::new(&owned.vertices, &owned.faces);
    let wound = own.of();
    let at = |x: f64, y: f64, z: f64| wound.winding_number(Vec3::new(x, y, z));
    assert_eq!(
        [
            at(0.5, 0.25, 0.75),
            at(1e-12, 0.5, 0.5),
            at(-1e-12, 0.5, 0.5)
        ],
        [1.0, 1.0, 0.0]
    );
    for (found, share) in [
        (at(0.0, 0.5, 0.5), 0.5),
        (at(0.5, 0.0, 0.5), 0.5),
        (at(0.0, 0.0, 0.5), 0.25),
        (at(1.0, 1.0, 1.0), 0.125),
    ] {
        assert!((found - share).abs() < 1e-15, "{found} {share}");
    }
    assert!(at(f64::NAN, 0.0, 0.0).is_nan());
    let bars = Cpu::new()
        .winding_numbers_vjp(&wound, &[Vec3::new(0.5, 0.5, 0.9)], &[1.0])
        .unwrap();
    assert!(
        bars.queries[0] == Vec3::zero() && bars.vertices.iter().all(|&bar| bar == Vec3::zero())
    );
}

/// Faces of a bumpy sphere without some of them.
fn holed() -> Owned {
    let mut owned = bumpy_sphere(2);
    let mut k = 0;
    owned.faces.retain(|_| {
        k += 1;
        k % 11 != 0
    });
    owned
}

#[test]
fn derivatives_up_to_the_second_are_those_of_all_faces() {
    if !geograd_tests::is_due("derivatives_up_to_the_second_are_those_of_all_faces") {
        return;
    }
    let (owned, mut random) = (holed(), Random(0x0a11_5eed_0000_0004));
    let border = MeshBorder::new(&owned.mesh());
    for _ in 0..20 {
        let point = random.vector(1.5);
        let lifted = |point: Vec3<Second>| {
            let vertices: Vec<Vec3<Second>> =
                owned.vertices.iter().map(geograd::Pack::lift).collect();
            let mesh = Mesh::new(&vertices, &owned.faces).unwrap();
            let tree = MeshTree::new(&mesh);
            let surface = tree.on(&mesh).unwrap();
            let own = border.of(&surface).unwrap().winding_number(point);
            (own, brute(&vertices, &owned.faces, point))
        };
        let (value, gradient, curvature) = hessian(|p| lifted(p).0, point);
        let (other, slopes, bend) = hessian(|p| lifted(p).1, point);
        assert!((value - other).abs() < 1e-12);
        let size = 1.0 + slopes.length() + bend.x.length() + bend.y.length() + bend.z.length();
        assert!(
            (gradient - slopes).length() < 1e-9 * size,
            "{gradient} {slopes}"
        );
        for (found, expected) in [
            (curvature.x, bend.x),
            (curvature.y, bend.y),
            (curvature.z, bend.z),
        ] {
            assert!(
                (found - expected).length() < 1e-9 * size,
                "{found} {expected}"
            );
        }
    }
}

#[test]
fn derivatives_along_moves_of_vertices_are_those_of_all_faces() {
    let (owned, mut random) = (holed(), Random(0x0a11_5eed_0000_0008));
    let border = MeshBorder::new(&owned.mesh());
    let mut moving = |v: Vec3<f64>| {
        let way = random.vector(1.0);
        let [x, y, z] = [(v.x, way.x), (v.y, way.y), (v.z, way.z)].map(|(value, slope)| Jet {
            value,
            derivative: [slope],
        });
        Vec3::new(x, y, z)
    };
    let vertices: Vec<_> = owned.vertices.iter().map(|&v| moving(v)).collect();
    let mesh = Mesh::new(&vertices, &owned.faces).unwrap();
    let tree = MeshTree::new(&mesh);
    let surface = tree.on(&mesh).unwrap();
    let wound = border.of(&surface).unwrap();
    for k in 0..20 {
        let point = moving(Vec3::new(0.1 * f64::from(k) - 1.0, 0.3, 0.2));
        let found = wound.winding_number(point).derivative[0];
        let expected = brute(&vertices, &owned.faces, point).derivative[0];
        let size = 1.0 + expected.abs();
        assert!((found - expected).abs() < 1e-9 * size, "{found} {expected}");
    }
}

type Second = Jet<Jet<f64, 5>, 5>;

fn bars_of(
    wound: &WoundSurface<'_, f64>,
    points: &[Vec3<f64>],
    by: &[f64],
) -> MeshBars<Vec3<f64>, f64> {
    Cpu::new().winding_numbers_vjp(wound, points, by).unwrap()
}

#[test]
fn cotangents_are_those_of_differences() {
    if !geograd_tests::is_due("cotangents_are_those_of_differences") {
        return;
    }
    let mut random = Random(0x0a11_5eed_0000_0005);
    for owned in all()
        .into_iter()
        .chain([holed()])
        .filter(|owned| owned.name != "slivers")
    {
        let own = Wound::new(&owned.vertices, &owned.faces);
        let wound = own.of();
        let points: Vec<_> = (0..200)
            .map(|_| random.vector(2.0))
            .filter(|&p| wound.surface().distance(p) > 0.05)
            .collect();
        let by: Vec<_> = points.iter().map(|_| random.within(-1.0, 1.0)).collect();
        let bars = bars_of(&wound, &points, &by);
        let ways: Vec<_> = owned.vertices.iter().map(|_| random.vector(1.0)).collect();
        let moves: Vec<_> = points.iter().map(|_| random.vector(1.0)).collect();
        let dot = |a: &[Vec3<f64>], b: &[Vec3<f64>]| -> f64 {
            a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
        };
        let side = |step: f64| -> f64 {
            let moved = |all: &[Vec3<f64>], ways: &[Vec3<f64>]| -> Vec<_> {
                all.iter().zip(ways).map(|(&v, &w)| v + w * step).collect()
            };
            let (vertices, points) = (moved(&owned.vertices, &ways), moved(&points, &moves));
            points
                .iter()
                .zip(&by)
                .map(|(&p, by)| by * brute(&vertices, &owned.faces, p))
                .sum()
        };
        let step = 1e-5;
        let slope = dot(&bars.vertices, &ways) + dot(&bars.queries, &moves);
        let difference = (side(step) - side(-step)) / (2.0 * step);
        assert!(
            (slope - difference).abs() < 1e-6 * (1.0 + slope.abs()),
            "{}: {slope} {difference}",
            owned.name
        );
        assert!(
            owned.is_closed
                || bars.vertices.iter().any(|bar| bar.length() > 1e-3)
                || owned.name == "repeated vertices"
        );
    }
}

#[test]
fn batches_have_the_bits_of_one_point_and_of_any_threads() {
    if !geograd_tests::is_due("batches_have_the_bits_of_one_point_and_of_any_threads") {
        return;
    }
    let (owned, mut random) = (holed(), Random(0x0a11_5eed_0000_0006));
    let own = Wound::new(&owned.vertices, &owned.faces);
    let wound = own.of();
    let points: Vec<_> = (0..3000).map(|_| random.vector(1.5)).collect();
    let by: Vec<_> = points.iter().map(|_| random.within(-1.0, 1.0)).collect();
    let run = |threads: usize| {
        with_threads(threads, || {
            (
                Cpu::new().winding_numbers(&wound, &points).unwrap(),
                bars_of(&wound, &points, &by),
            )
        })
    };
    let (values, bars) = run(1);
    for (value, &point) in values.iter().zip(&points) {
        assert_eq!(value.to_bits(), wound.winding_number(point).to_bits());
    }
    for threads in [2, 5] {
        let (again, bars_again) = run(threads);
        assert!(
            again
                .iter()
                .zip(&values)
                .all(|(a, b)| a.to_bits() == b.to_bits())
        );
        let mut all = bars
            .vertices
            .iter()
            .zip(&bars_again.vertices)
            .chain(bars.queries.iter().zip(&bars_again.queries));
        assert!(all.all(|(a, b)| [a.x, a.y, a.z].map(f64::to_bits) == [b.x, b.y, b.z].map(f64::to_bits)));
    }
}

#[test]
fn signs_by_winding_are_those_of_closed_meshes_and_extend_to_open_ones() {
    let (cpu, mut random) = (Cpu::new(), Random(0x0a11_5eed_0000_0007));
    let (full, owned) = (bumpy_sphere(2), holed());
    let closed = Wound::new(&full.vertices, &full.faces);
    let open = Wound::new(&owned.vertices, &owned.faces);
    let by_normals = ClosedMesh::new(&closed.0).unwrap();
    let points: Vec<_> = (0..500).map(|_| random.vector(1.5)).collect();
    for own in [&closed, &open] {
        let wound = own.of();
        let surface = wound.surface();
        let records = cpu.nearest_faces(surface, &points).unwrap();
        let kind = MeshDistance::Wound(&own.2);
        let found = cpu
            .mesh_distances(kind, surface, &points, &records)
            .unwrap();
        let bars = cpu
            .mesh_distances_vjp(kind, surface, &points, &records, &vec![1.0; 500])
            .unwrap();
        for (k, &point) in points.iter().enumerate() {
            assert_eq!(found[k].to_bits(), wound.signed_distance(point).to_bits());
            let expected = closed.of().surface().signed_distance(&by_normals, point);
            if own.2.edges().is_empty() {
                assert!((found[k] - expected).abs() < 1e-12);
            } else if expected.abs() > 0.3 {
                // Holes are smaller than that.
                assert_eq!(found[k] < 0.0, expected < 0.0, "{point}");
            }
            let step = bars.queries[k] * (1e-6 / bars.queries[k].length().max(0.5));
            let rise = wound.signed_distance(point + step) - found[k];
            // Nearer than that, and at the medial axis, a step changes the face.
            let is_smooth = found[k].abs() > 0.1 && own.2.edges().is_empty();
            assert!(!is_smooth || (rise - 1e-6).abs() < 1e-8, "{point} {rise}");
        }
    }
    let other = MeshBorder::new(&tetrahedron().mesh());
    let wound = closed.of();
    let error = other.of(wound.surface()).unwrap_err();
    assert!(matches!(
        error,
        MeshFault::OtherBorder { found: [4, 4], .. }
    ));
    assert!(
        error
            .to_string()
            .starts_with("the border is of 4 vertices and 4 faces")
    );
    let records = cpu.nearest_faces(wound.surface(), &points).unwrap();
    let error = cpu
        .mesh_distances(
            MeshDistance::Wound(&other),
            wound.surface(),
            &points,
            &records,
        )
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "`border` item 0: value is of another mesh"
    );
}

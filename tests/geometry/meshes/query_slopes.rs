//! Derivatives of queries by the point and by the vertices, against differences of the whole query.
use super::mesh_shapes::{Owned, all, queries};
use crate::space::draw::Random;
use geograd::mesh::{ClosedMesh, Mesh, MeshTree};
use geograd::{Jet, Ray3, Scalar, Vec3, hessian};

type Along = Jet<f64, 1>;

/// A vector that moves along another one.
fn moving(v: Vec3<f64>, along: Vec3<f64>) -> Vec3<Along> {
    let jet = |value: f64, slope: f64| Jet {
        value,
        derivative: [slope],
    };
    Vec3::new(jet(v.x, along.x), jet(v.y, along.y), jet(v.z, along.z))
}

/// The derivative of a query along a move of the point and all vertices, by duals and from both sides by differences.
fn slopes(
    owned: &Owned,
    ways: &[Vec3<f64>],
    query: impl Fn(&Mesh<'_, Along>, &MeshTree) -> Along,
    plain: impl Fn(&Mesh<'_, f64>, &MeshTree, f64) -> f64,
) -> (f64, [f64; 2]) {
    let mesh = owned.mesh();
    let tree = MeshTree::new(&mesh);
    let jets: Vec<_> = owned
        .vertices
        .iter()
        .zip(ways)
        .map(|(&v, &w)| moving(v, w))
        .collect();
    let by_duals = query(&Mesh::new(&jets, &owned.faces).unwrap(), &tree).derivative[0];
    let here = plain(&mesh, &tree, 0.0);
    let side = |step: f64| {
        let moved: Vec<_> = owned
            .vertices
            .iter()
            .zip(ways)
            .map(|(&v, &w)| v + w * step)
            .collect();
        let mesh = Mesh::new(&moved, &owned.faces).unwrap();
        (plain(&mesh, &MeshTree::new(&mesh), step) - here) / step
    };
    (by_duals, [side(1e-6), side(-1e-6)])
}

/// A slope between those of both sides. Differences of a distance from an edge err by the step over the distance.
fn is_between_near(distance: f64, slope: f64, sides: [f64; 2]) -> bool {
    let [low, high] = [sides[0].min(sides[1]), sides[0].max(sides[1])];
    let bend = if distance > 0.0 { 6e-6 / distance } else { 0.0 };
    let room = 2e-5 * (1.0 + slope.abs()) + bend;
    low - room <= slope && slope <= high + room
}

fn is_between(slope: f64, sides: [f64; 2]) -> bool {
    is_between_near(f64::INFINITY, slope, sides)
}

#[test]
fn distances_have_the_slopes_of_differences() {
    if !geograd_tests::is_due("distances_have_the_slopes_of_differences") {
        return;
    }
    let mut random = Random(0xfeed_5eed_0000_0001);
    let mut judged = 0;
    for owned in all() {
        // Slivers change their form within a step.
        if ["slivers", "without area"].contains(&owned.name) {
            continue;
        }
        let closed = ClosedMesh::new(&owned.mesh()).ok();
        let ways: Vec<_> = owned.vertices.iter().map(|_| random.vector(1.0)).collect();
        let count = if owned.faces.len() > 1000 { 4 } else { 60 };
        for p in queries(&owned, &mut random, count) {
            let way = random.vector(1.0);
            // A difference of a curved distance errs by the step over the distance; near an edge it is no limit.
            let own = owned.mesh();
            let distance = MeshTree::new(&own).on(&own).unwrap().distance(p);
            if distance > 0.0 && distance < 1e-4 {
                continue;
            }
            let near = |mesh: &Mesh<'_, f64>, tree: &MeshTree, step: f64| {
                tree.on(mesh).unwrap().distance(p + way * step)
            };
            let (slope, sides) = slopes(
                &owned,
                &ways,
                |mesh, tree| tree.on(mesh).unwrap().distance(moving(p, way)),
                near,
            );
            assert!(
                is_between_near(distance, slope, sides),
                "{}: {p}: {slope} {sides:?}",
                owned.name
            );
            let (slope, sides) = slopes(
                &owned,
                &ways,
                |mesh, tree| tree.on(mesh).unwrap().squared_distance(moving(p, way)),
                |mesh, tree, step| tree.on(mesh).unwrap().squared_distance(p + way * step),
            );
            let scale = 1.0 + 10.0 * p.length_squared();
            assert!(
                is_between(slope / scale, sides.map(|x| x / scale)),
                "{}: {p}",
                owned.name
            );
            if let Some(closed) = &closed {
                let (slope, sides) = slopes(
                    &owned,
                    &ways,
                    |mesh, tree| {
                        tree.on(mesh)
                            .unwrap()
                            .signed_distance(closed, moving(p, way))
                    },
                    |mesh, tree, step| {
                        tree.on(mesh)
                            .unwrap()
                            .signed_distance(closed, p + way * step)
                    },
                );
                assert!(
                    is_between_near(distance, slope, sides),
                    "{}: {p}: {slope} {sides:?}",
                    owned.name
                );
            }
            judged += 1;
        }
    }
    assert!(judged > 400, "{judged}");
}

/// A signed distance is smooth through a face: the derivative on it is the normal.
#[test]
fn signed_distances_on_a_face_have_the_normal_as_slope() {
    let owned = super::mesh_shapes::cube();
    let mesh = owned.mesh();
    let (tree, closed) = (MeshTree::new(&mesh), ClosedMesh::new(&mesh).unwrap());
    let at = Vec3::new(0.25, 0.5, 1.0);
    let lifted: Vec<_> = owned
        .vertices
        .iter()
        .map(geograd::Pack::lift::<Jet<f64, 3>>)
        .collect();
    let jets = Mesh::new(&lifted, &owned.faces).unwrap();
    let p = Vec3::new(
        Jet::variable(at.x, 0),
        Jet::variable(at.y, 1),
        Jet::variable(at.z, 2),
    );
    let signed = tree.on(&jets).unwrap().signed_distance(&closed, p);
    assert_eq!((signed.value, signed.derivative), (0.0, [0.0, 0.0, 1.0]));
}

#[test]
fn second_derivatives_over_an_edge_are_those_of_a_cylinder() {
    let owned = super::mesh_shapes::cube();
    let mesh = owned.mesh();
    let tree = MeshTree::new(&mesh);
    let at = Vec3::new(-0.6, 0.5, -0.8);
    let record = tree.on(&mesh).unwrap().nearest_face(at);
    let triangle = mesh.triangle(record.face);
    let (value, gradient, curvature) = hessian(
        |p: Vec3<_>| {
            let lifted = geograd::Pack::lift(&triangle);
            geograd::mesh::distance_replay(p, lifted, record.feature)
        },
        at,
    );
    assert!((value - 1.0).abs() < 1e-15);
    assert!(
        (gradient.x + 0.6).abs() < 1e-15 && gradient.y == 0.0 && (gradient.z + 0.8).abs() < 1e-15
    );
    assert!((curvature.x.x - 0.64).abs() < 1e-15 && (curvature.x.z + 0.48).abs() < 1e-15);
    assert!(curvature.y.y.abs() < 1e-15);
}

#[test]
fn hits_have_the_slopes_of_differences() {
    if !geograd_tests::is_due("hits_have_the_slopes_of_differences") {
        return;
    }
    let mut random = Random(0xabcd_ef01_2345_6789);
    let mut judged = 0;
    for owned in all() {
        if ["slivers", "without area"].contains(&owned.name) {
            continue;
        }
        let ways: Vec<_> = owned.vertices.iter().map(|_| random.vector(1.0)).collect();
        for _ in 0..(if owned.faces.len() > 1000 { 5 } else { 40 }) {
            let face = random.below(owned.faces.len()) as u32;
            let t = owned.mesh().triangle(face);
            let target =
                t.a + (t.b - t.a) * random.within(0.2, 0.4) + (t.c - t.a) * random.within(0.2, 0.4);
            let from = target + t.normal() + random.vector(0.3);
            let (way, turn) = (random.vector(1.0), random.vector(1.0));
            let parameter =
                |x: Option<geograd::mesh::MeshHit<f64>>| x.map_or(0.0, |x| x.hit.parameter);
            let (slope, sides) = slopes(
                &owned,
                &ways,
                |mesh, tree| {
                    let ray = Ray3::new(moving(from, way), moving(target - from, turn));
                    tree.on(mesh)
                        .unwrap()
                        .first_hit(ray)
                        .map_or(Along::zero(), |x| x.hit.parameter)
                },
                |mesh, tree, step| {
                    let ray = Ray3::new(from + way * step, target - from + turn * step);
                    parameter(tree.on(mesh).unwrap().first_hit(ray))
                },
            );
            assert!(
                is_between(slope, sides),
                "{}: {from} {target}: {slope} {sides:?}",
                owned.name
            );
            judged += 1;
        }
    }
    assert!(judged > 200, "{judged}");
}

//! Faces of convex hulls of points, their measures and the derivatives of these, and membership.
use super::draw::Random;
use super::hull_draw::{FAMILIES, pair};
use geograd::ad::gradient;
use geograd::hull3::hull_search;
use geograd::prelude::*;
use geograd::{Flaw, Validate, VertexFault};

fn points(random: &mut Random, count: usize) -> Vec<Vec3<f64>> {
    (0..count).map(|_| random.vector(1.0)).collect()
}

#[test]
fn faces_are_planes_with_all_points_behind() {
    let mut random = Random(0x2468_ace0_1357_9bdf);
    for count in [4, 5, 8, 20, 200, 2000] {
        let all = points(&mut random, count);
        let hull = hull_search(&all);
        assert_eq!(hull.dimension(), 3);
        let mut sides = std::collections::HashMap::new();
        for face in hull.faces() {
            let [a, b, c] = [face[0], face[1], face[2]].map(|k| all[k]);
            let normal = (b - a).cross(c - a);
            assert!(all.iter().all(|&p| normal.dot(p - a) < 1e-14));
            for (k, &from) in face.iter().enumerate() {
                *sides.entry((from, face[(k + 1) % face.len()])).or_insert(0) += 1;
            }
        }
        // Every edge has two faces, which run along it in opposite directions.
        assert!(
            sides
                .iter()
                .all(|(&(from, to), &n)| n == 1 && sides.contains_key(&(to, from)))
        );
        // Euler's formula.
        assert_eq!(
            hull.corners().len() + hull.faces().count(),
            sides.len() / 2 + 2
        );
    }
}

#[test]
fn points_that_are_no_corners_change_nothing() {
    let mut random = Random(0x1122_3344_5566_7788);
    for _ in 0..100 {
        let mut all = points(&mut random, 6);
        let plain = hull_search(&all);
        let known = (
            plain.volume(&all),
            plain.surface(&all),
            plain.centroid(&all),
        );
        // Halves of sums are on edges exactly, or inside.
        let grid: Vec<Vec3<f64>> = all
            .iter()
            .map(|v| Vec3::new(v.x.round(), v.y.round(), v.z.round()))
            .collect();
        let corners = hull_search(&grid).corners().len();
        let mut more = grid.clone();
        more.extend(grid.iter().zip(&grid[1..]).map(|(&p, &q)| (p + q) * 0.5));
        more.extend(&grid);
        assert_eq!(hull_search(&more).corners().len(), corners);
        all.extend((0..4).map(|k| all[k]).collect::<Vec<_>>());
        let last = (all[0] + all[1] + all[2] + all[3]) * 0.25;
        all.push(last);
        let hull = hull_search(&all);
        assert_eq!(hull.corners(), plain.corners());
        assert_eq!(
            (hull.volume(&all), hull.surface(&all), hull.centroid(&all)),
            known
        );
    }
}

#[test]
fn measures_of_known_solids() {
    let cube = Hull3::from(Obb3::new(
        Vec3::new(1.0, 2.0, 3.0),
        Vec3::new(2.0, 4.0, 0.5),
        Rotation3::identity(),
    ));
    assert!((cube.volume() - 4.0).abs() < 1e-14 && (cube.surface() - 22.0).abs() < 1e-14);
    assert!((cube.center() - Vec3::new(1.0, 2.0, 3.0)).length() < 1e-15);
    assert_eq!(
        cube.faces().faces().map(<[usize]>::len).collect::<Vec<_>>(),
        [4; 6]
    );
    let [x, y] = [Vec3::new(3.0, 0.0, 1.0), Vec3::new(0.0, 3.0, 1.0)];
    let flat: Hull3<f64, 8> = Hull3::from_vertices(&[Vec3::zero(), x, y, (x + y) * 0.25]);
    assert_eq!((flat.volume(), flat.faces().dimension()), (0.0, 2));
    assert!((flat.surface() - x.cross(y).length()).abs() < 1e-14);
    assert!((flat.center() - (x + y) * (1.0 / 3.0)).length() < 1e-15);
    let line: Hull3<f64, 8> = Hull3::from_vertices(&[x * 0.5, x, Vec3::zero()]);
    assert_eq!(
        (line.surface(), line.center(), line.faces().corners()),
        (0.0, x * 0.5, &[1, 2][..])
    );
    let place: Hull3<f64, 8> = Hull3::from_vertices(&[y, y]);
    assert_eq!((place.center(), place.faces().corners()), (y, &[0][..]));
}

#[test]
fn derivatives_of_measures_are_those_of_differences() {
    let mut random = Random(0x99aa_bbcc_ddee_ff00);
    for _ in 0..40 {
        let hull: Hull3<f64, 8> = Hull3::from_vertices(&points(&mut random, 8));
        let along = points(&mut random, 8);
        let at = |step: f64| Hull3 {
            vertices: std::array::from_fn(|k| hull.vertices[k] + along[k] * step),
            ..hull
        };
        let check = |value: &dyn Fn(Hull3<f64, 8>) -> f64, slope: Hull3<f64, 8>| {
            let difference = (value(at(1e-6)) - value(at(-1e-6))) / 2e-6;
            let found: f64 = slope
                .vertices
                .iter()
                .zip(&along)
                .map(|(g, &d)| g.dot(d))
                .sum();
            assert!(
                (found - difference).abs() < 1e-7,
                "{found} {difference} {hull:?}"
            );
        };
        check(
            &|hull| hull.volume(),
            gradient(|hull: Hull3<_, 8>| hull.volume(), hull).1,
        );
        check(
            &|hull| hull.surface(),
            gradient(|hull: Hull3<_, 8>| hull.surface(), hull).1,
        );
        check(
            &|hull| hull.center().y,
            gradient(|hull: Hull3<_, 8>| hull.center().y, hull).1,
        );
    }
}

#[test]
fn a_hull_contains_its_vertices_and_what_is_between_them() {
    let mut random = Random(0x0f1e_2d3c_4b5a_6978);
    for family in 0..FAMILIES.len() {
        for _ in 0..40 {
            let [a, _] = pair(&mut random, family);
            let vertices: Vec<_> = a.iter().map(|&[x, y, z]| Vec3::new(x, y, z)).collect();
            let hull: Hull3<f64, 8> = Hull3::from_vertices(&vertices);
            assert!(vertices.iter().all(|&v| hull.contains(v)), "{hull:?}");
            let bounds = hull.bounding();
            let beyond = 1e-9 * (bounds.max.length() + bounds.min.length()) + f64::MIN_POSITIVE;
            assert!(
                !hull.contains(bounds.max + Vec3::new(beyond, 0.0, 0.0)),
                "{hull:?}"
            );
            let way = random.vector(1.0);
            let most = hull.support(way);
            let highest = vertices
                .iter()
                .map(|v| way.dot(*v - most))
                .fold(f64::NEG_INFINITY, f64::max);
            assert!(
                highest <= 1e-15 * (bounds.size().length() + most.length()),
                "{hull:?}"
            );
        }
    }
}

#[test]
fn a_hull_says_which_vertex_is_at_fault() {
    let fault = |hull: Result<Hull3<f64, 2>, Flaw>| match hull.unwrap_err() {
        Flaw::Vertex { index, fault } => (index, fault),
        other => panic!("{other}"),
    };
    let nowhere = Vec3::new(0.0, f64::NAN, 0.0);
    assert_eq!(fault(Hull3::try_new(&[])), (0, VertexFault::Missing));
    assert_eq!(
        fault(Hull3::try_new(&[Vec3::zero(); 3])),
        (2, VertexFault::Overfull)
    );
    assert_eq!(
        fault(Hull3::try_new(&[Vec3::zero(), nowhere])),
        (1, VertexFault::NotFinite)
    );
    let behind: Hull3<f64, 2> = Hull3 {
        vertices: [Vec3::zero(), nowhere],
        count: 1,
    };
    assert!(behind.validate().is_ok());
}

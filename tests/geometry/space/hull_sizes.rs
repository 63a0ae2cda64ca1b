//! Distances of hulls of twelve and of thirty-two corners.
use super::draw::Random;
use super::hull_oracle::{Point, signed, size};
use geograd::distance3::{closest_points, penetration, signed_distance};
use geograd::prelude::*;

/// Corners of a kind: on a sphere, on a grid, of a prism of many sides, in a cube.
fn body(random: &mut Random, count: usize) -> Vec<Vec3<f64>> {
    let corner = |v: Vec3<f64>| v * (1.0 / v.length());
    match random.below(4) {
        0 => (0..count).map(|_| corner(random.vector(1.0))).collect(),
        1 => {
            let mut one = || random.below(5) as f64 * 0.5 - 1.0;
            (0..count).map(|_| Vec3::new(one(), one(), one())).collect()
        }
        2 => {
            let (from, high) = (random.within(0.0, 6.0), random.within(0.2, 1.0));
            let angle =
                |k: usize| from + (k / 2) as f64 * std::f64::consts::TAU / (count / 2) as f64;
            let side = |k: usize| if k.is_multiple_of(2) { high } else { -high };
            let at = |k: usize| Vec3::new(angle(k).cos(), angle(k).sin(), side(k));
            (0..count).map(at).collect()
        }
        _ => (0..count).map(|_| random.vector(0.8)).collect(),
    }
}

/// Two bodies: apart or not, one on top of the other, or of the same place.
fn pair(random: &mut Random, count: usize) -> [Vec<Vec3<f64>>; 2] {
    let (a, mut b) = (body(random, count), body(random, count));
    let highest =
        |all: &[Vec3<f64>], side: f64| all.iter().map(|p| side * p.z).fold(f64::MIN, f64::max);
    let shift = match random.below(4) {
        0 => Vec3::zero(),
        1 => {
            let aside = random.vector(0.7);
            let gap = [0.0, 1e-9, -1e-9, 0.2, -0.2][random.below(5)];
            Vec3::new(aside.x, aside.y, highest(&a, 1.0) + highest(&b, -1.0) + gap)
        }
        _ => random.vector(1.8),
    };
    b.iter_mut().for_each(|p| *p += shift);
    [a, b]
}

fn points(all: &[Vec3<f64>]) -> Vec<Point> {
    all.iter().map(|p| [p.x, p.y, p.z]).collect()
}

/// The gap of two sets of points along a direction of length one.
fn gap(a: &[Vec3<f64>], b: &[Vec3<f64>], along: Vec3<f64>) -> f64 {
    let low = b.iter().map(|&p| along.dot(p)).fold(f64::MAX, f64::min);
    low - a.iter().map(|&p| along.dot(p)).fold(f64::MIN, f64::max)
}

/// The largest gap along the normals of planes through three corners, and of those along two edges.
fn best_gap(a: &[Vec3<f64>], b: &[Vec3<f64>], edges: [&[Vec3<f64>]; 2]) -> f64 {
    let mut normals = vec![];
    for all in [a, b] {
        for i in 0..all.len() {
            for j in 0..i {
                normals.extend((0..j).map(|k| (all[i] - all[k]).cross(all[j] - all[k])));
            }
        }
    }
    normals.extend(
        edges[0]
            .iter()
            .flat_map(|u| edges[1].iter().map(|v| u.cross(*v))),
    );
    let clear = normals.into_iter().filter(|n| n.length() > 1e-9);
    let units = clear.map(|n| n * (1.0 / n.length()));
    units.fold(f64::MIN, |most, n| {
        most.max(gap(a, b, n)).max(gap(a, b, -n))
    })
}

fn edges<const N: usize>(hull: &Hull3<f64, N>) -> Vec<Vec3<f64>> {
    let all = hull.faces();
    let along = |ring: &[usize]| -> Vec<Vec3<f64>> {
        let next = |k: usize| ring[(k + 1) % ring.len()];
        let side = |k: usize| hull.vertices[next(k)] - hull.vertices[ring[k]];
        (0..ring.len()).map(side).collect()
    };
    all.faces().flat_map(along).collect()
}

/// The normal proves that the hulls are no closer, the points that they are no farther apart.
fn proved<const N: usize>(a: &Hull3<f64, N>, b: &Hull3<f64, N>, found: f64) {
    let (out, points) = (penetration(*a, *b), closest_points(*a, *b));
    let way = points.on_b - points.on_a;
    if found.abs() > 1e-12 {
        let along = gap(&a.vertices, &b.vertices, out.direction);
        assert!((along - found).abs() < 1e-7, "{along} {found} {a:?} {b:?}");
        assert!(
            (way.dot(out.direction) - found).abs() < 1e-13,
            "{found} {a:?} {b:?}"
        );
    }
}

#[test]
fn hulls_of_twelve_corners_are_as_far_apart_as_the_oracle_says() {
    if !geograd_tests::is_due("hulls_of_twelve_corners_are_as_far_apart_as_the_oracle_says") {
        return;
    }
    let mut random = Random(0x1212_3456_789a_bcde);
    for _ in 0..80 {
        let [a, b] = pair(&mut random, 12);
        let (p, q) = (points(&a), points(&b));
        let (truth, unit) = (signed(&p, &q), size(&p, &q));
        let [a, b] = [a, b].map(|all| Hull3::<f64, 12>::try_new(&all).unwrap());
        let found = signed_distance(a, b);
        assert!(
            (found - truth).abs() < 1e-12 * unit,
            "{found} {truth} {a:?} {b:?}"
        );
        proved(&a, &b, found);
        let single = f64::from(signed_distance(a.cast::<f32>(), b.cast::<f32>()));
        assert!(
            (single - truth).abs() < 1e-6 * unit,
            "{single} {truth} {a:?} {b:?}"
        );
    }
}

#[test]
fn hulls_of_thirty_two_corners_have_the_best_gap_of_all_planes() {
    let mut random = Random(0x3232_3456_789a_bcde);
    for _ in 0..16 {
        let [a, b] = pair(&mut random, 32);
        let [p, q] = [&a, &b].map(|all| Hull3::<f64, 32>::try_new(all).unwrap());
        let found = signed_distance(p, q);
        let most = best_gap(&a, &b, [&edges(&p), &edges(&q)]);
        // Between hulls that are apart the best plane may be across the vector of two corners.
        assert!(found > most - 1e-12, "{found} {most} {p:?} {q:?}");
        if found < 0.0 {
            assert!((found - most).abs() < 1e-12, "{found} {most} {p:?} {q:?}");
        }
        proved(&p, &q, found);
        assert!((signed_distance(q, p) - found).abs() < 1e-12);
    }
}

//! Points and segments against polygons of any kind.
use super::any::Dice;
use geograd::distance::ring::{
    EdgeFold, Fill, distance_to_polyline, distance_to_ring, fold_ring, signed_distance_to_ring,
    winding_of_ring,
};
use geograd::distance::{edge_distance, edge_winding};
use geograd::intersection::{edge_inside, length_inside_ring};
use geograd::{Jet, Segment2, Vec2};

fn random_ring(dice: &mut Dice, n: usize, whole: bool) -> Vec<Vec2<f64>> {
    (0..n)
        .map(|_| {
            let mut number = || {
                if whole {
                    dice.whole(5) as f64 - 2.0
                } else {
                    dice.in_range(-2.0, 2.0)
                }
            };
            Vec2::new(number(), number())
        })
        .collect()
}

/// The winding number by adding up angles.
fn winding_by_angles(p: Vec2<f64>, ring: &[Vec2<f64>]) -> f64 {
    let n = ring.len();
    let turn: f64 = (0..n)
        .map(|i| {
            let (a, b) = (ring[i] - p, ring[(i + 1) % n] - p);
            (a.x * b.y - a.y * b.x).atan2(a.x * b.x + a.y * b.y)
        })
        .sum();
    (turn / std::f64::consts::TAU).round()
}

/// The distance by many samples of each edge, refined around the best.
fn distance_by_samples(p: Vec2<f64>, ring: &[Vec2<f64>]) -> f64 {
    let n = ring.len();
    let mut least = f64::INFINITY;
    for i in 0..n {
        let (a, b) = (ring[i], ring[(i + 1) % n]);
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..25 {
            let at = |t: f64| (a.x + (b.x - a.x) * t - p.x).hypot(a.y + (b.y - a.y) * t - p.y);
            let step = (high - low) / 10.0;
            let samples = (0..=10).map(|k| low + step * k as f64);
            let best = samples.min_by(|s, t| at(*s).total_cmp(&at(*t))).unwrap();
            least = least.min(at(best));
            (low, high) = ((best - step).max(0.0), (best + step).min(1.0));
        }
    }
    least
}

#[test]
fn values_are_those_of_angles_and_samples() {
    let mut dice = Dice(11);
    for _ in 0..3000 {
        let whole = dice.whole(2) == 0;
        let most = [9, 60][dice.whole(2) as usize];
        let n = 1 + dice.whole(most) as usize;
        let ring = random_ring(&mut dice, n, whole);
        let p = Vec2::new(dice.in_range(-3.0, 3.0), dice.in_range(-3.0, 3.0));
        let winding = winding_by_angles(p, &ring);
        assert_eq!(winding_of_ring(p, &ring), winding, "{p:?} {ring:?}");
        let want = distance_by_samples(p, &ring);
        let sign = if winding == 0.0 { 1.0 } else { -1.0 };
        let got = signed_distance_to_ring(p, &ring);
        assert!(
            (got - sign * want).abs() < 1e-12,
            "{p:?} {ring:?} {got} {want}"
        );
        assert!((distance_to_ring(p, &ring) - want).abs() < 1e-12);
        let odd = winding.rem_euclid(2.0) == 1.0;
        assert_eq!(
            fold_ring(p, &ring).signed_distance(Fill::EvenOdd) < 0.0,
            odd
        );
        let closed: Vec<_> = ring.iter().chain(&ring[..1]).copied().collect();
        assert!((distance_to_polyline(p, &closed) - want).abs() < 1e-12);
        // Halves of the edges joined are all of them, in f32 at any size.
        // (One by one, where slices are searched side by side.)
        let edges = || (0..n).map(|i| (ring[i], ring[(i + 1) % n]));
        let half = |odd: usize| {
            edges()
                .skip(odd)
                .step_by(2)
                .fold(EdgeFold::empty(), |state, (from, to)| {
                    state.with_edge(p, from, to)
                })
        };
        assert!((half(0).join(half(1)).signed_distance(Fill::NonZero) - got).abs() < 1e-15);
        for size in [1e-30_f32, 1e30] {
            let small = |v: Vec2<f64>| Vec2::new(v.x as f32 * size, v.y as f32 * size);
            let ring: Vec<_> = ring.iter().map(|&v| small(v)).collect();
            let got = distance_to_ring(small(p), &ring) / size;
            assert!((f64::from(got) - want).abs() < 2e-6);
        }
    }
}

#[test]
fn derivatives_of_the_signed_distance_and_at_ties() {
    let mut dice = Dice(5);
    let mut compared = 0;
    for _ in 0..1500 {
        let ring = random_ring(&mut dice, 4, false);
        let all: Vec<f64> = ring
            .iter()
            .flat_map(|v| [v.x, v.y])
            .chain([dice.in_range(-2.0, 2.0), dice.in_range(-2.0, 2.0)])
            .collect();
        fn of<S: geograd::Scalar<Mask = bool>>(x: &[S]) -> S {
            let v: Vec<Vec2<S>> = x.chunks(2).map(|v| Vec2::new(v[0], v[1])).collect();
            signed_distance_to_ring(v[4], &v[..4])
        }
        let jets: Vec<Jet<f64, 10>> = (0..10).map(|k| Jet::variable(all[k], k)).collect();
        let got = of(&jets);
        for k in 0..10 {
            let f = |step: f64| {
                let mut all = all.clone();
                all[k] += step;
                of(&all)
            };
            let (low, mid, high) = (f(-1e-6), f(0.0), f(1e-6));
            if (high - 2.0 * mid + low).abs() > 1e-10 {
                continue;
            }
            compared += 1;
            assert!(
                (got.derivative[k] - (high - low) / 2e-6).abs() < 1e-5,
                "{all:?} {k}"
            );
        }
    }
    assert!(compared > 13_000, "{compared}");
    // The centre of a square: four edges share, each edge half to either end.
    let x: Vec<Jet<f64, 10>> = [0., 0., 2., 0., 2., 2., 0., 2., 1., 1.]
        .iter()
        .enumerate()
        .map(|(k, v)| Jet::variable(*v, k))
        .collect();
    let v: Vec<_> = x.chunks(2).map(|v| Vec2::new(v[0], v[1])).collect();
    let deep = signed_distance_to_ring(v[4], &v[..4]);
    assert_eq!(deep.value, -1.0);
    assert_eq!(
        deep.derivative,
        [
            0.125, 0.125, -0.125, 0.125, -0.125, -0.125, 0.125, -0.125, 0.0, 0.0
        ]
    );
    // On a vertex, and with all vertices there.
    let same = vec![v[0]; 4];
    for d in [
        signed_distance_to_ring(v[0], &v[..4]),
        signed_distance_to_ring(v[0], &same),
    ] {
        assert_eq!((d.value, d.derivative), (0.0, [0.0; 10]));
    }
    assert_eq!(signed_distance_to_ring(Vec2::new(0.0, 0.0), &[]), f64::MAX);
    let nothing: EdgeFold<Jet<f64, 1>> = EdgeFold::empty().join(EdgeFold::empty());
    assert_eq!(
        nothing.signed_distance(Fill::NonZero),
        Jet::variable(f64::MAX, 9)
    );
    assert_eq!(
        edge_winding(
            Vec2::new(0.0, 0.0),
            Vec2::new(1.0, 0.0),
            Vec2::new(2.0, 0.0)
        ),
        0.0
    );
}

#[test]
fn an_edge_shares_its_derivative_as_the_nearest_point_lies() {
    let x: [Jet<f64, 6>; 6] =
        std::array::from_fn(|k| Jet::variable([1., 2., 0., 0., 4., 0.][k], k));
    let d = edge_distance(
        Vec2::new(x[0], x[1]),
        Vec2::new(x[2], x[3]),
        Vec2::new(x[4], x[5]),
    );
    assert_eq!(
        (d.value, d.derivative),
        (2.0, [0.0, 1.0, 0.0, -0.75, 0.0, -0.25])
    );
    // However near: the direction is that of the normal, where a difference of points is noise.
    let x: [Jet<f64, 6>; 6] =
        std::array::from_fn(|k| Jet::variable([1., 0.5 + 1e-16, 0., 0., 3., 1.5][k], k));
    let d = edge_distance(
        Vec2::new(x[0], x[1]),
        Vec2::new(x[2], x[3]),
        Vec2::new(x[4], x[5]),
    );
    assert!(d.value < 2e-16 && d.value >= 0.0);
    let x: [Jet<f64, 6>; 6] =
        std::array::from_fn(|k| Jet::variable([1., 0.5 + 2e-16, 0., 0., 3., 1.5][k], k));
    let d = edge_distance(
        Vec2::new(x[0], x[1]),
        Vec2::new(x[2], x[3]),
        Vec2::new(x[4], x[5]),
    );
    let n = 1.25_f64.sqrt();
    assert!(
        (d.derivative[0] + 0.5 / n).abs() < 1e-14 && (d.derivative[1] - 1.0 / n).abs() < 1e-14,
        "{d:?}"
    );
}

#[test]
fn the_length_of_a_segment_inside_is_that_of_samples() {
    let mut dice = Dice(23);
    for _ in 0..300 {
        let mut ring = random_ring(&mut dice, 7, false);
        // Star-shaped around the origin: simple, and not convex.
        ring.sort_by(|a, b| a.y.atan2(a.x).total_cmp(&b.y.atan2(b.x)));
        let gap = (0..7).any(|i| {
            let (a, b) = (ring[i], ring[(i + 1) % 7]);
            a.x * b.y - a.y * b.x < 0.0
        });
        if gap {
            continue;
        }
        let s = random_ring(&mut dice, 2, false);
        let segment = Segment2::new(s[0], s[1]);
        let n = 4000;
        let inside = (0..n)
            .filter(|k| {
                winding_by_angles(segment.point_at((*k as f64 + 0.5) / n as f64), &ring) != 0.0
            })
            .count();
        let want = inside as f64 / n as f64 * segment.length();
        let got = length_inside_ring(segment, &ring);
        assert!(
            (got - want).abs() < 8.0 / n as f64 * segment.length(),
            "{got} {want}"
        );
        ring.reverse();
        assert!((length_inside_ring(segment, &ring) - got).abs() < 1e-14);
        // Derivatives by differences.
        let all: Vec<f64> = ring.iter().chain(&s).flat_map(|v| [v.x, v.y]).collect();
        fn of<S: geograd::Scalar<Mask = bool>>(x: &[S]) -> S {
            let v: Vec<Vec2<S>> = x.chunks(2).map(|v| Vec2::new(v[0], v[1])).collect();
            length_inside_ring(Segment2::new(v[7], v[8]), &v[..7])
        }
        let jets: Vec<Jet<f64, 18>> = (0..18).map(|k| Jet::variable(all[k], k)).collect();
        let jet = of(&jets);
        for k in 0..18 {
            let f = |step: f64| {
                let mut all = all.clone();
                all[k] += step;
                of(&all)
            };
            let (low, mid, high) = (f(-1e-6), f(0.0), f(1e-6));
            if (high - 2.0 * mid + low).abs() < 1e-10 {
                assert!(
                    (jet.derivative[k] - (high - low) / 2e-6).abs() < 1e-4,
                    "{k}"
                );
            }
        }
    }
    let square = [(0., 0.), (1., 0.), (1., 1.), (0., 1.)].map(|(x, y)| Vec2::new(x, y));
    let whole = |x: f64, y: f64, u: f64, v: f64| {
        length_inside_ring(Segment2::new(Vec2::new(x, y), Vec2::new(u, v)), &square)
    };
    assert_eq!(whole(-1.0, 0.5, 2.0, 0.5), 1.0);
    assert_eq!(whole(0.25, 0.5, 0.75, 0.5), 0.5);
    assert_eq!(whole(2.0, 0.5, 3.0, 0.5), 0.0);
    assert!((whole(-1.0, -1.0, 2.0, 2.0) - 2f64.sqrt()).abs() < 1e-15); // through two corners
    assert_eq!(whole(0.5, 0.5, 0.5, 0.5), 0.0);
    assert_eq!(
        edge_inside(Segment2::new(square[0], square[0]), square[1], square[2]),
        0.0
    );
}

/// Across an edge the signed distance is smooth: exactly on it the derivative is the outward normal, of rings of
/// either orientation, and by either rule.
#[test]
fn on_an_edge_the_derivative_is_the_outward_normal() {
    let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)];
    let places = [
        ((1.0, 0.0), [0.0, -1.0]),
        ((2.0, 0.5), [1.0, 0.0]),
        ((0.5, 2.0), [0.0, 1.0]),
        ((0.0, 1.5), [-1.0, 0.0]),
    ];
    for (place, normal) in places {
        for backwards in [false, true] {
            let point: Vec2<Jet<f64, 2>> =
                Vec2::new(Jet::variable(place.0, 0), Jet::variable(place.1, 1));
            let mut ring =
                square.map(|(x, y)| Vec2::new(Jet::variable(x, 9), Jet::<f64, 2>::variable(y, 9)));
            if backwards {
                ring.reverse();
            }
            for fill in [Fill::NonZero, Fill::EvenOdd] {
                let found = fold_ring(point, &ring).signed_distance(fill);
                assert_eq!(
                    (found.value, found.derivative),
                    (0.0, normal),
                    "{place:?} {backwards}"
                );
            }
            assert_eq!(fold_ring(point, &ring).distance().derivative, [0.0; 2]);
        }
    }
    // On a vertex, and where a ring runs back along itself, there is no such normal.
    let spike = [(0.0, 0.0), (2.0, 0.0), (1.0, 0.0)]
        .map(|(x, y)| Vec2::new(Jet::variable(x, 9), Jet::<f64, 2>::variable(y, 9)));
    let point = Vec2::new(Jet::variable(0.5, 0), Jet::variable(0.0, 1));
    assert_eq!(signed_distance_to_ring(point, &spike).derivative, [0.0; 2]);
}

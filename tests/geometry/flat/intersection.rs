//! Crossings, hits and lengths inside.
use super::any::{Any, Dice, KINDS, build, count};
use super::oracle;
use geograd::intersection::{
    Hit, crossing_of_lines, first_hit, length_inside, meeting_of_segments, span,
};
use geograd::{Jet, Line2, Ray2, Scalar, Segment2, Vec2};

fn at<S>(x: S, y: S) -> Vec2<S> {
    Vec2::new(x, y)
}

macro_rules! each {
    ($any:expr, $x:ident => $do:expr) => {
        match $any {
            Any::Point($x) => $do,
            Any::Line($x) => $do,
            Any::Ray($x) => $do,
            Any::Segment($x) => $do,
            Any::Triangle($x) => $do,
            Any::Aabb($x) => $do,
            Any::Obb($x) => $do,
            Any::Circle($x) => $do,
            Any::Capsule($x) => $do,
            Any::Quad($x) => $do,
        }
    };
}

fn hit<S: Scalar>(ray: Ray2<S>, shape: Any<S>) -> Hit<S> {
    each!(shape, x => first_hit(ray, x))
}

#[test]
fn lines_cross_where_both_are() {
    let mut dice = Dice(4);
    for _ in 0..3000 {
        let whole = dice.whole(2) == 0;
        let (a, b) = (dice.shape(1, whole, 2.0), dice.shape(1, whole, 2.0));
        let of = |x: &[f64]| Line2::new(at(x[0], x[1]), at(x[2], x[3]));
        let found = crossing_of_lines(of(&a), of(&b));
        let turn = a[2] * b[3] - a[3] * b[2];
        assert_eq!(found.found == 1.0, turn != 0.0);
        let jets: Vec<Jet<f64, 8>> = a
            .iter()
            .chain(&b)
            .enumerate()
            .map(|(k, v)| Jet::variable(*v, k))
            .collect();
        let line = |k: usize| Line2::new(at(jets[k], jets[k + 1]), at(jets[k + 2], jets[k + 3]));
        let jet = crossing_of_lines(line(0), line(4));
        assert!(jet.point.x.derivative.iter().all(|s| s.is_finite()));
        if turn.abs() < 1e-2 {
            continue;
        }
        assert!(of(&b).side(found.point).abs() < 1e-11 * (1.0 + found.along_a.abs()));
        assert!(of(&b).point_at(found.along_b).distance(found.point) < 1e-10);
        // The point stays on both lines as they move.
        for line in [line(0), line(4)] {
            let off = line.side(jet.point);
            assert!(off.derivative.iter().all(|s| s.abs() < 1e-8), "{off:?}");
        }
    }
    // No tolerance in units: short directions, far apart lengths, one nearly parallel.
    let short = crossing_of_lines(
        Line2::new(at(0.0_f32, 0.0), at(1e-30, 0.0)),
        Line2::new(at(3.0, 1.0), at(0.0, 1e30)),
    );
    assert!(short.found == 1.0 && short.point.distance(at(3.0, 0.0)) < 1e-6);
    let slight = crossing_of_lines(
        Line2::new(at(0.0, 0.0), at(1.0, 0.0)),
        Line2::new(at(0.0_f64, -1e-7), at(1.0, 1e-7)),
    );
    assert!((slight.point.x - 1.0).abs() < 1e-15);
}

#[test]
fn segments_meet_in_nothing_a_point_or_a_segment() {
    let seg = |a: f64, b: f64, c: f64, d: f64| Segment2::new(at(a, b), at(c, d));
    let base = seg(0., 0., 4., 0.);
    for (other, kind, from, to) in [
        (seg(1., 1., 1., -1.), 1.0, at(1., 0.), at(1., 0.)),
        (seg(1., 1., 1., 0.), 1.0, at(1., 0.), at(1., 0.)),
        (seg(4., 0., 5., 5.), 1.0, at(4., 0.), at(4., 0.)),
        (seg(4., 0., 6., 0.), 1.0, at(4., 0.), at(4., 0.)),
        (seg(3., 0., 6., 0.), 2.0, at(3., 0.), at(4., 0.)),
        (seg(3., 0., 1., 0.), 2.0, at(1., 0.), at(3., 0.)),
        (base, 2.0, at(0., 0.), at(4., 0.)),
        (base.reversed(), 2.0, at(0., 0.), at(4., 0.)),
        (seg(2., 0., 2., 0.), 1.0, at(2., 0.), at(2., 0.)),
        (seg(2., 1., 2., 1.), 0.0, at(0., 0.), at(0., 0.)),
        (seg(5., 0., 6., 0.), 0.0, at(0., 0.), at(0., 0.)),
        (seg(1., 1., 3., 1.), 0.0, at(0., 0.), at(0., 0.)),
        (seg(5., 1., 5., -1.), 0.0, at(0., 0.), at(0., 0.)),
    ] {
        for size in [1.0, 1e-200, 1e150] {
            let scaled = |s: Segment2<f64>| Segment2::new(s.from * size, s.to * size);
            let (a, b) = (scaled(base), scaled(other));
            let found = meeting_of_segments(a, b);
            assert_eq!(found.kind, kind, "{other:?}");
            assert!(
                found.from.distance(from * size) <= 1e-15 * size,
                "{other:?} {found:?}"
            );
            assert!(
                found.to.distance(to * size) <= 1e-15 * size,
                "{other:?} {found:?}"
            );
            assert_eq!(meeting_of_segments(b, a).kind, kind, "{other:?}");
        }
    }
    let point = seg(1., 2., 1., 2.);
    assert_eq!(meeting_of_segments(point, point).kind, 1.0);
    assert_eq!(meeting_of_segments(point, seg(1., 3., 1., 3.)).kind, 0.0);
    // Derivatives of whole segments in every position are finite.
    let mut dice = Dice(8);
    for _ in 0..3000 {
        let all: Vec<f64> = [dice.shape(3, true, 2.0), dice.shape(3, true, 2.0)].concat();
        let x: Vec<Jet<f64, 8>> = (0..8).map(|k| Jet::variable(all[k], k)).collect();
        let p = |k: usize| at(x[k], x[k + 1]);
        let found = meeting_of_segments(Segment2::new(p(0), p(2)), Segment2::new(p(4), p(6)));
        for number in [found.from.x, found.from.y, found.to.x, found.to.y] {
            assert!(number.derivative.iter().all(|s| s.is_finite()), "{all:?}");
        }
        let want = oracle::signed_distance((3, &all[..4]), (3, &all[4..]));
        assert_eq!(found.kind.value > 0.0, want <= 1e-15, "{all:?}");
    }
}

#[test]
fn rays_hit_the_border_first() {
    let mut dice = Dice(6);
    let (mut hits, mut compared) = (0, 0);
    for kind in (0..KINDS).cycle().take(300 * KINDS) {
        if kind == 0 {
            continue;
        }
        let whole = dice.whole(3) == 0;
        let (shape, mut ray) = (dice.shape(kind, whole, 2.0), dice.shape(2, whole, 3.0));
        if dice.whole(2) == 0 {
            // Towards the shape.
            (ray[2], ray[3]) = (shape[0] - ray[0] + 0.1, shape[1] - ray[1] + 0.2);
        }
        if ray[2] == 0.0 && ray[3] == 0.0 {
            continue;
        }
        let beam = Ray2::new(at(ray[0], ray[1]), at(ray[2], ray[3]));
        let found = hit(beam, build(kind, &shape));
        let context = || format!("{beam:?}\n{:?}\n{found:?}", build(kind, &shape));
        let inside = |t: f64, slack: f64| {
            let p = beam.point_at(t);
            oracle::holds((kind, &shape), [p.x, p.y], slack)
        };
        let reach = if found.kind == 0.0 {
            30.0
        } else {
            found.parameter
        };
        if found.kind > 0.0 {
            hits += 1;
            let p = found.point;
            let off = oracle::signed_distance((0, &[p.x, p.y]), (kind, &shape));
            assert!(off.abs() < 1e-9, "{}: {off}", context());
            let length = found.normal.length();
            assert!((length - 1.0).abs() < 1e-12, "{}", context());
            let against =
                found.normal.dot(beam.direction) * if found.kind == 1.0 { 1.0 } else { -1.0 };
            assert!(against <= 1e-12, "{}", context());
        }
        let start_inside = found.kind == 2.0;
        for k in 1..25 {
            let t = reach * f64::from(k) / 25.0;
            // Pieces of lines have no inside: samples miss them, but for rays along them.
            let slack = if start_inside { 1e-9 } else { -1e-9 };
            assert_eq!(inside(t, slack), start_inside, "{}: at {t}", context());
        }
        // Derivatives: finite always, and right where the hit is clean.
        let all: Vec<f64> = ray.iter().chain(&shape).copied().collect();
        let jets: Vec<Jet<f64, 12>> = (0..all.len()).map(|k| Jet::variable(all[k], k)).collect();
        let of = |x: &[f64]| {
            hit(
                Ray2::new(at(x[0], x[1]), at(x[2], x[3])),
                build(kind, &x[4..]),
            )
        };
        let jet = hit(
            Ray2::new(at(jets[0], jets[1]), at(jets[2], jets[3])),
            build(kind, &jets[4..]),
        );
        for number in [jet.parameter, jet.point.x, jet.normal.x, jet.normal.y] {
            assert!(
                number.derivative.iter().all(|s| s.is_finite()),
                "{}",
                context()
            );
        }
        if whole || found.kind == 0.0 {
            assert!(found.kind > 0.0 || jet.parameter.derivative == [0.0; 12]);
            continue;
        }
        for k in 0..4 + count(kind) {
            let f = |step: f64| {
                let mut all = all.clone();
                all[k] += step;
                of(&all).parameter
            };
            let (low, mid, high) = (f(-1e-6), f(0.0), f(1e-6));
            let derivative = (high - low) / 2e-6;
            if (high - 2.0 * mid + low).abs() < 1e-10 && derivative.abs() < 30.0 {
                compared += 1;
                let got = jet.parameter.derivative[k];
                assert!(
                    (got - derivative).abs() < 1e-4 * (1.0 + derivative.abs()),
                    "{} {k}: {got} {derivative}",
                    context()
                );
            }
        }
    }
    assert!(hits > 800 && compared > 3000, "{hits} {compared}");
}

#[test]
fn the_length_inside_a_convex_shape_is_that_of_samples() {
    let mut dice = Dice(12);
    for kind in (4..KINDS).cycle().take(100 * KINDS) {
        let whole = dice.whole(3) == 0;
        let (shape, s) = (dice.shape(kind, whole, 1.5), dice.shape(3, false, 3.0));
        let segment = Segment2::new(at(s[0], s[1]), at(s[2], s[3]));
        let any = build(kind, &shape);
        let got = each!(any, x => length_inside(segment, x));
        let n = 150;
        let inside = (0..n)
            .filter(|k| {
                let p = segment.point_at((f64::from(*k) + 0.5) / f64::from(n));
                oracle::holds((kind, &shape), [p.x, p.y], 0.0)
            })
            .count();
        let want = inside as f64 / f64::from(n) * segment.length();
        assert!(
            (got - want).abs() < 2.1 / f64::from(n) * segment.length(),
            "{any:?} {segment:?} {got} {want}"
        );
        // In single precision at any size.
        let size = [1e-30_f32, 1e30][dice.whole(2) as usize];
        let single: Vec<f32> = shape
            .iter()
            .enumerate()
            .map(|(k, v)| *v as f32 * if kind == 6 && k == 4 { 1.0 } else { size })
            .collect();
        let p = |k: usize| at(s[k] as f32 * size, s[k + 1] as f32 * size);
        let any = build(kind, &single);
        let small = each!(any, x => length_inside(Segment2::new(p(0), p(2)), x)) / size;
        assert!(
            small.is_finite() && (f64::from(small) - got).abs() < 1e-4 || whole,
            "{small} {got}"
        );
    }
}

#[test]
fn spans_of_flat_and_endless_shapes() {
    let line = Line2::new(at(0.0, 0.0), at(2.0, 0.0));
    let found = span(line, Segment2::new(at(3.0, -1.0), at(3.0, 1.0)));
    assert_eq!((found.enter, found.exit, found.found), (1.5, 1.5, 1.0));
    assert_eq!(
        span(line, Segment2::new(at(3.0, 1.0), at(3.0, 2.0))).found,
        0.0
    );
    let along = span(line, Segment2::new(at(6.0, 0.0), at(3.0, 0.0)));
    assert_eq!((along.enter, along.exit), (1.5, 3.0));
    let same = span(line, line);
    assert_eq!(
        (same.enter, same.exit, same.found),
        (-f64::MAX, f64::MAX, 1.0)
    );
    let half = span(line, Ray2::new(at(4.0, 0.0), at(1.0, 0.0)));
    assert_eq!((half.enter, half.exit), (2.0, f64::MAX));
    let flat = [at(1.0, -1.0), at(1.0, 1.0), at(1.0, 1.0), at(1.0, -1.0)];
    assert_eq!(span(line, flat).enter, 0.5);
    let flat = [at(1.0, 1.0), at(1.0, 2.0), at(1.0, 2.0), at(1.0, 1.0)];
    assert_eq!(span(line, flat).found, 0.0);
    let point = [at(1.0, 1.0); 4];
    assert_eq!(span(line, point).found, 0.0);
    assert_eq!(span(line, at(4.0, 0.0)).enter, 2.0);
    assert_eq!(span(line, at(4.0, 1.0)).found, 0.0);
}

#[test]
fn length_inside_takes_its_derivatives_from_faces_along_an_axis_alone() {
    use geograd::ad::forward::gradient;
    use geograd::{Segment2, Triangle2, Vec2, intersection::length_inside};
    let segment = Segment2::new(Vec2::new(0.5, -1.0), Vec2::new(0.5, 3.0));
    let triangle = Triangle2::new(
        Vec2::new(0.0, 0.0),
        Vec2::new(2.0, 0.0),
        Vec2::new(0.0, 2.0),
    );
    let (length, (_, derivatives)) = gradient(|(a, b)| length_inside(a, b), (segment, triangle));
    assert_eq!(length, 1.5);
    // It enters after a quarter of the way from a to b and leaves after a quarter of that from c to b.
    for (found, expected) in [
        (derivatives.a.y, -0.75),
        (derivatives.b.y, -0.25 + 0.25),
        (derivatives.c.y, 0.75),
    ] {
        assert!(f64::abs(found - expected) < 1e-15, "{derivatives:?}");
    }
}

//! Distances of all pairs of shapes.
use super::any::{Any, Dice, KINDS, MOST, build, count};
use super::oracle;
use geograd::distance::segments::closest_points_of_segments;
use geograd::{Jet, Pose2, Segment2, Vec2};

type Derivatives = Jet<f64, { 2 * MOST }>;

/// Every pair of kinds, several times.
fn pairs(times: usize, mut test: impl FnMut(&mut Dice, usize, usize)) {
    let mut dice = Dice(7);
    for i in 0..KINDS {
        for j in 0..KINDS {
            for _ in 0..times {
                test(&mut dice, i, j);
            }
        }
    }
}

/// Both shapes with all of their numbers as variables.
fn variables(i: usize, a: &[f64], j: usize, b: &[f64]) -> (Any<Derivatives>, Any<Derivatives>) {
    let lift = |x: &[f64], first: usize| -> Vec<Derivatives> {
        (0..x.len())
            .map(|k| Jet::variable(x[k], first + k))
            .collect()
    };
    (build(i, &lift(a, 0)), build(j, &lift(b, count(i))))
}

fn is_lines(i: usize, j: usize) -> bool {
    i == 1 && j == 1
}

#[test]
fn values_are_those_of_the_hull_of_differences() {
    pairs(60, |dice, i, j| {
        let whole = dice.whole(2) == 0;
        let spread = if whole { 3.0 } else { 4.0 };
        let (a, b) = (dice.shape(i, whole, spread), dice.shape(j, whole, spread));
        let want = oracle::signed_distance((i, &a), (j, &b));
        let (x, y) = (build(i, &a), build(j, &b));
        let got = x.signed(y);
        let context = || format!("{x:?}\n{y:?}\ngot {got}, want {want}");
        if is_lines(i, j) {
            // The oracle's lines end; ours part only where they are parallel.
            let turn = a[2] * b[3] - a[3] * b[2];
            assert_eq!(turn != 0.0, got == -f64::MAX, "{}", context());
            assert!(x.distance(y) >= 0.0 && (turn == 0.0 || x.distance(y) == 0.0));
            return;
        }
        // An unbounded pair's far ends cost the oracle digits, and shallow crossings lie beyond them.
        let endless = [1, 2].contains(&i) || [1, 2].contains(&j);
        let tolerance = if endless { 1e-11 } else { 1e-13 };
        let cut_short = [1, 2].contains(&i) && [1, 2].contains(&j) && (got < -50.0 || want < -50.0);
        assert!(
            cut_short || (got - want).abs() < tolerance * (1.0 + want.abs()),
            "{}",
            context()
        );
        let reached = x.distance(y);
        assert_eq!(reached, got.max(0.0), "{}", context());
        assert!(
            (x.squared(y) - reached * reached).abs() < 1e-12,
            "{}",
            context()
        );
        assert!(
            (y.signed(x) - got).abs() < 1e-14 * (1.0 + got.abs()),
            "{}",
            context()
        );
        if !endless {
            let far = x.farthest(y);
            assert!(
                (far - oracle::farthest((i, &a), (j, &b))).abs() < 1e-13,
                "{}",
                context()
            );
            let ends = x.farthest_points(y);
            let (p, q) = (ends.on_a, ends.on_b);
            assert!((p.distance(q) - far).abs() < 1e-13, "{}", context());
            assert!(oracle::holds((i, &a), [p.x, p.y], 1e-13), "{}", context());
            assert!(oracle::holds((j, &b), [q.x, q.y], 1e-13), "{}", context());
        }
    });
}

#[test]
fn closest_points_are_points_of_the_shapes_and_as_far_apart_as_they_should_be() {
    pairs(60, |dice, i, j| {
        if is_lines(i, j) {
            return;
        }
        let whole = dice.whole(2) == 0;
        let (a, b) = (dice.shape(i, whole, 3.0), dice.shape(j, whole, 3.0));
        let (x, y) = (build(i, &a), build(j, &b));
        let signed = x.signed(y);
        if signed < -50.0 {
            return;
        }
        let found = x.closest(y);
        let context = || format!("{x:?}\n{y:?}\n{found:?} at {signed}");
        let way = found.on_b - found.on_a;
        let out = x.penetration(y);
        let length = out.direction.length();
        assert!(
            (length - 1.0).abs() < 1e-14 || length == 0.0,
            "{}",
            context()
        );
        assert_eq!(out.depth, (-signed).max(0.0));
        assert!((way.length() - signed.abs()).abs() < 1e-12, "{}", context());
        let slack = 1e-9;
        assert!(
            oracle::holds((i, &a), [found.on_a.x, found.on_a.y], slack)
                && oracle::holds((j, &b), [found.on_b.x, found.on_b.y], slack),
            "{}",
            context()
        );
        // Coinciding centres prefer no direction; the points are those of one.
        if length == 0.0 {
            return;
        }
        assert!(
            (way - out.direction * signed).length() < 1e-12,
            "{}",
            context()
        );
        if out.depth > 0.0 {
            // After the shift they touch.
            let touching = x.signed(y.moved(Pose2::new(out.direction * out.depth, 0.0)));
            assert!(touching.abs() < 1e-12, "{}: {touching}", context());
        }
    });
}

/// The central difference along one number, and whether both halves of it agree: no kink is near.
fn difference(f: impl Fn(f64) -> f64, x: f64) -> Option<f64> {
    let h = 1e-6;
    let (low, mid, high) = (f(x - h), f(x), f(x + h));
    let (left, right) = ((mid - low) / h, (high - mid) / h);
    ((left - right).abs() < 1e-4).then_some((high - low) / (2.0 * h))
}

#[test]
fn derivatives_are_those_of_differences() {
    let mut compared = 0;
    pairs(15, |dice, i, j| {
        if is_lines(i, j) {
            return;
        }
        let (a, b) = (dice.shape(i, false, 3.0), dice.shape(j, false, 3.0));
        let (x, y) = variables(i, &a, j, &b);
        let signed = x.signed(y);
        if signed.value.abs() < 1e-3 || signed.value < -50.0 {
            return;
        }
        let penetration = x.penetration(y).depth;
        let squared = x.squared(y);
        let all: Vec<f64> = a.iter().chain(&b).copied().collect();
        for k in 0..all.len() {
            let at = |v: f64| {
                let mut all = all.clone();
                all[k] = v;
                (build(i, &all[..a.len()]), build(j, &all[a.len()..]))
            };
            let f = |v: f64| {
                let (x, y) = at(v);
                x.signed(y)
            };
            let Some(want) = difference(f, all[k]) else {
                continue;
            };
            compared += 1;
            let got = signed.derivative[k];
            let context = || format!("{:?}\n{:?}\nnumber {k}", build(i, &a), build(j, &b));
            assert!(
                (got - want).abs() < 2e-5 * (1.0 + want.abs()),
                "{}: {got} {want}",
                context()
            );
            let (inside, outside) = (signed.value < 0.0, signed.value > 0.0);
            let depth = if inside { -got } else { 0.0 };
            assert!(
                (penetration.derivative[k] - depth).abs() < 1e-11 * (1.0 + got.abs()),
                "{}",
                context()
            );
            let square = if outside {
                2.0 * signed.value * got
            } else {
                0.0
            };
            assert!(
                (squared.derivative[k] - square).abs() < 1e-9 * (1.0 + square.abs()),
                "{}",
                context()
            );
        }
    });
    assert!(compared > 8_000, "{compared}");
}

#[test]
fn derivatives_at_kinks_are_finite_and_shared_evenly_between_mirror_images() {
    pairs(12, |dice, i, j| {
        let (a, mut b) = (dice.shape(i, true, 2.0), dice.shape(j, true, 2.0));
        if i == j && dice.whole(4) == 0 {
            b.clone_from(&a);
        }
        let (x, y) = variables(i, &a, j, &b);
        let context = || format!("{:?}\n{:?}", build(i, &a), build(j, &b));
        let (signed, distance) = (x.signed(y), x.distance(y));
        let closest = x.closest(y);
        let penetration = x.penetration(y);
        for number in [
            signed,
            distance,
            x.squared(y),
            x.farthest(y),
            closest.on_a.x,
            closest.on_a.y,
            closest.on_b.x,
            closest.on_b.y,
            penetration.depth,
            penetration.direction.x,
            penetration.direction.y,
        ] {
            assert!(number.value.is_finite(), "{}", context());
            assert!(
                number.derivative.iter().all(|s| s.is_finite()),
                "{}: {number:?}",
                context()
            );
        }
        if distance.value == 0.0 {
            assert_eq!(distance.derivative, [0.0; 2 * MOST], "{}", context());
        }
        // A shift of both changes nothing, and a shift of one by less than itself.
        let shift = |kind: usize, first: usize, axis: usize| -> f64 {
            let places: &[usize] = match kind {
                0 | 1 | 2 | 6 | 7 => &[0],
                3 | 5 | 8 => &[0, 2],
                4 => &[0, 2, 4],
                _ => &[0, 2, 4, 6],
            };
            places
                .iter()
                .map(|p| signed.derivative[first + p + axis])
                .sum()
        };
        let of_a = Vec2::new(shift(i, 0, 0), shift(i, 0, 1));
        let of_b = Vec2::new(shift(j, count(i), 0), shift(j, count(i), 1));
        assert!(
            (of_a + of_b).length() < 1e-12,
            "{}: {of_a:?} {of_b:?}",
            context()
        );
        assert!(of_a.length() < 1.0 + 1e-12, "{}: {of_a:?}", context());
    });
}

#[test]
fn rigid_motions_change_nothing_and_scale_scales() {
    pairs(40, |dice, i, j| {
        if is_lines(i, j) {
            return;
        }
        let whole = dice.whole(2) == 0;
        let (a, b) = (dice.shape(i, whole, 3.0), dice.shape(j, whole, 3.0));
        let (x, y) = (build(i, &a), build(j, &b));
        let signed = x.signed(y);
        if signed < -50.0 {
            return;
        }
        let shift = Vec2::new(dice.in_range(-9.0, 9.0), dice.in_range(-9.0, 9.0));
        let pose = Pose2::new(shift, dice.in_range(-3.0, 3.0));
        let moved = x.moved(pose).signed(y.moved(pose));
        // Rays and lines that were parallel may cross far away after rounding.
        let endless = [1, 2].contains(&i) && [1, 2].contains(&j);
        assert!(
            endless || (moved - signed).abs() < 1e-12,
            "{x:?}\n{y:?}\n{signed} {moved}"
        );
        let scaled = |kind: usize, x: &[f64], factor: f64| -> Vec<f64> {
            let mut x: Vec<f64> = x.iter().map(|v| v * factor).collect();
            if kind == 6 {
                x[4] /= factor;
            }
            x
        };
        for power in [-600, -90, 90, 500] {
            let factor = 2.0_f64.powi(power);
            let (a, b) = (scaled(i, &a, factor), scaled(j, &b, factor));
            let got = build(i, &a).signed(build(j, &b)) / factor;
            assert!(
                (got - signed).abs() < 1e-13,
                "{x:?}\n{y:?}\n{signed} {got} {power}"
            );
        }
    });
}

#[test]
fn single_precision_is_right_at_every_size_and_far_from_the_origin() {
    if !geograd_tests::is_due("single_precision_is_right_at_every_size_and_far_from_the_origin") {
        return;
    }
    pairs(40, |dice, i, j| {
        if [1, 2].contains(&i) || [1, 2].contains(&j) {
            return;
        }
        let whole = dice.whole(2) == 0;
        let (mut a, mut b) = (dice.shape(i, whole, 3.0), dice.shape(j, whole, 3.0));
        let factor = [1.0, 1e30, 1e-30][dice.whole(3) as usize];
        let places = |kind: usize| count(kind) - usize::from(kind == 6);
        a[..places(i)].iter_mut().for_each(|v| *v *= factor);
        b[..places(j)].iter_mut().for_each(|v| *v *= factor);
        let single = |x: &[f64]| -> Vec<f32> { x.iter().map(|v| *v as f32).collect() };
        let double = |x: &[f32]| -> Vec<f64> { x.iter().map(|v| f64::from(*v)).collect() };
        let (a, b) = (single(&a), single(&b));
        let want = build(i, &double(&a)).signed(build(j, &double(&b)));
        let (x, y) = (build(i, &a), build(j, &b));
        let got = f64::from(x.signed(y));
        assert!(
            (got - want).abs() < 4e-6 * factor,
            "{x:?}\n{y:?}\n{got} {want}"
        );
        let lift = |x: &[f32], first: usize| -> Vec<Jet<f32, 16>> {
            (0..x.len())
                .map(|k| Jet::variable(x[k], first + k))
                .collect()
        };
        let (x, y) = (build(i, &lift(&a, 0)), build(j, &lift(&b, count(i))));
        for number in [x.signed(y), x.farthest(y), x.closest(y).on_a.x] {
            assert!(number.value.is_finite() && number.derivative.iter().all(|s| s.is_finite()));
        }
    });
    // Numbers of whole size, exact a million away.
    pairs(40, |dice, i, j| {
        if is_lines(i, j) || [5, 6, 7, 8].contains(&i) || [5, 6, 7, 8].contains(&j) {
            return;
        }
        let (mut a, mut b) = (dice.shape(i, true, 3.0), dice.shape(j, true, 3.0));
        let near = build(i, &a).signed(build(j, &b));
        let places = |kind: usize| {
            if kind == 1 || kind == 2 {
                2
            } else {
                count(kind)
            }
        };
        a[..places(i)].iter_mut().for_each(|v| *v += 1e6);
        b[..places(j)].iter_mut().for_each(|v| *v += 1e6);
        assert_eq!(build(i, &a).signed(build(j, &b)), near);
    });
}

#[test]
fn segments_meet_at_their_points_and_parameters() {
    let mut dice = Dice(3);
    for _ in 0..5_000 {
        let whole = dice.whole(2) == 0;
        let (a, b) = (dice.shape(3, whole, 2.0), dice.shape(3, whole, 2.0));
        let of = |x: &[f64]| Segment2::new(Vec2::new(x[0], x[1]), Vec2::new(x[2], x[3]));
        let found = closest_points_of_segments(of(&a), of(&b));
        let want = oracle::signed_distance((3, &a), (3, &b)).max(0.0);
        let context = || format!("{:?}\n{:?}\n{found:?} {want}", of(&a), of(&b));
        assert!(
            (found.on_a.distance(found.on_b) - want).abs() < 1e-13,
            "{}",
            context()
        );
        assert!(
            (of(&a).point_at(found.along_a).distance(found.on_a)) < 1e-15,
            "{}",
            context()
        );
        assert!((0.0..=1.0).contains(&found.along_a) && (0.0..=1.0).contains(&found.along_b));
        let back = closest_points_of_segments(of(&b), of(&a));
        assert!(back.on_a.distance(found.on_b) < 1e-13, "{}", context());
        // Derivatives: finite, and right where nothing changes its kind.
        let all: Vec<f64> = a.iter().chain(&b).copied().collect();
        let x: Vec<Jet<f64, 8>> = (0..8).map(|k| Jet::variable(all[k], k)).collect();
        let p = |k: usize| Vec2::new(x[k], x[k + 1]);
        let jet = closest_points_of_segments(Segment2::new(p(0), p(2)), Segment2::new(p(4), p(6)));
        for number in [jet.on_a.x, jet.on_b.y, jet.along_a, jet.along_b] {
            assert!(
                number.derivative.iter().all(|s| s.is_finite()),
                "{}",
                context()
            );
        }
        if whole || want < 1e-3 && want > 0.0 {
            continue;
        }
        for k in 0..8 {
            let f = |v: f64| {
                let mut all = all.clone();
                all[k] = v;
                closest_points_of_segments(of(&all[..4]), of(&all[4..]))
                    .on_a
                    .x
            };
            if let Some(want) = difference(f, all[k]).filter(|want| want.abs() < 1e2) {
                let got = jet.on_a.x.derivative[k];
                assert!(
                    (got - want).abs() < 1e-3 * (1.0 + want.abs()),
                    "{}: {got} {want}",
                    context()
                );
            }
        }
    }
}

#[test]
fn ties_share_equally() {
    // A point in the middle of a square: four faces.
    let (x, y) = variables(0, &[1.0, 1.0], 5, &[0.0, 0.0, 2.0, 2.0]);
    let deep = x.signed(y);
    assert_eq!(deep.value, -1.0);
    assert_eq!(deep.derivative[..6], [0.0, 0.0, 0.25, 0.25, -0.25, -0.25]);
    assert_eq!(x.penetration(y).direction.length().value, 1.0);
    // Equal segments side by side: both ends of both.
    let (x, y) = variables(3, &[0.0, 0.0, 4.0, 0.0], 3, &[0.0, 1.0, 4.0, 1.0]);
    let apart = x.signed(y);
    assert_eq!(apart.value, 1.0);
    assert_eq!(
        apart.derivative[..8],
        [0.0, -0.5, 0.0, -0.5, 0.0, 0.5, 0.0, 0.5]
    );
    let found = x.closest(y);
    assert_eq!((found.on_a.x.value, found.on_b.x.value), (2.0, 2.0));
    // Boxes face to face, of which the smaller one decides; then one in the other.
    let (x, y) = variables(6, &[0., 0., 4., 4., 0.], 6, &[5., 0.5, 2., 2., 0.]);
    let found = x.closest(y);
    assert_eq!((found.on_a.x.value, found.on_a.y.value), (2.0, 0.5));
    assert_eq!(x.signed(y).derivative[..5], [-1.0, 0.0, -0.5, 0.0, 0.5]);
    let (x, y) = variables(6, &[0., 0., 4., 4., 0.], 6, &[2., 0., 2., 2., 0.]);
    let found = x.closest(y);
    assert_eq!((found.on_a.x.value, found.on_a.y.value), (2.0, 0.0));
    assert_eq!((found.on_b.x.value, found.on_b.y.value), (1.0, 0.0));
}

/// Segments that share an end touch, to the bit: their ends are not start and way added up.
#[test]
fn segments_that_share_an_end_have_no_distance() {
    let mut dice = Dice(97);
    for _ in 0..2000 {
        let mut at = || Vec2::new(dice.in_range(-2.0, 2.0), dice.in_range(-2.0, 2.0));
        let (shared, p, q) = (at(), at(), at());
        for (a, b) in [
            (Segment2::new(p, shared), Segment2::new(q, shared)),
            (Segment2::new(p, shared), Segment2::new(shared, q)),
        ] {
            assert_eq!(geograd::distance::distance(a, b), 0.0, "{a:?} {b:?}");
        }
    }
}

#[test]
fn boxes_along_the_axes_are_as_far_by_their_bounds_as_by_their_faces() {
    use geograd::distance::{signed_distance, upright::signed_distance_aabb2};
    let mut dice = Dice(9);
    let (mut apart, mut overlapping) = (0, 0);
    for round in 0..2000 {
        let mut shape = || {
            let numbers: [f64; 4] = std::array::from_fn(|_| match round % 2 {
                0 => dice.whole(8) as f64,
                _ => dice.in_range(-4.0, 4.0),
            });
            let [x, y, width, height] = numbers;
            geograd::Aabb2::new(x, y, x + width.abs() + 0.125, y + height.abs() + 0.125)
        };
        let (a, b) = (shape(), shape());
        let known = signed_distance(a.corners(), b.corners());
        let found = signed_distance_aabb2(a, b);
        assert!((found - known).abs() < 1e-13, "{a:?} {b:?} {found} {known}");
        apart += u32::from(found > 0.0);
        overlapping += u32::from(found < 0.0);
    }
    assert!(apart > 200 && overlapping > 200, "{apart} {overlapping}");
}

#[test]
fn nearest_points_by_bounds_are_as_far_as_the_boxes() {
    use geograd::distance::{signed_distance, upright::closest_points_aabb2};
    let mut dice = Dice(10);
    let (mut apart, mut overlapping) = (0, 0);
    for round in 0..4000 {
        let mut shape = || {
            let numbers: [f64; 4] = std::array::from_fn(|_| match round % 2 {
                0 => dice.whole(8) as f64,
                _ => dice.in_range(-4.0, 4.0),
            });
            let [x, y, width, height] = numbers;
            // Flat ones, too.
            geograd::Aabb2::new(x, y, x + width.abs().floor(), y + height.abs() + 0.125)
        };
        let (a, b) = (shape(), shape());
        let known = signed_distance(a.corners(), b.corners());
        let found = closest_points_aabb2(a, b);
        let way = found.on_b - found.on_a;
        let length = way.x.hypot(way.y);
        assert!(
            (length - known.abs()).abs() < 1e-13,
            "{a:?} {b:?} {found:?}"
        );
        // On the border of one box, and in both where they overlap.
        for (shape, point) in [(a, found.on_a), (b, found.on_b)] {
            let beyond = signed_distance(point, shape);
            assert!(beyond <= 1e-15, "{a:?} {b:?} {found:?}");
        }
        if known < 0.0 {
            let borders = [(a, found.on_a), (b, found.on_b)]
                .map(|(shape, point)| signed_distance(point, shape) >= -1e-15);
            assert_eq!(borders, [true; 2], "{a:?} {b:?} {found:?}");
        }
        apart += u32::from(known > 0.0);
        overlapping += u32::from(known < 0.0);
    }
    assert!(apart > 200 && overlapping > 200, "{apart} {overlapping}");
    // No digit of a small box is lost beside a large one.
    let long = geograd::Aabb2::new(0.0_f32, 0.0, 10.0, 0.0);
    let short = geograd::Aabb2::new(7e-5_f32, 0.0, 2.9e-4, 0.0);
    assert_eq!(closest_points_aabb2(long, short).on_a.x, 1.8e-4);
}

#[test]
fn depth_of_parallel_boxes_has_the_mean_of_both_ways_of_turning() {
    use geograd::ad::forward::gradient;
    use geograd::{Obb2, distance::signed_distance};
    let mut dice = Dice(11);
    let (mut held, mut overlapping) = (0, 0);
    for round in 0..2000 {
        let mut shape = |large: f64| {
            let [width, height] = [(); 2].map(|()| dice.in_range(0.0, large));
            let [x, y] = [(); 2].map(|()| dice.in_range(-1.0, 1.0));
            Obb2::new(x, y, width, height, 0.0)
        };
        // Every other b is small, often so small that it has no size.
        let (a, mut b) = (shape(4.0), shape(if round % 2 == 0 { 4.0 } else { 0.5 }));
        if round % 4 == 3 {
            b.size = geograd::Vec2::zero();
        }
        let (depth, (derivatives, _)) = gradient(|(a, b)| signed_distance(a, b), (a, b));
        // Steps go beyond the kink if another face is nearly as deep.
        let step = 1e-7;
        let by = |by: f64| (signed_distance(Obb2 { heading: by, ..a }, b) - depth) / by;
        let [left, right] = [-step, step].map(by);
        let wide = [-2.0 * step, 2.0 * step].map(by);
        if depth > -1e-3 || (left - wide[0]).abs() + (right - wide[1]).abs() > 1e-5 {
            continue;
        }
        let mean = (left + right) / 2.0;
        let found = derivatives.heading;
        assert!(
            (found - mean).abs() < 1e-5,
            "{a:?} {b:?} {found} {left} {right}"
        );
        overlapping += 1;
        held += u32::from((left - right).abs() < 1e-5);
    }
    assert!(overlapping > 500 && held > 100, "{overlapping} {held}");
}

/// Boxes of whole numbers and quarter turns, of small angles, of any; every other one without a width.
fn turned_boxes(dice: &mut Dice, round: usize) -> [geograd::Obb2<f64>; 2] {
    [0, 1].map(|which| {
        let numbers: [f64; 4] = std::array::from_fn(|_| match round % 2 {
            0 => dice.whole(8) as f64,
            _ => dice.in_range(-4.0, 4.0),
        });
        let [x, y, width, height] = numbers;
        let heading = match (round / 2 % 3, which) {
            (0, _) => dice.whole(4) as f64 * std::f64::consts::FRAC_PI_2,
            (1, 1) => dice.in_range(-1.0, 1.0) * 1e-7,
            (1, _) => 0.0,
            _ => dice.in_range(-4.0, 4.0),
        };
        let height = if round.is_multiple_of(5) {
            0.0
        } else {
            height.abs()
        };
        geograd::Obb2::new(x, y, width.abs(), height, heading)
    })
}

#[test]
fn turned_boxes_are_as_far_in_the_frame_of_one_as_by_their_corners() {
    use geograd::distance::{self, Convex, turned};
    let mut dice = Dice(12);
    let (mut apart, mut overlapping) = (0, 0);
    for round in 0..6000 {
        let [a, b] = turned_boxes(&mut dice, round);
        let [by_corners, to_corners] = [a.corners(), b.corners()];
        let known = distance::signed_distance(by_corners, to_corners);
        let close = |found: f64, known: f64| {
            assert!((found - known).abs() < 1e-12, "{a:?} {b:?} {found} {known}");
        };
        close(turned::signed_distance_obb2(a, b), known);
        close(turned::distance_obb2(a, b), known.max(0.0));
        close(
            turned::squared_distance_obb2(a, b),
            distance::squared_distance(by_corners, to_corners),
        );
        let pushed = turned::penetration_obb2(a, b);
        close(pushed.depth, (-known).max(0.0));
        close(
            turned::farthest_distance_obb2(a, b),
            distance::farthest_distance(by_corners, to_corners),
        );
        // Shifted by the depth, and a little more, they are apart.
        if known < -1e-9 {
            close(pushed.direction.length(), 1.0);
            let center = b.center + pushed.direction * (pushed.depth + 1e-9);
            let left = turned::signed_distance_obb2(a, geograd::Obb2 { center, ..b });
            assert!(left > 0.0 && left < 1e-8, "{a:?} {b:?} {left}");
        }
        let found = turned::closest_points_obb2(a, b);
        close((found.on_b - found.on_a).length(), known.abs());
        close(found.on_a.signed_distance(a).max(0.0), 0.0);
        close(found.on_b.signed_distance(b).max(0.0), 0.0);
        apart += u32::from(known > 0.0);
        overlapping += u32::from(known < 0.0);
    }
    assert!(apart > 600 && overlapping > 600, "{apart} {overlapping}");
}

#[test]
fn faces_that_are_all_but_parallel_are_told_apart_in_single_precision() {
    use geograd::ad::forward::gradient;
    use geograd::distance::turned;
    use geograd::{Obb2, Pack};
    let of = |[x, y, width, height, heading]: [f32; 5]| Obb2::new(x, y, width, height, heading);
    let angle = 1e-5_f32;
    // The parting, nearest or farthest feature of each pair differs from the next one by less than a digit.
    let pairs = [
        [[0.5, 0.25, 1.0, 0.0, 0.0], [0.0, 0.0, 2.0, 1.0, angle]],
        [[0.5, 0.2, 1.0, 0.5, 0.0], [0.0, 0.0, 2.0, 1.0, angle]],
        [[2.0, 1.0, 2.0, 1.0, 0.0], [0.0, 0.0, 2.0, 1.0, angle]],
        [[0.0, 0.0, 50.0, 1e-3, 0.0], [0.0, 0.0, 50.0, 1e-3, 0.0]],
        [[0.0, 0.0, 0.0, 0.5, 0.0], [0.0, 0.0, 50.0, 0.0, 1e-6]],
    ];
    for pair in pairs {
        let [a, b] = pair.map(of);
        let wide = |shape: Obb2<f32>| shape.remake(&mut |&x| f64::from(x));
        macro_rules! same {
            ($f:ident) => {
                let (_, found) = gradient(|(a, b)| turned::$f(a, b), (a, b));
                let (_, known) = gradient(|(a, b)| turned::$f(a, b), (wide(a), wide(b)));
                let pairs = [(found.0, known.0), (found.1, known.1)];
                for (found, known) in pairs {
                    for (found, known) in found.scalars().into_iter().zip(known.scalars()) {
                        let off = (f64::from(found) - known).abs();
                        assert!(off < 1e-6, "{a:?} {b:?} {found} {known}");
                    }
                }
            };
        }
        same!(signed_distance_obb2);
        same!(distance_obb2);
        same!(farthest_distance_obb2);
    }
}

/// A box far from the origin keeps its digits: its centre, which is rounded there, has no part in distances.
#[test]
fn boxes_along_the_axes_keep_their_digits_far_from_the_origin() {
    use geograd::distance::{Convex, upright::penetration_aabb2};
    use geograd::{Aabb2, Circle};
    // Steps of the last digit at ten thousand.
    let at = |steps: f32| 10000.0_f32 + steps / 1024.0;
    let a = Aabb2::new(at(0.0), 0.0, at(1.0), 1.0);
    let apart = Aabb2::new(at(3.0), 0.0, 10001.0, 1.0);
    let touching = Aabb2::new(at(1.0), 0.0, at(2.0), 1.0);
    assert_eq!(a.distance(apart), 0.001_953_125);
    assert_eq!(a.signed_distance(touching), 0.0);
    // Beside shapes of other kinds, too.
    let point = Vec2::new(at(3.0), 0.5);
    assert_eq!(
        (a.distance(point), Convex::distance(point, a)),
        (0.001_953_125, 0.001_953_125)
    );
    assert_eq!(a.distance(Circle::new(point, 0.0)), 0.001_953_125);
    let inside = Vec2::new(at(1.0), 0.5);
    assert_eq!(a.signed_distance(inside), 0.0);
    let mut dice = Dice(98);
    for _ in 0..2000 {
        // Steps of the last digit at ten thousand: all differences are exact.
        let step = 1.0_f32 / 1024.0;
        let mut shape = || {
            let [x, y, width, height] = [(); 4].map(|()| dice.whole(12) as f32 * step);
            let (x, y) = (10000.0 + x, -12000.0 + y);
            Aabb2::new(x, y, x + width, y + height)
        };
        let (a, b) = (shape(), shape());
        let wide = |x: Aabb2<f32>| {
            let [min, max] = [x.min, x.max].map(|v| Vec2::new(f64::from(v.x), f64::from(v.y)));
            Aabb2 { min, max }
        };
        let (wide_a, wide_b) = (wide(a), wide(b));
        let known = wide_a.corners().signed_distance(wide_b.corners()) as f32;
        assert_eq!(a.signed_distance(b), known, "{a:?} {b:?}");
        let known = wide_a.corners().farthest_distance(wide_b.corners()) as f32;
        assert_eq!(a.farthest_distance(b), known, "{a:?} {b:?}");
        for corner in b.corners() {
            let far = Vec2::new(f64::from(corner.x), f64::from(corner.y));
            let known = wide_a.corners().signed_distance(far) as f32;
            let (found, back) = (a.signed_distance(corner), corner.signed_distance(a));
            assert_eq!((found, back), (known, known), "{a:?} {corner:?}");
        }
        let out = penetration_aabb2(a, b);
        let moved = |by: f32| {
            let by = out.direction * by;
            Aabb2 {
                min: b.min + by,
                max: b.max + by,
            }
        };
        assert_eq!(
            a.distance(moved(out.depth)),
            (-out.depth).max(0.0).max(a.distance(b))
        );
        if out.depth > 0.0 {
            assert_eq!(a.signed_distance(moved(out.depth)), 0.0, "{a:?} {b:?}");
            assert!(
                a.signed_distance(moved(out.depth - step)) < 0.0,
                "{a:?} {b:?}"
            );
        } else if a.distance(b) > 0.0 {
            assert!((out.direction.length() - 1.0).abs() < 1e-6);
        }
    }
}

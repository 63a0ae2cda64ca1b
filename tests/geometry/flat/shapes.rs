//! Single shapes: constructors, circumcircles, incircles, intervals, poses.
use super::any::Dice;
use geograd::error::Field;
use geograd::shape::circumcircle;
use geograd::{
    Capsule2, Circle, Flaw, Interval, Jet, Line2, Pose2, Ray2, Segment2, Triangle2, Vec2,
};

fn at<S>(x: S, y: S) -> Vec2<S> {
    Vec2::new(x, y)
}

#[test]
fn constructors_name_the_field() {
    let (nan, far) = (f64::NAN, f64::INFINITY);
    let p = at(0.0, 0.0);
    assert_eq!(
        Segment2::try_new(p, at(0.0, nan)),
        Err(Flaw::NotFinite(Field::new("to.y")))
    );
    assert_eq!(
        Segment2::try_new(at(far, 0.0), p),
        Err(Flaw::NotFinite(Field::new("from.x")))
    );
    assert!(Segment2::try_new(p, p).is_ok());
    assert_eq!(
        Line2::try_new(p, p),
        Err(Flaw::Zero(Field::new("direction")))
    );
    assert_eq!(
        Line2::try_new(at(0.0, far), p),
        Err(Flaw::NotFinite(Field::new("point.y")))
    );
    assert_eq!(
        Ray2::try_new(p, at(-0.0, 0.0)),
        Err(Flaw::Zero(Field::new("direction")))
    );
    assert_eq!(
        Ray2::try_new(p, at(nan, 1.0)),
        Err(Flaw::NotFinite(Field::new("direction.x")))
    );
    assert_eq!(
        Triangle2::try_new(p, p, at(1.0, nan)),
        Err(Flaw::NotFinite(Field::new("c.y")))
    );
    assert!(Triangle2::try_new(p, p, p).is_ok());
    assert_eq!(
        Circle::try_new(p, -1.0),
        Err(Flaw::Negative(Field::new("radius")))
    );
    assert_eq!(
        Circle::try_new(p, nan),
        Err(Flaw::NotFinite(Field::new("radius")))
    );
    assert!(Circle::try_new(p, 0.0).is_ok());
    assert_eq!(
        Capsule2::try_new(p, at(far, 0.0), 1.0),
        Err(Flaw::NotFinite(Field::new("to.x")))
    );
    assert_eq!(
        Capsule2::try_new(p, p, -0.5),
        Err(Flaw::Negative(Field::new("radius")))
    );
    assert_eq!(
        Interval::try_new(2.0, 1.0),
        Err(Flaw::Inverted(Field::new("min"), "max"))
    );
    assert_eq!(
        Interval::try_new(2.0, nan),
        Err(Flaw::NotFinite(Field::new("max")))
    );
    assert_eq!(
        Flaw::Zero(Field::new("direction")).to_string(),
        "direction is zero"
    );
    assert_eq!(
        Flaw::NotFinite(Field::new("c.y")).to_string(),
        "c.y is not a finite number"
    );
}

#[test]
fn a_circumcircle_runs_through_its_points_at_every_size() {
    let mut dice = Dice(1);
    for _ in 0..3000 {
        let mut point = || at(dice.in_range(-2.0, 2.0), dice.in_range(-2.0, 2.0));
        let (a, b, c) = (point(), point(), point());
        if Triangle2::new(a, b, c).area() < 1e-2 {
            continue;
        }
        for size in [1.0, 2f64.powi(-500), 2f64.powi(500)] {
            let round = circumcircle(a * size, b * size, c * size);
            for p in [a, b, c] {
                let off = round.center.distance(p * size) - round.radius;
                assert!(off.abs() < 1e-10 * size, "{a:?} {b:?} {c:?} {off}");
            }
        }
        // Derivatives: centre and radius move so that every point stays on the circle.
        let all = [a.x, a.y, b.x, b.y, c.x, c.y];
        let x: [Jet<f64, 6>; 6] = std::array::from_fn(|k| Jet::variable(all[k], k));
        let p = [at(x[0], x[1]), at(x[2], x[3]), at(x[4], x[5])];
        let round = circumcircle(p[0], p[1], p[2]);
        for p in p {
            let off = round.center.distance(p) - round.radius;
            assert!(off.derivative.iter().all(|s| s.abs() < 1e-7), "{off:?}");
        }
    }
}

#[test]
fn points_on_a_line_have_a_finite_circumcircle() {
    let cases = [
        [0., 0., 1., 0., 6., 0.],
        [0., 0., 6., 0., 1., 0.],
        [1., 1., 0., 0., 6., 6.],
        [2., 3., 2., 3., 2., 3.],
        [2., 3., 2., 3., 4., 3.],
        [2., 3., 4., 3., 2., 3.],
        [4., 3., 2., 3., 2., 3.],
        [-1., 0., 0., 0., 1., 0.],
        [0., 0., 1e-20, 0., 1., 0.],
        [0., 0., 1., 1e-30, 2., 0.],
    ];
    for x in cases {
        let jets: Vec<Jet<f64, 6>> = (0..6).map(|k| Jet::variable(x[k], k)).collect();
        let p: Vec<_> = jets.chunks(2).map(|v| at(v[0], v[1])).collect();
        let round = circumcircle(p[0], p[1], p[2]);
        let longest = (0..3)
            .map(|i| p[i].distance(p[(i + 1) % 3]).value)
            .fold(0.0, f64::max);
        for number in [round.center.x, round.center.y, round.radius] {
            assert!(
                number.value.is_finite() && number.derivative.iter().all(|s| s.is_finite()),
                "{x:?}"
            );
        }
        if x[3] != 1e-30 {
            assert_eq!(round.radius.value, longest / 2.0, "{x:?}");
        }
        let single = circumcircle(
            at(x[0] as f32, x[1] as f32),
            at(x[2] as f32, x[3] as f32),
            at(x[4] as f32, x[5] as f32),
        );
        assert!(single.radius.is_finite() && single.center.is_finite());
    }
    // Three sides of length zero share: half of the mean of the three points' derivatives would be odd, the
    // centre moves with all of them.
    let x: [Jet<f64, 6>; 6] =
        std::array::from_fn(|k| Jet::variable([2., 3., 2., 3., 2., 3.][k], k));
    let round = circumcircle(at(x[0], x[1]), at(x[2], x[3]), at(x[4], x[5]));
    let sum: f64 = (0..3).map(|k| round.center.x.derivative[2 * k]).sum();
    assert!((sum - 1.0).abs() < 1e-15);
    assert_eq!(round.radius.derivative, [0.0; 6]);
}

#[test]
fn an_incircle_touches_all_sides_at_every_size() {
    let mut dice = Dice(3);
    for _ in 0..3000 {
        let mut point = || at(dice.in_range(-2.0, 2.0), dice.in_range(-2.0, 2.0));
        let corners = [point(), point(), point()];
        let [a, b, c] = corners;
        let circle = Triangle2::new(a, b, c).incircle();
        // The bisectors of two angles meet in the center.
        let half = |k: usize| {
            let [p, q, r] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
            ((q - p).angle_to(r - p) / 2.0, (q - p).angle())
        };
        let ((alpha, heading), (beta, _)) = (half(0), half(1));
        let reach = a.distance(b) * beta.sin() / (alpha + beta).sin();
        let turn = heading + alpha;
        let center = a + at(turn.cos(), turn.sin()) * reach;
        let off = center.distance(circle.center) + (reach * alpha.sin()).abs() - circle.radius;
        assert!(off.abs() < 1e-9, "{corners:?} {circle:?} {center:?}");
        for size in [2f64.powi(-500), 2f64.powi(500)] {
            let sized = Triangle2::new(a * size, b * size, c * size).incircle();
            let off = sized.center.distance(circle.center * size);
            assert!(off.max((sized.radius - circle.radius * size).abs()) < 1e-14 * size);
        }
        // Far away it is where it was, relative to a corner, as far as the corners are.
        let far = at(2f64.powi(20), -2f64.powi(21));
        let (q, r) = (b + far - (a + far), c + far - (a + far));
        let near = Triangle2::new(at(0.0, 0.0), q, r).incircle();
        let moved = Triangle2::new(a + far, b + far, c + far).incircle();
        assert_eq!(moved.radius, near.radius);
        assert!(moved.center.distance(near.center + (a + far)) < 1e-9);
    }
}

#[test]
fn incircles_without_area_have_finite_derivatives() {
    let cases = [
        [2., 3., 2., 3., 2., 3.],
        [2., 3., 2., 3., 4., 3.],
        [2., 3., 4., 3., 2., 3.],
        [4., 3., 2., 3., 2., 3.],
        [0., 0., 1., 0., 6., 0.],
        [0., 0., 1e-18, 0., 0., 1e-18],
        [0., 0., 1e18, 0., 0., 1e18],
        [1e18, 1e18, 1e18, 1e18, 1e-18, 0.],
    ];
    for x in cases {
        let x: [Jet<f32, 6>; 6] = std::array::from_fn(|k| Jet::variable(x[k] as f32, k));
        let [a, b, c] = [at(x[0], x[1]), at(x[2], x[3]), at(x[4], x[5])];
        let circle = Triangle2::new(a, b, c).incircle();
        for number in [circle.center.x, circle.center.y, circle.radius] {
            let derivatives = number.derivative.iter().all(|s| s.is_finite());
            assert!(number.value.is_finite() && derivatives, "{x:?} {number:?}");
        }
        // It goes where the triangle goes.
        let along_x: f32 = circle.center.x.derivative.iter().step_by(2).sum();
        assert!((along_x - 1.0).abs() < 1e-6, "{x:?} {along_x}");
    }
    let p = at(2.0_f64, 3.0);
    assert_eq!(Triangle2::new(p, p, p).incircle(), Circle::new(p, 0.0));
    let tiny = Triangle2::new(at(0.0, 0.0), at(4e-18_f32, 0.0), at(0.0, 3e-18)).incircle();
    assert!((tiny.radius / 1e-18 - 1.0).abs() < 1e-6);
    let huge = Triangle2::new(at(0.0, 0.0), at(4e18_f32, 0.0), at(0.0, 3e18)).incircle();
    assert!((huge.radius / 1e18 - 1.0).abs() < 1e-6);
}

#[test]
fn intervals_measure_and_share_their_derivatives() {
    let mut dice = Dice(2);
    for _ in 0..2000 {
        let mut number = || dice.whole(7) as f64 / 2.0;
        let (a, b) = (number(), number());
        let (one, two) = (
            Interval::new(a, a + number()),
            Interval::new(b, b + number()),
        );
        let n = 7000;
        let in_both = |x: f64| f64::from(u8::from(one.contains(x) && two.contains(x)));
        let in_any = |x: f64| f64::from(u8::from(one.contains(x) || two.contains(x)));
        let sum = |f: &dyn Fn(f64) -> f64| -> f64 {
            (0..n).map(|k| f((k as f64 + 0.5) * 1e-3)).sum::<f64>() * 1e-3
        };
        let (inter, union) = (sum(&in_both), sum(&in_any));
        let want = if union > 0.0 { inter / union } else { 0.0 };
        assert!((one.iou(two) - want).abs() < 1e-9, "{one:?} {two:?}");
        let gap = (two.min - one.max).max(one.min - two.max);
        assert_eq!(
            (one.signed_distance(two), one.distance(two)),
            (gap, gap.max(0.0))
        );
    }
    let x: [Jet<f64, 4>; 4] = std::array::from_fn(|k| Jet::variable([1., 3., 1., 3.][k], k));
    let same = Interval::new(x[0], x[1]).iou(Interval::new(x[2], x[3]));
    assert_eq!((same.value, same.derivative), (1.0, [0.0; 4]));
    let tiny = Interval::new(0.0_f32, 1e-30).iou(Interval::new(5e-31, 1.5e-30));
    assert!((tiny - 1.0 / 3.0).abs() < 1e-6);
    assert_eq!(Interval::new(1.0, 1.0).iou(Interval::new(1.0, 1.0)), 0.0);
    assert_eq!(Interval::new(0.0, 4.0).signed_distance_to(1.0), -1.0);
    assert_eq!(Interval::new(0.0, 4.0).distance_to(7.0), 3.0);
}

#[test]
fn poses_carry_every_shape() {
    let pose = Pose2::new(at(3.0, -1.0), 0.7);
    let (p, q, r) = (at(1.0, 2.0), at(-1.0, 0.5), at(0.25, -3.0));
    let near = |a: Vec2<f64>, b: Vec2<f64>| assert!(a.distance(b) < 1e-14);
    let segment = pose * Segment2::new(p, q);
    near(segment.from, pose * p);
    near(segment.to, pose * q);
    near(
        (pose * Line2::through(p, q)).point_at(0.3),
        pose * Line2::through(p, q).point_at(0.3),
    );
    near(
        (pose * Ray2::through(p, q)).point_at(0.3),
        pose * Ray2::through(p, q).point_at(0.3),
    );
    near(
        (pose * Triangle2::new(p, q, r)).centroid(),
        pose * Triangle2::new(p, q, r).centroid(),
    );
    near((pose * Circle::new(p, 2.0)).center, pose * p);
    let capsule = pose * Capsule2::new(p, q, 0.5);
    near(capsule.to, pose * q);
    assert_eq!(capsule.radius, 0.5);
}

#[test]
fn lines_keep_their_side_through_coefficients() {
    let mut dice = Dice(9);
    for _ in 0..500 {
        let mut point = || at(dice.in_range(-2.0, 2.0), dice.in_range(-2.0, 2.0));
        let (p, q, x) = (point(), point(), point());
        let line = Line2::through(p, q);
        let [a, b, c] = line.coefficients();
        let again = Line2::from_coefficients(a, b, c);
        assert!((line.side(x) - again.side(x)).abs() < 1e-12);
        assert!((line.side(x) - (a * x.x + b * x.y + c) / a.hypot(b)).abs() < 1e-12);
        assert!(line.side(p + (q - p).perp()) > 0.0);
        assert!((line.nearest(x).distance(x) - line.side(x).abs()).abs() < 1e-12);
    }
    let none = Line2::from_coefficients(0.0, 0.0, 1.0);
    assert!(none.point.is_finite() && none.side(at(1.0, 2.0)) == 0.0);
}

#[test]
fn points_are_in_triangles_circles_and_capsules_where_the_signed_distance_says_so() {
    use geograd::distance::signed_distance;
    let mut dice = Dice(17);
    for _ in 0..5000 {
        let mut point = || at(dice.whole(5) as f64, dice.whole(5) as f64);
        let (a, b, c, p) = (point(), point(), point(), point());
        let triangle = Triangle2::new(a, b, c);
        let away = signed_distance(triangle, p);
        assert!(
            away.abs() < 1e-14 || triangle.contains(p) == (away < 0.0),
            "{triangle:?} {p:?}"
        );
        assert!(
            away.abs() != 0.0 || triangle.contains(p),
            "{triangle:?} {p:?}"
        );
        let circle = Circle::new(a, 2.0);
        assert_eq!(circle.contains(p), signed_distance(circle, p) <= 0.0);
        let capsule = Capsule2::new(a, b, 1.0);
        assert_eq!(capsule.contains(p), signed_distance(p, capsule) <= 0.0);
    }
}

//! Closest points of shapes of the plane.
use super::check;
use super::draw::Dice;
use geograd::distance::segments::closest_points_of_segments;
use geograd::distance::{self, Convex};
use geograd::{Capsule2, Circle, Obb2, Pack, Pose2, Segment2, Triangle2, Vec2};

fn place(dice: &mut Dice) -> Vec2<f64> {
    Vec2::new(dice.whole(2), dice.whole(2))
}

/// Two places, seldom one.
fn ends(dice: &mut Dice) -> [Vec2<f64>; 2] {
    let from = place(dice);
    match dice.below(6) {
        0 => [from, from],
        _ => [from, place(dice)],
    }
}

/// Three corners, most of them in line.
fn corners(dice: &mut Dice) -> [Vec2<f64>; 3] {
    let [from, to] = ends(dice);
    match dice.below(4) {
        0 => [from, to, place(dice)],
        _ => [
            from,
            to,
            from + (to - from) * [0.5, 2.0, -1.0][dice.below(3)],
        ],
    }
}

/// A shape of whole numbers, its centre or one of its corners at a place that others may have, too.
trait Drawn: Copy {
    fn drawn(dice: &mut Dice, at: Vec2<f64>) -> Self;
}
impl Drawn for Vec2<f64> {
    fn drawn(_: &mut Dice, at: Vec2<f64>) -> Self {
        at
    }
}
impl Drawn for Segment2<f64> {
    fn drawn(dice: &mut Dice, at: Vec2<f64>) -> Self {
        let [from, to] = ends(dice);
        Segment2::new(at, at + (to - from))
    }
}
impl Drawn for Triangle2<f64> {
    fn drawn(dice: &mut Dice, at: Vec2<f64>) -> Self {
        let [from, to, last] = corners(dice);
        Triangle2::new(at, at + (to - from), at + (last - from))
    }
}
impl Drawn for Circle<f64> {
    fn drawn(dice: &mut Dice, at: Vec2<f64>) -> Self {
        Circle::new(at, dice.length())
    }
}
impl Drawn for Capsule2<f64> {
    fn drawn(dice: &mut Dice, at: Vec2<f64>) -> Self {
        let edge = Segment2::drawn(dice, at);
        Capsule2::new(edge.from, edge.to, dice.length())
    }
}
impl Drawn for Obb2<f64> {
    fn drawn(dice: &mut Dice, at: Vec2<f64>) -> Self {
        Obb2::new(at.x, at.y, dice.length(), dice.length(), 0.0)
    }
}

/// Pairs of shapes, as they are and turned, in both orders and formats.
macro_rules! pairs {
    ($dice:expr; $($A:ident $B:ident),*) => { $({
        let dice = &mut *$dice;
        for _ in 0..4000 {
            let (at, other) = (place(dice), place(dice));
            let other = if dice.below(2) == 0 { at } else { other };
            let a = <$A<f64> as Drawn>::drawn(dice, at);
            let b = <$B<f64> as Drawn>::drawn(dice, other);
            let moved = |shape: $B<f64>, by: Vec2<f64>| Pose2::new(by, 0.0) * shape;
            let back = |shape: $A<f64>, by: Vec2<f64>| Pose2::new(by, 0.0) * shape;
            check!(distance, a, b, Some(moved), 8, f64);
            check!(distance, b, a, Some(back), 8, f64);
            let turn = Pose2::new(Vec2::new(dice.whole(9) * 0.1, 0.3), dice.whole(30) * 0.1);
            let (a, b) = (turn * a, turn * b);
            let never = None::<fn($B<f64>, Vec2<f64>) -> $B<f64>>;
            check!(distance, a, b, never, 8, f64);
            let never = None::<fn($B<f32>, Vec2<f32>) -> $B<f32>>;
            check!(distance, a.cast::<f32>(), b.cast::<f32>(), never, 8, f32);
            let never = None::<fn($A<f32>, Vec2<f32>) -> $A<f32>>;
            check!(distance, b.cast::<f32>(), a.cast::<f32>(), never, 8, f32);
        }
    })* };
}

#[test]
fn of_shapes_that_meet_in_a_point_or_along_a_line() {
    let dice = &mut Dice(0x1234_5678_9abc_def1);
    pairs!(dice;
        Vec2 Circle, Vec2 Capsule2, Segment2 Circle, Segment2 Capsule2, Circle Circle, Circle Capsule2,
        Capsule2 Capsule2, Capsule2 Obb2, Circle Obb2);
}

#[test]
fn of_triangles_without_area() {
    if !geograd_tests::is_due("of_triangles_without_area") {
        return;
    }
    let dice = &mut Dice(0xfeed_5678_9abc_def1);
    pairs!(dice;
        Vec2 Triangle2, Segment2 Triangle2, Triangle2 Triangle2, Triangle2 Circle, Triangle2 Capsule2, Triangle2 Obb2);
}

/// A side of four corners has one in its middle: both halves part shapes equally.
#[test]
fn of_polygons_with_corners_in_line() {
    let dice = &mut Dice(0xabcd_5678_9abc_def1);
    for _ in 0..20_000 {
        let (width, height) = (2.0 + dice.below(3) as f64, 1.0 + dice.below(3) as f64);
        let part = [0.25, 0.5, 0.75][dice.below(3)];
        let turn = Pose2::new(Vec2::new(0.3, dice.whole(9) * 0.1), dice.whole(30) * 0.1);
        let side = turn * Vec2::new(part * width, 0.0);
        let last = turn * Vec2::new(dice.below(4) as f64, height);
        let a = [
            turn * Vec2::zero(),
            side,
            turn * Vec2::new(width, 0.0),
            last,
        ];
        let at = Vec2::new(dice.below(5) as f64, -1.0);
        let tip = at + Vec2::new(0.0, 1.0 + 0.125 * dice.below(4) as f64);
        let b = [at, at + Vec2::new(1.0, 0.0), tip].map(|corner| turn * corner);
        let never = None::<fn([Vec2<f64>; 3], Vec2<f64>) -> [Vec2<f64>; 3]>;
        check!(distance, a, b, never, 8, f64);
        let (a, b) = (a.map(|p| p.cast::<f32>()), b.map(|p| p.cast::<f32>()));
        let never = None::<fn([Vec2<f32>; 3], Vec2<f32>) -> [Vec2<f32>; 3]>;
        check!(distance, a, b, never, 8, f32);
    }
}

/// Rounding says of segments in line, turned, where they cross.
#[test]
fn of_segments_in_line() {
    let dice = &mut Dice(0x0123_5678_9abc_def1);
    for _ in 0..20_000 {
        let (from, way) = (place(dice), place(dice));
        let turn = Pose2::new(Vec2::new(dice.whole(9) * 0.1, 0.3), dice.whole(30) * 0.1);
        let mut edge = || {
            let [start, end] = [0.25 * dice.whole(4), 0.25 * dice.whole(4)];
            turn * Segment2::new(from + way * start, from + way * end)
        };
        let (a, b) = (edge(), edge());
        let found = closest_points_of_segments(a, b);
        let wide = (found.on_a.distance(found.on_b), a.distance(b));
        let (a, b) = (a.cast::<f32>(), b.cast::<f32>());
        let found = closest_points_of_segments(a, b);
        let thin = (found.on_a.distance(found.on_b), a.distance(b));
        assert!((wide.0 - wide.1).abs() < 1e-13, "{a:?} {b:?}: {wide:?}");
        assert!((thin.0 - thin.1).abs() < 1e-4, "{a:?} {b:?}: {thin:?}");
    }
}

/// By the numbers of the circles: the points are on both borders, on one line through the centre, and the shift parts.
#[test]
fn of_circles_with_one_center() {
    let center = Vec2::new(3.0, -4.0);
    let (a, b) = (Circle::new(center, 2.0), Circle::new(center, 5.0));
    let found = distance::closest_points(a, b);
    let (to_a, to_b) = (found.on_a - center, found.on_b - center);
    assert_eq!((to_a.length(), to_b.length()), (2.0, 5.0));
    assert_eq!(to_a.dot(to_b), -10.0);
    assert_eq!(
        (found.on_a - found.on_b).length(),
        -distance::signed_distance(a, b)
    );
}

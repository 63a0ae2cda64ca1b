//! Closest points of shapes of space.
use super::check;
use super::draw::Dice;
use geograd::distance3;
use geograd::{
    Capsule3, Cone, Cylinder, Line3, Obb3, Pack, Pose3, Rotation3, RoundBox3, Segment3, Sphere,
    Tetrahedron, Triangle3, Vec3,
};

fn place(dice: &mut Dice) -> Vec3<f64> {
    Vec3::new(dice.whole(2), dice.whole(2), dice.whole(2))
}

/// A way, seldom none.
fn way(dice: &mut Dice) -> Vec3<f64> {
    match dice.below(6) {
        0 => Vec3::zero(),
        _ => place(dice),
    }
}

/// A way of a length.
fn long(dice: &mut Dice) -> Vec3<f64> {
    let way = place(dice);
    if way == Vec3::zero() {
        Vec3::new(0.0, 0.0, 1.0)
    } else {
        way
    }
}

/// A shape of whole numbers, its centre or one of its corners at a place that others may have, too.
trait Drawn: Copy {
    fn drawn(dice: &mut Dice, at: Vec3<f64>) -> Self;
}
impl Drawn for Vec3<f64> {
    fn drawn(_: &mut Dice, at: Vec3<f64>) -> Self {
        at
    }
}
impl Drawn for Sphere<f64> {
    fn drawn(dice: &mut Dice, at: Vec3<f64>) -> Self {
        Sphere::new(at, dice.length())
    }
}
impl Drawn for Segment3<f64> {
    fn drawn(dice: &mut Dice, at: Vec3<f64>) -> Self {
        Segment3::new(at, at + way(dice))
    }
}
impl Drawn for Capsule3<f64> {
    fn drawn(dice: &mut Dice, at: Vec3<f64>) -> Self {
        Capsule3::new(at, at + way(dice), dice.length())
    }
}
impl Drawn for Line3<f64> {
    fn drawn(dice: &mut Dice, at: Vec3<f64>) -> Self {
        Line3::new(at, long(dice))
    }
}
impl Drawn for Triangle3<f64> {
    fn drawn(dice: &mut Dice, at: Vec3<f64>) -> Self {
        let u = way(dice);
        let v = if dice.below(4) == 0 {
            u * -1.0
        } else {
            way(dice)
        };
        Triangle3::new(at, at + u, at + v)
    }
}
impl Drawn for Tetrahedron<f64> {
    fn drawn(dice: &mut Dice, at: Vec3<f64>) -> Self {
        Tetrahedron::new(at, at + way(dice), at + way(dice), at + way(dice))
    }
}
impl Drawn for Obb3<f64> {
    fn drawn(dice: &mut Dice, at: Vec3<f64>) -> Self {
        let turns = [
            [1.0, 0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0, 1.0],
            [1.0, 1.0, 1.0, 1.0],
        ];
        let [w, x, y, z] = turns[dice.below(3)];
        let size = Vec3::new(dice.length(), dice.length(), dice.length());
        let size = if dice.below(4) == 0 { size * 0.0 } else { size };
        Obb3::new(at, size, Rotation3::new(w, x, y, z))
    }
}
impl Drawn for RoundBox3<f64> {
    fn drawn(dice: &mut Dice, at: Vec3<f64>) -> Self {
        RoundBox3::new(Obb3::drawn(dice, at), dice.length())
    }
}
impl Drawn for Cylinder<f64> {
    fn drawn(dice: &mut Dice, at: Vec3<f64>) -> Self {
        Cylinder::new(at, at + long(dice) * 2.0, dice.length())
    }
}
impl Drawn for Cone<f64> {
    fn drawn(dice: &mut Dice, at: Vec3<f64>) -> Self {
        Cone::new(at, at + long(dice) * 2.0, dice.length())
    }
}

/// Pairs of shapes, as they are and turned, in both orders and formats.
macro_rules! pairs {
    ($dice:expr; $($A:ident $B:ident),*) => { $({
        let dice = &mut *$dice;
        for _ in 0..500 {
            let (at, other) = (place(dice), place(dice));
            let other = if dice.below(2) == 0 { at } else { other };
            let a = <$A<f64> as Drawn>::drawn(dice, at);
            let b = <$B<f64> as Drawn>::drawn(dice, other);
            let still = Rotation3::identity();
            let moved = |shape: $B<f64>, by: Vec3<f64>| Pose3::new(by, still) * shape;
            let back = |shape: $A<f64>, by: Vec3<f64>| Pose3::new(by, still) * shape;
            check!(distance3, a, b, Some(moved), 8, f64);
            check!(distance3, b, a, Some(back), 8, f64);
            let turn = Rotation3::from_yaw(dice.whole(30) * 0.1) * Rotation3::new(0.8, 0.6, 0.0, 0.0);
            let turn = Pose3::new(Vec3::new(dice.whole(9) * 0.1, 0.3, 0.0), turn);
            let (a, b) = (turn * a, turn * b);
            let never = None::<fn($B<f64>, Vec3<f64>) -> $B<f64>>;
            check!(distance3, a, b, never, 8, f64);
            let never = None::<fn($B<f32>, Vec3<f32>) -> $B<f32>>;
            check!(distance3, a.cast::<f32>(), b.cast::<f32>(), never, 8, f32);
            let never = None::<fn($A<f32>, Vec3<f32>) -> $A<f32>>;
            check!(distance3, b.cast::<f32>(), a.cast::<f32>(), never, 8, f32);
        }
    })* };
}

#[test]
fn of_round_shapes_whose_cores_meet() {
    if !geograd_tests::is_due("of_round_shapes_whose_cores_meet") {
        return;
    }
    let dice = &mut Dice(0x1234_5678_9abc_def1);
    pairs!(dice;
        Vec3 Sphere, Vec3 Capsule3, Sphere Sphere, Sphere Segment3, Sphere Capsule3, Sphere Triangle3, Sphere Tetrahedron,
        Sphere Obb3, Segment3 Capsule3, Capsule3 Capsule3, Capsule3 Triangle3, Capsule3 Obb3, Vec3 RoundBox3,
        Capsule3 RoundBox3);
}

#[test]
fn of_bodies_that_overlap_touch_or_are_flat() {
    if !geograd_tests::is_due("of_bodies_that_overlap_touch_or_are_flat") {
        return;
    }
    let dice = &mut Dice(0xabcd_5678_9abc_def1);
    pairs!(dice;
        Segment3 Triangle3, Segment3 Obb3, Triangle3 Triangle3, Triangle3 Tetrahedron, Triangle3 Obb3,
        Tetrahedron Tetrahedron, Tetrahedron Obb3, Obb3 Obb3);
}

#[test]
fn of_balls_on_an_axis() {
    let dice = &mut Dice(0x7654_5678_9abc_def1);
    pairs!(dice; Vec3 Cylinder, Vec3 Cone, Sphere Cylinder, Sphere Cone, Sphere Line3);
}

/// By the numbers of the capsules: their axes cross in one point, and both directions across them part them.
#[test]
fn of_capsules_whose_axes_cross() {
    let meet = Vec3::new(1.0, 2.0, 3.0);
    let (u, v) = (Vec3::new(4.0, 0.0, 0.0), Vec3::new(1.0, 2.0, 0.0));
    let a = Capsule3::new(meet - u, meet + u, 2.0);
    let b = Capsule3::new(meet - v, meet + v, 0.5);
    let found = distance3::closest_points(a, b);
    let (to_a, to_b) = (found.on_a - meet, found.on_b - meet);
    assert_eq!((to_a.length(), to_b.length()), (2.0, 0.5));
    assert_eq!(to_a.dot(to_b), -1.0);
    assert_eq!(
        [to_a.dot(u), to_a.dot(v), to_b.dot(u), to_b.dot(v)],
        [0.0; 4]
    );
}

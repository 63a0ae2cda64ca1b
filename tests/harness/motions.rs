//! Motions of the plane and of space: what they do to numbers, and that false invariances are refused.
use geograd::ad::check::symmetry::{moved_by, velocity};
use geograd::check::*;
use geograd::convention::KittiBox;
use geograd::kernels::verbs::{Convert, Distance, GiouAabb, Iou, IouBev, Wasserstein};
use geograd::kernels::{Op, RowOf};
use geograd::{
    Aabb3, Fixed, Obb3, Plane3, Pose3, Rotation3, Shape, Vec2, Vec3, YawBox3, operation,
};
use std::f64::consts::{PI, TAU};

const TRANSLATIONS: [Motion; 3] = [
    Motion::TranslationX,
    Motion::TranslationY,
    Motion::TranslationZ,
];
const ROTATIONS: [Motion; 3] = [Motion::RotationX, Motion::RotationY, Motion::Rotation];

/// A place with an axis times an angle.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
pub struct Turned<S> {
    pub place: Vec3<S>,
    #[shape(rotation_vector)]
    pub turn: Vec3<S>,
}

/// The motion of the world, as a pose.
fn pose_of(motion: Motion, amount: f64) -> Pose3<f64> {
    let at = |axis: usize| Vec3::load(&[0, 1, 2].map(|i| f64::from(u8::from(i == axis))));
    let still = Rotation3::identity();
    if let Some(axis) = TRANSLATIONS.iter().position(|m| *m == motion) {
        return Pose3::new(at(axis) * amount, still);
    }
    let axis = ROTATIONS.iter().position(|m| *m == motion);
    let axis = axis.expect("shifts and turns only");
    Pose3::new(Vec3::zero(), Rotation3::from_axis_angle(at(axis), amount))
}

/// The shape, moved as its numbers say.
fn moved<X: Sample>(motion: Motion, amount: f64, shape: &X) -> X {
    shape.refill(&moved_by(motion, amount, &shape.kinds(), &shape.scalars()))
}

#[track_caller]
fn near(a: &[Vec3<f64>], b: &[Vec3<f64>]) {
    for (a, b) in a.iter().zip(b) {
        assert!(
            (*a - *b).length() < 1e-9 * (1.0 + a.length()),
            "{a:?} {b:?}"
        );
    }
}

/// Random shapes, turned and shifted by amounts of both signs.
fn each<X: Sample>(motions: &[Motion], mut check: impl FnMut(X, Motion, f64)) {
    let mut draw = Draw::new(11);
    for _ in 0..100 {
        for &motion in motions {
            check(X::ordinary(&mut draw), motion, draw.within(-3.0, 3.0));
        }
    }
}

#[test]
fn shapes_move_as_their_numbers_say() {
    let all = [TRANSLATIONS, ROTATIONS].concat();
    each(&all, |shape: Obb3<f64>, motion, amount| {
        let there = pose_of(motion, amount);
        let wanted = shape.corners().map(|corner| there * corner);
        near(&moved(motion, amount, &shape).corners(), &wanted);
    });
    each(&all, |pose: Pose3<f64>, motion, amount| {
        let point = Vec3::new(0.3, -0.7, 1.1);
        let wanted = pose_of(motion, amount) * (pose * point);
        near(&[moved(motion, amount, &pose) * point], &[wanted]);
    });
    each(&all, |plane: Plane3<f64>, motion, amount| {
        let (there, point) = (pose_of(motion, amount), Vec3::new(0.3, -0.7, 1.1));
        let on = plane.project(point);
        let apart = moved(motion, amount, &plane).signed_distance(there * on);
        assert!(apart.abs() < 1e-9, "{plane:?} {motion:?}: {apart}");
    });
    each(&all, |shape: Turned<f64>, motion, amount| {
        let pose = |shape: Turned<f64>| {
            Pose3::new(shape.place, Rotation3::from_rotation_vector(shape.turn))
        };
        let point = Vec3::new(0.3, -0.7, 1.1);
        let wanted = pose_of(motion, amount) * (pose(shape) * point);
        near(&[pose(moved(motion, amount, &shape)) * point], &[wanted]);
    });
    let upright = [
        TRANSLATIONS[0],
        TRANSLATIONS[1],
        TRANSLATIONS[2],
        Motion::Rotation,
    ];
    each(&upright, |shape: YawBox3<f64>, motion, amount| {
        let there = pose_of(motion, amount);
        let wanted = shape.corners().map(|corner| there * corner);
        near(&moved(motion, amount, &shape).corners(), &wanted);
    });
    // The camera's y axis points down: to the world's −z.
    each(
        &[Motion::RotationY],
        |shape: KittiBox<f64>, motion, amount| {
            let there = pose_of(Motion::Rotation, -amount);
            let wanted = YawBox3::from(shape).corners().map(|corner| there * corner);
            near(
                &YawBox3::from(moved(motion, amount, &shape)).corners(),
                &wanted,
            );
        },
    );
}

#[test]
fn velocities_are_those_of_finite_motions() {
    fn check<X: Sample>(shape: &X) {
        let (x, kinds) = (shape.scalars(), shape.kinds());
        let all = [&TRANSLATIONS[..], &ROTATIONS, &[Motion::Scaling]].concat();
        for motion in all {
            let still = f64::from(u8::from(motion == Motion::Scaling));
            let step = 1e-5;
            let [behind, ahead] = [-step, step].map(|h| moved_by(motion, still + h, &kinds, &x));
            let speed = velocity(motion, &kinds, &x);
            for i in 0..x.len() {
                let found = (ahead[i] - behind[i]) / (2.0 * step);
                // Near a pole differences are only as good as its curvature.
                let tolerance = 1e-7 * (1.0 + speed[i].abs()).powi(3);
                assert!(
                    (found - speed[i]).abs() < tolerance,
                    "{shape:?} {motion:?} {i}: {found} {}",
                    speed[i]
                );
            }
        }
    }
    let mut draw = Draw::new(5);
    for _ in 0..50 {
        check(&Obb3::ordinary(&mut draw));
        check(&YawBox3::ordinary(&mut draw));
        check(&Plane3::ordinary(&mut draw));
        check(&(Vec2::ordinary(&mut draw), Pose3::ordinary(&mut draw)));
        // From no rotation to nearly a whole one, on both sides of the series' end.
        for angle in [
            0.0,
            1e-9,
            0.0999,
            0.1001,
            1.0,
            PI - 1e-3,
            PI + 1e-3,
            TAU - 0.1,
        ] {
            let axis: Vec3<f64> = Sample::ordinary(&mut draw);
            let turn = axis * (angle / axis.length());
            check(&Turned { place: axis, turn });
        }
    }
}

/// The declared answers of an item to turns about x, y and z, and to a shift along z.
fn answers<O: Op>() -> [Option<Effect>; 4] {
    let [x, y, z] = ROTATIONS;
    [x, y, z, Motion::TranslationZ].map(|motion| {
        let found = O::DECLARED
            .invariances
            .iter()
            .find(|invariance| invariance.motion == motion);
        found.map(|invariance| invariance.answer)
    })
}

#[test]
fn a_row_turns_as_its_shapes_do() {
    type Two<X> = (X, X);
    let stays = Some(Effect::Stays);
    assert_eq!(answers::<RowOf<Iou, Two<Obb3<f64>>>>(), [stays; 4]);
    assert_eq!(
        answers::<RowOf<Distance, (Vec3<f64>, Obb3<f64>)>>(),
        [stays; 4]
    );
    assert_eq!(answers::<RowOf<Wasserstein, Two<Obb3<f64>>>>(), [stays; 4]);
    let upright = [None, None, stays, stays];
    assert_eq!(answers::<RowOf<Iou, Two<YawBox3<f64>>>>(), upright);
    assert_eq!(answers::<RowOf<IouBev, Two<YawBox3<f64>>>>(), upright);
    assert_eq!(answers::<RowOf<Iou, (YawBox3<f64>, Obb3<f64>)>>(), upright);
    let aligned = [None, None, None, stays];
    assert_eq!(answers::<RowOf<Iou, (Aabb3<f64>, Obb3<f64>)>>(), aligned);
    assert_eq!(answers::<RowOf<GiouAabb, Two<Obb3<f64>>>>(), aligned);
    let follows = Some(Effect::Follows);
    assert_eq!(
        answers::<RowOf<Convert<Obb3<f64>>, YawBox3<f64>>>(),
        [None, None, follows, follows]
    );
    let plane = [None, None, stays, None];
    assert_eq!(answers::<RowOf<Distance, Two<Vec2<f64>>>>(), plane);
}

/// The extents of a box along the axes of the world.
fn extent<S: Scalar>(shape: Obb3<S>) -> Vec3<S> {
    let centred = Obb3::new(Vec3::zero(), shape.size, shape.rotation);
    centred.bounding().size()
}

/// Operations that declare a motion rightly or wrongly.
macro_rules! declared {
    ($($Name:ident: $a:ident: $A:ident, $b:ident: $B:ident, $formula:expr, [$($invariances:tt)*];)*) => {
        $( operation! {
            /// A function of two shapes of space.
            pub $Name = "declared": ($a: $A<S>, $b: $B<S>) -> S { $formula }
            invariances [$($invariances)*]
            jumps Never
            derivative Reverse
        } )*
    };
}
declared! {
    UprightTurnsAboutX: a: Vec3, b: YawBox3, Distance.of(a, b), [RotationX Stays];
    UprightTurnsAboutY: a: Vec3, b: YawBox3, Distance.of(a, b), [RotationY Stays];
    AlignedTurns: a: Vec3, b: Aabb3, Distance.of(a, b), [Rotation Stays];
    HeightStays: a: Vec3, b: Vec3, a.z + b.z, [TranslationZ Stays];
    HeightTurns: a: Vec3, b: Vec3, a.z - b.z, [TranslationZ Stays, Rotation Stays, RotationX Stays];
    RealPartStays: a: Rotation3, b: Rotation3, a.w - b.w, [RotationY Stays];
    // Bounds keep their extent along the axis of a turn, and no other.
    BoundsTurn: a: Obb3, b: Obb3, extent(a).y + extent(b).x, [RotationX Stays];

    BoundsTurnAboutZ: a: Obb3, b: Obb3, extent(a).z - extent(b).z, [Rotation Stays];
    UprightMoves: a: Vec3, b: YawBox3, Distance.of(a, b),
        [TranslationX Stays, TranslationY Stays, TranslationZ Stays, Rotation Stays, Scaling Power(1)];
    HeightFalls: a: Vec3, b: Vec3, a.z - b.z, [TranslationZ Stays, Rotation Stays, Scaling Power(1)];
    AngleBetween: a: Rotation3, b: Rotation3, (a.inverse() * b).normalized().w.squared(),
        [RotationX Stays, RotationY Stays, Rotation Stays, TranslationZ Stays, Scaling Stays];
    PlaneMoves: a: Vec3, b: Plane3, b.signed_distance(a),
        [TranslationX Stays, TranslationY Stays, TranslationZ Stays, RotationX Stays, RotationY Stays, Rotation Stays,
         Scaling Power(1)];
    TurnedMoves: a: Vec3, b: Turned,
        (Rotation3::from_rotation_vector(b.turn).inverse() * (a - b.place)).x,
        [TranslationX Stays, TranslationY Stays, TranslationZ Stays, RotationX Stays, RotationY Stays, Rotation Stays,
         Scaling Power(1)];
}

/// Refused in both formats for a motion, by values and by derivatives, and for nothing else.
macro_rules! refused {
    ($($Name:ident for $($motion:ident)|+;)*) => { $( {
        let motions = [$(Motion::$motion),+];
        for report in Check::of($Name).samples(8).hard(29).run() {
            for motion in motions {
                let name = stringify!($Name);
                assert!(report.refused_for(Reason::MotionBroken(motion)), "{name}\n{report}");
                assert!(report.refused_for(Reason::MotionUnbalanced(motion)), "{name}\n{report}");
            }
            for failure in &report.failures {
                let (Reason::MotionBroken(motion) | Reason::MotionUnbalanced(motion)) =
                    failure.fault.reason
                else {
                    panic!("{report}");
                };
                assert!(motions.contains(&motion), "{report}");
            }
        }
    } )* };
}

#[test]
fn false_invariances_are_refused() {
    refused! {
        UprightTurnsAboutX for RotationX;
        UprightTurnsAboutY for RotationY;
        AlignedTurns for Rotation;
        HeightStays for TranslationZ;
        HeightTurns for RotationX;
        RealPartStays for RotationY;
        BoundsTurn for RotationX;
    }
}

#[test]
fn true_invariances_are_accepted() {
    Check::of(UprightMoves).samples(15).hard(11).assert();
    Check::of(BoundsTurnAboutZ).samples(15).hard(11).assert();
    Check::of(HeightFalls).samples(15).hard(11).assert();
    Check::of(AngleBetween).samples(15).hard(11).assert();
    Check::of(PlaneMoves).samples(15).hard(11).assert();
    Check::of(TurnedMoves).samples(15).hard(11).assert();
}

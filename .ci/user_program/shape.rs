//! A user's program with shapes and a function of its own: batches and programs; its tests run the harness. It runs
//! here without the feature `check`, and is compiled outside the workspace with the feature `gpu`, too.
use geograd::distance::Convex;
use geograd::kernels::op::{Declared, Declares, Jumps};
use geograd::kernels::{Cpu, Fold, One, Op, Skip};
use geograd::{Capsule2, Circle, Error, Obb2, Pose2, Program, Scalar, Shape, Sym, Vec2, Vec3, ad};

/// Two thick links on a base.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
pub struct Arm<S> {
    base: Vec2<S>,
    #[shape(positive)]
    links: [S; 2],
    #[shape(angle)]
    shoulder: S,
    #[shape(number)]
    elbow: S,
    #[shape(positive)]
    thickness: S,
}

/// A round obstacle; its numbers may lie in memory as the compiler likes.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
pub struct Post<S> {
    center: Vec2<S>,
    #[shape(positive)]
    radius: S,
}

impl<S: Scalar> Arm<S> {
    fn links(self) -> [Capsule2<S>; 2] {
        let along = |length| Vec2::new(length, S::zero());
        let shoulder = Pose2::new(self.base, self.shoulder);
        let elbow = shoulder * Pose2::new(along(self.links[0]), self.elbow);
        let ends = [self.base, elbow.translation, elbow * along(self.links[1])];
        [0, 1].map(|i| Capsule2::new(ends[i], ends[i + 1], self.thickness.halved()))
    }
}

geograd::operation! {
    /// How far the arm is from a wall and a post; minus the depth where it is in one of them.
    pub Clearance = "clearance": (arm: Arm<S>, wall: Obb2<S>, post: Post<S>) -> S {
        let disc = Circle::new(post.center, post.radius);
        let [upper, lower] = arm.links().map(|x| x.signed_distance(wall).least(x.signed_distance(disc)));
        upper.least(lower)
    }
    invariances [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1)]
    jumps Never
    derivative Reverse
}

geograd::verb! {
    /// The longest reach of an arm, in the unit of length.
    pub Reach: (arm) => HasReach::reach
}
geograd::operation! {
    /// The sum of the lengths of its links.
    Reach: (arm: Arm<S>) -> S { arm.links[0] + arm.links[1] }
    invariances [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1)]
    jumps Never
    derivative Reverse
}

/// How far a path climbs.
#[derive(Clone, Copy, Debug, Default)]
struct Climb;

impl Declares for Climb {
    const DECLARED: Declared = Declared::new("climb", &[], Jumps::Never);
}

impl Fold for Climb {
    const CLOSED: bool = false;
    type Element<S: Scalar> = Vec3<S>;
    type Context<S: Scalar> = [S; 0];
    type Reference<S: Scalar> = [S; 0];
    type State<S: Scalar> = S;
    type Out<S: Scalar> = S;
    fn reference<S: Scalar>(_: [S; 0], _: &[Vec3<S>]) -> [S; 0] {
        []
    }
    fn empty<S: Scalar>() -> S {
        S::zero()
    }
    fn edge<S: Scalar>(_: [S; 0], _: [S; 0], from: Vec3<S>, to: Vec3<S>) -> S {
        (to.z - from.z).most(S::zero())
    }
    fn join<S: Scalar>(one: S, other: S) -> S {
        one + other
    }
    fn finish<S: Scalar>(_: [S; 0], _: [S; 0], climb: S) -> S {
        climb
    }
}

fn main() -> Result<(), Error> {
    let wall = Obb2::new(0.85, 1.05, 1.1, 0.24, -0.35);
    let (center, base) = (Vec2::new(-0.95, -0.35), Vec2::new(0.0, 0.0));
    let post = Post {
        center,
        radius: 0.34,
    };
    let posture = |i: u16| {
        let (shoulder, elbow) = (0.37 * f64::from(i), 0.61 * f64::from(i));
        Arm {
            base,
            links: [1.0, 0.75],
            shoulder,
            elbow,
            thickness: 0.16,
        }
    };
    let arms: Vec<_> = (0..3000).map(posture).collect();
    let columns = (&arms, One(wall), One(post));
    let (mut values, mut derivatives) = (vec![0.0; arms.len()], arms.clone());
    let targets = (&mut values, (&mut derivatives, Skip, Skip));
    Cpu::new().aligned_into(Clearance.value_grad(), columns, targets)?;

    // The batch says what duals say.
    let scene = (wall, post);
    for i in (0..arms.len()).step_by(100) {
        let (value, (by_arm, _)) = ad::gradient(
            |(arm, (wall, post))| Clearance::eval((arm, wall, post)),
            (arms[i], scene),
        );
        assert_eq!(values[i], value);
        approx(derivatives[i].shoulder, by_arm.shoulder);
        approx(derivatives[i].elbow, by_arm.elbow);
        approx(derivatives[i].links[1], by_arm.links[1]);
    }
    // A verb is a method, too.
    assert_eq!(Cpu::new().aligned(Reach, &arms[..1])?, [arms[0].reach()]);
    // What is not valid is refused by name.
    let flat = Arm {
        thickness: 0.0,
        ..arms[0]
    };
    let refused = Cpu::new().aligned(Clearance, (&[flat], One(wall), One(post)));
    assert!(refused.unwrap_err().to_string().contains("thickness"));

    let program = Program::trace(|x: (Arm<Sym<f32>>, Obb2<_>, Post<_>)| Clearance::eval(x))?;
    assert!(program.wgsl("clearance")?.starts_with("fn clearance("));

    // A fold of its own over points of space.
    let trail = [0.0, 3.0, 2.0, 4.0].map(|z| Vec3::new(z * z, 1.0, z));
    let climbs = Cpu::new().fold(Climb, One([]), &trail, &[0, 2, 4])?;
    assert_eq!(climbs, [3.0, 2.0]);
    let (_, by_vertex) = Cpu::new().fold_vjp(Climb, One([]), &trail, &[0, 2, 4], &[1.0, 1.0])?;
    assert_eq!(
        by_vertex.iter().map(|bar| bar.z).collect::<Vec<_>>(),
        [-1.0, 1.0, -1.0, 1.0]
    );

    let hit = values.iter().filter(|value| **value < 0.0).count();
    println!("{hit} of {} postures collide", arms.len());
    Ok(())
}

fn approx(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-12 * (1.0 + b.abs()), "{a} {b}");
}

#[cfg(test)]
mod tests {
    use super::{Arm, Clearance};
    use geograd::check::*;
    use geograd::kernels::check::check_with;

    #[test]
    fn the_harness_accepts_the_row() {
        let mut plan = Sampling::new(20, 1);
        plan.hard = 40;
        for report in [
            check_with::<Clearance, f64>(&plan),
            check_with::<Clearance, f32>(&plan),
        ] {
            assert!(report.passed(), "{report}");
        }
    }

    #[test]
    fn the_derive_draws_valid_arms() {
        let mut draw = Draw::new(1);
        assert!((0..100).all(|_| Arm::<f64>::draw(&mut draw).inside()));
    }

    #[test]
    fn a_gradient_is_checked_in_a_line() {
        assert_gradient!(|x: f64| x * x, |x: f64| 2.0 * x, at 3.0);
    }
}

//! Lie groups of rotations and of rigid motions: Jacobians, coupled exponential and logarithm, adjoint; two columns of
//! a matrix as coordinates of a rotation.
use crate::shape::{Pose3, Rotation3};
use crate::{Scalar, Vec3};

/// Below this angle in radians coefficients are their power series. Measured in double precision: series and direct
/// formulas are off by less than 5·10⁻¹⁶ of the coefficient, on both sides. In single precision by 7·10⁻⁷.
const SMALL_ANGLE: f64 = 1.0;

/// Returns `Σ c₀ + c₁ u + c₂ u² + …`.
fn series<S: Scalar>(u: S, terms: &[f64]) -> S {
    let mut sum = S::zero();
    for &term in terms.iter().rev() {
        sum = sum * u + S::lit(term);
    }
    sum
}

/// `(-1)ᵏ / (2k + 2)!` for k = 0, 1, …
const B: [f64; 9] = [
    1.0 / 2.0,
    -1.0 / 24.0,
    1.0 / 720.0,
    -1.0 / 40_320.0,
    1.0 / 3_628_800.0,
    -1.0 / 479_001_600.0,
    1.0 / 87_178_291_200.0,
    -1.0 / 20_922_789_888_000.0,
    1.0 / 6_402_373_705_728_000.0,
];
/// `(-1)ᵏ / (2k + 3)!` for k = 0, 1, …
const C: [f64; 9] = [
    1.0 / 6.0,
    -1.0 / 120.0,
    1.0 / 5_040.0,
    -1.0 / 362_880.0,
    1.0 / 39_916_800.0,
    -1.0 / 6_227_020_800.0,
    1.0 / 1_307_674_368_000.0,
    -1.0 / 355_687_428_096_000.0,
    1.0 / 121_645_100_408_832_000.0,
];
/// `|B₂ₖ₊₂| / (2k + 2)!` for k = 0, 1, …, of Bernoulli's numbers.
const D: [f64; 11] = [
    1.0 / 12.0,
    1.0 / 720.0,
    1.0 / 30_240.0,
    1.0 / 1_209_600.0,
    1.0 / 47_900_160.0,
    691.0 / 1_307_674_368_000.0,
    1.0 / 74_724_249_600.0,
    3617.0 / 10_670_622_842_880_000.0,
    43867.0 / 5_109_094_217_170_944_000.0,
    174_611.0 / 802_857_662_698_291_200_000.0,
    77_683.0 / 14_101_100_039_391_805_440_000.0,
];

/// Returns `sin t / t`, `(1 - cos t) / t²` and `(t - sin t) / t³` for the length t of a vector.
fn forward<S: Scalar>(v: Vec3<S>) -> [S; 3] {
    let (u, angle) = (v.length_squared(), v.length());
    let small = angle.below(S::lit(SMALL_ANGLE));
    let near = S::select(small, u, S::zero());
    let c = series(near, &C);
    let (one, far) = (S::one(), S::select(small, S::one(), angle));
    let half = far.halved();
    let (sin, cos) = half.sin_cos();
    let sinc = sin.over(half);
    let full = sinc * cos;
    [
        S::select(small, one - near * c, full),
        S::select(small, series(near, &B), sinc.squared().halved()),
        S::select(small, c, (one - full).over(far.squared())),
    ]
}

/// Returns `(t/2) cot(t/2)` and `(1 - (t/2) cot(t/2)) / t²` for the length t of a vector.
fn backward<S: Scalar>(v: Vec3<S>) -> [S; 2] {
    let (u, angle) = (v.length_squared(), v.length());
    let small = angle.below(S::lit(SMALL_ANGLE));
    let near = S::select(small, u, S::zero());
    let d = series(near, &D);
    let (one, far) = (S::one(), S::select(small, S::one(), angle));
    let half = far.halved();
    let (sin, cos) = half.sin_cos();
    let pole = sin.equals(S::zero());
    let cot = S::select(pole, S::zero(), cos.over(S::select(pole, one, sin)));
    let full = half * cot;
    [
        S::select(small, one - near * d, full),
        S::select(small, d, (one - full).over(far.squared())),
    ]
}

/// Returns `a I + b [v] + c v vᵀ`, column by column.
fn combine<S: Scalar>(v: Vec3<S>, a: S, b: S, c: S) -> [Vec3<S>; 3] {
    let (x, y, z) = (v * (v.x * c), v * (v.y * c), v * (v.z * c));
    let side = v * b;
    [
        Vec3::new(x.x + a, x.y + side.z, x.z - side.y),
        Vec3::new(y.x - side.z, y.y + a, y.z + side.x),
        Vec3::new(z.x + side.y, z.y - side.x, z.z + a),
    ]
}

/// Returns the left Jacobian times a vector.
fn by_left_jacobian<S: Scalar>(v: Vec3<S>, x: Vec3<S>) -> Vec3<S> {
    let [a, b, c] = forward(v);
    x * a + (v.cross(x) * b + v * (v.dot(x) * c))
}

/// Returns the inverse of the left Jacobian times a vector.
fn by_left_jacobian_inverse<S: Scalar>(v: Vec3<S>, x: Vec3<S>) -> Vec3<S> {
    let [a, c] = backward(v);
    x * a - (v.cross(x) * S::lit(0.5) - v * (v.dot(x) * c))
}

impl<S: Scalar> Rotation3<S> {
    /// Returns the left Jacobian of the exponential at a rotation vector, column by column: a small change δ of the
    /// vector turns the rotation by `J δ` radians about the world's axes.
    ///
    /// It is smooth everywhere and singular at whole turns but zero. Source: Solà, Deray and Atchuthan, *A micro Lie
    /// theory for state estimation in robotics*, 2018.
    ///
    /// ```
    /// use geograd::{Rotation3, Vec3};
    /// let (v, step) = (Vec3::new(0.4, -1.0, 2.0), Vec3::new(0.0, 1e-6, 0.0));
    /// let [_, by_y, _] = Rotation3::left_jacobian(v);
    /// let exp = Rotation3::from_rotation_vector;
    /// let turn: Vec3<f64> = (exp(v + step) * exp(v).inverse()).rotation_vector();
    /// assert!(turn.distance(by_y * 1e-6) < 1e-11);
    /// ```
    #[must_use]
    pub fn left_jacobian(v: Vec3<S>) -> [Vec3<S>; 3] {
        let [a, b, c] = forward(v);
        combine(v, a, b, c)
    }
    /// Returns the right Jacobian of the exponential at a rotation vector, column by column: the turn is about the
    /// body's axes. It is the transposed left Jacobian.
    #[must_use]
    pub fn right_jacobian(v: Vec3<S>) -> [Vec3<S>; 3] {
        Self::left_jacobian(-v)
    }
    /// Returns the inverse of the left Jacobian at a rotation vector shorter than 2π, column by column: the derivative
    /// of the logarithm by a small turn about the world's axes.
    ///
    /// It is smooth up to 2π, half turns included. There it has a pole, at which it takes a finite value.
    ///
    /// ```
    /// use geograd::{Rotation3, Vec3};
    /// let v = Vec3::new(0.0, 0.0, std::f64::consts::PI);
    /// let ([x, ..], [inverse, side, _]) = (Rotation3::left_jacobian(v), Rotation3::left_jacobian_inverse(v));
    /// let back = inverse * x.x + side * x.y;
    /// assert!(back.distance(Vec3::new(1.0, 0.0, 0.0)) < 1e-15);
    /// ```
    #[must_use]
    pub fn left_jacobian_inverse(v: Vec3<S>) -> [Vec3<S>; 3] {
        let [a, c] = backward(v);
        combine(v, a, S::lit(-0.5), c)
    }
    /// Returns the inverse of the right Jacobian at a rotation vector shorter than 2π, column by column: the derivative
    /// of the logarithm by a small turn about the body's axes. It is the transposed inverse of the left Jacobian.
    #[must_use]
    pub fn right_jacobian_inverse(v: Vec3<S>) -> [Vec3<S>; 3] {
        Self::left_jacobian_inverse(-v)
    }
    /// Returns the angle in radians between two rotations, in `[0, π]`: that of the turn from one to the other.
    ///
    /// Kinks: equal rotations, with derivative 0, and rotations half a turn apart.
    ///
    /// ```
    /// use geograd::Rotation3;
    /// let (a, b) = (Rotation3::from_yaw(0.5_f64), Rotation3::from_yaw(0.2));
    /// assert!((a.angle_to(b) - 0.3).abs() < 1e-15);
    /// assert!((a.squared_angle_to(b) - 0.09).abs() < 1e-15);
    /// assert_eq!(a.angle_to(a), 0.0);
    /// ```
    #[must_use]
    pub fn angle_to(self, other: Self) -> S {
        (self.inverse() * other).angle()
    }
    /// Returns the square of the angle between two rotations, in `[0, π²]`: smooth but at rotations half a turn apart.
    #[must_use]
    pub fn squared_angle_to(self, other: Self) -> S {
        self.tangent_to(other).length_squared()
    }
    /// Returns the first two columns of the matrix: six coordinates without jumps, as networks learn them.
    #[must_use]
    pub fn to_6d(self) -> [Vec3<S>; 2] {
        let [x, y, _] = self.axes();
        [x, y]
    }
    /// Returns the rotation whose x axis is along the first vector and whose y axis is in the half plane of both: the
    /// inverse of [`to_6d`](Self::to_6d).
    ///
    /// Kinks: at parallel vectors, or a second of zero, the y axis is any that is orthogonal to the first, with
    /// derivative zero by the second; for a first of zero the x axis stays, with derivative zero.
    ///
    /// Source: Zhou et al., *On the continuity of rotation representations in neural networks*, CVPR 2019.
    ///
    /// ```
    /// use geograd::{Rotation3, Vec3};
    /// let turned = Rotation3::from_6d([Vec3::new(0.0, 2.0, 0.0), Vec3::new(-3.0, 1.0, 0.0)]);
    /// assert!(turned.angle_to(Rotation3::from_yaw(std::f64::consts::FRAC_PI_2)) < 1e-15);
    /// ```
    #[must_use]
    pub fn from_6d([x, y]: [Vec3<S>; 2]) -> Self {
        let (zero, one) = (S::zero(), S::one());
        let unit = |v: Vec3<S>| {
            let size = v.x.primal().magnitude();
            let size = size.most(v.y.primal().magnitude());
            let size = size.most(v.z.primal().magnitude());
            let none = size.at_most(S::Primal::zero());
            let scale = S::Primal::select(none, S::Primal::one(), size).binade();
            (v * S::from_primal(scale)).normalize_or_zero()
        };
        let empty = |v: Vec3<S>| v.x.equals(zero) & v.y.equals(zero) & v.z.equals(zero);
        let ex = Vec3::new(one, zero, zero);
        let (ey, ez) = (Vec3::new(zero, one, zero), Vec3::new(zero, zero, one));
        let a = Vec3::select(empty(x), ex, unit(x));
        let side = a.cross(unit(y));
        // The sine of an angle that is rounding only.
        let parallel = side.length().at_most(S::rounding(4.0, 1));
        // The world's axis that is farthest from the first.
        let (ax, ay, az) = (a.x.magnitude(), a.y.magnitude(), a.z.magnitude());
        let other = Vec3::select(ay.at_most(az), ey, ez);
        let other = Vec3::select(ax.at_most(ay) & ax.at_most(az), ex, other);
        let c = Vec3::select(parallel, a.cross(other), side).normalize_or_zero();
        Rotation3::from_axes([a, c.cross(a), c])
    }
}

impl<S: Scalar> Pose3<S> {
    /// Returns the coupled exponential: the motion after one unit of time at constant velocity, a screw, from the turn
    /// as a rotation vector in radians and the shift, in the unit of length.
    ///
    /// [`retract`](Self::retract) turns and shifts apart; it is the default of optimisers. Smooth everywhere.
    ///
    /// ```
    /// use geograd::{Pose3, Vec3};
    /// let half = Vec3::new(0.0, 0.0, std::f64::consts::PI);
    /// let arc = Pose3::from_twist(half, Vec3::new(std::f64::consts::PI, 0.0, 0.0));
    /// assert!(arc.translation.distance(Vec3::new(0.0, 2.0, 0.0)) < 1e-15); // half a circle of radius one
    /// ```
    #[must_use]
    pub fn from_twist(turn: Vec3<S>, shift: Vec3<S>) -> Self {
        Pose3::new(
            by_left_jacobian(turn, shift),
            Rotation3::from_rotation_vector(turn),
        )
    }
    /// Returns the coupled logarithm: the turn, of length 0 to π radians, and the shift of the screw to this motion;
    /// the inverse of [`from_twist`](Self::from_twist).
    ///
    /// Kinks: half turns, as of [`rotation_vector`](Rotation3::rotation_vector).
    ///
    /// ```
    /// use geograd::{Pose3, Rotation3, Vec3};
    /// let pose = Pose3::new(Vec3::new(1.0, 2.0, 3.0), Rotation3::new(0.1_f64, 0.7, -0.2, 0.4));
    /// let (turn, shift) = pose.twist();
    /// assert!(Pose3::from_twist(turn, shift).translation.distance(pose.translation) < 1e-14);
    /// ```
    #[must_use]
    pub fn twist(self) -> (Vec3<S>, Vec3<S>) {
        let turn = self.rotation.rotation_vector();
        (turn, by_left_jacobian_inverse(turn, self.translation))
    }
    /// Returns the adjoint, the 6 by 6 matrix of the motion, times a twist: `a_from_b.adjoint(turn, shift)` is in frame
    /// a the velocity that in frame b is `turn` and `shift`.
    ///
    /// ```
    /// use geograd::{Pose3, Rotation3, Vec3};
    /// let a_from_b = Pose3::new(Vec3::new(1.0, 2.0, 3.0), Rotation3::new(0.1_f64, 0.7, -0.2, 0.4));
    /// let (turn, shift) = (Vec3::new(0.1, -0.4, 0.2), Vec3::new(1.0, 0.5, 0.0));
    /// let in_a = a_from_b.adjoint(turn, shift);
    /// let point = Vec3::new(0.3, 0.2, 0.1);
    /// let there = Pose3::from_twist(in_a.0, in_a.1) * (a_from_b * point);
    /// assert!(there.distance(a_from_b * (Pose3::from_twist(turn, shift) * point)) < 1e-14);
    /// ```
    #[must_use]
    pub fn adjoint(self, turn: Vec3<S>, shift: Vec3<S>) -> (Vec3<S>, Vec3<S>) {
        let turn = self.rotation * turn;
        (turn, self.rotation * shift + self.translation.cross(turn))
    }
    /// Returns the transposed adjoint times a gradient by a twist, or times a moment and a force: `a_from_b` takes them
    /// from frame a to frame b.
    #[must_use]
    pub fn adjoint_transposed(self, by_turn: Vec3<S>, by_shift: Vec3<S>) -> (Vec3<S>, Vec3<S>) {
        let back = self.rotation.inverse();
        let moment = by_turn - self.translation.cross(by_shift);
        (back * moment, back * by_shift)
    }
    /// Returns the gradient by the turn and the shift of [`retract`](Self::retract) at zero, from the gradient by the
    /// seven numbers of the pose.
    ///
    /// A batch returns a column of the former when its function takes the step as an argument of its own:
    ///
    /// ```
    /// use geograd::kernels::function;
    /// use geograd::prelude::*;
    /// let seen = function(|pose: Pose3<_>, [turn, shift]: [Vec3<_>; 2], point: Vec3<_>| {
    ///     (pose.retract(turn, shift) * point).length_squared()
    /// });
    /// let tilted = Rotation3::new(0.9_f64, 0.1, -0.3, 0.2);
    /// let poses = [0.0, 1.0, 2.0].map(|x| Pose3::new(Vec3::new(x, 1.0, 0.0), tilted));
    /// let columns = (&poses, One([Vec3::zero(); 2]), One(Vec3::new(0.5, 0.2, 0.1)));
    /// let (_, (by_pose, by_step, _)) = Cpu::new().aligned(seen.value_grad(), columns)?;
    /// for ((pose, by_pose), [by_turn, by_shift]) in poses.iter().zip(by_pose).zip(by_step) {
    ///     let (turn, shift) = pose.tangent_gradient(by_pose);
    ///     assert!(turn.distance(by_turn) < 1e-14 && shift.distance(by_shift) < 1e-14);
    /// }
    /// # Ok::<(), geograd::Error>(())
    /// ```
    #[must_use]
    pub fn tangent_gradient(self, gradient: Self) -> (Vec3<S>, Vec3<S>) {
        (
            self.rotation.tangent_gradient(gradient.rotation),
            self.rotation.inverse() * gradient.translation,
        )
    }
}

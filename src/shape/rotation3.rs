//! Rotations of space.
use crate::{Scalar, Shape, Vec3};
use std::ops::Mul;

/// A rotation of space as a quaternion `w + x i + y j + z k` of any length except zero. All functions divide by its
/// length, so that derivatives by the four numbers are those of the direction alone. A quaternion and its negative give
/// one rotation.
///
/// Optimisers that step in the four numbers need nothing else. Others step in three and use the *body tangent*:
/// the rotation vector, in the body's own axes, of a small turn applied first. Gradients go from one to the other
/// with [`tangent_gradient`](Self::tangent_gradient), steps with [`retract`](Self::retract).
///
/// The zero quaternion is not valid; it acts as no rotation, with derivative zero.
///
/// ```
/// use geograd::{Rotation3, Vec3};
/// let quarter = Rotation3::from_axis_angle(Vec3::new(0.0, 0.0, 2.0), std::f64::consts::FRAC_PI_2);
/// assert!((quarter * Vec3::new(1.0, 0.0, 5.0)).distance(Vec3::new(0.0, 1.0, 5.0)) < 1e-15);
/// assert!((quarter * quarter.inverse()).angle() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(non_zero)]
#[repr(C)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rotation3<S> {
    /// The real part.
    #[shape(kind = "QuaternionW")]
    pub w: S,
    /// The part along x.
    #[shape(kind = "QuaternionX")]
    pub x: S,
    /// The part along y.
    #[shape(kind = "QuaternionY")]
    pub y: S,
    /// The part along z.
    #[shape(kind = "QuaternionZ")]
    pub z: S,
}

/// Below this angle in radians, exponential and logarithm are their power series: four terms are then
/// exact in double precision.
const SMALL_ANGLE: f64 = 0.03;

impl<S> Rotation3<S> {
    /// Creates a rotation from the four numbers of a quaternion, unchecked.
    #[inline(always)]
    pub const fn new(w: S, x: S, y: S, z: S) -> Self {
        Rotation3 { w, x, y, z }
    }
}

impl<S: Scalar> Rotation3<S> {
    /// Returns the rotation by zero.
    #[inline(always)]
    pub fn identity() -> Self {
        let zero = S::zero();
        Rotation3::new(S::one(), zero, zero, zero)
    }
    /// Returns the vector part.
    #[must_use]
    #[inline(always)]
    pub fn vector(self) -> Vec3<S> {
        Vec3::new(self.x, self.y, self.z)
    }
    /// Returns the quaternion of length one; no rotation (with derivative zero) for the zero quaternion.
    #[must_use]
    #[inline(always)]
    pub fn normalized(self) -> Self {
        let size = self.w.primal().magnitude();
        let size = size.most(self.x.primal().magnitude());
        let size = size.most(self.y.primal().magnitude());
        let size = size.most(self.z.primal().magnitude());
        let zero = size.at_most(S::Primal::zero());
        let scale = S::from_primal(S::Primal::select(zero, S::Primal::one(), size).binade());
        let (none, one) = (S::zero(), S::one());
        let w = S::select(zero, one, self.w * scale);
        let x = S::select(zero, none, self.x * scale);
        let y = S::select(zero, none, self.y * scale);
        let z = S::select(zero, none, self.z * scale);
        let length = ((w * w + x * x) + (y * y + z * z)).root();
        Rotation3::new(
            w.over(length),
            x.over(length),
            y.over(length),
            z.over(length),
        )
    }
    /// Returns this rotation as a quaternion of length one with `w ≥ 0`. If `w = 0`, the first of x, y and z that is
    /// not zero is positive.
    #[must_use]
    #[inline(always)]
    pub fn canonical(self) -> Self {
        let unit = self.normalized();
        let zero = S::zero();
        let y_decides = unit.y.below(zero) | (unit.y.equals(zero) & unit.z.below(zero));
        let x_decides = unit.x.below(zero) | (unit.x.equals(zero) & y_decides);
        let flip = unit.w.below(zero) | (unit.w.equals(zero) & x_decides);
        let turn = |x: S| S::select(flip, -x, x).canonical();
        Rotation3::new(turn(unit.w), turn(unit.x), turn(unit.y), turn(unit.z))
    }
    /// Creates the rotation by an angle in radians about an axis of any length, counter-clockwise when the axis points
    /// at the viewer; no rotation for the zero axis.
    #[must_use]
    #[inline]
    pub fn from_axis_angle(axis: Vec3<S>, angle: S) -> Self {
        let axis = axis.normalize_or_zero();
        let zero = axis.length_squared().at_most(S::zero());
        let (sin, cos) = angle.halved().sin_cos();
        Rotation3::new(
            S::select(zero, S::one(), cos),
            axis.x * sin,
            axis.y * sin,
            axis.z * sin,
        )
    }
    /// Creates the rotation about the z axis by an angle in radians, counter-clockwise seen from above.
    #[must_use]
    #[inline(always)]
    pub fn from_yaw(angle: S) -> Self {
        let (sin, cos) = angle.halved().sin_cos();
        Rotation3::new(cos, S::zero(), S::zero(), sin)
    }
    /// Returns the exponential: the rotation about the vector by its length in radians. Smooth everywhere; near
    /// zero it is a power series.
    #[must_use]
    #[inline]
    pub fn from_rotation_vector(v: Vec3<S>) -> Self {
        let angle = v.length();
        let small = angle.below(S::lit(SMALL_ANGLE));
        // cos(θ/2) and sin(θ/2)/θ in powers of θ².
        let u = v.length_squared();
        let cos_series = S::one()
            - u * (S::lit(1.0 / 8.0)
                - u * (S::lit(1.0 / 384.0)
                    - u * (S::lit(1.0 / 46080.0) - u * S::lit(1.0 / 10_321_920.0))));
        let sin_series = S::lit(0.5)
            - u * (S::lit(1.0 / 48.0)
                - u * (S::lit(1.0 / 3840.0)
                    - u * (S::lit(1.0 / 645_120.0) - u * S::lit(1.0 / 185_794_560.0))));
        let safe = S::select(small, S::one(), angle);
        let (sin, cos) = safe.halved().sin_cos();
        let per_angle = S::select(small, sin_series, sin.over(safe));
        let w = S::select(small, cos_series, cos);
        Rotation3::new(w, v.x * per_angle, v.y * per_angle, v.z * per_angle)
    }
    /// Returns the logarithm: the axis times the angle in radians, of length 0 to π. Smooth but at half turns,
    /// where the axis jumps to its opposite; there the first of its coordinates that is not zero is
    /// positive.
    #[must_use]
    #[inline]
    pub fn rotation_vector(self) -> Vec3<S> {
        let unit = self.canonical();
        let v = unit.vector();
        let sin = v.length();
        let small = sin.below(S::lit(SMALL_ANGLE / 2.0));
        // 2 atan(t)/sin with t = sin/cos: 2/cos (1 − t²/3 + t⁴/5 − …).
        let cos = S::select(small, unit.w, S::one());
        let u = v.length_squared().over(cos * cos);
        let series = S::one()
            - u * (S::lit(1.0 / 3.0)
                - u * (S::lit(0.2)
                    - u * (S::lit(1.0 / 7.0) - u * (S::lit(1.0 / 9.0) - u * S::lit(1.0 / 11.0)))));
        let series = (series + series).over(cos);
        let safe = S::select(small, S::one(), sin);
        let half = safe.atan2(unit.w);
        v * S::select(small, series, (half + half).over(safe))
    }
    /// Returns the angle in radians, in `[0, π]`; derivative zero at no rotation.
    #[must_use]
    #[inline]
    pub fn angle(self) -> S {
        let unit = self.canonical();
        let half = unit.vector().length().atan2(unit.w);
        half + half
    }
    /// Returns the images of the axes x, y and z: the columns of the matrix.
    #[must_use]
    #[inline(always)]
    pub fn axes(self) -> [Vec3<S>; 3] {
        let q = self.normalized();
        let (x2, y2, z2) = (q.x + q.x, q.y + q.y, q.z + q.z);
        let (xx, yy, zz) = (q.x * x2, q.y * y2, q.z * z2);
        let (xy, xz, yz) = (q.x * y2, q.x * z2, q.y * z2);
        let (wx, wy, wz) = (q.w * x2, q.w * y2, q.w * z2);
        let one = S::one();
        [
            Vec3::new(one - (yy + zz), xy + wz, xz - wy),
            Vec3::new(xy - wz, one - (xx + zz), yz + wx),
            Vec3::new(xz + wy, yz - wx, one - (xx + yy)),
        ]
    }
    /// Returns the matrix, row by row: `m[i][j]` is coordinate i of the image of axis j.
    #[must_use]
    #[inline(always)]
    pub fn matrix(self) -> [[S; 3]; 3] {
        let [x, y, z] = self.axes();
        [[x.x, y.x, z.x], [x.y, y.y, z.y], [x.z, y.z, z.z]]
    }
    /// Creates the rotation from the images of the axes: a quaternion of length one if they are orthonormal and
    /// right-handed, else a quaternion of a rotation near them.
    ///
    /// The largest of the four numbers is found first and the others follow from it, so that no
    /// rotation loses digits and none has a kink but the choice of the sign.
    #[must_use]
    #[inline]
    pub fn from_axes([a, b, c]: [Vec3<S>; 3]) -> Self {
        // Four times the squares of w, x, y and z.
        let one = S::one();
        let w4 = (one + a.x) + (b.y + c.z);
        let x4 = (one + a.x) - (b.y + c.z);
        let y4 = (one - a.x) + (b.y - c.z);
        let z4 = (one - a.x) - (b.y - c.z);
        // Four times the products of two of them.
        let (wx, wy, wz) = (b.z - c.y, c.x - a.z, a.y - b.x);
        let (xy, xz, yz) = (a.y + b.x, c.x + a.z, b.z + c.y);
        // Each row is four times the quaternion times one of its numbers; any of them will do.
        let pick = |mask: S::Mask, yes: [S; 4], no: [S; 4]| {
            [
                S::select(mask, yes[0], no[0]),
                S::select(mask, yes[1], no[1]),
                S::select(mask, yes[2], no[2]),
                S::select(mask, yes[3], no[3]),
            ]
        };
        let (by_w, by_x) = ([w4, wx, wy, wz], [wx, x4, xy, xz]);
        let (by_y, by_z) = ([wy, xy, y4, yz], [wz, xz, yz, z4]);
        let first = pick(x4.above(w4), by_x, by_w);
        let second = pick(z4.above(y4), by_z, by_y);
        let (one, other) = (x4.most(w4), z4.most(y4));
        let [w, x, y, z] = pick(other.above(one), second, first);
        Rotation3::new(w, x, y, z).normalized()
    }
    /// Creates the rotation from a matrix, row by row: see [`from_axes`](Self::from_axes).
    #[must_use]
    #[inline]
    pub fn from_matrix(m: [[S; 3]; 3]) -> Self {
        let column = |j: usize| Vec3::new(m[0][j], m[1][j], m[2][j]);
        Self::from_axes([column(0), column(1), column(2)])
    }
    /// Returns the rotation back.
    #[must_use]
    #[inline(always)]
    pub fn inverse(self) -> Self {
        Rotation3::new(self.w, -self.x, -self.y, -self.z)
    }
    /// Returns the rotation a fraction `t` of the way to another one, along the shorter arc and at even speed. Kink:
    /// rotations half a turn apart, where both arcs are equally long.
    #[must_use]
    #[inline]
    pub fn interpolate(self, other: Self, t: S) -> Self {
        self.retract(self.tangent_to(other) * t)
    }
    /// Returns the rotation after a small turn about the body's own axes, as a rotation vector: the step of an
    /// optimiser in three numbers.
    ///
    /// ```
    /// use geograd::{Rotation3, Vec3};
    /// let (here, there) = (Rotation3::from_yaw(0.3), Rotation3::new(0.9, 0.1, -0.3, 0.2));
    /// let step: Vec3<f64> = here.tangent_to(there);
    /// assert!(here.retract(step).tangent_to(there).length() < 1e-15);
    /// ```
    #[must_use]
    #[inline]
    pub fn retract(self, tangent: Vec3<S>) -> Self {
        self * Rotation3::from_rotation_vector(tangent)
    }
    /// Returns the small turn about the body's own axes that leads to another rotation: the inverse of
    /// [`retract`](Self::retract).
    #[must_use]
    #[inline]
    pub fn tangent_to(self, other: Self) -> Vec3<S> {
        (self.inverse() * other).rotation_vector()
    }
    /// Returns the gradient by the body tangent from the gradient by the four numbers (of any function of the
    /// rotation): `½ ⟨gradient, q e⟩` for e = i, j, k.
    ///
    /// ```
    /// use geograd::{Jet, Rotation3, Vec3};
    /// let q = Rotation3::new(0.8_f64, 0.1, -0.3, 0.4);
    /// let up = |q: Rotation3<Jet<f64, 4>>| q.axes()[0].z; // how far the body's x axis looks up
    /// let derivatives = up(Rotation3::new(
    ///     Jet::variable(q.w, 0),
    ///     Jet::variable(q.x, 1),
    ///     Jet::variable(q.y, 2),
    ///     Jet::variable(q.z, 3),
    /// ))
    /// .derivative;
    /// let tangent = q.tangent_gradient(Rotation3::new(derivatives[0], derivatives[1], derivatives[2], derivatives[3]));
    /// assert!(tangent.x.abs() < 1e-15); // turning about its own x axis does not move it
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn tangent_gradient(self, gradient: Self) -> Vec3<S> {
        let (q, g) = (self, gradient);
        Vec3::new(
            ((g.x * q.w - g.w * q.x) + (g.y * q.z - g.z * q.y)).halved(),
            ((g.y * q.w - g.w * q.y) + (g.z * q.x - g.x * q.z)).halved(),
            ((g.z * q.w - g.w * q.z) + (g.x * q.y - g.y * q.x)).halved(),
        )
    }
    /// Returns the gradient by the four numbers from the gradient by the body tangent: the inverse of
    /// [`tangent_gradient`](Self::tangent_gradient) among gradients that do not change the length.
    #[must_use]
    #[inline(always)]
    pub fn quaternion_gradient(self, tangent: Vec3<S>) -> Self {
        let (w, x, y, z) = (self.w, self.x, self.y, self.z);
        let norm = (w * w + x * x) + (y * y + z * z);
        let zero = norm.at_most(S::zero());
        let per = S::lit(2.0).over(S::select(zero, S::one(), norm));
        let per = S::select(zero, S::zero(), per);
        let t = tangent * per;
        Rotation3::new(
            -((x * t.x + y * t.y) + z * t.z),
            (w * t.x + y * t.z) - z * t.y,
            (w * t.y + z * t.x) - x * t.z,
            (w * t.z + x * t.y) - y * t.x,
        )
    }
}

impl<S: Scalar> Mul for Rotation3<S> {
    type Output = Self;
    /// Returns the rotation that turns by `other` first, then by `self`; of length one.
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.normalized(), other.normalized());
        Rotation3::new(
            (a.w * b.w - a.x * b.x) - (a.y * b.y + a.z * b.z),
            (a.w * b.x + a.x * b.w) + (a.y * b.z - a.z * b.y),
            (a.w * b.y + a.y * b.w) + (a.z * b.x - a.x * b.z),
            (a.w * b.z + a.z * b.w) + (a.x * b.y - a.y * b.x),
        )
    }
}

impl<S: Scalar> Mul<Vec3<S>> for Rotation3<S> {
    type Output = Vec3<S>;
    #[inline]
    fn mul(self, v: Vec3<S>) -> Vec3<S> {
        let q = self.normalized();
        // v + 2 w (u × v) + 2 u × (u × v)
        let side = q.vector().cross(v);
        let side = side + side;
        v + (side * q.w + q.vector().cross(side))
    }
}

impl<S: std::fmt::Display> std::fmt::Display for Rotation3<S> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("(")?;
        self.w.fmt(f)?;
        f.write_str("; ")?;
        self.x.fmt(f)?;
        f.write_str(", ")?;
        self.y.fmt(f)?;
        f.write_str(", ")?;
        self.z.fmt(f)?;
        f.write_str(")")
    }
}

//! Rotations of space as three angles.
use crate::Scalar;
use crate::shape::Rotation3;

/// The axes that three angles turn about, in order: each turns about an axis of the body as the previous turns have
/// left it (intrinsic). Read backwards, a name gives turns about fixed axes: `Zyx` is yaw, pitch, roll.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the names say it")]
pub enum EulerOrder {
    Xyz,
    Xzy,
    Yxz,
    Yzx,
    Zxy,
    Zyx,
    Xyx,
    Xzx,
    Yxy,
    Yzy,
    Zxz,
    Zyz,
}

impl EulerOrder {
    /// All twelve.
    pub const ALL: [EulerOrder; 12] = [
        EulerOrder::Xyz,
        EulerOrder::Xzy,
        EulerOrder::Yxz,
        EulerOrder::Yzx,
        EulerOrder::Zxy,
        EulerOrder::Zyx,
        EulerOrder::Xyx,
        EulerOrder::Xzx,
        EulerOrder::Yxy,
        EulerOrder::Yzy,
        EulerOrder::Zxz,
        EulerOrder::Zyz,
    ];
    /// Returns the three axes: 0 is x, 1 is y, 2 is z.
    #[must_use]
    pub const fn axes(self) -> [usize; 3] {
        match self {
            EulerOrder::Xyz => [0, 1, 2],
            EulerOrder::Xzy => [0, 2, 1],
            EulerOrder::Yxz => [1, 0, 2],
            EulerOrder::Yzx => [1, 2, 0],
            EulerOrder::Zxy => [2, 0, 1],
            EulerOrder::Zyx => [2, 1, 0],
            EulerOrder::Xyx => [0, 1, 0],
            EulerOrder::Xzx => [0, 2, 0],
            EulerOrder::Yxy => [1, 0, 1],
            EulerOrder::Yzy => [1, 2, 1],
            EulerOrder::Zxz => [2, 0, 2],
            EulerOrder::Zyz => [2, 1, 2],
        }
    }
}

impl<S: Scalar> Rotation3<S> {
    /// Creates a rotation from three angles in radians about the axes that the order names.
    ///
    /// ```
    /// use geograd::{EulerOrder, Rotation3};
    /// let car = Rotation3::from_euler(EulerOrder::Zyx, [0.5_f64, 0.1, -0.2]); // yaw, pitch, roll
    /// let [yaw, pitch, roll] = car.euler(EulerOrder::Zyx);
    /// assert!((yaw - 0.5).abs() < 1e-15 && (pitch - 0.1).abs() < 1e-15 && (roll + 0.2).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn from_euler(order: EulerOrder, angles: [S; 3]) -> Self {
        let [i, j, k] = order.axes();
        let turn = |axis: usize, angle: S| {
            let (sin, cos) = angle.halved().sin_cos();
            let along = |n: usize| if n == axis { sin } else { S::zero() };
            Rotation3::new(cos, along(0), along(1), along(2))
        };
        turn(i, angles[0]) * turn(j, angles[1]) * turn(k, angles[2])
    }
    /// Returns three angles in radians about the axes that the order names: the first and the third in `[−π, π]`, the
    /// middle one in `[−π/2, π/2]`, or `[0, π]` where the first and the third axis are equal.
    ///
    /// Kinks: at either end of the middle angle's range (gimbal lock) only the sum or the difference of
    /// the others is determined; they share it equally.
    ///
    /// Source: Bernardes and Viollet, *Quaternion to Euler angles conversion: a direct, general and
    /// computationally efficient method*, PLoS ONE 2022.
    #[must_use]
    pub fn euler(self, order: EulerOrder) -> [S; 3] {
        let unit = self.normalized();
        let at = [unit.x, unit.y, unit.z];
        // The source turns about fixed axes: these are the angles in reverse order.
        let [k, j, i] = order.axes();
        let symmetric = i == k;
        let k = if symmetric { 3 - i - j } else { k };
        let odd = (j + 3 - i) % 3 != 1;
        let third = if odd { -at[k] } else { at[k] };
        let (a, b, c, d) = if symmetric {
            (unit.w, at[i], at[j], third)
        } else {
            (unit.w - at[j], at[i] + third, at[j] + unit.w, third - at[i])
        };
        let middle = c.hypot(d).atan2(a.hypot(b));
        let middle = middle + middle;
        let (half_sum, half_difference) = (b.atan2(a), d.atan2(c));
        let first = half_sum - half_difference;
        let last = half_sum + half_difference;
        let (middle, last) = if symmetric {
            (middle, last)
        } else {
            let last = if odd { -last } else { last };
            (middle - S::lit(std::f64::consts::FRAC_PI_2), last)
        };
        [wrap(last), middle, wrap(first)]
    }
}

/// Returns an angle of `(−2π, 2π)` in radians, brought to `[−π, π]`.
fn wrap<S: Scalar>(angle: S) -> S {
    let (pi, turn) = (
        S::lit(std::f64::consts::PI),
        S::lit(2.0 * std::f64::consts::PI),
    );
    let angle = S::select(angle.above(pi), angle - turn, angle);
    S::select(angle.below(-pi), angle + turn, angle)
}

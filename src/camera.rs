//! Cameras: images of points in the camera's frame, whose z axis looks ahead, x to the right and y down.
//!
//! A camera sees the points of its domain; beyond it lenses map two points to one pixel. `project` returns finite
//! pixels for points beyond, too, the principal point for some: `sees` tells which pixels to use. Poses take points of
//! the world to the camera: `camera.project(camera_from_world * point)`.
//!
//! ```
//! use geograd::camera::Pinhole;
//! use geograd::prelude::*;
//! let camera = Pinhole::new(Vec2::new(500.0, 500.0), Vec2::new(320.0, 240.0));
//! let points = [Vec3::new(0.2_f64, -0.1, 2.0), Vec3::new(0.0, 0.0, 4.0)];
//! let pixels = Cpu::new().aligned(Project, (&points, One(camera)))?;
//! assert_eq!(pixels, [Vec2::new(370.0, 215.0), Vec2::new(320.0, 240.0)]);
//! # Ok::<(), geograd::Error>(())
//! ```
use crate::{Scalar, Shape, Vec2, Vec3};

/// A pinhole camera: no distortion.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
pub struct Pinhole<S> {
    /// The focal length in pixels, along x and y.
    #[shape(names("fx", "fy"), positive)]
    pub focal: Vec2<S>,
    /// The principal point in pixels.
    #[shape(names("cx", "cy"))]
    pub center: Vec2<S>,
}

/// A camera with radial and tangential distortion (Brown 1966, Conrady 1919).
///
/// The coefficients are OpenCV's, in the order k₁, k₂, k₃, p₁, p₂; [`from_opencv`](BrownConrady::from_opencv) reads its
/// vector, which has the tangential ones before k₃.
///
/// The undistorted image `(x, y)`, of length r, becomes
/// `(x, y) (1 + k₁ r² + k₂ r⁴ + k₃ r⁶) + (2 p₁ x y + p₂ (r² + 2 x²), p₁ (r² + 2 y²) + 2 p₂ x y)`.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
pub struct BrownConrady<S> {
    /// The camera without distortion.
    pub pinhole: Pinhole<S>,
    /// The radial coefficients k₁, k₂ and k₃: numbers 1, 2 and 5 of OpenCV's vector.
    pub radial: [S; 3],
    /// The tangential coefficients p₁ and p₂: numbers 3 and 4 of OpenCV's vector.
    pub tangential: [S; 2],
}

/// A fisheye camera (Kannala and Brandt 2006): the distance from the centre of the image is
/// `θ (1 + k₁ θ² + k₂ θ⁴ + k₃ θ⁶ + k₄ θ⁸)` for the angle θ in radians between the point and the axis.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
pub struct Fisheye<S> {
    /// The camera without distortion.
    pub pinhole: Pinhole<S>,
    /// The coefficients k₁ to k₄.
    pub radial: [S; 4],
}

/// Returns `1 + k₁ u + k₂ u² + …`.
fn polynomial<S: Scalar, const N: usize>(u: S, k: [S; N]) -> S {
    let mut sum = S::zero();
    for i in (0..N).rev() {
        sum = (sum + k[i]) * u;
    }
    sum + S::one()
}

/// Returns `true` only where `1 + 3 k₁ u + 5 k₂ u² + …` is positive from zero to u: there `r (1 + k₁ r² + …)`
/// increases.
///
/// Bernstein's coefficients bound a polynomial on each of sixteen parts; the answer may be `false` close to a turn.
fn increases<S: Scalar, const N: usize>(u: S, k: [S; N]) -> S::Mask {
    const PARTS: usize = 16;
    let mut all = S::zero().at_most(S::zero());
    let share = u * S::lit(1.0 / PARTS as f64);
    for part in 0..PARTS {
        // The polynomial in t from 0 to 1 on this part, by Horner's shift.
        let mut terms = [S::zero(); 5];
        terms[0] = S::one();
        let mut power = S::one();
        for i in 0..N {
            power *= share;
            terms[i + 1] = k[i] * S::lit((2 * i + 3) as f64) * power;
        }
        for i in 0..N {
            for j in (i..N).rev() {
                let above = terms[j + 1];
                terms[j] += above * S::lit(part as f64);
            }
        }
        // b_j = Σ C(j, i) / C(N, i) a_i
        for j in 0..=N {
            let (mut sum, mut ratio) = (S::zero(), 1.0);
            for (i, &term) in terms.iter().enumerate().take(j + 1) {
                sum += term * S::lit(ratio);
                ratio *= (j - i) as f64 / (N - i).max(1) as f64;
            }
            all = all & sum.above(S::zero());
        }
    }
    all
}

impl<S> Pinhole<S> {
    /// Creates a camera from focal lengths and principal point in pixels, unchecked.
    #[inline(always)]
    pub const fn new(focal: Vec2<S>, center: Vec2<S>) -> Self {
        Pinhole { focal, center }
    }
}

impl<S: Scalar> Pinhole<S> {
    /// Returns the image of a point, in pixels. Points at z = 0 are outside the domain; they get the principal point,
    /// with derivative zero.
    #[must_use]
    pub fn project(self, point: Vec3<S>) -> Vec2<S> {
        self.place(ahead(point))
    }
    /// Returns `true` where the point is ahead of the camera: z is more than a thousandth of its distance from the
    /// axis.
    #[must_use]
    pub fn sees(self, point: Vec3<S>) -> S::Mask {
        let aside = Vec2::new(point.x, point.y).length();
        point.z.above(S::zero()) & point.z.at_least(aside * S::lit(1e-3))
    }
    /// Returns the pixel of an image at focal length one.
    fn place(self, image: Vec2<S>) -> Vec2<S> {
        let (focal, center) = (self.focal, self.center);
        let pixel = Vec2::new(image.x * focal.x, image.y * focal.y) + center;
        pixel.canonical()
    }
}

/// Returns the image at focal length one.
fn ahead<S: Scalar>(point: Vec3<S>) -> Vec2<S> {
    let none = point.z.equals(S::zero());
    let z = S::select(none, S::one(), point.z);
    let over = |x: S| S::select(none, S::zero(), x.over(z));
    Vec2::new(over(point.x), over(point.y))
}

impl<S> BrownConrady<S> {
    /// Creates a camera from the one without distortion and OpenCV's vector `(k₁, k₂, p₁, p₂, k₃)`, unchecked.
    ///
    /// ```
    /// use geograd::Vec2;
    /// use geograd::camera::{BrownConrady, Pinhole};
    /// let pinhole = Pinhole::new(Vec2::new(500.0, 500.0), Vec2::new(320.0, 240.0));
    /// let camera = BrownConrady::from_opencv(pinhole, [-0.2, 0.05, 0.001, -0.002, 0.01]);
    /// assert_eq!(camera.radial, [-0.2, 0.05, 0.01]);
    /// assert_eq!(camera.tangential, [0.001, -0.002]);
    /// ```
    #[must_use]
    #[inline(always)]
    pub fn from_opencv(pinhole: Pinhole<S>, coefficients: [S; 5]) -> Self {
        let [k1, k2, p1, p2, k3] = coefficients;
        BrownConrady {
            pinhole,
            radial: [k1, k2, k3],
            tangential: [p1, p2],
        }
    }
}

impl<S: Scalar> BrownConrady<S> {
    /// Returns the image of a point, in pixels. Points at z = 0 are outside the domain.
    ///
    /// ```
    /// use geograd::camera::{BrownConrady, Pinhole};
    /// use geograd::{Vec2, Vec3};
    /// let pinhole = Pinhole::new(Vec2::new(500.0, 500.0), Vec2::new(320.0, 240.0));
    /// let camera = BrownConrady { pinhole, radial: [-0.2, 0.0, 0.0], tangential: [0.0; 2] };
    /// let point = Vec3::new(0.5_f64, 0.0, 1.0);
    /// assert_eq!(camera.project(point), Vec2::new(320.0 + 500.0 * 0.5 * (1.0 - 0.05), 240.0));
    /// assert!(camera.sees(point) && !camera.sees(Vec3::new(2.0, 0.0, 1.0)));
    /// ```
    #[must_use]
    pub fn project(self, point: Vec3<S>) -> Vec2<S> {
        let image = ahead(point);
        let Vec2 { x, y } = image;
        let (xx, yy, xy) = (x * x, y * y, x * y);
        let u = xx + yy;
        let [p1, p2] = self.tangential;
        let (p, q) = (p1 + p1, p2 + p2);
        let bent = Vec2::new(p * xy + p2 * u + q * xx, p1 * u + p * yy + q * xy);
        self.pinhole
            .place(image * polynomial(u, self.radial) + bent)
    }
    /// Returns `true` where the point is ahead of the camera and the radial distortion increases from the axis to it.
    /// It may be `false` close to the first turn, too.
    #[must_use]
    pub fn sees(self, point: Vec3<S>) -> S::Mask {
        self.pinhole.sees(point) & increases(ahead(point).length_squared(), self.radial)
    }
}

impl<S: Scalar> Fisheye<S> {
    /// Returns the image of a point, in pixels; the angle may exceed a right angle. Points straight behind are outside
    /// the domain; they and the origin get the principal point, with derivative zero.
    ///
    /// ```
    /// use geograd::camera::{Fisheye, Pinhole};
    /// use geograd::{Vec2, Vec3};
    /// let pinhole = Pinhole::new(Vec2::new(300.0, 300.0), Vec2::new(500.0, 500.0));
    /// let camera = Fisheye { pinhole, radial: [0.0; 4] };
    /// let aside: Vec2<f64> = camera.project(Vec3::new(2.0, 0.0, 0.0));
    /// assert!((aside.x - (500.0 + 300.0 * std::f64::consts::FRAC_PI_2)).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn project(self, point: Vec3<S>) -> Vec2<S> {
        let (zero, one) = (S::zero(), S::one());
        let aside = Vec2::new(point.x, point.y);
        // Near the axis θ / ρ is a series in the square of ρ / z, so that it is smooth there.
        let near = aside.length().below(point.z * S::lit(SMALL_SLOPE));
        let z = S::select(near, point.z, one);
        let slope = Vec2::new(aside.x.over(z), aside.y.over(z)).length_squared();
        let slope = S::select(near, slope, zero);
        let mut sum = zero;
        for i in (0..TERMS).rev() {
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            sum = sum * slope + S::lit(sign / (2 * i + 1) as f64);
        }
        let length = S::select(near, one, aside.length());
        let none = length.at_most(zero);
        let length = S::select(none, one, length);
        let angle = length.atan2(S::select(none, one, point.z));
        let per = S::select(near, sum.over(z), angle.over(length));
        let per = S::select(none, zero, per);
        let theta = S::select(near, slope * sum.squared(), angle.squared());
        self.pinhole
            .place(aside * (per * polynomial(theta, self.radial)))
    }
    /// Returns `true` where the angle is up to 3 radians and the distance from the image's centre increases from the
    /// axis to it. It may be `false` close to the first turn, too.
    #[must_use]
    pub fn sees(self, point: Vec3<S>) -> S::Mask {
        let aside = Vec2::new(point.x, point.y).length();
        let angle = aside.atan2(point.z);
        let apart = aside.above(S::zero()) | point.z.above(S::zero());
        apart & angle.at_most(S::lit(3.0)) & increases(angle.squared(), self.radial)
    }
}

/// Below this tangent of the angle to the axis, θ / ρ is a series.
const SMALL_SLOPE: f64 = 0.125;
/// The number of its terms, exact in double precision.
const TERMS: usize = 9;

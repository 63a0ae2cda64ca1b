//! Numbers and shapes of kinds that break things.
use crate::ad::check::sample::Draw;
use crate::kernels::cpu::checked::fill;
use crate::kernels::real::Real;
use crate::shape::{Aabb3, Obb3, Rotation3, YawBox3};
use crate::{Aabb2, Fixed, Obb2, Vec2, Vec3};
use std::f64::consts::FRAC_PI_4;

/// Numbers of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Family {
    /// Any bits that are a finite number.
    Bits,
    /// Sizes and places a few orders of magnitude apart.
    Moderate,
    /// Few different numbers, so that shapes share coordinates.
    Shared,
    /// Those, with angles of multiples of 45 degrees.
    Eighths,
    /// Of about unit size.
    Ordinary,
}

/// The families that batches compute at full speed.
const QUICK: [Family; 4] = [
    Family::Moderate,
    Family::Shared,
    Family::Eighths,
    Family::Ordinary,
];

/// Of so many draws one is of any bits: what is far from ordinary takes the scalar code, which is a
/// tenth as fast.
const RARELY: usize = 16;

/// Few different numbers.
const SHARED: [f64; 16] = [
    0.0, -0.0, 1.0, -1.0, 2.0, -2.0, 0.5, -0.5, 3.0, 0.1, -0.1, 1e-3, 1e3, 0.25, 1.5, -3.0,
];

/// Whether a format is double precision.
pub(super) fn is_wide<T: Real>() -> bool {
    T::LARGEST > f64::from(f32::MAX)
}

fn any_bits<T: Real>(bits: u64) -> T {
    let x = match is_wide::<T>() {
        true => f64::from_bits(bits),
        false => f64::from(f32::from_bits((bits >> 32) as u32)),
    };
    T::lit(if x.is_finite() { x } else { 1.0 })
}

impl Family {
    /// One of the families; rarely any bits.
    pub fn any(draw: &mut Draw) -> Self {
        match draw.once_in(RARELY) {
            true => Family::Bits,
            false => QUICK[draw.below(QUICK.len())],
        }
    }
    /// Fills a list. One loop per family: it is most of what drawing takes.
    pub fn fill<T: Real>(self, draw: &mut Draw, numbers: &mut [T]) {
        #[inline(always)]
        fn each<T>(draw: &mut Draw, numbers: &mut [T], number: impl Fn(u64) -> T) {
            for x in numbers {
                *x = number(draw.bits());
            }
        }
        match self {
            Family::Bits => each(draw, numbers, any_bits),
            // From 2⁻¹⁶ to 2¹⁶, both signs.
            Family::Moderate => each(draw, numbers, |bits| {
                let power = 1023 - 16 + (bits & 31);
                let sign = bits << 58 & 1 << 63;
                T::lit(f64::from_bits(sign | power << 52 | bits >> 12))
            }),
            Family::Shared | Family::Eighths => {
                each(draw, numbers, |bits| T::lit(SHARED[(bits >> 60) as usize]));
            }
            Family::Ordinary => each(draw, numbers, |bits| {
                T::lit((bits >> 11) as f64 / (1_u64 << 51) as f64 - 2.0)
            }),
        }
    }
    /// Fills a list with shapes.
    pub fn shapes<T: Real, X: Drawn<T>>(self, draw: &mut Draw, shapes: &mut [X]) {
        fill(shapes, |numbers| {
            self.fill(draw, numbers);
            if let (Family::Eighths, Some(angle)) = (self, X::ANGLE) {
                for x in numbers.iter_mut().skip(angle).step_by(X::LEN) {
                    *x = T::lit(((draw.bits() >> 60) as f64 - 8.0) * FRAC_PI_4);
                }
            }
        });
        for shape in shapes {
            *shape = shape.valid();
        }
    }
}

/// A shape that can be drawn.
pub trait Drawn<T>: Fixed<Scalar = T> {
    /// Which of its numbers is an angle.
    const ANGLE: Option<usize>;
    /// A valid shape, from one of any finite numbers.
    #[must_use]
    fn valid(self) -> Self;
    /// The sizes of its sides: the shortest one, the longest one.
    fn sides(&self) -> [f64; 2];
    /// Its area or its volume.
    fn content(&self) -> f64;
}

/// The shortest and the longest of some sides.
fn shortest_and_longest<const N: usize>(sides: [f64; N]) -> [f64; 2] {
    let shortest = sides.into_iter().fold(f64::INFINITY, f64::min);
    [shortest, sides.into_iter().fold(0.0, f64::max)]
}

impl<T: Real> Drawn<T> for Obb2<T> {
    const ANGLE: Option<usize> = Some(4);
    #[inline]
    fn valid(self) -> Self {
        let (w, h) = (self.size.x.unsigned(), self.size.y.unsigned());
        Obb2::new(self.center.x, self.center.y, w, h, self.heading)
    }
    fn sides(&self) -> [f64; 2] {
        shortest_and_longest([self.size.x.widen(), self.size.y.widen()])
    }
    fn content(&self) -> f64 {
        self.size.x.widen() * self.size.y.widen()
    }
}

impl<T: Real> Drawn<T> for Aabb2<T> {
    const ANGLE: Option<usize> = None;
    #[inline]
    fn valid(self) -> Self {
        let (p, q) = (self.min, self.max);
        Aabb2::new(p.x.least(q.x), p.y.least(q.y), p.x.most(q.x), p.y.most(q.y))
    }
    fn sides(&self) -> [f64; 2] {
        let w = self.max.x.widen() - self.min.x.widen();
        let h = self.max.y.widen() - self.min.y.widen();
        shortest_and_longest([w, h])
    }
    fn content(&self) -> f64 {
        let w = self.max.x.widen() - self.min.x.widen();
        let h = self.max.y.widen() - self.min.y.widen();
        w * h
    }
}

/// Sizes of no sign.
fn sizes<T: Real>(size: Vec3<T>) -> Vec3<T> {
    Vec3::new(size.x.unsigned(), size.y.unsigned(), size.z.unsigned())
}

fn widened<T: Real>(size: Vec3<T>) -> [f64; 3] {
    [size.x.widen(), size.y.widen(), size.z.widen()]
}

impl<T: Real> Drawn<T> for Aabb3<T> {
    const ANGLE: Option<usize> = None;
    #[inline]
    fn valid(self) -> Self {
        let (p, q) = (self.min, self.max);
        Aabb3::new(
            Vec3::new(p.x.least(q.x), p.y.least(q.y), p.z.least(q.z)),
            Vec3::new(p.x.most(q.x), p.y.most(q.y), p.z.most(q.z)),
        )
    }
    fn sides(&self) -> [f64; 2] {
        let ([x, y, z], [u, v, w]) = (widened(self.min), widened(self.max));
        shortest_and_longest([u - x, v - y, w - z])
    }
    fn content(&self) -> f64 {
        let ([x, y, z], [u, v, w]) = (widened(self.min), widened(self.max));
        (u - x) * (v - y) * (w - z)
    }
}

impl<T: Real> Drawn<T> for YawBox3<T> {
    const ANGLE: Option<usize> = Some(6);
    #[inline]
    fn valid(self) -> Self {
        YawBox3::new(self.center, sizes(self.size), self.heading)
    }
    fn sides(&self) -> [f64; 2] {
        shortest_and_longest(widened(self.size))
    }
    fn content(&self) -> f64 {
        widened(self.size).into_iter().product()
    }
}

impl<T: Real> Drawn<T> for Obb3<T> {
    const ANGLE: Option<usize> = None;
    #[inline]
    fn valid(self) -> Self {
        let (q, zero) = (self.rotation, T::default());
        let nothing = q.w == zero && q.x == zero && q.y == zero && q.z == zero;
        let w = if nothing { T::one() } else { q.w };
        let rotation = Rotation3::new(w, q.x, q.y, q.z);
        Obb3::new(self.center, sizes(self.size), rotation)
    }
    fn sides(&self) -> [f64; 2] {
        shortest_and_longest(widened(self.size))
    }
    fn content(&self) -> f64 {
        widened(self.size).into_iter().product()
    }
}

/// Parallelograms, convex but for rounding: a corner and two sides.
impl<T: Real> Drawn<T> for [Vec2<T>; 4] {
    const ANGLE: Option<usize> = None;
    #[inline]
    fn valid(self) -> Self {
        let [p, u, v, _] = self;
        // Sums of three numbers must be finite.
        let quarter = T::lit(0.25);
        let (p, u, v) = (p * quarter, u * quarter, v * quarter);
        [p, p + u, p + u + v, p + v]
    }
    fn sides(&self) -> [f64; 2] {
        let [p, q, r, s] = self.map(|v| [v.x.widen(), v.y.widen()]);
        let length = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
        // The height of a flat one is far shorter than its sides.
        let longest = length(p, q).max(length(p, s)).max(length(p, r));
        [self.content() / longest, longest.max(length(q, s))]
    }
    fn content(&self) -> f64 {
        let [p, q, _, s] = self.map(|v| [v.x.widen(), v.y.widen()]);
        ((q[0] - p[0]) * (s[1] - p[1]) - (q[1] - p[1]) * (s[0] - p[0])).abs()
    }
}

//! Numbers, and shapes over them: a number is a shape, and a shape is lifted to other numbers.
use crate::error::Field;
use crate::scalar::format::Format;
use crate::scalar::mask::Mask;
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number type of shapes; the [module](super) lists the implementing types and the rules at kinks.
///
/// Division in geometry goes through [`over`](Scalar::over), roots through
/// [`root`](Scalar::root), absolute values through [`magnitude`](Scalar::magnitude): the
/// operators and inherent methods of some dual types round differently or have no derivative there.
///
/// ```
/// use geograd::Scalar;
/// fn norm<S: Scalar>(x: S, y: S) -> S {
///     x.hypot(y)
/// }
/// assert_eq!(norm(3.0_f32, 4.0), 5.0);
/// let derivative = norm(num_dual::Dual64::new(0.0, 1.0), num_dual::Dual64::new(0.0, 0.0)).eps;
/// assert_eq!(derivative, 0.0); // a norm at zero has derivative zero
/// ```
///
#[doc = include_str!("generic.md")]
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a number that shapes are made of",
    label = "not a `Scalar`",
    note = "`f32`, `f64`, `Jet`, num-dual's numbers, `Lanes` and `Sym` are",
    note = "a whole number is not: write `2.0`, or `S::lit(2.0)` in a generic function"
)]
pub trait Scalar:
    Fixed<Scalar = Self>
    + Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// The outcome of a comparison.
    type Mask: Mask;
    /// The plain number (or lanes of plain numbers) under all derivative parts.
    type Primal: Scalar<Mask = Self::Mask, Primal = Self::Primal>;
    /// `true` for symbols: large functions of them are compiled once instead of inlined, since they run once.
    #[doc(hidden)]
    const RECORDS: bool = false;

    /// Returns the format of the plain numbers, which knows their epsilon and their largest number. Of a symbol it is
    /// that of the recording, known when it runs alone.
    fn format() -> Format;
    /// Returns a literal: `S::lit(0.5)`. Rounded to the precision of the scalar.
    fn lit(x: f64) -> Self;
    /// Returns a constant: no derivative.
    fn from_primal(x: Self::Primal) -> Self;
    /// Returns the value without its derivatives.
    fn primal(self) -> Self::Primal;

    /// Returns `self < other`, by value.
    fn below(self, other: Self) -> Self::Mask;
    /// Returns `self ≤ other`, by value.
    fn at_most(self, other: Self) -> Self::Mask;
    /// Returns `self = other`, by value.
    fn equals(self, other: Self) -> Self::Mask;
    /// Returns `yes` where the mask is true, else `no`. The other value has no effect, even if it is NaN.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// Returns the quotient, with the value of plain numbers.
    fn over(self, divisor: Self) -> Self;
    /// Returns the square root; 0 with derivative 0 for zero and below, NaN for NaN.
    fn root(self) -> Self;
    /// Returns sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// Returns sine and cosine, each as a short high part (half the significand, a constant) and the rest (which
    /// carries the derivative): `[(sin_high, sin_low), (cos_high, cos_low)]`.
    fn sin_cos_parts(self) -> [(Self, Self); 2];
    /// Returns `(high, low)` with `high + low = self` exactly, `high` a constant of half the significand.
    fn parts(self) -> (Self, Self);
    /// Returns the angle of `(x, self)` in radians, in `[−π, π]`; 0 with derivative 0 at the origin. The sign of a zero
    /// does not count: `(−1, −0)` is at π.
    fn atan2(self, x: Self) -> Self;
    /// Returns the exponential.
    fn exp(self) -> Self;
    /// Returns the natural logarithm.
    fn ln(self) -> Self;
    /// Returns the power of two `2⁻ᵉ` (a constant) that brings `self > 0` into `[2, 4)`. Values too small
    /// to be normal count as the smallest normal number.
    fn binade(self) -> Self;

    /// Returns zero.
    #[inline(always)]
    fn zero() -> Self {
        Self::lit(0.0)
    }
    /// Returns a power of a multiple of the [`epsilon`](Format::epsilon): a bound of relative errors of roundings.
    #[inline(always)]
    fn rounding(factor: f64, power: i32) -> Self {
        Self::lit((factor * Self::format().epsilon()).powi(power))
    }
    /// Returns the largest finite number.
    #[inline(always)]
    fn largest() -> Self {
        Self::lit(Self::format().largest())
    }
    /// Returns the largest finite number to a power between −1 and 1, for bounds of sizes.
    #[doc(hidden)]
    #[inline]
    fn largest_to(power: f64) -> Self {
        Self::lit(Self::format().largest_to(power))
    }
    /// Returns a length that is negligible in a sum with one, 2⁻⁶⁴ in single precision and 2⁻⁵¹² in double precision:
    /// no difference of [ordinary](crate::kernels::op::Limits::ORDINARY) coordinates is so small, but one times the
    /// sine of a small angle is. Quotients by it may have infinite derivatives.
    #[doc(hidden)]
    #[inline]
    fn speck() -> Self {
        Self::largest_to(-0.5)
    }
    /// Returns the finite number that is farthest below zero.
    #[inline(always)]
    fn lowest() -> Self {
        Self::lit(-Self::format().largest())
    }
    /// Returns one.
    #[inline(always)]
    fn one() -> Self {
        Self::lit(1.0)
    }
    /// Returns `self > other`, by value.
    #[inline(always)]
    fn above(self, other: Self) -> Self::Mask {
        other.below(self)
    }
    /// Returns `self ≥ other`, by value.
    #[inline(always)]
    fn at_least(self, other: Self) -> Self::Mask {
        other.at_most(self)
    }
    /// Returns half of the number.
    #[inline(always)]
    fn halved(self) -> Self {
        self * Self::lit(0.5)
    }
    /// Returns the smaller value; an exact tie shares the derivative, half and half.
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        let nearer = Self::select(self.below(other), self, other);
        Self::select(self.equals(other), self.halved() + other.halved(), nearer)
    }
    /// Returns the larger value; an exact tie shares the derivative, half and half.
    #[inline(always)]
    fn most(self, other: Self) -> Self {
        let nearer = Self::select(other.below(self), self, other);
        Self::select(self.equals(other), self.halved() + other.halved(), nearer)
    }
    /// Returns the nearest value in `[low, high]`; at either bound half of the derivative.
    #[inline(always)]
    fn clamp(self, low: Self, high: Self) -> Self {
        self.most(low).least(high)
    }
    /// Returns the absolute value; derivative zero at zero.
    #[inline(always)]
    fn magnitude(self) -> Self {
        self.most(-self)
    }
    /// Returns the [`root`](Scalar::root), by the name that plain numbers have. Numbers below zero have the root 0, not
    /// NaN.
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.root()
    }
    /// Returns the [`magnitude`](Scalar::magnitude), by the name that plain numbers have.
    #[inline(always)]
    fn abs(self) -> Self {
        self.magnitude()
    }
    /// Returns the [`least`](Scalar::least), by the name that plain numbers have; of NaN and a number it is not always
    /// the number.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.least(other)
    }
    /// Returns the [`most`](Scalar::most), by the name that plain numbers have; of NaN and a number it is not always
    /// the number.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.most(other)
    }
    /// Returns `self` or `−self`, whichever is not negative. Unlike [`magnitude`](Scalar::magnitude) it has the
    /// derivative of `self` at zero: for choosing between two descriptions of one thing, where there is no kink.
    #[inline(always)]
    fn unsigned(self) -> Self {
        Self::select(self.below(Self::zero()), -self, self)
    }
    /// Returns `self`, negated where `side` is negative.
    #[inline(always)]
    fn signed_as(self, side: Self) -> Self {
        Self::select(side.below(Self::zero()), -self, self)
    }
    /// Returns `√(self² + other²)` without overflow; 0 with derivative 0 at the origin.
    #[inline(always)]
    fn hypot(self, other: Self) -> Self {
        let (x, y) = (self.primal(), other.primal());
        let large = x.magnitude().most(y.magnitude());
        let zero = large.at_most(Self::Primal::zero());
        let scale = Self::Primal::select(zero, Self::Primal::one(), large).binade();
        let (scale, back) = (
            Self::from_primal(scale),
            Self::from_primal(Self::Primal::one().over(scale)),
        );
        let (x, y) = (self * scale, other * scale);
        (x * x + y * y).root() * back
    }
    /// Returns this value with the derivatives multiplied by a constant: shares a derivative at a tie that one
    /// comparison cannot detect.
    #[inline(always)]
    fn damp(self, share: Self::Primal) -> Self {
        let value = Self::from_primal(self.primal());
        value + (self - value) * Self::from_primal(share)
    }
    /// Returns these derivatives with another value, to correct rounding of the value alone.
    ///
    /// The literal zero as value means that products with it are zero: programs do not compute them, only their
    /// derivatives.
    #[inline(always)]
    fn with_primal(self, value: Self::Primal) -> Self {
        (self - Self::from_primal(self.primal())) + Self::from_primal(value)
    }
    /// Returns the value as an `f64`, exactly, for searches that decide in that format; `None` of several numbers, of
    /// symbols, and of other formats.
    #[doc(hidden)]
    #[inline(always)]
    fn widened(self) -> Option<f64> {
        None
    }
    /// Returns `false` if it is known to be a number: an input of a program that is being recorded, whose columns are
    /// checked.
    #[doc(hidden)]
    #[inline(always)]
    fn may_be_nan(self) -> bool {
        true
    }
    /// Returns the number where the mask is true, else the given NaN in every part.
    #[doc(hidden)]
    #[inline(always)]
    fn known(self, known: Self::Mask, nan: Self::Primal) -> Self {
        Self::select(known, self, self * Self::from_primal(nan))
    }
    /// Returns `true` where the value is neither infinite nor NaN.
    ///
    /// A guard stands before the operation that needs it: `x.over(S::select(y.equals(zero), one, y))`, then a choice.
    /// On a GPU a check of the result is unreliable, because drivers fold a divisor that is always zero, and their
    /// quotient is neither infinite nor NaN; nor does a check afterwards keep derivatives finite.
    #[inline(always)]
    fn finite(self) -> Self::Mask {
        self.unsigned().at_most(Self::largest())
    }
    /// Returns the nearest finite number: for results that overflow. Not a guard of a division by zero, for which see
    /// [`finite`](Scalar::finite).
    #[inline(always)]
    fn saturated(self) -> Self {
        let largest = Self::largest();
        let low = Self::select(self.above(largest), largest, self);
        Self::select(low.below(-largest), -largest, low)
    }
    /// Returns the number, with a positive zero for either zero. Results apply it last: the sign of a zero sum of
    /// products depends on which unneeded terms were left out.
    #[inline(always)]
    fn canonical(self) -> Self {
        self + Self::zero()
    }
    /// Returns the sine.
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Returns the cosine.
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Returns the tangent.
    #[inline(always)]
    fn tan(self) -> Self {
        let (sin, cos) = self.sin_cos();
        sin.over(cos)
    }
    /// Returns `self` squared.
    #[inline(always)]
    fn squared(self) -> Self {
        self * self
    }
    /// Returns an integer power, by repeated multiplication.
    #[inline]
    fn powi(self, exponent: i32) -> Self {
        let (mut left, mut square, mut out) = (exponent.unsigned_abs(), self, Self::one());
        while left > 0 {
            if left & 1 == 1 {
                out *= square;
            }
            square *= square;
            left >>= 1;
        }
        if exponent < 0 {
            Self::one().over(out)
        } else {
            out
        }
    }
}

/// A shape as a list of scalars, in a fixed order.
///
/// `With<T>` is this shape over `T`: of dual numbers to differentiate, of gradients to hold a Hessian. Numbers, shapes,
/// tuples and arrays of them, and vectors of run-time length are packs. `#[derive(Shape)]` makes a struct one.
///
/// ```
/// use geograd::{Obb2, Pack};
/// let car = Obb2::new(1.0, 2.0, 4.5, 1.8, 0.3);
/// assert_eq!(car.scalars(), [1.0, 2.0, 4.5, 1.8, 0.3]);
/// let names = ["x", "y", "width", "height", "heading"];
/// let mut next = names.into_iter();
/// let named = car.remake(&mut |_| next.next().unwrap());
/// assert_eq!(named.heading, "heading");
/// ```
pub trait Pack: Clone {
    /// The number type of the shape.
    type Scalar: Clone;
    /// This shape over `T`.
    type With<T: Clone>: Clone;
    /// `true` if it has lists of run-time length. [`fewer`](Pack::fewer) is not called otherwise.
    const LISTS: bool = false;
    /// Returns this shape with every scalar replaced, first field first.
    fn remake<T: Clone>(&self, f: &mut impl FnMut(&Self::Scalar) -> T) -> Self::With<T>;
    /// Calls a function with every scalar by reference, first field first.
    fn each(&mut self, f: &mut impl FnMut(&mut Self::Scalar));

    /// Returns the shape as constants of another scalar: of dual numbers, to take part in a function that
    /// is differentiated with respect to something else.
    ///
    /// ```
    /// use geograd::{Obb2, Pack, ad};
    /// let (here, there) = (Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0));
    /// let (_, derivatives) = ad::gradient(|b: Obb2<_>| b.iou(there.lift()), here);
    /// assert!(derivatives.center.x > 0.0);
    /// ```
    fn lift<D: Scalar>(&self) -> Self::With<D>
    where
        Self::Scalar: Into<f64> + Copy,
    {
        self.remake(&mut |&x| D::lit(x.into()))
    }
    /// Returns the shape in another format, rounded.
    ///
    /// ```
    /// use geograd::{Obb2, Pack};
    /// let single: Obb2<f32> = Obb2::new(0.1_f64, 0.2, 1.0, 1.0, 0.3).cast();
    /// assert_eq!(single.center.x, 0.1);
    /// ```
    fn cast<T: Copy + 'static>(&self) -> Self::With<T>
    where
        Self::Scalar: num_traits::AsPrimitive<T>,
    {
        self.remake(&mut |x| num_traits::AsPrimitive::as_(*x))
    }
    /// Returns copies with some elements of a list of run-time length dropped: halves first, single ones last. Empty
    /// for shapes of fixed size. For shrinking.
    ///
    /// ```
    /// use geograd::Pack;
    /// let all: Vec<_> = vec![1.0, 2.0, 3.0].fewer().collect();
    /// assert_eq!(all, [vec![3.0], vec![1.0, 2.0], vec![2.0, 3.0], vec![1.0, 3.0], vec![1.0, 2.0]]);
    /// ```
    fn fewer(&self) -> Box<dyn Iterator<Item = Self> + '_> {
        Box::new(std::iter::empty())
    }
    /// Returns the number of scalars of the shape.
    fn count(&self) -> usize {
        let mut n = 0;
        self.remake(&mut |_| n += 1);
        n
    }
    /// Returns all scalars, first field first.
    fn scalars(&self) -> Vec<Self::Scalar> {
        let mut all = Vec::new();
        self.remake(&mut |x| all.push(x.clone()));
        all
    }
    /// Returns this shape with its scalars taken from a list, which must have enough of them.
    ///
    /// # Panics
    ///
    /// When the list is shorter than [`count`](Pack::count).
    fn refill(&self, from: &[Self::Scalar]) -> Self {
        let mut shape = self.clone();
        let mut next = from.iter();
        shape.each(&mut |x| *x = next.next().expect("one scalar per field").clone());
        shape
    }
}

/// A shape whose number of scalars does not depend on its value: numbers, [derived](crate::Shape) shapes, and arrays of
/// them and tuples of up to six.
///
/// ```
/// use geograd::{Fixed, Obb2, Pack, Vec2};
/// let [start, end] = <[Vec2<f64>; 2]>::load(&[0.0, 1.0, 2.0, 3.0]);
/// assert_eq!((start.y, end.x), (1.0, 2.0));
/// let mut numbers = [0.0; 7];
/// (Obb2::new(1.0, 2.0, 4.0, 2.0, 0.5), end).store(&mut numbers);
/// assert_eq!(numbers, [1.0, 2.0, 4.0, 2.0, 0.5, 2.0, 3.0]);
/// assert_eq!(<(Obb2<f64>, Vec2<f64>)>::name(3).as_str(), "0.height");
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a shape of fixed size",
    label = "not a shape of fixed size",
    note = "numbers, arrays, tuples of up to six and structs with `#[derive(geograd::Shape)]` are"
)]
pub trait Fixed: Pack<Scalar: Copy + Send + Sync> + Copy + Send + Sync + 'static {
    /// This shape over another scalar.
    type Of<R: Scalar>: Fixed<Scalar = R>;
    /// The number of scalars.
    const LEN: usize;
    /// The number of whole numbers: counts and codes, which have no derivatives and are no part of `LEN`.
    const CODES: usize = 0;
    /// Returns the shape with the first `LEN` scalars of a slice, first field first. Its codes are zero.
    ///
    /// # Panics
    ///
    /// When there are fewer.
    fn load(from: &[Self::Scalar]) -> Self;
    /// Writes the scalars to the first `LEN` places of a slice, first field first.
    ///
    /// # Panics
    ///
    /// When there are fewer.
    fn store(self, to: &mut [Self::Scalar]);
    /// Returns the shape with one scalar everywhere. Its codes are zero.
    fn filled(scalar: Self::Scalar) -> Self;
    /// Returns the name of scalar `i`, such as `links[0].x`; that of a lone number from `LEN` on.
    fn name(i: usize) -> Field;
    /// Returns this shape with its codes taken from the first `CODES` places of a slice.
    ///
    /// # Panics
    ///
    /// When there are fewer.
    #[inline]
    #[must_use]
    fn load_codes(self, _from: &[u32]) -> Self {
        self
    }
    /// Writes the codes to the first `CODES` places of a slice, first field first.
    ///
    /// # Panics
    ///
    /// When there are fewer.
    #[inline]
    fn store_codes(self, _to: &mut [u32]) {}
    /// Returns the shape with the scalars of another one added, such as those of a gradient or of a step. It keeps its
    /// codes.
    ///
    /// ```
    /// use geograd::{Circle, Fixed, Vec2};
    /// let (wheel, gradient) = (Circle::new(Vec2::new(0.0, 1.0), 2.0), Circle::new(Vec2::new(1.0, 0.0), -1.0));
    /// let stepped = wheel.plus(gradient.scaled_by(-0.5));
    /// assert_eq!(stepped, Circle::new(Vec2::new(-0.5, 1.0), 2.5));
    /// ```
    #[inline]
    #[must_use]
    fn plus(mut self, other: Self) -> Self
    where
        Self::Scalar: Scalar,
    {
        let mut others = other.scalars().into_iter();
        self.each(&mut |x| *x += others.next().unwrap_or(Self::Scalar::zero()));
        self
    }
    /// Returns the shape with every scalar multiplied by a factor. It keeps its codes.
    #[inline]
    #[must_use]
    fn scaled_by(mut self, factor: Self::Scalar) -> Self
    where
        Self::Scalar: Scalar,
    {
        self.each(&mut |x| *x *= factor);
        self
    }
    /// Returns the lower bounds along the axes, two or three, and then the upper ones; nothing for a shape without
    /// known bounds. `#[shape(bounding)]` takes them from the shape's method `bounding`.
    #[must_use]
    fn axis_bounds(self) -> Vec<Self::Scalar> {
        Vec::new()
    }

    /// Returns the names of all scalars, first field first.
    #[must_use]
    fn names() -> Vec<Field> {
        (0..Self::LEN).map(Self::name).collect()
    }
    /// Returns all codes, first field first.
    #[must_use]
    fn codes(self) -> Vec<u32> {
        let mut all = vec![0; Self::CODES];
        self.store_codes(&mut all);
        all
    }
}

//! Declared properties of results, as data: inputs for which they are finite, their range, and results of identical
//! shapes and of shapes apart. The fuzzer tests them.

/// The valid finite inputs whose values and derivatives are finite.
///
/// ```
/// use geograd::kernels::op::Finite;
/// use geograd::Obb2;
/// use geograd::kernels::{Iou, RowOf, op::Declares};
/// assert_eq!(<RowOf<Iou, (Obb2<f64>, Obb2<f64>)>>::DECLARED.finite, Finite::Always);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Finite {
    /// All of them, with cotangents of any size; duals within [`Limits::ORDINARY`].
    Always,
    /// Inputs within limits, with cotangents of one.
    Within(Limits),
    /// Inputs within limits, for values; derivatives need not be finite.
    Values(Limits),
    /// Nothing is declared.
    Undeclared,
}

/// Limits of numbers: every length, coordinate and plain number is zero or between two powers of two in
/// magnitude; angles are zero or not below [`Limits::LEAST_ANGLE`].
///
/// ```
/// use geograd::kernels::op::Limits;
/// let limits = Limits::new([-40, 40], [-300, 300]);
/// assert_eq!(limits.single, [-40, 40]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Exponents of the least and of the largest magnitude in `f32`.
    pub single: [i32; 2],
    /// Exponents of the least and of the largest magnitude in `f64`.
    pub double: [i32; 2],
}

impl Limits {
    /// Creates limits from the exponents of both formats.
    #[must_use]
    pub const fn new(single: [i32; 2], double: [i32; 2]) -> Self {
        Limits { single, double }
    }
    /// From 2⁻²⁰ to 2²⁰ (about a millionth to a million) in `f32`, from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`: the default of a row.
    pub const ORDINARY: Limits = Limits::new([-20, 20], [-150, 150]);
    /// Exponents of the least magnitude of an angle in `f32` and in `f64`: the product of a length and the sine of a
    /// smaller one may be below the least normal number, whose reciprocal overflows.
    pub const LEAST_ANGLE: [i32; 2] = [-100, -900];
}

/// The range of every number of a result, both ends included.
///
/// ```
/// use geograd::kernels::op::Range;
/// use geograd::Obb2;
/// use geograd::kernels::{Iou, RowOf, op::Declares};
/// assert_eq!(<RowOf<Iou, (Obb2<f64>, Obb2<f64>)>>::DECLARED.range, Range::RATIO);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The least.
    pub least: f64,
    /// The largest.
    pub largest: f64,
}

impl Range {
    /// Any number.
    pub const ANY: Range = Range::new(f64::NEG_INFINITY, f64::INFINITY);
    /// From 0 to 1.
    pub const RATIO: Range = Range::new(0.0, 1.0);
    /// From −1 to 1.
    pub const SIGNED: Range = Range::new(-1.0, 1.0);
    /// From −3/2 to 1.
    pub const CIOU: Range = Range::new(-1.5, 1.0);
    /// From −9/4 to 1.
    pub const EIOU_BOX: Range = Range::new(-2.25, 1.0);
    /// From −5/2 to 1.
    pub const EIOU_HULL: Range = Range::new(-2.5, 1.0);
    /// From −3 to 1.
    pub const EIOU: Range = Range::new(-3.0, 1.0);
    /// Not below 0.
    pub const NOT_NEGATIVE: Range = Range::new(0.0, f64::INFINITY);
    /// Creates the range between two numbers.
    #[must_use]
    pub const fn new(least: f64, largest: f64) -> Self {
        Range { least, largest }
    }
}

/// The scores of two identical shapes and of two shapes apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Extremes {
    /// Nothing is declared.
    Undeclared,
    /// Shapes apart score 0 with derivatives of zero.
    Shared,
    /// Shapes apart score 0 with derivatives of zero, and identical shapes score 1, or 0 if they count as empty.
    Ratio,
    /// As [`Ratio`](Extremes::Ratio), and the derivatives of identical shapes are zero.
    Union,
    /// Identical shapes score 1, or 0 if they count as empty.
    One,
}

/// A lower bound of a result of two shapes, from axis-aligned boxes around both. Searches for the least result skip
/// pairs by it.
///
/// Boxes that contain the shapes are nearer, or overlap more deeply, than these.
///
/// ```
/// use geograd::kernels::op::{Declares, LowerBound};
/// use geograd::kernels::{Distance, RowOf};
/// use geograd::{Capsule3, Obb3};
/// let declared = <RowOf<Distance, (Capsule3<f64>, Obb3<f64>)>>::DECLARED;
/// assert_eq!(declared.lower, LowerBound::Distance);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum LowerBound {
    /// None is known.
    #[default]
    Unknown,
    /// The signed distance of both boxes.
    Distance,
    /// The squared distance of both boxes.
    SquaredDistance,
}

/// The source of an operation's derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Derivative {
    /// [`Op::adjoint`](crate::kernels::Op::adjoint), written by hand.
    ByHand,
    /// The recorded function, differentiated backwards.
    Reverse,
    /// The recorded function, differentiated forwards, one number of the input after another. For functions whose
    /// reverse derivatives lose digits, because large terms are added before they cancel.
    Forward,
}

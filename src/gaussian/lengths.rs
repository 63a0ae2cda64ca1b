//! Lengths in units of their own: sizes of boxes keep their digits however small or large they are relative to each
//! other or to the distance between them.
use crate::Scalar;

/// The units of the sizes of two boxes: powers of two, constants.
pub(super) struct BoxUnits<S: Scalar> {
    /// The factor that brings the largest size of the first box into `[2, 4)`; a box without size takes the other box's
    /// factor.
    pub a: S,
    /// The same for the second box.
    pub b: S,
    /// The unit of both, that of the larger box, over that of the first: at most one.
    pub share_a: S,
    /// The same for the second box.
    pub share_b: S,
    /// The factor that brings the largest size of both into `[2, 4)`.
    pub both: S,
    /// `true` where neither box has a size.
    pub none: S::Mask,
}

/// Returns the power of two that brings a length into `[2, 4)`; no larger than three quarters of the range of exponents
/// allow, so that derivatives by lengths stay finite in that unit.
#[inline(always)]
fn bounded_unit<S: Scalar>(length: S) -> S {
    let most = S::largest_to(-0.75).binade();
    let unit = length.binade();
    S::select(most.below(unit), most, unit)
}

impl<S: Scalar> BoxUnits<S> {
    /// Returns the units for the largest size of each box.
    #[inline(always)]
    pub fn of(a: S, b: S) -> Self {
        let zero = S::zero();
        let (none_a, none_b) = (a.at_most(zero), b.at_most(zero));
        let none = none_a & none_b;
        let a = S::select(none_a, b, a);
        let b = S::select(none_b, a, b);
        let own = bounded_unit(S::select(none, S::one(), a));
        let other = bounded_unit(S::select(none, S::one(), b));
        let both = S::select(own.below(other), own, other);
        BoxUnits {
            a: own,
            b: other,
            share_a: both.over(own),
            share_b: both.over(other),
            both,
            none,
        }
    }
    /// Returns a function of a number of a rotation: the number itself, or a constant if derivatives by it might not be
    /// finite. They grow as the larger size to a power.
    #[inline(always)]
    pub fn finite_derivatives<const POWER: usize>(&self) -> impl Fn(S) -> S + use<S, POWER> {
        let both = self.both.primal();
        let mut unit = both;
        for _ in 1..POWER {
            unit *= both;
        }
        let steep = unit.below(S::Primal::lit(4096.0 / S::format().largest()));
        move |x: S| S::select(steep, S::from_primal(x.primal()), x)
    }
}

/// The displacement between two centres.
pub(super) struct Displacement<S: Scalar> {
    /// Its squared length, in squared units of `1 / unit`.
    pub squared: S,
    /// The power of two that brings its largest coordinate into `[2, 4)`, a constant.
    pub unit: S,
    /// `true` where the centres agree.
    pub none: S::Mask,
}

impl<S: Scalar> Displacement<S> {
    /// Creates the displacement from its coordinates; infinite ones count as the largest number.
    #[inline(always)]
    pub fn of<const N: usize>(coordinates: [S; N]) -> Self {
        let mut longest = S::Primal::zero();
        let mut way = coordinates;
        for x in &mut way {
            *x = x.saturated();
            longest = longest.most(x.primal().magnitude());
        }
        let none = longest.at_most(S::Primal::zero());
        let unit = S::Primal::select(none, S::Primal::one(), longest);
        let unit = S::from_primal(bounded_unit(unit));
        let mut squared = (way[0] * unit).squared();
        for &x in &way[1..] {
            squared += (x * unit).squared();
        }
        Displacement {
            squared,
            unit,
            none,
        }
    }
}

/// Returns the sum of the squares of a distance of shapes and of a displacement, in squared units of length.
#[inline(always)]
pub(super) fn sum_of_squares<S: Scalar>(shape: S, units: &BoxUnits<S>, way: &Displacement<S>) -> S {
    let shape = shape.over(units.both).over(units.both);
    let way = way.squared.over(way.unit).over(way.unit);
    (shape + way).saturated()
}

/// Returns the root of the sum of both squares, a length. It is a constant where derivatives might not be finite: for
/// sizes near the largest numbers, and for boxes that are almost identical compared with their sizes.
///
/// Both are brought into the unit of the longer one, so that the shorter one alone can underflow.
#[inline(always)]
pub(super) fn root_of_sum<S: Scalar>(shape: S, units: &BoxUnits<S>, way: &Displacement<S>) -> S {
    let one = S::one();
    let length = |square: S, unit: S| square.primal().root().over(unit.primal());
    let longest = length(shape, units.both).most(length(way.squared, way.unit));
    let longest = S::from_primal(longest.saturated());
    let none = longest.at_most(S::zero());
    let unit = bounded_unit(S::select(none, one, longest));
    // Derivatives grow as the square of a unit over that of the sizes.
    let bound = units.both * S::lit((1_u64 << 40) as f64);
    let bounded = bound.below(unit) & !units.none;
    let unit = S::select(bounded, bound, unit);
    let (per_shape, per_way) = (unit.over(units.both), unit.over(way.unit));
    // A distance of zero has second derivatives; far from its unit they are beyond the format.
    let held = |x: S| x.least(S::largest_to(0.25));
    let of_shape = S::select(units.none, held(per_shape), per_shape);
    let of_way = S::select(way.none, held(per_way), per_way);
    let sum = shape * of_shape * of_shape + way.squared * of_way * of_way;
    let root = sum.primal().root();
    let own = |none: S::Mask, x: S| S::select(none, one, x).primal();
    let (of_shape, of_way) = (own(units.none, of_shape), own(way.none, of_way));
    let steep = of_shape * of_shape + of_way * of_way;
    let steep = steep.above((unit.primal() * root) * S::Primal::lit(S::format().largest() / 8.0));
    let sum = S::select(steep, S::from_primal(sum.primal()), sum);
    sum.root().over(unit).saturated()
}

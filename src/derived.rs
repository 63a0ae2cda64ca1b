//! `#[derive(Shape)]`, and the functions that the code calls that it writes.
//!
//! The derive (package `geograd-derive`) reads a struct's tokens without a parser of Rust. The code that it writes
//! names this module only, so it needs no feature or dependency of its user's crate.
pub use crate::Real;
pub use crate::ad::declared::Kind;
pub use crate::ad::sample::several::{
    all, as_angle, as_directions, as_lengths, as_non_negative, as_positive, as_rotation_vectors,
    combined, drawn, hard, in_order, joined, mingled, one_of, together,
};
pub use crate::ad::sample::{Draw, Sample};
pub use crate::error::{Field, Flaw, Validate};
pub use crate::kernels::item::Item;
pub use crate::product::{
    load, load_code, load_codes, name, no_code, store, store_code, store_codes, valid,
};
pub use crate::{Code, Fixed, Pack, Rule, Scalar};
pub use approx;
pub use std::vec::Vec;
#[cfg(feature = "proptest")]
pub use {
    crate::ad::sample::Family,
    crate::ad::sample::strategy::{Shapes, of},
    proptest::arbitrary::Arbitrary,
};

/// Makes a struct of numbers a shape of your own: batches, derivatives, programs and the harness then
/// take it as they take the library's.
///
/// The struct has named or numbered fields and one type parameter without bounds, the scalar, besides
/// any const parameters. Each field is the scalar, another shape, an array or a tuple of those, or a
/// count or code (see below). It derives `Clone`, `Copy`, `Debug` and `PartialEq`, too.
///
/// ```
/// use geograd::{ad, Fixed, Pack, Pose2, Shape, Validate, Vec2};
///
/// /// An arm of two links on a base.
/// #[derive(Clone, Copy, Debug, PartialEq, Shape)]
/// struct Arm<S> {
///     base: Pose2<S>,
///     #[shape(positive)]
///     links: [S; 2],
///     #[shape(number)]
///     elbow: S,
/// }
///
/// let base = Pose2::new(Vec2::new(1.0, 0.0), 0.0);
/// let arm = Arm { base, links: [2.0, 1.0], elbow: 0.5 };
/// let reach = |arm: Arm<_>| arm.links[0] + arm.links[1];
/// assert_eq!(ad::gradient(reach, arm).1.links, [1.0, 1.0]);
///
/// assert_eq!(Arm::<f64>::LEN, 7);
/// assert_eq!(Arm::<f64>::name(5).as_str(), "links[1]");
/// assert_eq!(Arm::load(&arm.scalars()), arm);
/// let flaw = Arm { links: [2.0, 0.0], ..arm }.validate().unwrap_err();
/// assert_eq!(flaw.to_string(), "links[1] is not positive");
/// approx::assert_relative_eq!(arm, arm.cast::<f32>().cast::<f64>());
/// ```
///
/// # Implementations
///
/// * [`Pack`](crate::Pack) and [`Fixed`](crate::Fixed): the scalars in the order of the fields, and their
///   names;
/// * [`Validate`](crate::Validate): every scalar is finite, every part valid, the rules below hold; its
///   [`RULES`](crate::Validate::RULES) are those rules as [data](crate::Rule), for the fuzzer and other languages;
/// * [`Item`](crate::kernels::Item): columns of it go into batches and come out of them;
/// * the comparisons of `approx`;
/// * [`Sample`](crate::ad::sample::Sample) for `f64`: random and hard inputs for the harness and, with the
///   feature `proptest`, the strategies of `ad::sample::strategy` and proptest's own `any`.
///
/// The code names the crate `geograd`. With a dependency of another name, say `gg`, write `#[shape(crate = "gg")]`.
///
/// # Attributes
///
/// | on a field | |
/// | --- | --- |
/// | `non_negative`, `positive` | all its numbers are; a vector then has lengths, such as a size, and is no place |
/// | `non_zero` | its numbers are not all zero: a vector that has a direction |
/// | `at_most = "other"` | none of its numbers exceeds the same one of the other field |
/// | `differs_from = "other"` | its numbers are not all those of the other field: two points apart |
/// | `names("width", "height")` | names of its numbers, instead of `field.x` and so on |
/// | `angle`, `length`, `number` | what turns and scaling do to its numbers; a lone scalar is a length |
/// | `direction`, `rotation_vector` | its points do not shift: they are directions, or axes times angles in radians |
/// | `kind = "AngleY"` | any other [`Kind`](crate::ad::declared::Kind) by its name |
/// | `code` | whole numbers: see [`Code`](crate::Code) |
///
/// | on the struct | |
/// | --- | --- |
/// | `non_zero` | its numbers are not all zero |
/// | `bounding` | its method `bounding` returns an axis-aligned box around it: searches for the nearest skip pairs by it |
/// | `validate = path` | a function of `&Self` with a rule that no word above says; `RULES` do not have it |
/// | `except(Validate, approx, Sample, Arbitrary)` | leaves these to you |
/// | `crate = "name"` | the library's name, where a manifest renames it |
///
/// A type that cannot be a shape does not compile:
///
/// ```compile_fail
/// #[derive(Clone, Copy, geograd::Shape)]
/// enum Either<S> { One(S), Other(S) }
/// ```
///
/// Rules are of scalars, so a count has none:
///
/// ```compile_fail
/// #[derive(Clone, Copy, Debug, PartialEq, geograd::Shape)]
/// struct Ticks<S> { step: S, #[shape(code, non_zero)] count: u16 }
/// ```
pub use geograd_derive::Shape;

/// The other derives of a shape.
#[diagnostic::on_unimplemented(
    message = "`{Self}` lacks one of `Clone`, `Copy`, `Debug` and `PartialEq`, which a shape derives, too",
    label = "write `#[derive(Clone, Copy, Debug, PartialEq, Shape)]`",
    note = "further errors of `derive(Shape)` follow from this one"
)]
#[doc(hidden)]
pub trait Standard {}
#[diagnostic::do_not_recommend]
impl<T: Copy + std::fmt::Debug + PartialEq> Standard for T {}

/// A shape of numbers: the first implementation of the derive, so that the compiler reports first what is missing.
#[doc(hidden)]
pub trait Derived: Standard {}

/// Returns the flaw of scalar `i` of a part that begins at scalar `at` of a shape.
#[cold]
fn flawed<W: Fixed>(_: &W, flaw: fn(Field) -> Flaw, i: usize) -> Result<(), Flaw> {
    Err(flaw(W::name(i)))
}

/// Returns the index of the first scalar for which a condition holds.
#[inline(always)]
fn first<P: Pack<Scalar: Copy>>(
    part: &P,
    mut holds: impl FnMut(P::Scalar) -> bool,
) -> Option<usize> {
    let (mut i, mut found) = (0, None);
    part.remake(&mut |&x| {
        if found.is_none() && holds(x) {
            found = Some(i);
        }
        i += 1;
    });
    found
}

/// Returns a part's first flaw, with the given names of its numbers.
#[inline]
pub fn valid_as<P: Fixed + Validate>(part: &P, names: &[&str]) -> Result<(), Flaw> {
    let renamed = |own: Field| {
        let i = (0..P::LEN).find(|&i| P::name(i) == own);
        let name = i.and_then(|i| names.get(i));
        name.map_or(own, |name| Field::new(name))
    };
    part.validate().map_err(|flaw| flaw.renamed(renamed))
}

/// Returns `Ok` when no number of a part is below zero; the part begins at scalar `at` of the whole.
#[inline]
pub fn non_negative<W: Fixed, P: Fixed>(whole: &W, part: &P, at: usize) -> Result<(), Flaw>
where
    P::Scalar: Scalar<Mask = bool>,
{
    match first(part, |x| x.below(Scalar::zero())) {
        Some(i) => flawed(whole, Flaw::Negative, at + i),
        None => Ok(()),
    }
}

/// Returns `Ok` when all numbers of a part are above zero.
#[inline]
pub fn positive<W: Fixed, P: Fixed>(whole: &W, part: &P, at: usize) -> Result<(), Flaw>
where
    P::Scalar: Scalar<Mask = bool>,
{
    match first(part, |x| x.at_most(Scalar::zero())) {
        Some(i) => flawed(whole, Flaw::NotPositive, at + i),
        None => Ok(()),
    }
}

/// Returns `Ok` when not all numbers of the part `name` are zero.
#[inline]
pub fn non_zero<P: Fixed>(part: &P, name: &str) -> Result<(), Flaw>
where
    P::Scalar: Scalar<Mask = bool>,
{
    match first(part, |x| !x.equals(Scalar::zero())) {
        Some(_) => Ok(()),
        None => Err(Flaw::Zero(Field::new(name))),
    }
}

/// Returns `Ok` when not all numbers of a shape are zero; otherwise its first number breaks the `rule`.
#[inline]
pub fn not_all_zero<W: Fixed>(whole: &W, rule: &'static str) -> Result<(), Flaw>
where
    W::Scalar: Scalar<Mask = bool>,
{
    non_zero(whole, "").map_err(|_| Flaw::Broken(W::name(0), rule))
}

/// Returns `Ok` when not all numbers of the part `name` are those of another part; otherwise it breaks the `rule`.
#[inline]
pub fn differs_from<P: Fixed>(
    part: &P,
    other: &P,
    name: &str,
    rule: &'static str,
) -> Result<(), Flaw>
where
    P::Scalar: Scalar<Mask = bool>,
{
    match first_of_two(part, other, |x, y| !x.equals(y)) {
        Some(_) => Ok(()),
        None => Err(Flaw::Broken(Field::new(name), rule)),
    }
}

/// Returns the place of the first pair of numbers of two parts for which something holds.
#[inline(always)]
fn first_of_two<P: Fixed>(
    a: &P,
    b: &P,
    mut holds: impl FnMut(P::Scalar, P::Scalar) -> bool,
) -> Option<usize> {
    let (mut i, mut found) = (0, None);
    a.remake(&mut |&x| {
        // The number in the same place, by walking there: parts are short.
        let mut k = 0;
        let here = first(b, |y| {
            k += 1;
            k == i + 1 && holds(x, y)
        });
        found = found.or(here);
        i += 1;
    });
    found
}

/// Returns `Ok` when no number of a part exceeds that of another part, the field `upper` of the whole.
#[inline]
pub fn at_most<W: Fixed, P: Fixed>(
    _: &W,
    low: &P,
    high: &P,
    at: usize,
    upper: &'static str,
) -> Result<(), Flaw>
where
    P::Scalar: Scalar<Mask = bool>,
{
    match first_of_two(low, high, |low, high| low.above(high)) {
        Some(i) => Err(Flaw::Inverted(W::name(at + i), upper)),
        None => Ok(()),
    }
}

/// Proptest's `any` for a shape, where its feature is on.
#[cfg(feature = "proptest")]
#[doc(hidden)]
#[macro_export]
macro_rules! __arbitrary {
    ([$($constant:tt)*] $shape:ty) => {
        impl<$($constant)*> $crate::derived::Arbitrary for $shape {
            type Parameters = $crate::derived::Family;
            type Strategy = $crate::derived::Shapes<Self>;
            fn arbitrary_with(family: $crate::derived::Family) -> Self::Strategy {
                $crate::derived::of(family)
            }
        }
    };
}
/// Proptest's `any` for a shape, where its feature is on.
#[cfg(not(feature = "proptest"))]
#[doc(hidden)]
#[macro_export]
macro_rules! __arbitrary {
    ($($shape:tt)*) => {};
}

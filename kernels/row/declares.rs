//! The properties that a function declares, as one value: names, documentation, invariances, limits, and the source of
//! its derivatives.
use crate::Fixed;
#[cfg(feature = "check")]
use crate::ad::declared::{Effect, Motion};
use crate::ad::declared::{Invariance, Jumps};
use crate::kernels::row::limits::{Derivative, Extremes, Finite, Limits, LowerBound, Range};
use std::fmt::Debug;

/// The declared properties of a function.
///
/// ```
/// use geograd::kernels::op::{Declared, Derivative, Jumps, Range};
/// const DISTANCE: Declared = Declared::new("distance", &[], Jumps::Never)
///     .range(Range::NOT_NEGATIVE)
///     .derivative(Derivative::Forward);
/// assert_eq!((DISTANCE.name, DISTANCE.range.least), ("distance", 0.0));
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Declared {
    /// The name of the function.
    pub name: &'static str,
    /// The names of its arguments, one for each; empty without own names.
    pub arguments: &'static [&'static str],
    /// Documentation in Markdown: the doc comment of its row, empty without one.
    pub doc: &'static str,
    /// Motions of the argument and their effect on the result; `&[]` declares none.
    pub invariances: &'static [Invariance],
    /// Places at which the value may jump.
    pub jumps: Jumps,
    /// The source of the derivatives of a straight line.
    pub derivative: Derivative,
    /// Inputs whose values and derivatives are finite.
    pub finite: Finite,
    /// The range of every number of the result.
    pub range: Range,
    /// The results of identical shapes and of shapes apart.
    pub extremes: Extremes,
    /// The lower bound of the result, from boxes around both arguments.
    pub lower: LowerBound,
    /// The domain as a condition of the argument's numbers, in addition to the rules of its shapes; `None` for
    /// everywhere. The harness and the fuzzer test inputs inside only; batches compute outside, too.
    pub domain: Option<fn(&[f64]) -> bool>,
    /// The error of values beyond rounding: absolute, in the unit of the result, and relative to each of its numbers.
    pub resolution: [f64; 2],
    /// A bound of a value's error where terms cancel, in roundings of the format: the size of these terms in the unit
    /// of the result; `None` for none. Derivatives may err by as much divided by the unit of the argument's number.
    pub roundings: Option<fn(&[f64]) -> f64>,
    /// `true` for a search that takes a distance of some roundings as none. Single precision then decides otherwise
    /// than double, and the harness compares both along the decisions of single.
    pub by_roundings: bool,
    /// `true` for a function that takes a thousand times as long as most: the fuzzer and tests give it fewer inputs.
    pub costly: bool,
}

/// Defines one setter per property.
macro_rules! properties {
    ($($(#[$doc:meta])* $name:ident: $type:ty;)*) => {
        impl Declared { $(
            $(#[$doc])*
            #[must_use]
            pub const fn $name(self, $name: $type) -> Self {
                Declared { $name, ..self }
            }
        )* }
    };
}

properties! {
    /// Names the arguments.
    arguments: &'static [&'static str];
    /// Documents the function in Markdown.
    doc: &'static str;
    /// Declares invariances, which replaces those of [`new`](Declared::new).
    invariances: &'static [Invariance];
    /// Declares the places of jumps, which replaces those of [`new`](Declared::new).
    jumps: Jumps;
    /// Declares the source of derivatives; the default is [`Derivative::Reverse`].
    derivative: Derivative;
    /// Declares the inputs with finite results; the default is within [`Limits::ORDINARY`].
    finite: Finite;
    /// Declares the range of every number of the result; the default is any number.
    range: Range;
    /// Declares the results of identical shapes and of shapes apart.
    extremes: Extremes;
    /// Declares the lower bound of the result, from boxes around both arguments; the default is none.
    lower: LowerBound;
    /// Declares that a search takes a distance of some roundings as none, so that formats decide differently.
    by_roundings: bool;
    /// Declares that a function takes a thousand times as long as most, so that the fuzzer gives it fewer inputs.
    costly: bool;
}

impl Declared {
    /// Declares a name, invariances and jumps, which have no defaults.
    #[must_use]
    pub const fn new(name: &'static str, invariances: &'static [Invariance], jumps: Jumps) -> Self {
        Declared {
            name,
            arguments: &[],
            doc: "",
            invariances,
            jumps,
            derivative: Derivative::Reverse,
            finite: Finite::Within(Limits::ORDINARY),
            range: Range::ANY,
            extremes: Extremes::Undeclared,
            lower: LowerBound::Unknown,
            domain: None,
            resolution: [0.0; 2],
            roundings: None,
            by_roundings: false,
            costly: false,
        }
    }
    /// Declares the domain, as a condition of the argument's numbers.
    #[must_use]
    pub const fn domain(self, inside: fn(&[f64]) -> bool) -> Self {
        Declared {
            domain: Some(inside),
            ..self
        }
    }
    /// Declares the error of values beyond rounding, in the unit of the result.
    #[must_use]
    pub const fn resolution(self, absolute: f64) -> Self {
        Declared {
            resolution: [absolute, self.resolution[1]],
            ..self
        }
    }
    /// Declares the error of values beyond rounding, relative to each number of the result.
    #[must_use]
    pub const fn relative_resolution(self, share: f64) -> Self {
        Declared {
            resolution: [self.resolution[0], share],
            ..self
        }
    }
    /// Declares the size of the terms that cancel in a value, from the argument's numbers: an error of as many
    /// roundings is allowed.
    #[must_use]
    pub const fn roundings(self, of: fn(&[f64]) -> f64) -> Self {
        Declared {
            roundings: Some(of),
            ..self
        }
    }
}

#[cfg(feature = "check")]
impl Declared {
    /// Returns the power of the scale with which the result grows, if it is declared.
    pub(crate) fn power(&self) -> Option<i32> {
        let power = |invariance: &Invariance| match (invariance.motion, invariance.answer) {
            (Motion::Scaling, Effect::Stays) => Some(0),
            (Motion::Scaling, Effect::Power(power)) => Some(power),
            _ => None,
        };
        self.invariances.iter().find_map(power)
    }
    /// Returns `true` if exchanging the shapes changes nothing. Rounding decides the side of a jump, so a row with
    /// jumps anywhere is not symmetric.
    pub(crate) fn is_symmetric(&self) -> bool {
        let exchange = Invariance::new(Motion::Exchange, Effect::Stays);
        self.invariances.contains(&exchange) && self.jumps != Jumps::Anywhere
    }
}

/// A function with declared properties: an operation ([`Op`](crate::kernels::Op)), a search
/// ([`Search`](crate::kernels::Search)) or a fold ([`Fold`](crate::kernels::Fold)).
pub trait Declares: Copy + Debug + Default + Send + Sync + 'static {
    /// The properties.
    const DECLARED: Declared;
}

/// Returns an argument from its numbers; `None` for a wrong count.
#[must_use]
pub fn argument<X: Fixed<Scalar = f64>>(numbers: &[f64]) -> Option<X> {
    (numbers.len() == X::LEN).then(|| X::load(numbers))
}

/// Writes the declared properties that clauses state, over those of a base: the one place that reads the clauses of
/// [`operation!`](crate::operation) and of the library's tables.
///
/// It takes the base, the type of the argument, the pattern of its parts, and the clauses, in their order and in
/// parentheses.
#[doc(hidden)]
#[macro_export]
macro_rules! __declared {
    (
        $base:expr, $In:ty, $arguments:tt,
        (
            $(invariances [$($motion:ident $answer:ident $(($power:literal))?),* $(,)?])?
            $(finite $finite:ident $(($limits:expr))?)?
            $(range $range:ident)?
            $(extremes $extremes:ident)?
            $(lower $lower:ident)?
            $(jumps $jumps:ident)?
            $(domain $domain:block)?
            $(resolution $absolute:literal)?
            $(relative_resolution $share:literal)?
            $(roundings $roundings:block)?
            $(derivative $derivative:ident)?
        )
    ) => {
        $base
            $(.invariances(&[$($crate::__private::Invariance {
                motion: $crate::__private::Motion::$motion,
                answer: $crate::__private::Effect::$answer $(($power))?,
            }),*]))?
            $(.finite($crate::__private::Finite::$finite $(($limits))?))?
            $(.range($crate::__private::Range::$range))?
            $(.extremes($crate::__private::Extremes::$extremes))?
            $(.lower($crate::__private::LowerBound::$lower))?
            $(.jumps($crate::__private::Jumps::$jumps))?
            $(.domain(|numbers| {
                #[allow(unused_parens, unused_variables)]
                $crate::__private::argument::<$In>(numbers).is_some_and(|$arguments| $domain)
            }))?
            $(.resolution($absolute))?
            $(.relative_resolution($share))?
            $(.roundings(|numbers| {
                #[allow(unused_parens, unused_variables)]
                $crate::__private::argument::<$In>(numbers).map_or(0.0, |$arguments| $roundings)
            }))?
            $(.derivative($crate::__private::Derivative::$derivative))?
    };
}

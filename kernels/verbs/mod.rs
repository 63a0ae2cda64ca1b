//! Verbs: one name per function, whatever shapes it takes.
//!
//! A verb is a value without fields, such as [`Iou`] or [`Distance`]. Columns select the formula:
//!
//! ```
//! use geograd::prelude::*;
//! let cars = [Obb2::new(0.0_f64, 0.0, 4.0, 2.0, 0.0)];
//! let masts = [Circle::new(Vec2::new(5.0, 0.0), 1.0)];
//! let cpu = Cpu::new();
//! assert_eq!(cpu.aligned(Distance, (&masts, &cars))?, [2.0]);
//! assert_eq!(cpu.all_pairs(Iou, &cars, &cars)?.values(), [1.0]);
//! let (_, (by_mast, _)) = cpu.aligned(Distance.value_grad(), (&masts, &cars))?;
//! assert_eq!(by_mast[0].center, Vec2::new(1.0, 0.0));
//! # Ok::<(), geograd::Error>(())
//! ```
//!
//! The pages of [`Unary`], [`Binary`], [`Ternary`] and [`Quaternary`] list every verb with its shapes. A *row* is a verb, the shapes
//! that it takes, and the formula. [`operation!`](crate::operation) adds rows for your own shapes,
//! [`verb!`](crate::verb) defines a verb, and [`function`] runs a plain generic function without a row.
//!
//! Overlaps, scores and intersections are methods of their first argument, too, for every row, own ones included
//! ([`prelude`](crate::prelude)): `a.iou(b)`. Distances, closest points and penetration are methods of any two convex
//! shapes of the plane ([`Convex`](crate::distance::Convex)); a row adds no method to them: `Distance.of(a, b)` calls
//! it. A batch of a pair without a row runs `function(|a: Segment2<_>, b: Triangle2<_>| a.distance(b))`. A method,
//! [`of`](Iou::of) and a batch return equal bits. A verb takes up to four arguments; [`function`] and an operation
//! with a name of its own take up to six.
//!
//! # Verbs by shapes
//!
#![doc = include_str!("shapes.md")]
mod function;
mod list;
pub mod mesh_solids;
pub mod methods;

pub use function::{Arguments, AtLeast, OwnFunction, at_least, function};
pub use list::*;

use crate::Fixed;

/// Verbs of one argument: `Area: Unary<Triangle2<f64>>` says that `Area` takes a triangle.
#[diagnostic::on_unimplemented(
    message = "`{Self}` of `{A}` is not defined",
    label = "`{Self}` does not take this shape",
    note = "a row adds shapes of your own: `operation! {{ {Self}: (a: …) -> … {{ … }} … }}`",
    note = "shapes of the library without a row: `function(f)` runs any generic function"
)]
pub trait Unary<A> {
    /// The result.
    type Out;
    /// The operation of the row.
    #[doc(hidden)]
    type By: Copy;
    #[doc(hidden)]
    const BY: Self::By;
    /// Computes the result.
    #[doc(hidden)]
    fn apply(a: A) -> Self::Out;
}

/// Verbs of two arguments: `Distance: Binary<Vec2<f64>, Obb2<f64>>` says that `Distance` takes a point and a box.
#[diagnostic::on_unimplemented(
    message = "`{Self}` of `{A}` and `{B}` is not defined",
    label = "`{Self}` does not take these two shapes",
    note = "a row adds shapes of your own: `operation! {{ {Self}: (a: …, b: …) -> … {{ … }} … }}`",
    note = "a row has one order of its shapes: exchange them, or run `function(f)` of any generic function"
)]
pub trait Binary<A, B> {
    /// The result.
    type Out;
    /// The operation of the row.
    #[doc(hidden)]
    type By: Copy;
    #[doc(hidden)]
    const BY: Self::By;
    /// Computes the result.
    #[doc(hidden)]
    fn apply(a: A, b: B) -> Self::Out;
}

/// Verbs of three arguments: `Circumcircle: Ternary<V, V, V>` says that `Circumcircle` takes three `V`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` of `{A}`, `{B}` and `{C}` is not defined",
    label = "`{Self}` does not take these three shapes",
    note = "a row adds shapes of your own: `operation! {{ {Self}: (a: …, b: …, c: …) -> … {{ … }} … }}`",
    note = "shapes of the library without a row: `function(f)` runs any generic function"
)]
pub trait Ternary<A, B, C> {
    /// The result.
    type Out;
    /// The operation of the row.
    #[doc(hidden)]
    type By: Copy;
    #[doc(hidden)]
    const BY: Self::By;
    /// Computes the result.
    #[doc(hidden)]
    fn apply(a: A, b: B, c: C) -> Self::Out;
}

/// Verbs of four arguments: `TimeOfImpact: Quaternary<A, M, B, M>` says that `TimeOfImpact` takes two bodies and their motions.
#[diagnostic::on_unimplemented(
    message = "`{Self}` of `{A}`, `{B}`, `{C}` and `{D}` is not defined",
    label = "`{Self}` does not take these four shapes",
    note = "shapes of the library without a row: `function(f)` runs any generic function"
)]
pub trait Quaternary<A, B, C, D> {
    /// The result.
    type Out;
    /// The operation of the row.
    #[doc(hidden)]
    type By: Copy;
    #[doc(hidden)]
    const BY: Self::By;
    /// Computes the result.
    #[doc(hidden)]
    fn apply(a: A, b: B, c: C, d: D) -> Self::Out;
}

/// Verbs by their arguments as one type, `(Vec2<f64>, Obb2<f64>)` or a lone shape: for code that is generic over the
/// verb.
pub trait Takes<In: Fixed> {
    /// The result.
    type Out;
    /// The operation of the row.
    type By: Copy;
    /// The operation of the row, as a value.
    const BY: Self::By;
}

/// The operation of a verb and the shapes `In`: `RowOf<Iou, (Obb2<f64>, Obb2<f64>)>`.
pub type RowOf<V, In> = <V as Takes<In>>::By;

/// Defines a verb: a value that batches run on all shapes for which it has a row.
///
/// `=> HasGap::gap` is optional. It makes the verb a method of its first argument, by a trait as visible as the verb.
///
/// ```
/// use geograd::prelude::*;
/// use geograd::{operation, verb};
///
/// verb! {
///     /// The free width between two vehicles; 0 where they touch.
///     pub Gap: (a, b) => HasGap::gap
/// }
/// operation! {
///     /// Between two rotated boxes.
///     Gap: (a: Obb2<S>, b: Obb2<S>) -> S { a.distance(b) }
///     invariances [Exchange Stays] jumps Never derivative Reverse
///
///     /// Between two circles.
///     Gap: (a: Circle<S>, b: Circle<S>) -> S { a.distance(b) }
///     invariances [Exchange Stays] jumps Never derivative Reverse
/// }
///
/// let masts = [Circle::new(Vec2::new(0.0_f64, 0.0), 1.0), Circle::new(Vec2::new(5.0, 0.0), 1.0)];
/// assert_eq!(Cpu::new().all_pairs(Gap, &masts[..1], &masts)?.values(), [0.0, 3.0]);
/// assert_eq!(masts[0].gap(masts[1]), 3.0);
/// # Ok::<(), geograd::Error>(())
/// ```
#[macro_export]
macro_rules! verb {
    ($( $(#[$doc:meta])* $vis:vis $Verb:ident: $arguments:tt $(=> $Trait:ident::$method:ident)? )+) => { $(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        $vis struct $Verb;

        $crate::__derivatives!($Verb);
        impl $Verb {
            /// Returns the operation for the shapes `In`, `(A<f64>, B<f64>)` or a lone one: for the harness and
            /// programs.
            #[must_use]
            pub const fn row<In: $crate::__private::Fixed>(self) -> <Self as $crate::__private::Takes<In>>::By
            where
                Self: $crate::__private::Takes<In>,
            {
                <Self as $crate::__private::Takes<In>>::BY
            }
        }
        $crate::__verb!([of $Verb] $arguments);
        $crate::__verb!([runs [] $Verb] $arguments);
        $( $crate::__verb!([method [$vis] $Trait::$method $Verb [$Verb]] $arguments); )?
    )+ };
}

/// Defines the parts of a verb: `of`, its runs in batches by the operation of its row, and the method of its first argument.
///
/// The first arms turn arguments into a trait, words for documentation, type parameters and parameters.
#[doc(hidden)]
#[macro_export]
macro_rules! __verb {
    ([$($part:tt)*] ($a:ident)) => {
        $crate::__verb!(@$($part)*, Unary, "one shape", "this shape", A, $a: A, []);
    };
    ([$($part:tt)*] ($a:ident, $b:ident)) => {
        $crate::__verb!(@$($part)*, Binary, "two shapes", "this shape and another", (A, B), $a: A, [$b: B]);
    };
    ([$($part:tt)*] ($a:ident, $b:ident, $c:ident)) => {
        $crate::__verb!(@$($part)*, Ternary, "three shapes", "this shape and others", (A, B, C), $a: A, [$b: B, $c: C]);
    };
    ([$($part:tt)*] ($a:ident, $b:ident, $c:ident, $d:ident)) => {
        $crate::__verb!(
            @$($part)*, Quaternary, "four shapes", "this shape and others", (A, B, C, D), $a: A, [$b: B, $c: C, $d: D]
        );
    };
    (
        @of $Verb:ident, $Takes:ident, $shapes:literal, $these:literal, $In:ty, $a:ident: $A:ident,
        [$($b:ident: $B:ident),*]
    ) => {
        impl $Verb {
            #[doc = ::core::concat!("Computes the result for ", $shapes, " of any scalar.")]
            #[inline]
            pub fn of<$A $(, $B)*>(
                self,
                $a: $A
                $(, $b: $B)*
            ) -> <Self as $crate::__private::$Takes<$A $(, $B)*>>::Out
            where
                Self: $crate::__private::$Takes<$A $(, $B)*>,
            {
                <Self as $crate::__private::$Takes<$A $(, $B)*>>::apply($a $(, $b)*)
            }
        }
    };
    (
        @runs [$($generic:tt)*] $Verb:ty, $Takes:ident, $shapes:literal, $these:literal, $In:ty, $a:ident: $A:ident,
        [$($b:ident: $B:ident),*]
    ) => {
        impl<$($generic)* $A $(, $B)*> $crate::__private::Takes<$In> for $Verb
        where
            $In: $crate::__private::Fixed,
            $Verb: $crate::__private::$Takes<$A $(, $B)*>,
        {
            type Out = <$Verb as $crate::__private::$Takes<$A $(, $B)*>>::Out;
            type By = <$Verb as $crate::__private::$Takes<$A $(, $B)*>>::By;
            const BY: Self::By = <$Verb as $crate::__private::$Takes<$A $(, $B)*>>::BY;
        }
        impl<$($generic)* $A $(, $B)*> $crate::__private::Function<$In> for $Verb
        where
            $In: $crate::__private::Item,
            $Verb: $crate::__private::$Takes<$A $(, $B)*, By: $crate::__private::Function<$In>>,
        {
            type Out = <<$Verb as $crate::__private::$Takes<$A $(, $B)*>>::By
                as $crate::__private::Function<$In>>::Out;
            fn call(
                &self,
            ) -> ::core::result::Result<
                $crate::__private::Call<<$In as $crate::__private::Pack>::Scalar>,
                $crate::__private::Error,
            > {
                $crate::__private::Function::<$In>::call(&<$Verb as $crate::__private::$Takes<$A $(, $B)*>>::BY)
            }
        }
    };
    (
        @method [$vis:vis] $Trait:ident::$method:ident $Name:ident [$Verb:path], $Takes:ident, $shapes:literal,
        $these:literal, $In:ty, $a:ident: $A:ident, [$($b:ident: $B:ident),*]
    ) => {
        #[doc = ::core::concat!("[`", ::core::stringify!($Name), "`](", ::core::stringify!($Verb), ") as a method.")]
        $vis trait $Trait<$($B),*>: Sized {
            /// The result.
            type Out;
            #[doc = ::core::concat!(
                "[`", ::core::stringify!($Name), "`](", ::core::stringify!($Verb), ") of ", $these, "."
            )]
            #[must_use]
            fn $method(self $(, $b: $B)*) -> Self::Out;
        }
        impl<$A $(, $B)*> $Trait<$($B),*> for $A
        where
            $Verb: $crate::__private::$Takes<$A $(, $B)*>,
        {
            type Out = <$Verb as $crate::__private::$Takes<$A $(, $B)*>>::Out;
            #[inline]
            fn $method(self $(, $b: $B)*) -> Self::Out {
                <$Verb as $crate::__private::$Takes<$A $(, $B)*>>::apply(self $(, $b)*)
            }
        }
    };
}

/// Verbs that a batch folds over a kind of path: `Distance: OverPath<Ring>` says that `Distance.over_ring()` is an
/// operation for [`Cpu::fold`](crate::kernels::Cpu::fold). The kinds are in [`fold`](crate::kernels::fold).
pub trait OverPath<P> {
    /// The operation.
    type By: crate::kernels::Fold;
    /// The operation, as a value.
    const BY: Self::By;
}

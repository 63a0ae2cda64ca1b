//! Operations in one row.

/// Makes a generic function an operation: a type without fields whose value batches, the harness and
/// programs take.
///
/// A row says the type and its name, the arguments (one to six shapes or numbers made of `S`), the
/// result and the formula, then its invariances, its jumps, and the source of its derivatives. All
/// three must be said: `invariances []` and `jumps Never` say none.
///
/// Clauses stand in this order; those in brackets are optional.
/// A call takes several rows, about a dozen before it needs a higher `recursion_limit`.
///
/// | clause | words |
/// | --- | --- |
/// | `invariances [Motion Effect, …]` | motions of all arguments: `TranslationX`, `TranslationY`, `Rotation` (in space about z), `Scaling`, `Exchange`, and in space `TranslationZ`, `RotationX`, `RotationY`; the result `Stays`, grows with `Power(p)` of the scale, or `Follows` |
/// | \[`finite`\] | `Always`, `Within(limits)`, `Values(limits)`, `Undeclared`: [`Finite`](crate::kernels::op::Finite) |
/// | \[`range`\] | `RATIO`, `SIGNED`, `NOT_NEGATIVE`, …: the constants of [`Range`](crate::kernels::op::Range) |
/// | \[`extremes`\] | `Shared`, `Ratio`, `Union`, `One`: [`Extremes`](crate::kernels::op::Extremes) |
/// | \[`lower`\] | `Distance`, `SquaredDistance`: [`LowerBound`](crate::kernels::op::LowerBound), by which searches for the nearest skip pairs |
/// | `jumps` | `Never`, `FromZero` (where the value leaves zero), `Anywhere` |
/// | \[`domain { … }`\] | a condition of the arguments outside of which nothing is checked |
/// | \[`resolution x`\], \[`relative_resolution x`\] | the error of a value beyond rounding |
/// | \[`roundings { … }`\] | the error of a value where terms cancel, in roundings of the format: [`roundings`](crate::kernels::op::Declared::roundings) |
/// | `derivative` | `Reverse`; `Forward`, where large terms cancel backwards; <code>ByHand &#124;(a, b), out_bar&#124; { … }</code> |
///
/// ```
/// use geograd::kernels::Cpu;
/// use geograd::{Obb2, Vec2, operation};
///
/// operation! {
///     /// How far a point is beyond a box, along the box's axes; negative inside.
///     pub Beyond = "beyond": (point: Vec2<S>, shape: Obb2<S>) -> S {
///         let local = shape.world_from_local().inverse() * point;
///         let (x, y) = (local.x.magnitude() - shape.size.x.halved(),
///             local.y.magnitude() - shape.size.y.halved());
///         x.most(y)
///     }
///     invariances [TranslationX Stays, TranslationY Stays, Scaling Power(1), Rotation Stays]
///     jumps Never
///     derivative Reverse
/// }
///
/// let points = [Vec2::new(3.0_f64, 0.0), Vec2::new(0.0, 2.0)];
/// let shapes = [Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0); 2];
/// assert_eq!(Cpu::new().aligned(Beyond, (&points, &shapes))?, [2.0, 1.0]);
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// A function that is not defined everywhere says where it is, of the same arguments made of `f64`; one whose values
/// are off by more than rounding says by how much. Both come between `jumps` and `derivative`, and [`Check::of`]
/// takes them from there. A camera has a pole in the plane of its aperture, so its row is refused without the domain:
///
/// ```
/// use geograd::check::*;
/// use geograd::{Shape, Vec2, Vec3, operation};
///
/// /// A pinhole camera at the origin that looks along z.
/// #[derive(Clone, Copy, Debug, PartialEq, Shape)]
/// pub struct Camera<S> {
///     #[shape(positive)]
///     focal: S,
///     center: Vec2<S>,
/// }
///
/// operation! {
///     /// The image of a point, in pixels.
///     pub Project = "project": (point: Vec3<S>, camera: Camera<S>) -> Vec2<S> {
///         let scale = camera.focal.over(point.z);
///         Vec2::new(point.x * scale, point.y * scale) + camera.center
///     }
///     invariances []
///     jumps Never
///     domain { point.z > 0.1 }
///     derivative Reverse
/// }
///
/// Check::of(Project).samples(50).assert();
/// let everywhere = Check::of(Project).samples(50).inside(|_| true).run();
/// assert!(everywhere.iter().any(|report| !report.passed()));
/// ```
///
/// Inputs outside are not judged, and a report says how many there were. `resolution 1e-9` is in the unit of the
/// result, `relative_resolution 1e-6` a share of each of its numbers.
///
/// [`Check::of`]: crate::check::Check::of
///
/// An adjoint by hand is a further formula, of the arguments and the cotangent of the result, that
/// gives the result and the derivatives:
///
/// ```
/// use geograd::kernels::{Cpu, Op};
/// use geograd::operation;
///
/// operation! {
///     /// The product of two numbers.
///     pub Product = "product": (a: S, b: S) -> S { a * b }
///     invariances [Exchange Stays]
///     jumps Never
///     derivative ByHand |(a, b), out_bar| { (a * b, (b * out_bar, a * out_bar)) }
///
///     /// The square of a number.
///     pub Square = "square": (a: S) -> S { a * a }
///     invariances []
///     jumps Never
///     derivative Reverse
/// }
///
/// let (a, b) = ([2.0_f64], [3.0]);
/// let (value, (by_a, _)) = Cpu::new().aligned(Product.value_grad(), (&a, &b))?;
/// assert_eq!((value[0], by_a[0]), (6.0, 3.0));
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// A row without a name of its own adds shapes to a verb, the library's or one's own: here a shape of one's own to
/// [`Distance`](crate::kernels::verbs::Distance).
///
/// ```
/// use geograd::prelude::*;
/// use geograd::operation;
///
/// /// A round tree of one height.
/// #[derive(Clone, Copy, Debug, PartialEq, geograd::Shape)]
/// struct Tree<S> {
///     foot: Vec2<S>,
///     #[shape(positive)]
///     radius: S,
/// }
///
/// operation! {
///     /// From a vehicle to a tree.
///     Distance: (car: Obb2<S>, tree: Tree<S>) -> S {
///         (car.signed_distance(tree.foot) - tree.radius).most(S::zero())
///     }
///     invariances [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1)]
///     jumps Never
///     derivative Reverse
/// }
///
/// let cars = [Obb2::new(0.0_f64, 0.0, 4.0, 2.0, 0.0)];
/// let trees = [Tree { foot: Vec2::new(5.0, 0.0), radius: 1.0 }];
/// let (distance, (_, by_tree)) = Cpu::new().aligned(Distance.value_grad(), (&cars, &trees))?;
/// assert_eq!((distance[0], by_tree[0].radius), (2.0, -1.0));
/// # Ok::<(), geograd::Error>(())
/// ```
#[macro_export]
macro_rules! operation {
    () => {};
    // An operation with a name of its own.
    (
        $(#[$($doc:tt)*])*
        $vis:vis $Name:ident = $name:literal: ($($arg:ident: $type:ty),+ $(,)?) -> $out:ty $body:block
        $($clauses:tt)*
    ) => {
        $crate::__operation! {
            @invariances
            [named [$([$($doc)*])*] $vis $Name, $name, [$($arg: $type),+] -> $out, $body]
            $($clauses)*
        }
    };
    ($(#[$($doc:tt)*])* $vis:vis $Name:ident = $($rest:tt)*) => {
        ::core::compile_error!(
            "an operation begins with its name, arguments, result and formula: \
             `pub Gap = \"gap\": (a: Circle<S>, b: Circle<S>) -> S { … }`"
        );
    };
    // A row of a verb.
    (
        $(#[$($doc:tt)*])*
        $Verb:path: ($($arg:ident: $type:ty),+ $(,)?) -> $out:ty $body:block
        $($clauses:tt)*
    ) => {
        $crate::__operation! {
            @invariances
            [row [$([$($doc)*])*] $Verb, [$($arg: $type),+] -> $out, $body]
            $($clauses)*
        }
    };
}

/// Collects the clauses of a row up to its derivative, which ends it, and writes the row. The rest are further rows.
///
/// The order and the words of clauses are those of [`__declared!`](crate::__declared), which alone reads them.
#[doc(hidden)]
#[macro_export]
macro_rules! __operation {
    (@invariances $row:tt invariances [$($invariances:tt)*] $($rest:tt)*) => {
        $crate::__operation! { @jumps $row [invariances [$($invariances)*]] $($rest)* }
    };
    (@invariances $($rest:tt)*) => {
        ::core::compile_error!(
            "`invariances […]` is missing after the formula: `invariances []` declares none, \
             `invariances [TranslationX Stays, Scaling Power(1)]` two"
        );
    };
    (@jumps $row:tt [$($clauses:tt)*] jumps $jumps:tt $($rest:tt)*) => {
        $crate::__operation! { @derivative $row [$($clauses)* jumps $jumps] $($rest)* }
    };
    (@jumps $row:tt $clauses:tt derivative $($rest:tt)*) => {
        $crate::__operation! { @jumps $row $clauses }
    };
    (
        @derivative $row:tt [$($clauses:tt)*]
        derivative $derivative:tt |$input:pat_param, $out_bar:ident| $adjoint:block $($rest:tt)*
    ) => {
        $crate::__operation! { @$row ($($clauses)* derivative $derivative) |$input, $out_bar| $adjoint }
        $crate::operation! { $($rest)* }
    };
    (@derivative $row:tt [$($clauses:tt)*] derivative $derivative:tt $($rest:tt)*) => {
        $crate::__operation! { @$row ($($clauses)* derivative $derivative) }
        $crate::operation! { $($rest)* }
    };
    // Any other clause: two or three tokens, which keep their places in messages.
    (@$next:ident $row:tt [$($clauses:tt)*] $clause:tt $word:tt ($($limits:tt)*) $($rest:tt)*) => {
        $crate::__operation! { @$next $row [$($clauses)* $clause $word ($($limits)*)] $($rest)* }
    };
    (@$next:ident $row:tt [$($clauses:tt)*] $clause:tt $word:tt $($rest:tt)*) => {
        $crate::__operation! { @$next $row [$($clauses)* $clause $word] $($rest)* }
    };
    (@jumps $row:tt $clauses:tt $($rest:tt)*) => {
        $crate::__operation! {
            @missing $clauses
            "`jumps …` is missing before `derivative`: `jumps Never`, `jumps FromZero` or `jumps Anywhere`"
        }
    };
    (@derivative $row:tt $clauses:tt $($rest:tt)*) => {
        $crate::__operation! {
            @missing $clauses
            "`derivative …` is missing, the last clause: `derivative Reverse`, `derivative Forward` or \
             `derivative ByHand |(a, b), out_bar| { … }`"
        }
    };
    // A clause may be misspelt: the compiler points to it.
    (@missing [$($clauses:tt)*] $message:literal) => {
        const _: $crate::__private::Declared = $crate::__declared!(
            $crate::__private::Declared::new("", &[], $crate::__private::Jumps::Never),
            (), (), ($($clauses)*)
        );
        ::core::compile_error!($message);
    };
    (
        @[named [$([$($doc:tt)*])*] $vis:vis $Name:ident, $($row:tt)*]
        $clauses:tt $(|$input:pat_param, $out_bar:ident| $adjoint:block)?
    ) => {
        $(#[$($doc)*])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        $vis struct $Name;

        $crate::__derivatives!($Name);
        $crate::__operation! {
            @impl [$([$($doc)*])*] $Name, $($row)* $clauses $(|$input, $out_bar| $adjoint)?
        }
    };
    (
        @[row [$([$($doc:tt)*])*] $Verb:path, [$($arg:ident: $type:ty),+] -> $out:ty, $body:block]
        $clauses:tt $(|$input:pat_param, $out_bar:ident| $adjoint:block)?
    ) => {
        const _: () = {
            // As visible as the shapes that it is of.
            pub struct Item<X>(::core::marker::PhantomData<fn() -> X>);
            #[allow(dead_code)]
            type S = f64;
            #[allow(unused_parens)]
            type This = Item<($($type),+)>;
            impl<X> ::core::clone::Clone for Item<X> {
                fn clone(&self) -> Self {
                    *self
                }
            }
            impl<X> ::core::marker::Copy for Item<X> {}
            impl<X> ::core::fmt::Debug for Item<X> {
                fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
                    f.write_str(::core::stringify!($Verb))
                }
            }
            impl<X> ::core::default::Default for Item<X> {
                fn default() -> Self {
                    Item(::core::marker::PhantomData)
                }
            }
            $crate::__operation! {
                @impl [$([$($doc)*])*] This,
                ::core::concat!(::core::stringify!($Verb), ::core::stringify!(($($type),+))),
                [$($arg: $type),+] -> $out, $body $clauses $(|$input, $out_bar| $adjoint)?
            }
            $crate::__takes!($Verb, ($($type),+), This, Item(::core::marker::PhantomData));
        };
    };
    (
        @impl [$([$($doc:tt)*])*] $Name:ident, $name:expr,
        [$($arg:ident: $type:ty),+] -> $out:ty, $body:block
        $clauses:tt $(|$input:pat_param, $out_bar:ident| $adjoint:block)?
    ) => {
        impl $crate::__private::Declares for $Name {
            const DECLARED: $crate::__private::Declared = $crate::__declared!(
                $crate::__private::Declared::new($name, &[], $crate::__private::Jumps::Never)
                    .arguments(&[$(::core::stringify!($arg)),+])
                    .doc($crate::__doc!([] $([$($doc)*])*)),
                <Self as $crate::__private::Op>::In<f64>, ($($arg),+), $clauses
            );
        }

        // One argument needs none.
        #[allow(unused_parens)]
        impl $crate::__private::Op for $Name {
            type In<S: $crate::__private::Scalar> = ($($type),+);
            type Out<S: $crate::__private::Scalar> = $out;
            #[allow(unused_imports, unused_parens)]
            fn eval<S: $crate::__private::Scalar>(($($arg),+): Self::In<S>) -> Self::Out<S> {
                use $crate::__private::{Mask as _, Scalar as _};
                $body
            }
            $(
                #[allow(unused_imports, unused_parens)]
                fn adjoint<S: $crate::__private::Scalar>(
                    $input: Self::In<S>,
                    $out_bar: Self::Out<S>,
                ) -> ::core::option::Option<(Self::Out<S>, Self::In<S>)> {
                    use $crate::__private::{Mask as _, Scalar as _};
                    ::core::option::Option::Some($adjoint)
                }
            )?
        }
    };
}

/// Derivative of a verb or an operation as methods that need no trait in scope.
#[doc(hidden)]
#[macro_export]
macro_rules! __derivatives {
    ($Name:ident) => {
        #[allow(dead_code)]
        impl $Name {
            /// Returns the function with its gradient: batches return the result, one number, and the gradient by every
            /// argument.
            #[must_use]
            pub const fn value_grad(self) -> $crate::__private::ValueGrad<Self> {
                $crate::__private::ValueGrad::of(self)
            }
            /// Returns the function with its Jacobian: aligned batches return the result, and in its shape the gradient
            /// of every number.
            #[must_use]
            pub const fn jacobian(self) -> $crate::__private::Jacobian<Self> {
                $crate::__private::Jacobian::of(self)
            }
            /// Returns the adjoint: batches take the arguments and a cotangent of the result, and return the cotangents
            /// of the arguments.
            #[must_use]
            pub const fn vjp(self) -> $crate::__private::Vjp<Self> {
                $crate::__private::Vjp::of(self)
            }
            /// Returns the function with its derivative along a direction: batches take the arguments and then as many
            /// directions, and return the result and its derivative.
            #[must_use]
            pub const fn jvp(self) -> $crate::__private::Jvp<Self> {
                $crate::__private::Jvp::of(self)
            }
            /// Returns the Hessian times a direction: batches take the arguments and then as many directions, and
            /// return the derivative of the gradient along them. The result is one number.
            #[must_use]
            pub const fn hvp(self) -> $crate::__private::Hvp<Self> {
                $crate::__private::Hvp::of(self)
            }
            /// Returns the function with its gradient and Hessian: [`value_grad`](Self::value_grad) with its Jacobian.
            #[must_use]
            pub const fn hessian(
                self,
            ) -> $crate::__private::Jacobian<$crate::__private::ValueGrad<Self>> {
                $crate::__private::ValueGrad::of(self).jacobian()
            }
        }
    };
}

/// Joins a verb and shapes to the operation that serves them.
#[doc(hidden)]
#[macro_export]
macro_rules! __takes {
    ($Verb:ty, ($A:ty), $By:ident, $value:expr) => {
        impl<S: $crate::__private::Scalar> $crate::__private::Unary<$A> for $Verb {
            type Out = <$By as $crate::__private::Op>::Out<S>;
            type By = $By;
            const BY: $By = $value;
            #[inline]
            fn apply(a: $A) -> Self::Out {
                $crate::__private::guarded(a, <$By as $crate::__private::Op>::eval::<S>)
            }
        }
    };
    ($Verb:ty, ($A:ty, $B:ty), $By:ident, $value:expr) => {
        impl<S: $crate::__private::Scalar> $crate::__private::Binary<$A, $B> for $Verb {
            type Out = <$By as $crate::__private::Op>::Out<S>;
            type By = $By;
            const BY: $By = $value;
            #[inline]
            fn apply(a: $A, b: $B) -> Self::Out {
                $crate::__private::guarded((a, b), <$By as $crate::__private::Op>::eval::<S>)
            }
        }
    };
    ($Verb:ty, ($A:ty, $B:ty, $C:ty), $By:ident, $value:expr) => {
        impl<S: $crate::__private::Scalar> $crate::__private::Ternary<$A, $B, $C> for $Verb {
            type Out = <$By as $crate::__private::Op>::Out<S>;
            type By = $By;
            const BY: $By = $value;
            #[inline]
            fn apply(a: $A, b: $B, c: $C) -> Self::Out {
                $crate::__private::guarded((a, b, c), <$By as $crate::__private::Op>::eval::<S>)
            }
        }
    };
}

/// The text of doc comments, given a list of attributes: a line each.
#[doc(hidden)]
#[macro_export]
macro_rules! __doc {
    ([$($line:expr,)*]) => { ::core::concat!($($line, "\n"),*) };
    ([$($line:expr,)*] [doc = $next:expr] $($rest:tt)*) => {
        $crate::__doc!([$($line,)* $next,] $($rest)*)
    };
    ([$($line:expr,)*] [$($other:tt)*] $($rest:tt)*) => { $crate::__doc!([$($line,)*] $($rest)*) };
}

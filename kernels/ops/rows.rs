//! Rows of one function for many pairs of shapes.

/// Operations of one function of two shapes: the function, its result, what all of them promise, where
/// they jump and where their slopes come from; then for every pair its name, the shapes and what else
/// it promises.
macro_rules! rows_of_pairs {
    ($(
        $function:path as $title:literal -> $out:ty,
        promises [$($motion:ident $answer:ident $(($power:literal))?),*],
        $(finite $finite:ident $(($limits:expr))?,)? $(range $range:ident,)? $(extremes $extremes:ident,)?
        jumps $jumps:ident, slopes $slopes:ident {
            $($Name:ident = $name:literal: $A:ident, $B:ident, $what:literal
                [$($further:ident $same:ident),*];)*
        }
    )*) => { $( crate::kernels::ops::rows::rows_of_pairs! {
        @each $function, $title, $out, [$($motion $answer $(($power))?),*],
        [
            $(const FINITE: crate::kernels::op::Finite = crate::kernels::op::Finite::$finite $(($limits))?;)?
            $(const RANGE: crate::kernels::op::Range = crate::kernels::op::Range::$range;)?
            $(const EXTREMES: crate::kernels::op::Extremes = crate::kernels::op::Extremes::$extremes;)?
        ], $jumps, $slopes;
        $($Name, $name, $A, $B, $what, [$($further $same),*];)*
    } )* };
    (@each $function:path, $title:literal, $out:ty, $shared:tt, $data:tt, $jumps:ident, $slopes:ident;
        $($Name:ident, $name:literal, $A:ident, $B:ident, $what:literal, $own:tt;)*) => { $(
        #[doc = concat!($title, " of ", $what, ".")]
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $Name;

        impl crate::kernels::op::Op for $Name {
            const NAME: &'static str = $name;
            const ARGUMENTS: &'static [&'static str] = &crate::kernels::ops::rows::names(
                crate::kernels::ops::rows::noun!($A),
                crate::kernels::ops::rows::noun!($B),
            );
            const DOC: &'static str = concat!($title, " of ", $what, ".");
            type In<S: crate::Scalar> = ($A<S>, $B<S>);
            type Out<S: crate::Scalar> = $out;
            const PROMISES: &'static [crate::kernels::op::Promise] =
                crate::kernels::ops::rows::promises!($shared $own);
            const JUMPS: crate::kernels::op::Jumps = crate::kernels::op::Jumps::$jumps;
            const SLOPES: crate::kernels::op::Slopes = crate::kernels::op::Slopes::$slopes;
            crate::kernels::ops::rows::items!($data);
            #[inline]
            fn eval<S: crate::Scalar>((a, b): Self::In<S>) -> $out {
                $function(a, b)
            }
        }
    )* };
}

/// Operations with a search: the type with its capacities, its name, its arguments and what they are, its result
/// and its record; how it decides and how it replays; what it promises and where it jumps.
macro_rules! searches {
    ($(
        $(#[$($doc:tt)*])*
        $Name:ident<$($N:ident),+> = $name:literal: ($($arg:ident),+) as $input:ty => $out:ty, by $record:ty;
        decide |$decided:pat_param| $decide:block
        replay |$replayed:pat_param, $found:ident| $replay:block
        promises $promises:tt
        $(finite $finite:ident $(($limits:expr))?)?
        $(range $range:ident)?
        $(extremes $extremes:ident)?
        jumps $jumps:ident
    )*) => { $(
        $(#[$($doc)*])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $Name<$(const $N: usize),+>;

        impl<$(const $N: usize),+> crate::kernels::decided::Decided for $Name<$($N),+> {
            const NAME: &'static str = $name;
            const ARGUMENTS: &'static [&'static str] = &[$(stringify!($arg)),+];
            const DOC: &'static str = crate::__doc!([] $([$($doc)*])*);
            type In<S: crate::Scalar> = $input;
            type Out<S: crate::Scalar> = $out;
            type Record = $record;
            const PROMISES: &'static [crate::kernels::op::Promise] =
                crate::kernels::ops::rows::promises!($promises []);
            const JUMPS: crate::kernels::op::Jumps = crate::kernels::op::Jumps::$jumps;
            $(const FINITE: crate::kernels::op::Finite =
                crate::kernels::op::Finite::$finite $(($limits))?;)?
            $(const RANGE: crate::kernels::op::Range = crate::kernels::op::Range::$range;)?
            $(const EXTREMES: crate::kernels::op::Extremes =
                crate::kernels::op::Extremes::$extremes;)?
            fn decide<S: crate::Scalar<Mask = bool>>($decided: $input) -> $record {
                $decide
            }
            fn replay<S: crate::Scalar>($replayed: $input, $found: $record) -> $out {
                $replay
            }
        }

        crate::__runs_decided!([$(const $N: usize),+] $Name<$($N),+>: $input => $out);
    )* };
}

/// Two lists of promises as one.
macro_rules! promises {
    ([$($motion:ident $answer:ident $(($power:literal))?),*] [$($further:ident $same:ident),*]) => {
        &[
            $(crate::kernels::op::Promise {
                motion: crate::kernels::op::Motion::$motion,
                answer: crate::kernels::op::Answer::$answer $(($power))?,
            },)*
            $(crate::kernels::op::Promise {
                motion: crate::kernels::op::Motion::$further,
                answer: crate::kernels::op::Answer::$same,
            },)*
        ]
    };
}

/// The items of a list.
macro_rules! items {
    ([$($item:tt)*]) => { $($item)* };
}

/// The noun of a shape, by its type.
macro_rules! noun {
    (Vec2) => {
        "point"
    };
    (Segment2) => {
        "segment"
    };
    (Line2) => {
        "line"
    };
    (Ray2) => {
        "ray"
    };
    (Triangle2) => {
        "triangle"
    };
    (Circle) => {
        "circle"
    };
    (Capsule2) => {
        "capsule"
    };
    (Aabb2) => {
        "shape"
    };
    (Obb2) => {
        "shape"
    };
}

/// The names of two arguments: what they are, or `a` and `b` of two of one kind.
pub(crate) const fn names(a: &'static str, b: &'static str) -> [&'static str; 2] {
    let (x, y) = (a.as_bytes(), b.as_bytes());
    let mut alike = x.len() == y.len();
    let mut i = 0;
    while alike && i < x.len() {
        alike = x[i] == y[i];
        i += 1;
    }
    if alike { ["a", "b"] } else { [a, b] }
}

pub(crate) use {items, noun, promises, rows_of_pairs, searches};

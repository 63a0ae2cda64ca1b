//! Tables of rows: what a function is, once, and a line for all shapes that it takes.

/// Rows of a verb. The head says the documentation, the names of the arguments, the result, the formula, the
/// [class](crate::kernels::ops::class::Class) of invariance, where it is finite, its range and its extremes, where it jumps
/// and where its slopes come from. A line each says the name of the row and its shapes, then what differs: another formula,
/// class, range, jump, source of slopes; and kernels that the library has compiled. A comment before it is its whole
/// documentation.
///
/// `" of two circles."` comes after a documentation that does not end in a full stop. Arguments `(a, b)` are called by what
/// they are where that differs: a point and a circle.
macro_rules! table {
    ($(
        $(#[doc = $title:literal])+
        $Verb:ty: $arguments:tt -> $out:ty $formula:block
        $class:tt
        $(finite $finite:ident $(($limits:expr))?)?
        $(range $range:ident)?
        $(extremes $extremes:ident)?
        jumps $jumps:ident slopes $slopes:ident
        { $($rows:tt)* }
    )*) => { $( crate::kernels::ops::rows::table! {
        @rows [concat!($($title),+)] $Verb, $arguments, $out, $formula, $class,
        [
            $(crate::kernels::op::Finite::$finite $(($limits))?,)?
            crate::kernels::op::Finite::Within(crate::kernels::op::Limits::ORDINARY),
        ],
        [$(crate::kernels::op::Range::$range,)? crate::kernels::op::Range::ANY],
        [$(crate::kernels::op::Extremes::$extremes,)? crate::kernels::op::Extremes::Unsaid],
        $jumps, $slopes;
        $($rows)*
    } )* };
    (
        @rows [$title:expr] $Verb:ty, $arguments:tt, $out:ty, $formula:block, $class:tt, $finite:tt, $range:tt,
        $extremes:tt, $jumps:ident, $slopes:ident;
        $(
            $(#[doc = $own_title:literal])?
            $name:literal: $($Shape:ident),+ $($own_formula:block)?
            $([$($own_class:tt)*])?
            $(finite $own_finite:ident)?
            $(range $own_range:ident)?
            $(extremes $own_extremes:ident)?
            $(jumps $own_jumps:ident)?
            $(slopes $own_slopes:ident $(|$input:pat_param, $out_bar:ident| $adjoint:block)?)?
            $(=> compiled { $compiled:expr })?;
        )*
    ) => { $( const _: () = {
        // As visible as the verb.
        #[derive(Clone, Copy, Debug, Default)]
        pub struct Row;

        // Of one argument they are needless.
        #[allow(unused_parens)]
        impl crate::kernels::op::Op for Row {
            const NAME: &'static str = $name;
            const ARGUMENTS: &'static [&'static str] =
                &crate::kernels::ops::rows::arguments!($arguments $($Shape)+);
            const DOC: &'static str = crate::kernels::ops::rows::text!(
                crate::kernels::ops::rows::first!($({ $own_title })? { $title }),
                $($Shape<f64>),+
            );
            type In<S: crate::Scalar> = ($($Shape<S>),+);
            type Out<S: crate::Scalar> = $out;
            const PROMISES: &'static [crate::kernels::op::Promise] = {
                crate::kernels::ops::rows::first!(@class [$([$($own_class)*])? $class] $($Shape<f64>),+)
            };
            const FINITE: crate::kernels::op::Finite =
                [$(crate::kernels::op::Finite::$own_finite,)? $finite[0]][0];
            const RANGE: crate::kernels::op::Range =
                [$(crate::kernels::op::Range::$own_range,)? $range[0]][0];
            const EXTREMES: crate::kernels::op::Extremes =
                [$(crate::kernels::op::Extremes::$own_extremes,)? $extremes[0]][0];
            const JUMPS: crate::kernels::op::Jumps =
                [$(crate::kernels::op::Jumps::$own_jumps,)? crate::kernels::op::Jumps::$jumps][0];
            const SLOPES: crate::kernels::op::Slopes =
                [$(crate::kernels::op::Slopes::$own_slopes,)? crate::kernels::op::Slopes::$slopes][0];
            #[inline]
            fn eval<S: crate::Scalar>($arguments: Self::In<S>) -> Self::Out<S> {
                crate::kernels::ops::rows::first!($($own_formula)? $formula)
            }
            $($(
                #[inline]
                fn adjoint<S: crate::Scalar>(
                    $input: Self::In<S>,
                    $out_bar: Self::Out<S>,
                ) -> Option<(Self::Out<S>, Self::In<S>)> {
                    Some($adjoint)
                }
            )?)?
            $(
                fn compiled() -> Option<crate::kernels::cpu::plan::Compiled> {
                    Some($compiled)
                }
            )?
        }
        crate::__takes!($Verb, ($($Shape<S>),+), Row, Row);
    }; )* };
}

/// The first of alternatives: what a row says, or else what its table says.
macro_rules! first {
    (@class [$class:tt $($other:tt)?] $($type:ty),+) => {
        crate::kernels::ops::class::promises!($class $($type),+)
    };
    ($one:block $($other:block)?) => { $one };
}

/// The names of arguments, by the names that the table gives them.
macro_rules! arguments {
    ((a, b) $A:ident $B:ident) => {
        crate::kernels::ops::noun::named(
            <$A<f64> as crate::kernels::ops::noun::Named>::NOUN.name,
            <$B<f64> as crate::kernels::ops::noun::Named>::NOUN.name,
        )
    };
    (($($argument:ident),+) $($Shape:ident)+) => { [$(stringify!($argument)),+] };
}

/// The documentation of a row: the title of the table, and what it is of.
macro_rules! text {
    ($title:expr, $($type:ty),+) => {{
        const PARTS: &[&str] = &crate::kernels::ops::noun::sentence(
            $title,
            &[$(<$type as crate::kernels::ops::noun::Named>::NOUN),+],
        );
        const BYTES: &[u8] = &crate::kernels::ops::noun::joined::<
            { crate::kernels::ops::noun::length(PARTS) },
        >(PARTS);
        match str::from_utf8(BYTES) {
            Ok(text) => text,
            Err(_) => panic!("parts of texts are texts"),
        }
    }};
}

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
            const ARGUMENTS: &'static [&'static str] = &crate::kernels::ops::noun::named(
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

pub(crate) use {arguments, first, items, noun, promises, rows_of_pairs, searches, table, text};

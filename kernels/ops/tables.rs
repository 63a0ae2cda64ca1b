//! Tables of rows: the shared clauses once, and a line for each row.

/// Writes the rows of a verb, and joins them to it.
///
/// ```text
/// /// The [squared distance](crate::distance::squared_distance) of {}.
/// SquaredDistance: (a, b) -> S { squared_distance(a, b) } [rigid(2), symmetric] (jumps Never) derivative Reverse {
///     "squared_distance_segments": Segment2, Segment2;
///     /// By the axes of both.
///     "squared_distance_obb2": Obb2, Obb2 { squared_distance_obb2(a, b) } (jumps Anywhere) derivative Forward;
/// }
/// ```
///
/// * The head has the documentation, arguments, result, formula, [class](crate::kernels::ops::class::Class) of
///   invariance, clauses and derivatives. Clauses stand in parentheses, in the order of
///   [`operation!`](crate::operation).
/// * A line has the name of the row and its shapes, then what differs from the head, in the same order.
/// * `{}` in the documentation stands for the shapes: "two segments". The documentation of a line is added to that of
///   the head.
/// * Arguments `(a, b)` of two kinds take the [names](crate::kernels::ops::noun::Noun) of these: `point`, `circle`.
macro_rules! table {
    ($(
        $(#[doc = $title:literal])+
        $Verb:ty: $arguments:tt -> $out:ty $formula:block
        $class:tt ($($clauses:tt)*) derivative $derivative:ident
        { $($rows:tt)* }
    )*) => { $( crate::kernels::ops::tables::table! {
        @rows [concat!($($title),+)] $Verb, $arguments, $out, $formula, $class,
        ($($clauses)* derivative $derivative);
        $($rows)*
    } )*
    crate::kernels::ops::tables::listed! {
        names [$(crate::kernels::ops::tables::table!(@list names [] $Verb; $($rows)*)),*]
        each |walk| { $(crate::kernels::ops::tables::table!(@list each [walk] $Verb; $($rows)*);)* }
    } };
    (
        @list $what:ident $walk:tt $Verb:ty;
        $(
            $(#[doc = $own_title:literal])?
            $name:literal: $($Shape:ident),+ $($own_formula:block)?
            $([$($own_class:tt)*])?
            $(($($own_clauses:tt)*))?
            $(derivative $own_derivative:ident $(|$input:pat_param, $out_bar:ident| $adjoint:block)?)?
            $(=> compiled { $compiled:expr })?;
        )*
    ) => {
        [$(crate::kernels::ops::tables::line!($what $walk straight $Verb, $name, [$($Shape)+] ($($Shape<f64>),+))),*]
    };
    (
        @rows [$title:expr] $Verb:ty, $arguments:tt, $out:ty, $formula:block, $class:tt, $head:tt;
        $(
            $(#[doc = $own_title:literal])?
            $name:literal: $($Shape:ident),+ $($own_formula:block)?
            $([$($own_class:tt)*])?
            $(($($own_clauses:tt)*))?
            $(derivative $own_derivative:ident $(|$input:pat_param, $out_bar:ident| $adjoint:block)?)?
            $(=> compiled { $compiled:expr })?;
        )*
    ) => { $( const _: () = {
        // As visible as the verb.
        #[derive(Clone, Copy, Debug, Default)]
        pub struct Item;

        impl crate::kernels::row::op::Declares for Item {
            const DECLARED: crate::kernels::row::op::Declared = crate::__declared!(
                crate::__declared!(
                    crate::kernels::row::op::Declared::new(
                        $name,
                        crate::kernels::ops::tables::first!(@class [$([$($own_class)*])? $class] $($Shape<f64>),+),
                        crate::kernels::row::op::Jumps::Never,
                    )
                    .arguments(&crate::kernels::ops::tables::arguments!($arguments $($Shape)+))
                    .doc(crate::kernels::ops::tables::text!($title, concat!($($own_title)?), $($Shape<f64>),+)),
                    <Self as crate::kernels::row::op::Op>::In<f64>, $arguments, $head
                ),
                <Self as crate::kernels::row::op::Op>::In<f64>, $arguments,
                ($($($own_clauses)*)? $(derivative $own_derivative)?)
            );
        }

        // One argument needs none.
        #[allow(unused_parens)]
        impl crate::kernels::row::op::Op for Item {
            type In<S: crate::Scalar> = ($($Shape<S>),+);
            type Out<S: crate::Scalar> = $out;
            #[inline]
            fn eval<S: crate::Scalar>($arguments: Self::In<S>) -> Self::Out<S> {
                crate::kernels::ops::tables::first!($($own_formula)? $formula)
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
                fn compiled() -> Option<crate::kernels::row::compiled::Compiled> {
                    Some($compiled)
                }
            )?
        }
        crate::__takes!($Verb, ($($Shape<S>),+), Item, Item);
    }; )* };
}

/// Adds a row to the list of its file: its names, or a call of the walk.
macro_rules! line {
    (names [] $sort:ident $Verb:ty, $name:literal, [$($shape:tt)+] $input:ty) => {
        crate::kernels::ops::walk::Written {
            name: $name,
            verb: stringify!($Verb),
            shapes: &[$(stringify!($shape)),+],
        }
    };
    (each [$walk:ident] search $Verb:ty, $name:literal, [$($shape:tt)+] $input:ty) => {
        $walk.search::<<<$Verb as crate::kernels::verbs::Takes<$input>>::By as crate::kernels::call::search::Searches>::Search>(
            crate::kernels::ops::tables::line!(names [] search $Verb, $name, [$($shape)+] $input),
        )
    };
    (each [$walk:ident] $sort:ident $Verb:ty, $name:literal, [$($shape:tt)+] $input:ty) => {
        $walk.$sort::<<$Verb as crate::kernels::verbs::Takes<$input>>::By>(
            crate::kernels::ops::tables::line!(names [] $sort $Verb, $name, [$($shape)+] $input),
        )
    };
}

/// Selects by the shape of an argument, which may be a hull: its type, or the name and the type that a list has, in
/// which a hull has up to eight vertices.
macro_rules! sized {
    (Hull3, $S:ty, $N:tt) => { crate::Hull3<$S, $N> };
    ($A:ident, $S:ty, $N:tt) => { $A<$S> };
}

/// Adds a row of a search of two shapes to the list of its file, as [`line!`] does.
macro_rules! pair_line {
    (listed $($line:tt)*) => { crate::kernels::ops::tables::pair_line!($($line)*) };
    ($what:ident $walk:tt $Verb:ident, $name:literal, Hull3, Hull3) => {
        crate::kernels::ops::tables::line!(
            $what $walk search $Verb, $name, [Hull3_8 Hull3_8] (crate::Hull3<f64, 8>, crate::Hull3<f64, 8>)
        )
    };
    ($what:ident $walk:tt $Verb:ident, $name:literal, Hull3, $B:ident) => {
        crate::kernels::ops::tables::line!(
            $what $walk search $Verb, $name, [Hull3_8 $B] (crate::Hull3<f64, 8>, $B<f64>)
        )
    };
    ($what:ident $walk:tt $Verb:ident, $name:literal, $A:ident, Hull3) => {
        crate::kernels::ops::tables::line!(
            $what $walk search $Verb, $name, [$A Hull3_8] ($A<f64>, crate::Hull3<f64, 8>)
        )
    };
    ($what:ident $walk:tt $Verb:ident, $name:literal, $A:ident, $B:ident) => {
        crate::kernels::ops::tables::line!($what $walk search $Verb, $name, [$A $B] ($A<f64>, $B<f64>))
    };
}

/// Defines the list of rows of a file.
macro_rules! listed {
    (names [$($names:expr),* $(,)?] each |$walk:ident| $each:block) => {
        /// The names of the rows of this file, a list for every verb.
        pub(super) const NAMES: &[&[crate::kernels::ops::walk::Written]] = &[$(&$names),*];

        /// Walks through every row of this file.
        // A lone argument needs no parentheses.
        #[allow(unused_parens)]
        #[inline]
        pub(super) fn each<W: crate::kernels::ops::walk::Walk>($walk: &mut W) {
            // The scalar of a verb whose type names its result, as conversions do.
            #[allow(dead_code)]
            type S = f64;
            $each
        }
    };
}

/// Selects the first given alternative: the line's, or else the head's.
macro_rules! first {
    (@class [$class:tt $($other:tt)?] $($type:ty),+) => {
        crate::kernels::ops::class::invariances!($class $($type),+)
    };
    ($one:block $($other:block)?) => { $one };
}

/// Builds the names of arguments from those that the table gives.
macro_rules! arguments {
    ((a, b) $A:ident $B:ident) => {
        crate::kernels::ops::noun::named(
            <$A<f64> as crate::kernels::ops::noun::Named>::NOUN.name,
            <$B<f64> as crate::kernels::ops::noun::Named>::NOUN.name,
        )
    };
    (($($argument:ident),+) $($Shape:ident)+) => { [$(stringify!($argument)),+] };
}

/// Builds the documentation of a row, from the title of its table and the row's own sentence.
macro_rules! text {
    ($title:expr, $own:expr, $($type:ty),+) => {{
        const PARTS: &[&str] = &crate::kernels::ops::noun::sentences(
            $title,
            $own,
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

/// Writes operations with a search of convex polygons, and joins them to their verbs.
///
/// Each says its verb with the capacities of the row, the name, arguments, result and record. Then come the search, the
/// replay, the class of invariance and the jumps.
macro_rules! searches {
    ($(
        $(#[$($doc:tt)*])*
        $Verb:ident<$($N:ident),+> = $name:literal: ($($arg:ident),+) as $input:ty => $out:ty, by $record:ty;
        decide |$decided:pat_param| $decide:block
        replay |$replayed:pat_param, $found:ident| $replay:block
        $class:tt
        $(range $range:ident)?
        jumps $jumps:ident
    )*) => { $( const _: () = {
        // As visible as the verb.
        #[derive(Clone, Copy, Debug, Default)]
        pub struct Item<$(const $N: usize),+>;

        impl<$(const $N: usize),+> crate::kernels::row::op::Declares for Item<$($N),+> {
            const DECLARED: crate::kernels::row::op::Declared = crate::kernels::row::op::Declared::new(
                $name,
                crate::kernels::ops::class::invariances!($class crate::ConvexPolygon<f64, 3>),
                crate::kernels::row::op::Jumps::$jumps,
            )
            .arguments(&[$(stringify!($arg)),+])
            .doc(crate::__doc!([] $([$($doc)*])*))
            $(.range(crate::kernels::row::op::Range::$range))?;
        }

        impl<$(const $N: usize),+> crate::kernels::call::search::Search for Item<$($N),+> {
            type In<S: crate::Scalar> = $input;
            type Out<S: crate::Scalar> = $out;
            type Record = $record;
            fn decide<S: crate::Scalar<Mask = bool>>($decided: $input) -> $record {
                $decide
            }
            fn replay<S: crate::Scalar>($replayed: $input, $found: $record) -> $out {
                $replay
            }
        }
        crate::kernels::ops::tables::finds!($Verb<$($N),+> ($($arg),+));
    }; )*
    crate::kernels::ops::tables::listed! {
        names [$([crate::kernels::ops::tables::capacity!(names [] $Verb, $name, ($($arg),+))]),*]
        each |walk| { $(crate::kernels::ops::tables::capacity!(each [walk] $Verb, $name, ($($arg),+));)* }
    } };
}

/// Adds the row of a search to the list: for polygons of up to six corners, two of up to five, or one and a point.
macro_rules! capacity {
    ($what:ident $walk:tt $Verb:ident, $name:literal, (point, $polygon:ident)) => {
        crate::kernels::ops::tables::line!(
            $what $walk search $Verb, $name, [Vec2 ConvexPolygon6] (crate::Vec2<f64>, crate::ConvexPolygon<f64, 6>)
        )
    };
    ($what:ident $walk:tt $Verb:ident, $name:literal, ($polygon:ident)) => {
        crate::kernels::ops::tables::line!(
            $what $walk search $Verb, $name, [ConvexPolygon6] crate::ConvexPolygon<f64, 6>
        )
    };
    ($what:ident $walk:tt $Verb:ident, $name:literal, ($a:ident, $b:ident)) => {
        crate::kernels::ops::tables::line!(
            $what $walk search $Verb, $name, [ConvexPolygon5 ConvexPolygon5]
            (crate::ConvexPolygon<f64, 5>, crate::ConvexPolygon<f64, 5>)
        )
    };
}

/// Joins a verb of convex polygons to its search.
macro_rules! finds {
    ($Verb:ident<N> ($polygon:ident)) => {
        impl<S: crate::Scalar<Mask = bool>, const N: usize>
            crate::kernels::verbs::Unary<crate::ConvexPolygon<S, N>> for $Verb
        {
            type Out = <Item<N> as crate::kernels::call::search::Search>::Out<S>;
            type By = crate::kernels::call::search::Searched<Item<N>>;
            const BY: Self::By = crate::kernels::call::search::search(Item);
            #[inline]
            fn apply(polygon: crate::ConvexPolygon<S, N>) -> Self::Out {
                use crate::kernels::call::search::Search;
                crate::scalar::guarded(polygon, |polygon| {
                    Item::<N>::replay(polygon, Item::<N>::decide(polygon))
                })
            }
        }
    };
    ($Verb:ident<N> (point, $polygon:ident)) => {
        crate::kernels::ops::tables::finds!(
            @pair [const N: usize] $Verb, crate::Vec2<S>, crate::ConvexPolygon<S, N>, <N>
        );
    };
    ($Verb:ident<N> ($a:ident, $b:ident)) => {
        crate::kernels::ops::tables::finds!(@two [const N: usize] $Verb, N, <N>);
    };
    // The hull has up to as many corners as both polygons together, a sum that the type must name.
    ($Verb:ident<N, K> ($a:ident, $b:ident)) => {
        crate::kernels::ops::tables::finds!(@two [] $Verb, 3, <3, 6>);
        crate::kernels::ops::tables::finds!(@two [] $Verb, 4, <4, 8>);
        crate::kernels::ops::tables::finds!(@two [] $Verb, 5, <5, 10>);
        crate::kernels::ops::tables::finds!(@two [] $Verb, 6, <6, 12>);
        crate::kernels::ops::tables::finds!(@two [] $Verb, 7, <7, 14>);
        crate::kernels::ops::tables::finds!(@two [] $Verb, 8, <8, 16>);
    };
    (@two $constants:tt $Verb:ident, $N:tt, <$($capacity:tt),+>) => {
        crate::kernels::ops::tables::finds!(
            @pair $constants $Verb, crate::ConvexPolygon<S, $N>, crate::ConvexPolygon<S, $N>, <$($capacity),+>
        );
    };
    (@pair [$($constant:tt)*] $Verb:ident, $A:ty, $B:ty, <$($capacity:tt),+>) => {
        impl<S: crate::Scalar<Mask = bool>, $($constant)*> crate::kernels::verbs::Binary<$A, $B> for $Verb {
            type Out = <Item<$($capacity),+> as crate::kernels::call::search::Search>::Out<S>;
            type By = crate::kernels::call::search::Searched<Item<$($capacity),+>>;
            const BY: Self::By = crate::kernels::call::search::search(Item);
            #[inline]
            fn apply(a: $A, b: $B) -> Self::Out {
                use crate::kernels::call::search::Search;
                crate::scalar::guarded((a, b), |both| {
                    let found = Item::<$($capacity),+>::decide(both);
                    Item::<$($capacity),+>::replay(both, found)
                })
            }
        }
    };
}

pub(crate) use {
    arguments, capacity, finds, first, line, listed, pair_line, searches, sized, table, text,
};

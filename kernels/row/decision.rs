//! The interfaces of searches: decisions on plain numbers, and a formula that uses them.
use crate::kernels::row::declares::Declares;
use crate::{Fixed, Real, Scalar};
use std::hash::Hash;

/// An operation with a search.
///
/// [`search`](crate::kernels::search::search) turns it into a function of batches;
/// [`check_search_with`](crate::kernels::check::check_search_with) checks its derivatives. A search that hands numbers to
/// its replay is a [`HintedSearch`] instead.
pub trait Search: Declares {
    /// The arguments, generic over the scalar.
    type In<S: Scalar>: Fixed<Scalar = S>;
    /// The result, generic over the scalar.
    type Out<S: Scalar>: Fixed<Scalar = S>;
    /// The decisions. All items with one record share one replay: a GPU is given every replay once.
    type Record: Copy + Eq + Hash + Send + Sync + 'static;
    /// Returns the decisions for an input.
    fn decide<S: Scalar<Mask = bool>>(input: Self::In<S>) -> Self::Record;
    /// Returns the result from the input and the decisions.
    fn replay<S: Scalar>(input: Self::In<S>, record: Self::Record) -> Self::Out<S>;
    /// Returns `false` for a number of the input, by its place among the scalars, by which the replay's derivative is
    /// zero: duals leave it out. By default no number is left out.
    fn reads(_record: &Self::Record, _place: usize) -> bool {
        true
    }
    /// Returns the result, and the cotangents of the arguments given one of the result, by hand. By default nothing:
    /// duals of the replay compute them. Derivatives of derivatives are always those of the replay.
    fn adjoint<S: Real>(
        _input: Self::In<S>,
        _record: &Self::Record,
        _out_bar: Self::Out<S>,
    ) -> Option<(Self::Out<S>, Self::In<S>)> {
        None
    }
}

/// An operation with a search that hands numbers to its replay: *hints*, beside the record.
///
/// Hints are constants: no derivative is by them. Where an iteration finds them, one Newton step in the replay gives
/// the result its derivatives. They are no part of the record, so that items share replays. Every [`Search`] is a hinted
/// one without hints.
///
/// ```
/// use geograd::kernels::Cpu;
/// use geograd::kernels::op::{Declared, Declares, Jumps};
/// use geograd::kernels::search::{HintedSearch, search};
/// use geograd::Scalar;
///
/// /// The cube root of a positive number.
/// #[derive(Clone, Copy, Debug, Default)]
/// struct CubeRoot;
///
/// /// Newton's step to the cube root.
/// fn step<S: Scalar>(x: S, root: S) -> S {
///     root - (root * root * root - x).over(S::lit(3.0) * root * root)
/// }
///
/// impl Declares for CubeRoot {
///     const DECLARED: Declared = Declared::new("cube_root", &[], Jumps::Never);
/// }
///
/// impl HintedSearch for CubeRoot {
///     type In<S: Scalar> = S;
///     type Out<S: Scalar> = S;
///     type Record = ();
///     type Hints<S: Scalar> = [S; 1];
///     fn decide_with_hints<S: Scalar<Mask = bool>>(x: S) -> ((), [S; 1]) {
///         ((), [(0..100).fold(x.most(S::one()), |root, _| step(x, root))])
///     }
///     fn replay_with_hints<S: Scalar>(x: S, (): (), [root]: [S; 1]) -> S {
///         step(x, root)
///     }
/// }
///
/// let run = search(CubeRoot).value_grad();
/// let (roots, by): (Vec<f64>, Vec<f64>) = Cpu::new().aligned(run, &[8.0, 27.0])?;
/// assert_eq!(roots, [2.0, 3.0]);
/// assert!((by[0] - 1.0 / 12.0).abs() < 1e-15);
/// # Ok::<(), geograd::Error>(())
/// ```
pub trait HintedSearch: Declares {
    /// The arguments, generic over the scalar.
    type In<S: Scalar>: Fixed<Scalar = S>;
    /// The result, generic over the scalar.
    type Out<S: Scalar>: Fixed<Scalar = S>;
    /// The decisions, as in [`Search::Record`].
    type Record: Copy + Eq + Hash + Send + Sync + 'static;
    /// The hints: finite numbers of a fixed count, such as `[S; 3]`.
    type Hints<S: Scalar>: Fixed<Scalar = S>;
    /// Returns the decisions for an input, and the hints.
    fn decide_with_hints<S: Scalar<Mask = bool>>(
        input: Self::In<S>,
    ) -> (Self::Record, Self::Hints<S>);
    /// Returns the result from the input, the decisions and the hints.
    fn replay_with_hints<S: Scalar>(
        input: Self::In<S>,
        record: Self::Record,
        hints: Self::Hints<S>,
    ) -> Self::Out<S>;
    /// Returns `false` for a number of the input as [`Search::reads`] does.
    fn is_read(_record: &Self::Record, _place: usize) -> bool {
        true
    }
    /// Returns the result and cotangents by hand as [`Search::adjoint`] does.
    fn adjoint_with_hints<S: Real>(
        _input: Self::In<S>,
        _record: &Self::Record,
        _hints: &Self::Hints<S>,
        _out_bar: Self::Out<S>,
    ) -> Option<(Self::Out<S>, Self::In<S>)> {
        None
    }
}

impl<D: Search> HintedSearch for D {
    type In<S: Scalar> = <D as Search>::In<S>;
    type Out<S: Scalar> = <D as Search>::Out<S>;
    type Record = <D as Search>::Record;
    type Hints<S: Scalar> = [S; 0];
    #[inline]
    fn decide_with_hints<S: Scalar<Mask = bool>>(
        input: <D as Search>::In<S>,
    ) -> (<D as Search>::Record, [S; 0]) {
        (D::decide(input), [])
    }
    #[inline]
    fn replay_with_hints<S: Scalar>(
        input: <D as Search>::In<S>,
        record: <D as Search>::Record,
        []: [S; 0],
    ) -> <D as Search>::Out<S> {
        D::replay(input, record)
    }
    #[inline]
    fn is_read(record: &<D as Search>::Record, place: usize) -> bool {
        D::reads(record, place)
    }
    #[inline]
    fn adjoint_with_hints<S: Real>(
        input: <D as Search>::In<S>,
        record: &<D as Search>::Record,
        []: &[S; 0],
        out_bar: <D as Search>::Out<S>,
    ) -> Option<(<D as Search>::Out<S>, <D as Search>::In<S>)> {
        D::adjoint(input, record, out_bar)
    }
}

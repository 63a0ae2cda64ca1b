//! Operations over paths of any length: rings, polylines, clouds of points.
//!
//! A fold has three parts: the state of one edge, the join of two states, and the result of the last state. Edges are
//! independent, so batches compute them in parallel, as a program, and join states in order.
use crate::ad::adjoint::ring::measure_vjp;
use crate::kernels::row::declares::Declares;
use crate::ring::Measure;
use crate::{Fixed, Pack, Scalar, Vec2};

/// An operation over the edges of a path.
///
/// ```
/// use geograd::kernels::op::{Declared, Declares, Jumps};
/// use geograd::kernels::{Cpu, Fold, One};
/// use geograd::{Scalar, Vec2};
///
/// /// How much of a ring's length is above a height.
/// #[derive(Clone, Copy, Debug, Default)]
/// struct LengthAbove;
///
/// impl Declares for LengthAbove {
///     const DECLARED: Declared = Declared::new("length_above", &[], Jumps::Never);
/// }
///
/// impl Fold for LengthAbove {
///     const CLOSED: bool = true;
///     type Element<S: Scalar> = Vec2<S>;
///     type Context<S: Scalar> = S;
///     type Reference<S: Scalar> = [S; 0];
///     type State<S: Scalar> = S;
///     type Out<S: Scalar> = S;
///     fn reference<S: Scalar>(_height: S, _path: &[Vec2<S>]) -> [S; 0] {
///         []
///     }
///     fn empty<S: Scalar>() -> S {
///         S::zero()
///     }
///     fn edge<S: Scalar>(height: S, _: [S; 0], from: Vec2<S>, to: Vec2<S>) -> S {
///         let (low, high) = (from.y.least(to.y), from.y.most(to.y));
///         let rise = high - low;
///         let flat = rise.equals(S::zero());
///         let part = (high - height).clamp(S::zero(), rise);
///         let level = S::select(high.above(height), S::one(), S::zero());
///         let share = S::select(flat, level, part.over(S::select(flat, S::one(), rise)));
///         share * (to - from).length()
///     }
///     fn join<S: Scalar>(one: S, other: S) -> S {
///         one + other
///     }
///     fn finish<S: Scalar>(_height: S, _: [S; 0], state: S) -> S {
///         state
///     }
/// }
///
/// let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
/// let above = Cpu::new().fold(LengthAbove, One(1.0), &square, &[0, 4])?;
/// assert_eq!(above, [4.0]);
/// let (by_height, by_vertex) = Cpu::new().fold_vjp(LengthAbove, One(1.0), &square, &[0, 4], &[1.0])?;
/// assert_eq!((by_height[0], by_vertex[2].y), (-2.0, 1.0));
/// # Ok::<(), geograd::Error>(())
/// ```
pub trait Fold: Declares {
    /// `true` if an edge leads from the last vertex back to the first. A fold over vertices alone is closed, too: it
    /// uses only the start of each edge.
    const CLOSED: bool;
    /// The index in the state of the winding number around the point with which the context begins. `Some` only for a
    /// fold that needs nothing but this number and the nearest edges: batches then fold only those edges.
    #[doc(hidden)]
    const WINDING: Option<usize> = None;
    /// `true` for a fold that needs nothing but the winding number: batches then fold no edge where it is known.
    #[doc(hidden)]
    const IS_WINDING: bool = false;
    /// `true` for the length of a polyline, which has a kernel. It takes the path as points of the plane.
    #[doc(hidden)]
    const IS_LENGTH: bool = false;
    /// The measure of rings that the fold computes, if it has kernels and adjoints by hand. They replace its edges, and
    /// take the path as points of the plane.
    #[doc(hidden)]
    const MEASURE: Option<Measure> = None;
    /// Returns the path as points of the plane, for a fold with a winding number, a length or a measure of rings.
    #[doc(hidden)]
    fn in_plane<S: Scalar>(_path: &[Self::Element<S>]) -> &[Vec2<S>] {
        &[]
    }
    /// Returns the cotangents of a path as points of the plane, for a measure of rings.
    #[doc(hidden)]
    fn in_plane_mut<S: Scalar>(_path: &mut [Self::Element<S>]) -> &mut [Vec2<S>] {
        &mut []
    }
    /// An element of a path: a point of the plane or of space, or any other shape without codes (whole numbers).
    /// Batches check only that its numbers are finite.
    type Element<S: Scalar>: Fixed<Scalar = S>;
    /// The arguments besides the path: shapes, numbers, a tuple of them, or `[S; 0]` for none.
    type Context<S: Scalar>: Fixed<Scalar = S>;
    /// A local origin or unit of a path, which reduces rounding errors; `[S; 0]` for none.
    type Reference<S: Scalar>: Fixed<Scalar = S>;
    /// The state after some edges.
    type State<S: Scalar>: Fixed<Scalar = S>;
    /// The result.
    type Out<S: Scalar>: Fixed<Scalar = S>;
    /// Returns the local origin or unit of a path, which may be empty. Derivatives take it as a constant, so the result
    /// may depend on it by rounding only.
    fn reference<S: Scalar>(
        context: Self::Context<S>,
        path: &[Self::Element<S>],
    ) -> Self::Reference<S>;
    /// Returns the state of no edge, the neutral element of `join`.
    fn empty<S: Scalar>() -> Self::State<S>;
    /// Returns the state of one edge.
    fn edge<S: Scalar>(
        context: Self::Context<S>,
        reference: Self::Reference<S>,
        from: Self::Element<S>,
        to: Self::Element<S>,
    ) -> Self::State<S>;
    /// Joins the states of two stretches, `one` before `other`. It is associative up to rounding, and need not be
    /// commutative.
    fn join<S: Scalar>(one: Self::State<S>, other: Self::State<S>) -> Self::State<S>;
    /// Returns the result.
    fn finish<S: Scalar>(
        context: Self::Context<S>,
        reference: Self::Reference<S>,
        state: Self::State<S>,
    ) -> Self::Out<S>;
}

/// Closed paths of points of the plane, a kind of [`OverPath`](crate::kernels::OverPath).
#[derive(Clone, Copy, Debug)]
pub enum Ring {}
impl Ring {
    /// The name by which a row lists it.
    pub(crate) const NAME: &str = "ring";
}

/// Open paths of points of the plane, a kind of [`OverPath`](crate::kernels::OverPath).
#[derive(Clone, Copy, Debug)]
pub enum Polyline {}
impl Polyline {
    /// The name by which a row lists it.
    pub(crate) const NAME: &str = "polyline";
}

/// Open paths of points of space, a kind of [`OverPath`](crate::kernels::OverPath).
#[derive(Clone, Copy, Debug)]
pub enum Polyline3 {}
impl Polyline3 {
    /// The name by which a row lists it.
    pub(crate) const NAME: &str = "polyline3";
}

/// Points of space without an order, a kind of [`OverPath`](crate::kernels::OverPath).
#[derive(Clone, Copy, Debug)]
pub enum Cloud3 {}
impl Cloud3 {
    /// The name by which a row lists it.
    pub(crate) const NAME: &str = "cloud3";
}

/// Returns the result of a fold for one path.
///
/// ```
/// use geograd::kernels::fold::{Ring, fold};
/// use geograd::kernels::{OverPath, SignedDistance};
/// type Row = <SignedDistance as OverPath<Ring>>::By;
/// use geograd::Vec2;
/// let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
/// assert_eq!(fold::<Row, f64>(Vec2::new(1.0, 0.5), &square), -0.5);
/// ```
pub fn fold<F: Fold, S: Scalar>(context: F::Context<S>, path: &[F::Element<S>]) -> F::Out<S> {
    match F::MEASURE {
        Some(measure) => {
            let mut numbers = [S::zero(); 2];
            measure.write(F::in_plane(path), &mut numbers);
            F::Out::load(&numbers)
        }
        None => edge_by_edge::<F, S>(context, path),
    }
}

/// Computes [`fold`] from the edges, even if the fold has formulas for the whole path.
#[doc(hidden)]
pub fn edge_by_edge<F: Fold, S: Scalar>(
    context: F::Context<S>,
    path: &[F::Element<S>],
) -> F::Out<S> {
    let reference = F::reference(context, path);
    let mut state = F::empty();
    for k in 0..edges::<F>(path.len()) {
        let edge = F::edge(context, reference, path[k], path[(k + 1) % path.len()]);
        state = F::join(state, edge);
    }
    F::finish(context, reference, state)
}

/// Returns the number of edges of a path with `vertices` vertices.
pub(crate) fn edges<F: Fold>(vertices: usize) -> usize {
    if F::CLOSED {
        vertices
    } else {
        vertices.saturating_sub(1)
    }
}

/// Returns the cotangents of a path's vertices, as numbers, by the fold's adjoint by hand; `None` without one.
#[doc(hidden)]
pub fn by_hand<F: Fold, S: Scalar>(path: &[F::Element<S>], out_bar: F::Out<S>) -> Option<Vec<S>> {
    let measure = F::MEASURE?;
    let mut bars = vec![Vec2::zero(); path.len()];
    measure_vjp(measure, F::in_plane(path), &out_bar.scalars(), &mut bars);
    Some(bars.scalars())
}

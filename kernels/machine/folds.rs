//! Folds over paths, for every machine.
use super::Columns;
use super::{Input, Machine, On, PathSpans, VertexBars};
use crate::error::Argument;
use crate::kernels::One;
use crate::kernels::call::folding::Folding;
use crate::kernels::row::fold::Fold;
use crate::kernels::row::item::Item;
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::item::rows::{fill, numbers};
use crate::{Error, Fixed, Pack, Real};

/// The cotangents of every context and every vertex.
type PathCotangents<C, V> = (Vec<<C as Columns>::Item>, Vec<V>);

/// Paths of any number of vertices.
impl<E: ?Sized> Machine<E> {
    /// Computes one result per path. Path i has the vertices `offsets[i]..offsets[i + 1]`; the first offset is 0, the
    /// last one the number of vertices. `context` has the other arguments of the fold, one per path or [`One`] for all.
    ///
    /// # Errors
    ///
    /// [`Error::Offsets`] for offsets that decrease or do not cover the vertices. [`Error::Length`] if there are not as
    /// many contexts as paths. [`Error::Invalid`] for a vertex or context that is not valid. A GPU also returns
    /// [`Error::Gpu`], with [`GpuFault::TooLarge`](crate::GpuFault::TooLarge) for a path that fits no buffer.
    ///
    /// ```
    /// use geograd::kernels::{Backend, Cpu, One, SignedDistance};
    /// use geograd::Vec2;
    /// let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
    /// let point = One(Vec2::new(1.0_f32, 0.5));
    /// let distances = Cpu::new().fold(SignedDistance.over_ring(), point, &square, &[0, 4])?;
    /// assert_eq!(distances, [-0.5]);
    /// assert_eq!(Backend::Cpu.fold(SignedDistance.over_ring(), point, &square, &[0, 4])?, distances);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn fold<F, C: Columns, V: Fixed<Scalar: On<E>>>(
        &self,
        _fold: F,
        context: C,
        vertices: &[V],
        offsets: &[usize],
    ) -> Result<Vec<F::Out<V::Scalar>>, Error>
    where
        F: Fold<Context<V::Scalar> = C::Item, Element<V::Scalar> = V>,
        C::Item: Pack<Scalar = V::Scalar>,
    {
        self.folded::<F, C, V>(&context, vertices, PathSpans::Ragged(offsets))
    }

    /// Computes [`fold`](Machine::fold) over one path for many contexts: one result per context. There is one result if
    /// a [`One`] stands for all contexts, or if contexts have no numbers.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a vertex or context that is not valid, [`Error::Length`] for columns of contexts of
    /// different lengths; of a GPU as [`fold`](Machine::fold).
    ///
    /// ```
    /// use geograd::kernels::{Cpu, SignedDistance};
    /// use geograd::{Aabb2, Vec2};
    /// let square = Aabb2::new(0.0_f64, 0.0, 4.0, 4.0).corners();
    /// let points = [Vec2::new(1.0, 2.0), Vec2::new(7.0, 8.0)];
    /// let cpu = Cpu::new();
    /// assert_eq!(cpu.fold_one(SignedDistance.over_ring(), &points, &square)?, [-1.0, 5.0]);
    /// let (by_point, by_vertex) = cpu.fold_one_vjp(SignedDistance.over_ring(), &points, &square, &[1.0, 1.0])?;
    /// assert_eq!(by_point[0].x, -1.0);
    /// assert!((by_vertex[2].x + 0.6).abs() < 1e-15);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn fold_one<F, C: Columns, V: Fixed<Scalar: On<E>>>(
        &self,
        _fold: F,
        contexts: C,
        path: &[V],
    ) -> Result<Vec<F::Out<V::Scalar>>, Error>
    where
        F: Fold<Context<V::Scalar> = C::Item, Element<V::Scalar> = V>,
        C::Item: Pack<Scalar = V::Scalar>,
    {
        let spans = PathSpans::Shared(contexts_of(&contexts), path.len());
        self.folded::<F, C, V>(&contexts, path, spans)
    }

    /// Returns the adjoint of [`fold`](Machine::fold): one cotangent per context and one per vertex, from one per
    /// result.
    ///
    /// # Errors
    ///
    /// As [`fold`](Machine::fold), and [`Error::Length`] for another count of cotangents than of results,
    /// [`Error::Invalid`] for one that is not finite.
    pub fn fold_vjp<F, C: Columns, V: Fixed<Scalar: On<E>>>(
        &self,
        _fold: F,
        context: C,
        vertices: &[V],
        offsets: &[usize],
        upstream: &[F::Out<V::Scalar>],
    ) -> Result<(Vec<C::Item>, Vec<V>), Error>
    where
        F: Fold<Context<V::Scalar> = C::Item, Element<V::Scalar> = V>,
        C::Item: Pack<Scalar = V::Scalar>,
    {
        self.pulled_back::<F, C, V>(&context, vertices, PathSpans::Ragged(offsets), upstream)
    }

    /// Returns the adjoint of [`fold_one`](Machine::fold_one): one cotangent per context, and one per vertex, summed
    /// over all contexts.
    ///
    /// # Errors
    ///
    /// As [`fold_one`](Machine::fold_one), and [`Error::Length`] for another count of cotangents than of results,
    /// [`Error::Invalid`] for one that is not finite.
    pub fn fold_one_vjp<F, C: Columns, V: Fixed<Scalar: On<E>>>(
        &self,
        _fold: F,
        contexts: C,
        path: &[V],
        upstream: &[F::Out<V::Scalar>],
    ) -> Result<(Vec<C::Item>, Vec<V>), Error>
    where
        F: Fold<Context<V::Scalar> = C::Item, Element<V::Scalar> = V>,
        C::Item: Pack<Scalar = V::Scalar>,
    {
        let spans = PathSpans::Shared(contexts_of(&contexts), path.len());
        self.pulled_back::<F, C, V>(&contexts, path, spans, upstream)
    }

    /// Computes the [`fold`](Machine::fold) of ragged paths (of different lengths), for a fold without a context.
    ///
    /// There is one result per path. Path i has the vertices `offsets[i]..offsets[i + 1]`; the first offset is 0, the
    /// last one the number of vertices. Empty paths are valid.
    ///
    /// # Errors
    ///
    /// As [`fold`](Machine::fold).
    ///
    /// ```
    /// use geograd::Vec2;
    /// use geograd::kernels::{Cpu, SignedArea};
    /// let v = |x, y| Vec2::new(x, y);
    /// let vertices = [v(0.0, 0.0), v(4.0, 0.0), v(0.0, 3.0), v(0.0, 0.0), v(0.0, 1.0), v(1.0, 0.0)];
    /// assert_eq!(Cpu::new().ragged(SignedArea.over_ring(), &vertices, &[0, 3, 6])?, [6.0, -0.5]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn ragged<F, V: Fixed<Scalar: On<E> + Item>>(
        &self,
        fold: F,
        vertices: &[V],
        offsets: &[usize],
    ) -> Result<Vec<F::Out<V::Scalar>>, Error>
    where
        F: Fold<Context<V::Scalar> = [V::Scalar; 0], Element<V::Scalar> = V>,
    {
        self.fold(fold, One([]), vertices, offsets)
    }

    /// Writes the results of [`ragged`](Machine::ragged) to the caller's slice.
    ///
    /// # Errors
    ///
    /// As [`ragged`](Machine::ragged), and [`Error::Length`] for a buffer of another length. No error changes the
    /// buffer.
    pub fn ragged_into<F, V: Fixed<Scalar: On<E> + Item>>(
        &self,
        fold: F,
        vertices: &[V],
        offsets: &[usize],
        values: &mut [F::Out<V::Scalar>],
    ) -> Result<(), Error>
    where
        F: Fold<Context<V::Scalar> = [V::Scalar; 0], Element<V::Scalar> = V>,
    {
        // A copy is needed, since kernels of rings write results before every vertex is checked.
        let all = self.ragged(fold, vertices, offsets)?;
        expect(Argument::Values, all.len(), values.len())?;
        values.copy_from_slice(&all);
        Ok(())
    }

    /// Returns the adjoint of [`ragged`](Machine::ragged): one cotangent per vertex, from one cotangent per result.
    ///
    /// # Errors
    ///
    /// As [`ragged`](Machine::ragged), and [`Error::Length`] unless there is one cotangent per result,
    /// [`Error::Invalid`] for one that is not finite.
    ///
    /// ```
    /// use geograd::Vec2;
    /// use geograd::kernels::{Cpu, SignedArea};
    /// let v = |x, y| Vec2::new(x, y);
    /// let vertices = [v(0.0, 0.0), v(4.0, 0.0), v(0.0, 3.0)];
    /// let bars = Cpu::new().ragged_vjp(SignedArea.over_ring(), &vertices, &[0, 3], &[1.0])?;
    /// assert_eq!(bars, [v(-1.5, -2.0), v(1.5, 0.0), v(0.0, 2.0)]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn ragged_vjp<F, V: Fixed<Scalar: On<E> + Item>>(
        &self,
        fold: F,
        vertices: &[V],
        offsets: &[usize],
        upstream: &[F::Out<V::Scalar>],
    ) -> Result<Vec<V>, Error>
    where
        F: Fold<Context<V::Scalar> = [V::Scalar; 0], Element<V::Scalar> = V>,
    {
        let (_, bars) = self.fold_vjp(fold, One([]), vertices, offsets, upstream)?;
        Ok(bars)
    }

    /// Writes the results of [`ragged_vjp`](Machine::ragged_vjp) to the caller's slice.
    ///
    /// # Errors
    ///
    /// As [`ragged_vjp`](Machine::ragged_vjp), and [`Error::Length`] for a buffer of another length. These errors,
    /// and those of the arguments, leave the buffer as it was.
    pub fn ragged_vjp_into<F, V: Fixed<Scalar: On<E> + Item>>(
        &self,
        _fold: F,
        vertices: &[V],
        offsets: &[usize],
        upstream: &[F::Out<V::Scalar>],
        bars: &mut [V],
    ) -> Result<(), Error>
    where
        F: Fold<Context<V::Scalar> = [V::Scalar; 0], Element<V::Scalar> = V>,
    {
        let spans = PathSpans::Ragged(offsets);
        self.pull_into::<F, _, V>(&One([]), vertices, spans, upstream, bars)
            .map(drop)
    }

    fn folded<F, C: Columns, V: Fixed<Scalar: On<E>>>(
        &self,
        context: &C,
        vertices: &[V],
        spans: PathSpans<'_>,
    ) -> Result<Vec<F::Out<V::Scalar>>, Error>
    where
        F: Fold<Context<V::Scalar> = C::Item, Element<V::Scalar> = V>,
        C::Item: Pack<Scalar = V::Scalar>,
    {
        without_types::<F, C, V, _>(context, vertices, spans, |folding, input| {
            let mut out = vec![F::Out::filled(V::Scalar::default()); spans.count()];
            fill(&mut out, |out| self.engine().fold(folding, input, out))?;
            Ok(out)
        })
    }

    fn pulled_back<F, C: Columns, V: Fixed<Scalar: On<E>>>(
        &self,
        context: &C,
        vertices: &[V],
        spans: PathSpans<'_>,
        upstream: &[F::Out<V::Scalar>],
    ) -> Result<PathCotangents<C, V>, Error>
    where
        F: Fold<Context<V::Scalar> = C::Item, Element<V::Scalar> = V>,
        C::Item: Pack<Scalar = V::Scalar>,
    {
        let mut bars = vec![V::filled(V::Scalar::default()); vertices.len()];
        let by_context =
            self.pull_into::<F, C, V>(context, vertices, spans, upstream, &mut bars)?;
        Ok((by_context, bars))
    }

    /// Writes the cotangents of vertices. Returns the cotangents of contexts.
    fn pull_into<F, C: Columns, V: Fixed<Scalar: On<E>>>(
        &self,
        context: &C,
        vertices: &[V],
        spans: PathSpans<'_>,
        upstream: &[F::Out<V::Scalar>],
        bars: &mut [V],
    ) -> Result<Vec<C::Item>, Error>
    where
        F: Fold<Context<V::Scalar> = C::Item, Element<V::Scalar> = V>,
        C::Item: Pack<Scalar = V::Scalar>,
    {
        without_types::<F, C, V, _>(context, vertices, spans, |folding, input| {
            expect(Argument::Upstream, spans.count(), upstream.len())?;
            expect(Argument::GradVertices, vertices.len(), bars.len())?;
            let (engine, seeds) = (self.engine(), numbers(upstream));
            let mut by_context = vec![C::Item::filled(V::Scalar::default()); upstream.len()];
            fill(&mut by_context, |by_context| match F::MEASURE {
                Some(measure) => {
                    let bars = VertexBars::Plane(measure, F::in_plane_mut(bars));
                    engine.fold_back(folding, input, &seeds, by_context, bars)
                }
                None => fill(bars, |bars| {
                    engine.fold_back(
                        folding,
                        input,
                        &seeds,
                        by_context,
                        VertexBars::Numbers(bars),
                    )
                }),
            })?;
            Ok(by_context)
        })
    }
}

/// Returns the number of contexts; 1 if one stands for all.
fn contexts_of<C: Columns>(contexts: &C) -> usize {
    let mut count = None;
    contexts.list(&mut |column| count = count.or(column.count));
    count.unwrap_or(1)
}

/// Calls `run` with the fold and its input as numbers.
fn without_types<F, C: Columns, V: Fixed, R>(
    context: &C,
    vertices: &[V],
    spans: PathSpans<'_>,
    run: impl FnOnce(&Folding<V::Scalar>, &Input<'_, V::Scalar>) -> Result<R, Error>,
) -> Result<R, Error>
where
    V::Scalar: Real,
    F: Fold<Context<V::Scalar> = C::Item, Element<V::Scalar> = V>,
    C::Item: Pack<Scalar = V::Scalar>,
{
    let mut contexts = Vec::new();
    context.list(&mut |column| contexts.push(column));
    let input = Input {
        contexts,
        count: vertices.len(),
        vertices: numbers(vertices),
        plane: F::in_plane(vertices),
        spans,
        reference: &|context, path, reference| {
            F::reference(C::Item::load(context), &vertices[path]).store(reference);
        },
    };
    run(&Folding::of::<F, C::Item>(), &input)
}

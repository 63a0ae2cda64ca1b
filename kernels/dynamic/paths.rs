//! Untyped folds over paths of plain numbers.
use super::forms::gpu_of;
use super::rows::{Layout, Rows, named, renamed};
use crate::ad::program::Neutral;
use crate::error::{Argument, Error};
use crate::kernels::backend::Backend;
use crate::kernels::gpu::Gpu;
use crate::kernels::machine::Here;
use crate::kernels::machine::{Column, Columns};
use crate::kernels::row::fold::Fold;
use crate::kernels::row::item::counts::expect;
use crate::kernels::row::item::memory::seen_as;
use crate::kernels::row::item::rows::into_numbers;
use crate::kernels::row::item::{Item, Leaf};
use crate::{Fixed, Real};
use std::borrow::Cow;
use std::marker::PhantomData;

/// The derivatives by the numbers of contexts and of vertices.
type Derivatives<T> = (Vec<T>, Vec<T>);

/// An untyped fold.
#[derive(Debug)]
pub(super) struct UntypedFold<T: 'static> {
    pub(super) values: fn(Backend<'_>, &[Rows<'_, T>], &[T], &[usize]) -> Result<Vec<T>, Error>,
    pub(super) derivatives:
        fn(Backend<'_>, &[Rows<'_, T>], &[T], &[usize], &[T]) -> Result<Derivatives<T>, Error>,
    /// The fold over one path that all contexts share.
    pub(super) shared: Shared<T>,
    /// The number of scalars of a vertex.
    pub(super) vertex: usize,
    /// The result of one path from the numbers of its context and then of its vertices.
    pub(super) symbols: fn(&[Neutral]) -> Vec<Neutral>,
}

/// A fold over one path for many contexts: its values, and its derivatives for a cotangent per context.
#[derive(Debug)]
pub(super) struct Shared<T: 'static> {
    values: fn(Backend<'_>, &[Rows<'_, T>], &[T]) -> Result<Vec<T>, Error>,
    derivatives: fn(Backend<'_>, &[Rows<'_, T>], &[T], &[T]) -> Result<Derivatives<T>, Error>,
}

impl<T> Clone for Shared<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for Shared<T> {}
impl<T> Clone for UntypedFold<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for UntypedFold<T> {}

/// Columns of numbers, read as columns of shapes.
pub(super) struct Contexts<'a, R: Item> {
    rows: &'a [Rows<'a, R::Scalar>],
    row: PhantomData<fn() -> R>,
}

impl<'a, R: Item> Contexts<'a, R> {
    pub(super) const fn new(rows: &'a [Rows<'a, R::Scalar>]) -> Self {
        Contexts {
            rows,
            row: PhantomData,
        }
    }
}

impl<R: Item> Columns for Contexts<'_, R> {
    type Item = R;
    type Place = Here;
    fn list<'a>(&'a self, add: &mut dyn FnMut(Column<'a, R::Scalar>)) {
        for rows in self.rows {
            add(rows.lent());
        }
    }
}

/// Returns shapes from their numbers.
pub(super) fn loaded<P: Fixed>(numbers: &[P::Scalar]) -> Cow<'_, [P]>
where
    P::Scalar: 'static,
{
    match seen_as(numbers) {
        Some(shapes) => Cow::Borrowed(shapes),
        None => numbers.chunks_exact(P::LEN.max(1)).map(P::load).collect(),
    }
}

/// Builds an untyped fold in a format; `$machine` maps a backend to the machine.
macro_rules! fold_in {
    ($format:ty, |$backend:pat_param| $machine:expr) => {
        UntypedFold {
            values: |$backend, rows, vertices, offsets| {
                let contexts = Contexts::<F::Context<$format>>::new(rows);
                let vertices = loaded::<F::Element<$format>>(vertices);
                let values = $machine.fold(F::default(), contexts, &vertices, offsets)?;
                Ok(into_numbers(values))
            },
            derivatives: |$backend, rows, vertices, offsets, upstream| {
                let contexts = Contexts::<F::Context<$format>>::new(rows);
                let upstream = loaded::<F::Out<$format>>(upstream);
                let vertices = loaded::<F::Element<$format>>(vertices);
                let (contexts, vertices) =
                    $machine.fold_vjp(F::default(), contexts, &vertices, offsets, &upstream)?;
                Ok((into_numbers(contexts), into_numbers(vertices)))
            },
            shared: Shared {
                values: |$backend, rows, path| {
                    let contexts = Contexts::<F::Context<$format>>::new(rows);
                    let path = loaded::<F::Element<$format>>(path);
                    let values = $machine.fold_one(F::default(), contexts, &path)?;
                    Ok(into_numbers(values))
                },
                derivatives: |$backend, rows, path, upstream| {
                    let contexts = Contexts::<F::Context<$format>>::new(rows);
                    let upstream = loaded::<F::Out<$format>>(upstream);
                    let path = loaded::<F::Element<$format>>(path);
                    let (contexts, vertices) =
                        $machine.fold_one_vjp(F::default(), contexts, &path, &upstream)?;
                    Ok((into_numbers(contexts), into_numbers(vertices)))
                },
            },
            vertex: F::Element::<$format>::LEN,
            symbols: |x| {
                let (context, vertices) = x.split_at(F::Context::<Neutral>::LEN);
                let context = F::Context::<Neutral>::load(context);
                let path = loaded::<F::Element<Neutral>>(vertices);
                let result = fold::<F, Neutral>(context, &path);
                crate::Pack::scalars(&result)
            },
        }
    };
}

use crate::kernels::cpu::Cpu;
use crate::kernels::row::fold::fold;

pub(super) const fn fold_single<F: Fold>() -> UntypedFold<f32>
where
    F::Context<f32>: Item<Scalar = f32>,
{
    fold_in!(f32, |backend| backend)
}
pub(super) const fn fold_double<F: Fold>() -> UntypedFold<f64>
where
    F::Context<f64>: Item<Scalar = f64>,
{
    fold_in!(f64, |_| Cpu::new())
}
/// A fold over paths.
///
/// Paths are vertices, two numbers each in the plane and three in space, and offsets: path i has the vertices
/// `offsets[i]..offsets[i + 1]`. Further arguments of a fold are columns with a row per path; one row stands for all
/// paths, and one path for all rows.
///
/// ```
/// use geograd::kernels::dynamic::{Rows, operation};
/// let distance = operation("signed_distance_point_ring").expect("is listed");
/// let distance = distance.on_paths::<f64>().expect("is a fold");
/// let square = [0.0, 0.0, 2.0, 0.0, 2.0, 2.0, 0.0, 2.0];
/// let point = [Rows::new(&[1.0, 0.5], 2)];
/// assert_eq!(distance.values(&point, &square, &[0, 4])?, [-0.5]);
/// let (by_point, by_vertex) = distance.vjp(&point, &square, &[0, 4], &[1.0])?;
/// assert_eq!(by_point[0], [0.0, -1.0]);
/// assert_eq!(by_vertex[1] + by_vertex[3], 1.0);
/// // Many points and one ring.
/// let points = [Rows::new(&[1.0, 0.5, 3.0, 1.0], 2)];
/// assert_eq!(distance.values(&points, &square, &[0, 4])?, [-0.5, 1.0]);
/// # Ok::<(), geograd::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct OnPaths<T: Real> {
    pub(super) code: UntypedFold<T>,
    pub(super) names: Vec<Argument>,
    pub(super) takes: Vec<Leaf<T>>,
    /// The number of scalars of the result.
    pub(super) gives: usize,
    /// The GPU that runs it; `None` for the CPU.
    pub(super) gpu: Option<Gpu>,
}

impl<T: Real> OnPaths<T> {
    pub(super) fn new(
        code: UntypedFold<T>,
        names: &[&'static str],
        takes: Vec<Leaf<T>>,
        gives: usize,
    ) -> Self {
        OnPaths {
            code,
            names: named(names, takes.len()),
            takes,
            gives,
            gpu: None,
        }
    }
    /// Returns this fold on another machine. Without this call a fold runs on the CPU.
    ///
    /// # Errors
    ///
    /// [`GpuFault::OnlySingle`](crate::GpuFault::OnlySingle) for `f64` on a GPU.
    pub fn on(&self, backend: Backend<'_>) -> Result<Self, Error> {
        Ok(OnPaths {
            gpu: gpu_of::<T>(backend)?,
            ..self.clone()
        })
    }
    /// Returns the machine that runs it.
    fn backend(&self) -> Backend<'_> {
        self.gpu.as_ref().map_or(Backend::Cpu, Backend::Gpu)
    }
    /// Returns the name and the layout of every column that it takes besides paths.
    #[must_use]
    pub fn takes(&self) -> Vec<(Argument, Layout<T>)> {
        let layouts = self.takes.iter().map(|&leaf| Layout { leaf });
        self.names.iter().copied().zip(layouts).collect()
    }
    /// Returns the number of scalars of a result.
    #[must_use]
    pub const fn gives(&self) -> usize {
        self.gives
    }

    /// Returns the number of scalars of a vertex: two in the plane, three in space.
    #[must_use]
    pub const fn vertex(&self) -> usize {
        self.code.vertex
    }

    /// Returns the numbers of one result per path, or per row if all share one path.
    ///
    /// # Errors
    ///
    /// [`Error::Offsets`] for offsets that decrease or do not cover the vertices; otherwise those of
    /// [`Function::aligned`](super::Function::aligned).
    pub fn values(
        &self,
        contexts: &[Rows<'_, T>],
        vertices: &[T],
        offsets: &[usize],
    ) -> Result<Vec<T>, Error> {
        let backend = self.backend();
        let count = self.checked(contexts, vertices)?;
        let values = match self.shared(contexts, count, offsets) {
            Some((shared, _)) => (shared.values)(backend, contexts, vertices),
            None => (self.code.values)(backend, contexts, vertices, offsets),
        };
        values.map_err(|e| renamed(e, &self.names))
    }

    /// Writes the results of [`values`](OnPaths::values) to the caller's slice.
    ///
    /// # Errors
    ///
    /// As [`values`](OnPaths::values), and [`Error::Length`] for a slice of another length. Nothing is written then.
    pub fn values_into(
        &self,
        contexts: &[Rows<'_, T>],
        vertices: &[T],
        offsets: &[usize],
        values: &mut [T],
    ) -> Result<(), Error> {
        let all = self.values(contexts, vertices, offsets)?;
        expect(Argument::Values, all.len(), values.len())?;
        values.copy_from_slice(&all);
        Ok(())
    }

    /// Returns the cotangents of every column and of every vertex, from one cotangent per result.
    ///
    /// # Errors
    ///
    /// As [`values`](OnPaths::values), and [`Error::Length`] unless there is one cotangent per result,
    /// [`Error::Invalid`] for one that is not finite.
    pub fn vjp(
        &self,
        contexts: &[Rows<'_, T>],
        vertices: &[T],
        offsets: &[usize],
        upstream: &[T],
    ) -> Result<(Vec<Vec<T>>, Vec<T>), Error> {
        let backend = self.backend();
        let count = self.checked(contexts, vertices)?;
        let shared = self.shared(contexts, count, offsets);
        let results = match shared {
            Some((_, contexts)) => contexts,
            None => offsets.len().saturating_sub(1),
        };
        expect(
            Argument::Upstream,
            results.saturating_mul(self.gives),
            upstream.len(),
        )?;
        let derivatives = match shared {
            Some((shared, _)) => (shared.derivatives)(backend, contexts, vertices, upstream),
            None => (self.code.derivatives)(backend, contexts, vertices, offsets, upstream),
        };
        let (all, vertices) = derivatives.map_err(|e| renamed(e, &self.names))?;
        let wide: usize = self.takes.iter().map(|leaf| leaf.fields).sum();
        let mut from = 0;
        let mut columns = Vec::with_capacity(self.takes.len());
        for leaf in &self.takes {
            let own = from..from + leaf.fields;
            from = own.end;
            let rows = all.chunks_exact(wide);
            columns.push(rows.flat_map(|row| row[own.clone()].to_vec()).collect());
        }
        Ok((columns, vertices))
    }

    /// Returns results of one number, with their derivatives by every column and every vertex of their path.
    ///
    /// # Errors
    ///
    /// As [`values`](OnPaths::values), and [`Error::NotOneNumber`] for other results.
    pub fn value_grad(
        &self,
        contexts: &[Rows<'_, T>],
        vertices: &[T],
        offsets: &[usize],
    ) -> Result<(Vec<T>, Vec<Vec<T>>, Vec<T>), Error> {
        if self.gives != 1 {
            return Err(Error::NotOneNumber { found: self.gives });
        }
        let values = self.values(contexts, vertices, offsets)?;
        let ones = vec![T::one(); values.len()];
        let (contexts, vertices) = self.vjp(contexts, vertices, offsets, &ones)?;
        Ok((values, contexts, vertices))
    }

    /// Returns the fold over a shared path and the number of contexts, if there is one path and several contexts.
    fn shared(
        &self,
        contexts: &[Rows<'_, T>],
        vertices: usize,
        offsets: &[usize],
    ) -> Option<(Shared<T>, usize)> {
        let is_one = *offsets == [0, vertices];
        let count = contexts.iter().find_map(Rows::count)?;
        (is_one && count != 1).then_some((self.code.shared, count))
    }

    /// Checks the number of columns and their numbers of fields. Returns the number of vertices.
    fn checked(&self, contexts: &[Rows<'_, T>], vertices: &[T]) -> Result<usize, Error> {
        if contexts.len() != self.takes.len() {
            return Err(Error::Arguments {
                expected: self.takes.len(),
                found: contexts.len(),
            });
        }
        for ((rows, leaf), &name) in contexts.iter().zip(&self.takes).zip(&self.names) {
            rows.column(name, leaf.fields)?;
        }
        let (n, count) = (self.code.vertex, vertices.len() / self.code.vertex);
        expect(Argument::Vertices, count * n, vertices.len())?;
        Ok(count)
    }
}

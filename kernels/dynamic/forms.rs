//! Functions of columns of numbers, in every form of a batch.
use super::Mode;
use super::rows::{Layout, Rows, renamed};
use crate::error::{Argument, Error};
use crate::kernels::cpu::aligned::{checked, compute, compute_unchecked, items};
use crate::kernels::cpu::all_pairs::Bearable;
use crate::kernels::cpu::checked::{check, entries, expect};
use crate::kernels::cpu::pairs::Pairs;
use crate::kernels::cpu::plan::Face;
use crate::kernels::cpu::sweep::Upstream;
use crate::kernels::item::Target;
use crate::kernels::real::Real;
use crate::kernels::recording::{Call, Recording};
use crate::kernels::reduce::{Best, Found, check_sides, check_threshold};
use std::borrow::Cow;
use std::sync::Arc;

/// A function of rows of numbers: an operation in one format, its gradient or its adjoint, or a program.
///
/// Every call takes [`Rows`] and checks all of them before anything is written. Results are plain numbers, row by row.
#[derive(Clone)]
pub struct Function<T: Real> {
    pub(super) recording: Arc<Recording<T>>,
    pub(super) mode: Mode,
    pub(super) names: Vec<Argument>,
}

impl<T: Real> std::fmt::Debug for Function<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Function")
            .field("mode", &self.mode)
            .field("takes", &self.takes())
            .field("gives", &self.gives())
            .finish()
    }
}

impl<T: Real> Function<T> {
    /// The call that machines run.
    pub(crate) fn call(&self) -> Result<Call<T>, Error> {
        Call::of(Arc::clone(&self.recording)).derived(self.mode)
    }
    /// The plan of the CPU.
    pub(super) fn plan(&self, framed: bool) -> Result<Arc<Face<T>>, Error> {
        self.call()?.plan(framed)
    }
    /// A name and a layout for every column that it takes; cotangents of an adjoint come last.
    #[must_use]
    pub fn takes(&self) -> Vec<(Argument, Layout<T>)> {
        let own = self.recording.takes.iter().map(|&leaf| Layout { leaf });
        let mut all: Vec<_> = self.names.iter().copied().zip(own).collect();
        if self.mode == Mode::Vjp {
            let bars = self
                .recording
                .outputs
                .iter()
                .map(|&fields| Layout::numbers(fields));
            all.extend(bars.map(|layout| (Argument::Upstream, layout)));
        }
        all
    }
    /// The number of fields of every column that it gives.
    #[must_use]
    pub fn gives(&self) -> Vec<usize> {
        let takes: Vec<usize> = self
            .recording
            .takes
            .iter()
            .map(|leaf| leaf.fields)
            .collect();
        self.mode.gives(&takes, &self.recording.outputs)
    }

    /// Item i of every column: a list of numbers for every column of the result, as
    /// [`Cpu::aligned`](crate::kernels::Cpu::aligned).
    ///
    /// # Errors
    ///
    /// [`Error::Arguments`] for another number of columns, [`Error::Fields`] for rows of another number of fields,
    /// [`Error::Length`] for columns of different lengths, [`Error::Invalid`] for a row that is not valid.
    pub fn aligned(&self, rows: &[Rows<'_, T>]) -> Result<Vec<Vec<T>>, Error> {
        let face = self.plan(false)?;
        let columns = self.listed(rows)?;
        let count = self.count(&face, &columns)?;
        let mut lists = Vec::with_capacity(face.gives.len());
        for &fields in &face.gives {
            lists.push(vec![T::default(); entries(count, 1, fields)?]);
        }
        let mut results: Vec<Option<&mut [T]>> =
            lists.iter_mut().map(|list| Some(&mut list[..])).collect();
        self.fill_new(&face, (rows, &columns), count, &mut results)?;
        drop(results);
        Ok(lists)
    }

    /// [`aligned_into`](Function::aligned_into) for slices that nobody has seen: they may be written on an error, so that
    /// numbers can be checked while they are near.
    ///
    /// # Errors
    ///
    /// As [`aligned_into`](Function::aligned_into).
    pub fn aligned_into_new(
        &self,
        rows: &[Rows<'_, T>],
        results: &mut [Option<&mut [T]>],
    ) -> Result<(), Error> {
        let face = self.plan(false)?;
        let columns = self.listed(rows)?;
        let count = self.count(&face, &columns)?;
        self.fill_new(&face, (rows, &columns), count, results)
    }
    fn fill_new(
        &self,
        face: &Face<T>,
        (rows, columns): (&[Rows<'_, T>], &[crate::kernels::item::Column<'_, T>]),
        count: usize,
        results: &mut [Option<&mut [T]>],
    ) -> Result<(), Error> {
        let new = targets(&face.gives, count, results)?;
        match compute_unchecked(face, columns, count, new) {
            true => Ok(()),
            // Whatever is wrong is named, and what needs a look before is computed.
            false => self.aligned_into(rows, results),
        }
    }
    /// How many items there are.
    fn count(
        &self,
        face: &Face<T>,
        columns: &[crate::kernels::item::Column<'_, T>],
    ) -> Result<usize, Error> {
        items(&face.arguments, columns).map_err(|e| renamed(e, &self.names))
    }

    /// [`aligned`](Function::aligned) into the caller's slices: one for every column of the result, or `None` for
    /// what is not wanted.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Function::aligned), and [`Error::Length`] for a slice of another length, in numbers. Nothing is
    /// written then.
    pub fn aligned_into(
        &self,
        rows: &[Rows<'_, T>],
        results: &mut [Option<&mut [T]>],
    ) -> Result<(), Error> {
        let face = self.plan(false)?;
        let (columns, count, rare) = self.columns(&face, rows)?;
        let targets = targets(&face.gives, count, results)?;
        compute(&face, &columns, rare, count, targets);
        Ok(())
    }

    /// Columns, checked: how many items there are, and whether some may be too rare for kernels.
    fn columns<'a>(
        &self,
        face: &Face<T>,
        rows: &[Rows<'a, T>],
    ) -> Result<(Vec<crate::kernels::item::Column<'a, T>>, usize, bool), Error> {
        let columns = self.listed(rows)?;
        let (count, rare) = checked(face, &columns).map_err(|e| renamed(e, &self.names))?;
        Ok((columns, count, rare))
    }

    /// Columns of the right number of fields.
    pub(super) fn listed<'a>(
        &self,
        rows: &[Rows<'a, T>],
    ) -> Result<Vec<crate::kernels::item::Column<'a, T>>, Error> {
        let takes = self.takes();
        if takes.len() != rows.len() {
            return Err(Error::Arguments {
                expected: takes.len(),
                found: rows.len(),
            });
        }
        let columns = rows.iter().zip(&takes);
        columns
            .map(|(rows, (name, layout))| rows.column(*name, layout.fields()))
            .collect()
    }

    /// Both lists, checked.
    fn pairs<'a>(
        &self,
        face: &'a Face<T>,
        a: &Rows<'a, T>,
        b: &Rows<'a, T>,
    ) -> Result<Pairs<'a, T>, Error> {
        let columns = self.lists(a, b)?;
        let mut rare = [false; 2];
        for k in 0..2 {
            let (plan, column) = (&face.arguments[k], &columns[k]);
            rare[k] =
                check(Argument::input(k), plan, column).map_err(|e| renamed(e, &self.names))?;
        }
        Ok(Pairs {
            face,
            numbers: [Cow::Borrowed(a.numbers()), Cow::Borrowed(b.numbers())],
            rare,
            filter: true,
        })
    }

    /// Both lists as columns of the right number of fields.
    pub(super) fn lists<'a>(
        &self,
        a: &Rows<'a, T>,
        b: &Rows<'a, T>,
    ) -> Result<[crate::kernels::item::Column<'a, T>; 2], Error> {
        let takes = self.takes();
        let (2, [first, second]) = (self.recording.takes.len(), &takes[..]) else {
            return Err(Error::Arguments {
                expected: takes.len(),
                found: 2,
            });
        };
        let columns = [
            a.column(first.0, first.1.fields())?,
            b.column(second.0, second.1.fields())?,
        ];
        if columns
            .iter()
            .any(|column| column.len() >= u32::MAX as usize)
        {
            return Err(Error::TooLarge);
        }
        Ok(columns)
    }

    /// Every row of `a` with every row of `b`, as [`Cpu::all_pairs`](crate::kernels::Cpu::all_pairs): plane after
    /// plane, one for every number of the result, each a matrix, row by row.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Function::aligned), and [`Error::TooLarge`] when there are more numbers than memory has
    /// addresses.
    pub fn all_pairs(&self, a: Rows<'_, T>, b: Rows<'_, T>) -> Result<Vec<T>, Error> {
        let face = self.plan(true)?;
        let pairs = self.pairs(&face, &a, &b)?;
        let mut planes = vec![T::default(); planes_of(&pairs)?];
        (T::drivers().planes)(&pairs, &mut planes);
        Ok(planes)
    }

    /// [`all_pairs`](Function::all_pairs) into the caller's numbers.
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Function::all_pairs), and [`Error::Length`] for another number of them. Nothing is written
    /// then.
    pub fn all_pairs_into(
        &self,
        a: Rows<'_, T>,
        b: Rows<'_, T>,
        planes: &mut [T],
    ) -> Result<(), Error> {
        let face = self.plan(true)?;
        let pairs = self.pairs(&face, &a, &b)?;
        expect(Argument::Values, planes_of(&pairs)?, planes.len())?;
        (T::drivers().planes)(&pairs, planes);
        Ok(())
    }

    /// How a result of one number is computed of all pairs.
    pub(super) fn one_number(&self) -> Result<(), Error> {
        match self.gives().iter().sum() {
            1 => Ok(()),
            found => Err(Error::NotOneNumber { found }),
        }
    }

    /// The largest result of every row of `a` and its row of `b`, as [`Cpu::row_max`](crate::kernels::Cpu::row_max).
    ///
    /// # Errors
    ///
    /// As [`all_pairs`](Function::all_pairs), [`Error::NotOneNumber`] for other results, and [`Error::Length`] for rows
    /// without columns.
    pub fn row_max(&self, a: Rows<'_, T>, b: Rows<'_, T>) -> Result<Vec<Best<T>>, Error> {
        self.reduced(&a, &b, |pairs| {
            let [rows, columns] = pairs.counts();
            check_sides(rows, columns, true)?;
            Ok((T::drivers().row_max)(pairs))
        })
    }

    /// The largest result of every row of `b` and its row of `a`, as
    /// [`Cpu::column_max`](crate::kernels::Cpu::column_max).
    ///
    /// # Errors
    ///
    /// As [`row_max`](Function::row_max), for columns without rows.
    pub fn column_max(&self, a: Rows<'_, T>, b: Rows<'_, T>) -> Result<Vec<Best<T>>, Error> {
        self.reduced(&a, &b, |pairs| {
            let [rows, columns] = pairs.counts();
            check_sides(rows, columns, false)?;
            Ok((T::drivers().column_max)(pairs))
        })
    }

    /// Every pair whose result is above the threshold, row by row, as [`Cpu::above`](crate::kernels::Cpu::above).
    ///
    /// # Errors
    ///
    /// As [`row_max`](Function::row_max), and for a threshold that is not finite.
    pub fn above(
        &self,
        a: Rows<'_, T>,
        b: Rows<'_, T>,
        threshold: T,
    ) -> Result<Vec<Found<T>>, Error> {
        check_threshold(threshold)?;
        self.reduced(&a, &b, |pairs| {
            // Zeros are above a negative threshold, too.
            pairs.filter &= threshold >= T::default();
            Ok((T::drivers().above)(pairs, threshold))
        })
    }

    /// How many pairs have a result above the threshold, as [`Cpu::count_above`](crate::kernels::Cpu::count_above).
    ///
    /// # Errors
    ///
    /// As [`above`](Function::above).
    pub fn count_above(&self, a: Rows<'_, T>, b: Rows<'_, T>, threshold: T) -> Result<u64, Error> {
        check_threshold(threshold)?;
        self.reduced(&a, &b, |pairs| {
            pairs.filter &= threshold >= T::default();
            Ok((T::drivers().count_above)(pairs, threshold))
        })
    }

    /// The sum of all results, as [`Cpu::sum`](crate::kernels::Cpu::sum).
    ///
    /// # Errors
    ///
    /// As [`row_max`](Function::row_max), but for sides.
    pub fn sum(&self, a: Rows<'_, T>, b: Rows<'_, T>) -> Result<f64, Error> {
        self.reduced(&a, &b, |pairs| Ok((T::drivers().sum)(pairs)))
    }

    /// The mean of all results, zero where there are none, as [`Cpu::mean`](crate::kernels::Cpu::mean).
    ///
    /// # Errors
    ///
    /// As [`sum`](Function::sum).
    pub fn mean(&self, a: Rows<'_, T>, b: Rows<'_, T>) -> Result<f64, Error> {
        self.reduced(&a, &b, |pairs| {
            let [rows, columns] = pairs.counts();
            Ok((T::drivers().sum)(pairs) / (rows as f64 * columns as f64).max(1.0))
        })
    }

    pub(super) fn reduced<X>(
        &self,
        a: &Rows<'_, T>,
        b: &Rows<'_, T>,
        reduce: impl FnOnce(&mut Pairs<'_, T>) -> Result<X, Error>,
    ) -> Result<X, Error> {
        self.one_number()?;
        let face = self.plan(true)?;
        reduce(&mut self.pairs(&face, a, b)?).map_err(|e| renamed(e, &self.names))
    }

    /// The sum of all results and its derivatives by both lists, as [`Cpu::sum_grad`](crate::kernels::Cpu::sum_grad).
    ///
    /// # Errors
    ///
    /// As [`sum`](Function::sum).
    pub fn sum_grad(&self, a: Rows<'_, T>, b: Rows<'_, T>) -> Result<(f64, Vec<T>, Vec<T>), Error> {
        let sum = self.sum(a, b)?;
        let (a_bar, b_bar) =
            self.pulled(&a, &b, |columns| Ok((vec![T::one(); columns.max(1)], 0)))?;
        Ok((sum, a_bar, b_bar))
    }

    /// The mean of all results and its derivatives by both lists, zero where there are none, as
    /// [`Cpu::mean_grad`](crate::kernels::Cpu::mean_grad).
    ///
    /// # Errors
    ///
    /// As [`sum`](Function::sum).
    pub fn mean_grad(
        &self,
        a: Rows<'_, T>,
        b: Rows<'_, T>,
    ) -> Result<(f64, Vec<T>, Vec<T>), Error> {
        let sum = self.sum(a, b)?;
        let rows = |rows: &Rows<'_, T>| rows.count().unwrap_or(1) as f64;
        let factor = 1.0 / (rows(&a) * rows(&b)).max(1.0);
        let (a_bar, b_bar) = self.pulled(&a, &b, |columns| {
            Ok((vec![T::lit(factor); columns.max(1)], 0))
        })?;
        Ok((sum * factor, a_bar, b_bar))
    }

    /// Derivatives of `Σ upstream[i, j] · result[i, j]` by both lists, as
    /// [`Cpu::all_pairs_vjp`](crate::kernels::Cpu::all_pairs_vjp). `upstream` is a matrix, row by row.
    ///
    /// # Errors
    ///
    /// As [`sum`](Function::sum), and for an upstream of another size or one that is not finite.
    pub fn all_pairs_vjp(
        &self,
        a: Rows<'_, T>,
        b: Rows<'_, T>,
        upstream: &[T],
    ) -> Result<(Vec<T>, Vec<T>), Error> {
        let rows = a.count().unwrap_or(1);
        self.pulled(&a, &b, |columns| {
            let wanted = entries(rows, columns, 1)?;
            expect(Argument::Upstream, wanted, upstream.len())?;
            Ok((upstream.to_vec(), columns))
        })
    }

    /// Derivatives of both lists; the upstream derivatives for so many columns, and how many a row of them has.
    fn pulled(
        &self,
        a: &Rows<'_, T>,
        b: &Rows<'_, T>,
        upstream: impl FnOnce(usize) -> Result<(Vec<T>, usize), Error>,
    ) -> Result<(Vec<T>, Vec<T>), Error> {
        self.one_number()?;
        let face = self.call()?.derived(Mode::Vjp)?.plan(true)?;
        let pairs = self.pairs(&face, a, b)?;
        let (derivatives, step) = upstream(pairs.counts()[1])?;
        let upstream = Upstream {
            derivatives: &derivatives,
            step,
        };
        let bearable = Bearable::new(&face, &upstream)?;
        let mut bars = [a, b].map(|rows| vec![T::default(); rows.numbers().len()]);
        let [a_bar, b_bar] = &mut bars;
        bearable.pull_back(&pairs, upstream, a_bar, b_bar);
        // A gradient has the codes of its shape.
        for ((bar, rows), leaf) in bars.iter_mut().zip([a, b]).zip(&self.recording.takes) {
            let scalars = leaf.fields - leaf.codes;
            let bars = bar.chunks_exact_mut(leaf.fields);
            for (bar, row) in bars.zip(rows.numbers().chunks_exact(leaf.fields)) {
                bar[scalars..].copy_from_slice(&row[scalars..]);
            }
        }
        let [a_bar, b_bar] = bars;
        Ok((a_bar, b_bar))
    }
}

/// How many numbers all pairs give.
fn planes_of<T: Real>(pairs: &Pairs<'_, T>) -> Result<usize, Error> {
    let [rows, columns] = pairs.counts();
    entries(rows, columns, pairs.face.gives.iter().sum())
}

/// The caller's slices as targets, each of so many rows.
pub(super) fn targets<'a, T: Real>(
    gives: &[usize],
    count: usize,
    results: &'a mut [Option<&mut [T]>],
) -> Result<Vec<Option<Target<'a, T>>>, Error> {
    if results.len() != gives.len() {
        return Err(Error::Arguments {
            expected: gives.len(),
            found: results.len(),
        });
    }
    for (k, (result, &fields)) in results.iter().zip(gives).enumerate() {
        if let Some(result) = result {
            expect(
                Argument::Result(k),
                entries(count, 1, fields)?,
                result.len(),
            )?;
        }
    }
    let targets = results.iter_mut().zip(gives);
    Ok(targets
        .map(|(result, &fields)| {
            let result = result.as_deref_mut()?;
            Some(Target::of_rows(result, fields))
        })
        .collect())
}

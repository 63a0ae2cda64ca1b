//! Aligned batches: one result for item i of every column.
use crate::Pack;
use crate::error::{Argument, Error};
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::checked::{check, check_upstream};
use crate::kernels::cpu::desk::Aligned;
use crate::kernels::cpu::plan::{Face, Preparation};
use crate::kernels::cpu::simd::Simd;
use crate::kernels::item::{Column, Columns, Results, Target};
use crate::kernels::op::Runs;
use crate::kernels::real::Real;
use crate::kernels::targets::Targets;

/// The scalar of columns.
type ScalarOf<C> = <<C as Columns>::Item as Pack>::Scalar;

impl Cpu {
    /// Computes item i of every column: one result per item; results of several shapes come as one vector per shape.
    ///
    /// `run` is a verb ([`Iou`](crate::kernels::Iou)), its gradient
    /// ([`value_grad`](crate::kernels::Op::value_grad)) or Jacobian
    /// ([`jacobian`](crate::kernels::Op::jacobian)), its adjoint ([`vjp`](crate::kernels::Op::vjp)), or a program.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] when columns differ in length, [`Error::Invalid`] for a shape that is not
    /// valid.
    ///
    /// ```
    /// use geograd::Obb2;
    /// use geograd::kernels::{Cpu, Iou, Op};
    /// let a = [Obb2::new(0.0_f64, 0.0, 2.0, 2.0, 0.0), Obb2::new(5.0, 5.0, 1.0, 3.0, 0.7)];
    /// let b = [Obb2::new(1.0, 0.0, 2.0, 2.0, 0.0), Obb2::new(5.0, 5.0, 1.0, 3.0, 0.7)];
    /// let cpu = Cpu::new();
    /// assert_eq!(cpu.aligned(Iou, (&a, &b))?, [1.0 / 3.0, 1.0]);
    ///
    /// let (iou, (a_bar, _)) = cpu.aligned(Iou.value_grad(), (&a, &b))?;
    /// assert_eq!(iou[0], 1.0 / 3.0);
    /// assert!((a_bar[0].center.x - 4.0 / 9.0).abs() < 1e-15); // nearer is better
    ///
    /// // The adjoint: derivatives times what some loss says about every result.
    /// let (twice, _) = cpu.aligned(Iou.vjp(), ((&a, &b), &[2.0, 0.0]))?;
    /// assert_eq!(twice[0].center.x, 2.0 * a_bar[0].center.x);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn aligned<C: Columns, R: Runs<C::Item>>(
        &self,
        run: R,
        columns: C,
    ) -> Result<<R::Out as Results>::Many, Error> {
        let face = run.call()?.plan(false)?;
        let columns = listed(&columns);
        let count = items(&face.arguments, &columns)?;
        let mut many = R::Out::room(count);
        let mut targets = Vec::new();
        R::Out::places(&mut many, &mut |target| targets.push(Some(target)));
        if compute_unchecked(&face, &columns, count, targets) {
            return Ok(many);
        }
        let (count, rare) = checked(&face, &columns)?;
        let mut targets = Vec::new();
        R::Out::places(&mut many, &mut |target| targets.push(Some(target)));
        compute(&face, &columns, rare, count, targets);
        Ok(many)
    }

    /// [`aligned`](Cpu::aligned) into the caller's slices: one for every shape of a result, in a tuple
    /// like the result's; [`Skip`](crate::kernels::Skip) for what is not wanted.
    ///
    /// # Errors
    ///
    /// As [`aligned`](Cpu::aligned), and [`Error::Length`] for a slice of another length. Nothing is
    /// written then.
    ///
    /// ```
    /// use geograd::Aabb2;
    /// use geograd::kernels::{Cpu, Iou, Op, Skip};
    /// let boxes = [Aabb2::new(0.0, 0.0, 2.0, 2.0)];
    /// let mut a_bar = boxes;
    /// let targets = (Skip, (&mut a_bar, Skip));
    /// Cpu::new().aligned_into(Iou.value_grad(), (&boxes, &boxes), targets)?;
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn aligned_into<C: Columns, R: Runs<C::Item>>(
        &self,
        run: R,
        columns: C,
        mut targets: impl Targets<R::Out>,
    ) -> Result<(), Error> {
        let face = run.call()?.plan(false)?;
        let columns = listed(&columns);
        let (count, rare) = checked(&face, &columns)?;
        let list = fitting::<R::Out>(&mut targets, count)?;
        compute(&face, &columns, rare, count, list);
        Ok(())
    }
}

/// The targets as a list, each of so many items.
pub(crate) fn fitting<R: Results>(
    targets: &mut impl Targets<R>,
    count: usize,
) -> Result<Vec<Option<Target<'_, R::Scalar>>>, Error> {
    let mut list = Vec::new();
    let mut fits = Ok(());
    targets.list(&mut |target| {
        if let Some(target) = &target
            && target.count != count
            && fits.is_ok()
        {
            fits = Err(Error::Length {
                argument: Argument::Result(list.len()),
                expected: count,
                found: target.count,
            });
        }
        list.push(target);
    });
    fits.map(|()| list)
}

impl Cpu {
    /// [`aligned`](Cpu::aligned) into targets of the right length.
    pub(crate) fn run_into<C: Columns, R: Runs<C::Item>>(
        &self,
        run: R,
        columns: C,
        targets: Vec<Option<Target<'_, ScalarOf<C>>>>,
    ) -> Result<(), Error> {
        let face = run.call()?.plan(false)?;
        let columns = listed(&columns);
        let (count, rare) = checked(&face, &columns)?;
        compute(&face, &columns, rare, count, targets);
        Ok(())
    }
}

/// The columns as a list.
pub(crate) fn listed<C: Columns>(columns: &C) -> Vec<Column<'_, ScalarOf<C>>> {
    let mut all = Vec::new();
    columns.list(&mut |column| all.push(column));
    all
}

/// Checks columns: how many items there are, and whether some may be too rare for kernels.
pub(crate) fn checked<T: Real>(
    face: &Face<T>,
    columns: &[Column<'_, T>],
) -> Result<(usize, bool), Error> {
    let count = items(&face.arguments, columns)?;
    let rare = sound(&face.arguments, face.steepest, columns)?;
    Ok((count, rare))
}

/// The name of a column, given those of arguments: cotangents follow.
pub(crate) fn name_of<T>(arguments: &[Preparation<T>], k: usize) -> Argument {
    let own = arguments.get(k);
    own.map_or(Argument::Upstream, |argument| argument.argument(k))
}

/// The number of items of the columns of arguments and cotangents.
pub(crate) fn items<T: Real>(
    arguments: &[Preparation<T>],
    columns: &[Column<'_, T>],
) -> Result<usize, Error> {
    let mut count = None;
    for (k, column) in columns.iter().enumerate() {
        match (count, column.count) {
            (None, found) => count = found,
            (Some(expected), Some(found)) if expected != found => {
                return Err(Error::Length {
                    argument: name_of(arguments, k),
                    expected,
                    found,
                });
            }
            _ => (),
        }
    }
    Ok(count.unwrap_or(1))
}

/// Checks the numbers of columns; whether some may be too rare, or too steep, for kernels.
pub(crate) fn sound<T: Real>(
    arguments: &[Preparation<T>],
    steepest: f64,
    columns: &[Column<'_, T>],
) -> Result<bool, Error> {
    let mut rare = false;
    for (k, column) in columns.iter().enumerate() {
        match arguments.get(k) {
            Some(plan) => rare |= check(plan.argument(k), plan, column)?,
            None => {
                let numbers = column.all();
                check_upstream(&numbers, column.fields)?;
                // A cotangent too steep for kernels makes its item rare, as a rare shape does.
                rare |= !(T::kernels().all_up_to)(&numbers, steepest);
            }
        }
    }
    Ok(rare)
}

pub(crate) fn compute<'a, T: Real>(
    face: &'a Face<T>,
    columns: &'a [Column<'a, T>],
    rare: bool,
    count: usize,
    targets: Vec<Option<Target<'a, T>>>,
) {
    (T::drivers().aligned)(Aligned {
        face,
        columns,
        rare,
        count,
        unchecked: false,
        targets,
    });
}

/// Computes items whose numbers nobody has checked, into targets that nobody has seen: `true` when it has. `false` where
/// numbers must be checked before, or some are doubtful; results are then not all there.
///
/// Numbers of a program are read from memory once in this way, and not twice.
pub(crate) fn compute_unchecked<'a, T: Real>(
    face: &'a Face<T>,
    columns: &'a [Column<'a, T>],
    count: usize,
    targets: Vec<Option<Target<'a, T>>>,
) -> bool {
    let is_program = face.maker.program().is_some() && face.rare.is_none();
    let is_plain = face.arguments.iter().all(|x| x.frame.is_none());
    is_program
        && is_plain
        && Simd::current().is_ok()
        && (T::drivers().aligned)(Aligned {
            face,
            columns,
            rare: false,
            count,
            unchecked: true,
            targets,
        })
}

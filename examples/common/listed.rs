//! Every operation of the list in every form, on any machine: shapes are drawn and brought up once, then it
//! runs as often as it is asked to.
use geograd::ad::check::sample::{Draw, Sample};
use geograd::kernels::gpu::GpuRing;
use geograd::kernels::op::Vjp;
use geograd::kernels::resident::{Held, Matrix, Resident, RingBars, RingValues, Rings};
use geograd::kernels::{Backend, Decided, Fold, Op, Row, Runs, Single};
use geograd::{Error, Fixed, Pack, Vec2};
use std::marker::PhantomData;

/// What is computed of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Results of items.
    Value,
    /// Results of items with their gradients.
    Gradient,
    /// Slopes of items times a cotangent of the result.
    Adjoint,
    /// Results of all pairs.
    Pairs,
    /// Slopes of all pairs times an upstream matrix, summed for every row and column.
    PairsAdjoint,
    /// Results of paths.
    Paths,
    /// Slopes of paths times a cotangent of the result.
    PathsAdjoint,
}

impl Form {
    pub fn title(self) -> &'static str {
        match self {
            Form::Value => "aligned",
            Form::Gradient => "aligned, value and gradient",
            Form::Adjoint => "aligned, adjoint",
            Form::Pairs => "all pairs",
            Form::PairsAdjoint => "all pairs, adjoint",
            Form::Paths => "paths",
            Form::PathsAdjoint => "paths, adjoint",
        }
    }
}

/// A batch with all that it takes where it is computed.
pub trait Ready {
    fn run(&mut self) -> Result<(), Error>;
    /// What the last run gave.
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error>;
}

/// Gets a batch of so many items ready on a machine, and runs it once.
pub type Make = for<'a> fn(Backend<'a>, usize) -> Result<Box<dyn Ready + 'a>, Error>;

/// A form and how to get it ready.
fn form(form: Form, make: Make) -> (Form, Make) {
    (form, make)
}

/// An operation of the list.
pub struct Listed {
    pub name: &'static str,
    pub forms: Vec<(Form, Make)>,
}

/// Corners of the paths.
pub const CORNERS: usize = 16;
/// Different shapes; more items repeat them.
const DIFFERENT: usize = 4096;

/// A shape in single precision.
fn single<P: Fixed<Scalar = f64>, Q: Fixed<Scalar = f32>>(shape: P) -> Q {
    let numbers: Vec<f32> = shape.scalars().iter().map(|&x| x as f32).collect();
    Q::load(&numbers).load_codes(&shape.codes())
}

/// So many shapes that are inside of what an operation takes.
fn shapes<P: Sample + Fixed<Scalar = f64>, Q: Fixed<Scalar = f32>>(count: usize) -> Vec<Q> {
    let mut draw = Draw::new(1);
    let mut drawn = Vec::new();
    while drawn.len() < count.min(DIFFERENT) {
        let shape = P::ordinary(&mut draw);
        if shape.inside() {
            drawn.push(single(shape));
        }
    }
    (0..count).map(|i| drawn[i % DIFFERENT]).collect()
}

struct Aligned<'a, R: Row<Scalar = f32>, F: Runs<R>> {
    here: Resident<'a>,
    run: F,
    held: Held<R>,
    found: Held<F::Out>,
}

impl<R: Row<Scalar = f32>, F: Runs<R> + Copy> Ready for Aligned<'_, R, F> {
    fn run(&mut self) -> Result<(), Error> {
        self.here
            .aligned_into(self.run, &self.held, &mut self.found)
    }
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error> {
        self.found.numbers()
    }
}

fn aligned<'a, R, F>(backend: Backend<'a>, run: F, rows: &[R]) -> Result<Box<dyn Ready + 'a>, Error>
where
    R: Row<Scalar = f32> + 'a,
    F: Runs<R> + Copy + 'a,
{
    let here = backend.resident();
    let held = here.upload(rows)?;
    let found = here.aligned(run, &held)?;
    Ok(Box::new(Aligned {
        here,
        run,
        held,
        found,
    }))
}

struct Pairs<'a, A, B, F> {
    here: Resident<'a>,
    run: F,
    a: Held<A>,
    b: Held<B>,
    matrix: Matrix,
    slopes: Option<(Held<A>, Held<B>)>,
}

impl<A: Single<Scalar = f32>, B: Single<Scalar = f32>, F> Ready for Pairs<'_, A, B, F>
where
    F: Runs<(A, B), Out = f32> + Copy,
{
    fn run(&mut self) -> Result<(), Error> {
        let (run, a, b) = (self.run, &self.a, &self.b);
        match &mut self.slopes {
            None => self.here.all_pairs_into(run, a, b, &mut self.matrix),
            Some(slopes) => {
                *slopes = self.here.all_pairs_vjp(run, a, b, &self.matrix)?;
                Ok(())
            }
        }
    }
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error> {
        match &self.slopes {
            None => Ok(vec![self.matrix.download()?]),
            Some((a, b)) => Ok([a.numbers()?, b.numbers()?].concat()),
        }
    }
}

/// Of a square of so many pairs.
fn pairs<'a, A, B, F>(
    backend: Backend<'a>,
    run: F,
    rows: &[(A, B)],
    slopes: bool,
) -> Result<Box<dyn Ready + 'a>, Error>
where
    A: Single<Scalar = f32> + 'a,
    B: Single<Scalar = f32> + 'a,
    F: Runs<(A, B), Out = f32> + Copy + 'a,
{
    let here = backend.resident();
    let (a, b): (Vec<A>, Vec<B>) = rows.iter().copied().unzip();
    let (a, b) = (here.upload(&a)?, here.upload(&b)?);
    let matrix = here.all_pairs(run, &a, &b)?;
    let slopes = match slopes {
        true => Some(here.all_pairs_vjp(run, &a, &b, &matrix)?),
        false => None,
    };
    Ok(Box::new(Pairs {
        here,
        run,
        a,
        b,
        matrix,
        slopes,
    }))
}

/// Stars, one after another.
fn paths(count: usize) -> (Vec<Vec2<f32>>, Vec<usize>) {
    let mut draw = Draw::new(2);
    let corner = |k: usize| {
        let (radius, angle) = (
            0.5 + draw.unit(),
            k as f64 * std::f64::consts::TAU / CORNERS as f64,
        );
        Vec2::new((radius * angle.cos()) as f32, (radius * angle.sin()) as f32)
    };
    let different: Vec<_> = (0..CORNERS * DIFFERENT).map(corner).collect();
    let vertices = (0..CORNERS * count).map(|k| different[k % different.len()]);
    (
        vertices.collect(),
        (0..=count).map(|i| i * CORNERS).collect(),
    )
}

struct Ring<O: GpuRing> {
    rings: Rings,
    values: Option<RingValues<O::Out<f32>>>,
    ups: Vec<O::Out<f32>>,
    slopes: Option<RingBars>,
}

impl<O: GpuRing> Ready for Ring<O> {
    fn run(&mut self) -> Result<(), Error> {
        match self.ups.is_empty() {
            true => self.values = Some(self.rings.ragged(O::default())?),
            false => self.slopes = Some(self.rings.ragged_vjp(O::default(), &self.ups)?),
        }
        Ok(())
    }
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error> {
        let mut all = Vec::new();
        if let Some(values) = &self.values {
            all.push(values.download()?.iter().flat_map(Pack::scalars).collect());
        }
        if let Some(slopes) = &self.slopes {
            all.push(slopes.download()?.iter().flat_map(Pack::scalars).collect());
        }
        Ok(all)
    }
}

fn ring<'a, O: GpuRing>(
    backend: Backend<'a>,
    count: usize,
    slopes: bool,
) -> Result<Box<dyn Ready + 'a>, Error> {
    let (vertices, offsets) = paths(count);
    let ups = if slopes { count } else { 0 };
    let mut ready = Ring::<O> {
        rings: backend.upload_rings(&vertices, &offsets)?,
        values: None,
        ups: vec![Fixed::filled(1.0); ups],
        slopes: None,
    };
    ready.run()?;
    Ok(Box::new(ready))
}

struct Folded<'a, F: Fold> {
    backend: Backend<'a>,
    contexts: Vec<F::Context<f32>>,
    vertices: Vec<Vec2<f32>>,
    offsets: Vec<usize>,
    values: Vec<F::Out<f32>>,
    ups: Vec<F::Out<f32>>,
    slopes: (Vec<F::Context<f32>>, Vec<Vec2<f32>>),
}

impl<F: Fold<Context<f32>: Row<Scalar = f32>>> Ready for Folded<'_, F> {
    fn run(&mut self) -> Result<(), Error> {
        let (contexts, vertices, offsets) = (&self.contexts, &self.vertices, &self.offsets);
        let (backend, run) = (self.backend, F::default());
        match self.ups.is_empty() {
            true => self.values = backend.fold(run, contexts, vertices, offsets)?,
            false => self.slopes = backend.fold_vjp(run, contexts, vertices, offsets, &self.ups)?,
        }
        Ok(())
    }
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error> {
        Ok(vec![
            self.values.iter().flat_map(Pack::scalars).collect(),
            self.slopes.0.iter().flat_map(Pack::scalars).collect(),
            self.slopes.1.iter().flat_map(Pack::scalars).collect(),
        ])
    }
}

fn folded<'a, F>(
    backend: Backend<'a>,
    count: usize,
    slopes: bool,
) -> Result<Box<dyn Ready + 'a>, Error>
where
    F: Fold<Context<f32>: Row<Scalar = f32>, Context<f64>: Sample>,
{
    let (vertices, offsets) = paths(count);
    let ups = if slopes { count } else { 0 };
    let mut ready = Folded::<F> {
        backend,
        contexts: shapes::<F::Context<f64>, _>(count),
        vertices,
        offsets,
        values: Vec::new(),
        ups: vec![Fixed::filled(1.0); ups],
        slopes: (Vec::new(), Vec::new()),
    };
    ready.run()?;
    Ok(Box::new(ready))
}

/// An operation's type, by which the forms are found that it has: of two implementations of a method, the one
/// for what is behind fewer references comes first.
pub struct Of<O>(PhantomData<O>);

impl<O> Of<O> {
    pub const NEW: Self = Of(PhantomData);
}

/// The gradient of one number, or of more the adjoint.
pub trait Gradient {
    fn slopes(&self) -> (Form, Make);
}
impl<O> Gradient for Of<O>
where
    O: Op<Out<f32> = f32>,
    O::In<f64>: Sample,
    O::In<f32>: Row<Scalar = f32>,
{
    fn slopes(&self) -> (Form, Make) {
        form(Form::Gradient, |backend, count| {
            let rows = shapes::<O::In<f64>, O::In<f32>>(count);
            aligned(backend, O::default().value_grad(), &rows)
        })
    }
}
impl<O> Gradient for &Of<O>
where
    O: Op,
    O::In<f64>: Sample,
    O::In<f32>: Row<Scalar = f32>,
    O::Out<f32>: Row<Scalar = f32>,
{
    fn slopes(&self) -> (Form, Make) {
        form(Form::Adjoint, |backend, count| {
            let rows = shapes::<O::In<f64>, O::In<f32>>(count);
            let rows: Vec<_> = rows.into_iter().map(|x| (x, Fixed::filled(1.0))).collect();
            aligned(backend, O::default().vjp(), &rows)
        })
    }
}

/// All pairs of two shapes with one number as result.
pub trait AllPairs {
    fn pairs(&self) -> Vec<(Form, Make)>;
}
impl<O, A, B> AllPairs for Of<O>
where
    O: Op<In<f32> = (A, B), Out<f32> = f32>,
    O::In<f64>: Sample,
    A: Single<Scalar = f32>,
    B: Single<Scalar = f32>,
{
    fn pairs(&self) -> Vec<(Form, Make)> {
        vec![
            form(Form::Pairs, |backend, count| {
                let side = (count as f64).sqrt() as usize;
                let rows = shapes::<O::In<f64>, (A, B)>(side);
                pairs(backend, O::default(), &rows, false)
            }),
            form(Form::PairsAdjoint, |backend, count| {
                let side = (count as f64).sqrt() as usize;
                let rows = shapes::<O::In<f64>, (A, B)>(side);
                pairs(backend, O::default(), &rows, true)
            }),
        ]
    }
}
impl<O> AllPairs for &Of<O> {
    fn pairs(&self) -> Vec<(Form, Make)> {
        Vec::new()
    }
}

/// Results of items.
pub fn value<O: Op>() -> (Form, Make)
where
    O::In<f64>: Sample,
    O::In<f32>: Row<Scalar = f32>,
    O::Out<f32>: Row<Scalar = f32>,
{
    form(Form::Value, |backend, count| {
        let rows = shapes::<O::In<f64>, O::In<f32>>(count);
        aligned(backend, O::default(), &rows)
    })
}

/// The forms of measures of rings.
pub fn of_ring<O: GpuRing>() -> Vec<(Form, Make)> {
    vec![
        form(Form::Paths, |backend, count| {
            ring::<O>(backend, count, false)
        }),
        form(Form::PathsAdjoint, |backend, count| {
            ring::<O>(backend, count, true)
        }),
    ]
}

/// The forms of a fold.
pub fn of_fold<F>() -> Vec<(Form, Make)>
where
    F: Fold<Context<f32>: Row<Scalar = f32>, Context<f64>: Sample>,
{
    vec![
        form(Form::Paths, |backend, count| {
            folded::<F>(backend, count, false)
        }),
        form(Form::PathsAdjoint, |backend, count| {
            folded::<F>(backend, count, true)
        }),
    ]
}

/// The forms of what searches.
pub fn of_decided<D, R, Y>() -> Vec<(Form, Make)>
where
    D: Decided<In<f32> = R, Out<f32> = Y> + Runs<R, Out = Y>,
    D::In<f64>: Sample,
    R: Row<Scalar = f32>,
    Y: Row<Scalar = f32>,
    Vjp<D>: Runs<(R, Y), Out = R>,
{
    vec![
        form(Form::Value, |backend, count| {
            aligned(backend, D::default(), &shapes::<D::In<f64>, R>(count))
        }),
        form(Form::Adjoint, |backend, count| {
            let rows = shapes::<D::In<f64>, R>(count).into_iter();
            let rows: Vec<(R, Y)> = rows.map(|x| (x, Y::filled(1.0))).collect();
            aligned(backend, Decided::vjp(D::default()), &rows)
        }),
    ]
}

macro_rules! list {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }
     straight { $($straight:ident: $straight_op:ty,)* }
     folds { $($fold:ident: $fold_op:ty,)* } decided { $($decided:ident: $decided_op:ty,)* }
     further {
         straight { $($more:ident: $more_op:ty,)* }
         folds { $($more_fold:ident: $more_fold_op:ty,)* }
         decided { $($more_decided:ident: $more_decided_op:ty,)* }
     }) => {
        /// The whole list; unoptimised builds leave out its last section, as every operation costs them a
        /// second.
        // Which implementation serves an operation is found by the reference.
        #[allow(clippy::needless_borrow)]
        pub fn list() -> Vec<Listed> {
            macro_rules! straight {
                ($name:ident: $op:ty) => {{
                    let mut forms = vec![value::<$op>(), (&Of::<$op>::NEW).slopes()];
                    forms.extend((&Of::<$op>::NEW).pairs());
                    Listed { name: stringify!($name), forms }
                }};
            }
            #[cfg_attr(debug_assertions, allow(unused_mut))]
            let mut all = vec![
                $(straight!($pair: $pair_op),)*
                $(Listed { name: stringify!($ring), forms: of_ring::<$ring_op>() },)*
                $(straight!($straight: $straight_op),)*
                $(Listed { name: stringify!($fold), forms: of_fold::<$fold_op>() },)*
                $(Listed { name: stringify!($decided), forms: of_decided::<$decided_op, _, _>() },)*
            ];
            #[cfg(not(debug_assertions))]
            all.extend([
                $(straight!($more: $more_op),)*
                $(Listed { name: stringify!($more_fold), forms: of_fold::<$more_fold_op>() },)*
                $(Listed {
                    name: stringify!($more_decided),
                    forms: of_decided::<$more_decided_op, _, _>(),
                },)*
            ]);
            all
        }
    };
}
geograd::for_each_op!(list);

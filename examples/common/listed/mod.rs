//! Every operation of the list in every form, on any machine: shapes are drawn and brought up once, then it
//! runs as often as it is asked to.
pub mod ready;

use geograd::ad::check::sample::Sample;
use geograd::kernels::gpu::GpuRing;
use geograd::kernels::op::Vjp;
use geograd::kernels::{Backend, Fold, Item, Op, Runs, Search, Single};
use geograd::{Error, Fixed};
use ready::{Ready, aligned, folded, pairs, ring, shapes};

use std::marker::PhantomData;

/// What is computed of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Results of items.
    Value,
    /// Results of items with their gradients.
    Gradient,
    /// Derivatives of items times a cotangent of the result.
    Adjoint,
    /// Results of all pairs.
    Pairs,
    /// Derivatives of all pairs times an upstream matrix, summed for every row and column.
    PairsAdjoint,
    /// Results of paths.
    Paths,
    /// Derivatives of paths times a cotangent of the result.
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

/// An operation's type, by which the forms are found that it has: of two implementations of a method, the one
/// for what is behind fewer references comes first.
pub struct Of<O>(PhantomData<O>);

impl<O> Of<O> {
    pub const NEW: Self = Of(PhantomData);
}

/// The gradient of one number, or of more the adjoint.
pub trait Gradient {
    fn derivatives(&self) -> (Form, Make);
}
impl<O> Gradient for Of<O>
where
    O: Op<Out<f32> = f32>,
    O::In<f64>: Sample,
    O::In<f32>: Item<Scalar = f32>,
{
    fn derivatives(&self) -> (Form, Make) {
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
    O::In<f32>: Item<Scalar = f32>,
    O::Out<f32>: Item<Scalar = f32>,
{
    fn derivatives(&self) -> (Form, Make) {
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
    O::In<f32>: Item<Scalar = f32>,
    O::Out<f32>: Item<Scalar = f32>,
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
    F: Fold<Context<f32>: Item<Scalar = f32>, Context<f64>: Sample>,
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
pub fn of_search<D, R, Y>() -> Vec<(Form, Make)>
where
    D: Search<In<f32> = R, Out<f32> = Y> + Runs<R, Out = Y>,
    D::In<f64>: Sample,
    R: Item<Scalar = f32>,
    Y: Item<Scalar = f32>,
    Vjp<D>: Runs<(R, Y), Out = R>,
{
    vec![
        form(Form::Value, |backend, count| {
            aligned(backend, D::default(), &shapes::<D::In<f64>, R>(count))
        }),
        form(Form::Adjoint, |backend, count| {
            let rows = shapes::<D::In<f64>, R>(count).into_iter();
            let rows: Vec<(R, Y)> = rows.map(|x| (x, Y::filled(1.0))).collect();
            aligned(backend, Search::vjp(D::default()), &rows)
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
         decided { $($more_search:ident: $more_decided_op:ty,)* }
     }) => {
        /// The whole list; unoptimised builds leave out its last section, as every operation costs them a
        /// second.
        // Which implementation serves an operation is found by the reference.
        #[allow(clippy::needless_borrow)]
        pub fn list() -> Vec<Listed> {
            macro_rules! straight {
                ($name:ident: $op:ty) => {{
                    let mut forms = vec![value::<$op>(), (&Of::<$op>::NEW).derivatives()];
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
                $(Listed { name: stringify!($decided), forms: of_search::<$decided_op, _, _>() },)*
            ];
            #[cfg(not(debug_assertions))]
            all.extend([
                $(straight!($more: $more_op),)*
                $(Listed { name: stringify!($more_fold), forms: of_fold::<$more_fold_op>() },)*
                $(Listed {
                    name: stringify!($more_search),
                    forms: of_search::<$more_decided_op, _, _>(),
                },)*
            ]);
            all
        }
    };
}
geograd::for_each_op!(list);

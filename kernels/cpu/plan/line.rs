//! Operations of fixed size as functions of lists of numbers: all that is made of one is compiled once.
use super::compiled::Compiled;
use super::known::Known;
use crate::ad::program::{Plain, Sym};
use crate::kernels::item::{Item, Leaf, leaves_of};
use crate::kernels::op::{Derivative, Op};
use crate::kernels::real::Real;
use crate::{Fixed, Pack, Scalar};
use std::any::TypeId;

/// An operation of fixed size without its types.
#[derive(Debug)]
pub struct Line<T> {
    /// Its type.
    id: fn() -> TypeId,
    /// The source of its derivatives.
    pub(crate) derivatives: Derivative,
    /// Numbers of its input, numbers of its result, and codes of both.
    pub(crate) inputs: usize,
    pub(crate) outputs: usize,
    pub(crate) codes: usize,
    /// The function.
    pub(crate) eval: fn(&[Sym<T>]) -> Vec<Sym<T>>,
    /// The result and then the derivatives, by hand, from the input and the cotangent.
    pub(crate) adjoint: fn(&[Sym<T>], &[Sym<T>]) -> Vec<Sym<T>>,
    /// Its compiled kernels.
    pub(crate) compiled: fn() -> Option<Compiled>,
}

impl<T> Clone for Line<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for Line<T> {}

impl<T: Plain> Line<T> {
    pub(crate) const fn of<O: Op>() -> Self {
        Line {
            id: TypeId::of::<O>,
            derivatives: O::DERIVATIVE,
            inputs: O::In::<Sym<T>>::LEN,
            outputs: O::Out::<Sym<T>>::LEN,
            codes: O::In::<Sym<T>>::CODES + O::Out::<Sym<T>>::CODES,
            eval: |input| O::eval(O::In::<Sym<T>>::load(input)).scalars(),
            adjoint: match O::DERIVATIVE {
                Derivative::ByHand => adjoint::<O, T>,
                Derivative::Reverse | Derivative::Forward => |_, _| Vec::new(),
            },
            compiled: O::compiled,
        }
    }
    /// Under which what is made of it is kept.
    pub(super) fn key(&self, known: Known) -> (TypeId, TypeId, Known) {
        ((self.id)(), TypeId::of::<T>(), known)
    }
}

/// The result and the derivatives by hand. Without them they are NaN: the program fails to be finite, which nothing
/// then hides.
fn adjoint<O: Op, T: Plain>(input: &[Sym<T>], out_bar: &[Sym<T>]) -> Vec<Sym<T>> {
    let out_bar = O::Out::<Sym<T>>::load(out_bar);
    match O::adjoint(O::In::<Sym<T>>::load(input), out_bar) {
        Some((value, derivatives)) => [value.scalars(), derivatives.scalars()].concat(),
        None => vec![Sym::lit(f64::NAN); O::Out::<Sym<T>>::LEN + O::In::<Sym<T>>::LEN],
    }
}

/// The same with the shapes of its input and its result.
#[derive(Debug)]
pub struct Shaped<T> {
    pub(crate) line: Line<T>,
    pub(crate) takes: fn() -> Vec<Leaf<T>>,
    pub(crate) gives: fn() -> Vec<Leaf<T>>,
    /// The names of its arguments.
    pub(crate) arguments: &'static [&'static str],
}

impl<T> Clone for Shaped<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for Shaped<T> {}

impl<T: Real> Shaped<T> {
    pub(crate) const fn of<O, R>() -> Self
    where
        O: Op<In<T> = R>,
        R: Item<Scalar = T>,
        O::Out<T>: Item<Scalar = T>,
    {
        Shaped {
            line: Line::of::<O>(),
            takes: leaves_of::<R>,
            gives: leaves_of::<O::Out<T>>,
            arguments: O::ARGUMENTS,
        }
    }
    /// Numbers of every shape of its result.
    pub(crate) fn outputs(&self) -> Vec<usize> {
        (self.gives)().iter().map(|leaf| leaf.fields).collect()
    }
}

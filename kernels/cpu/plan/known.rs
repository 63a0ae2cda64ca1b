//! The programs and faces of operations: each is made once per operation and format, and kept.
use super::compiled::{of_compiled, outline};
use super::face::{Face, Want, name};
use super::line::{Line, Shaped};
use super::recorded::of_recorded;
use crate::ad::program::record::{TRIALS, listed};
use crate::ad::program::recorded::Recorded;
use crate::ad::program::{Plain, Sym};
use crate::error::Error;
#[cfg(feature = "gpu")]
use crate::kernels::gpu::Generated;
use crate::kernels::item::Item;
use crate::kernels::op::{self, Op};
use crate::kernels::real::Real;
use crate::{Pack, Scalar, Unrecordable};
use std::any::{Any, TypeId};
use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock};

/// A key of an object kept for an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Known {
    /// The programs of a fold.
    Fold,
    /// How batches compute what is wanted of an edge of a fold.
    Edge(Want),
    /// The program of what is wanted.
    Program(Want),
    /// How batches compute it, aligned or all pairs.
    Face(Want, bool),
    /// The kernel for a GPU, aligned or all pairs.
    #[cfg(feature = "gpu")]
    Shader(Want, bool),
    /// The kernels of a fold for a GPU.
    #[cfg(feature = "gpu")]
    FoldShader,
    /// The replays for a GPU of an operation with a search.
    #[cfg(feature = "gpu")]
    Replays(Want),
}

/// The objects made so far, by operation and format.
type Kept = HashMap<(TypeId, TypeId, Known), Made>;
type Made = Arc<dyn Any + Send + Sync>;
static KNOWN: RwLock<Option<Kept>> = RwLock::new(None);

/// Something that is made once per operation and format.
pub(crate) fn known<O: 'static, T: 'static, X: Send + Sync + 'static>(
    key: Known,
    make: impl Fn() -> Result<X, Error>,
) -> Result<Arc<X>, Error> {
    known_by((TypeId::of::<O>(), TypeId::of::<T>(), key), &make)
}

/// The same by the whole key.
fn known_by<X: Send + Sync + 'static>(
    key: (TypeId, TypeId, Known),
    make: &dyn Fn() -> Result<X, Error>,
) -> Result<Arc<X>, Error> {
    let found = kept(key, &|| Ok(Arc::new(make()?)))?;
    Ok(found
        .downcast()
        .unwrap_or_else(|_| unreachable!("a key stands for one type")))
}

/// The object under a key: the kept one, or one made now.
fn kept(
    key: (TypeId, TypeId, Known),
    make: &dyn Fn() -> Result<Made, Error>,
) -> Result<Made, Error> {
    let known = KNOWN.read().unwrap_or_else(PoisonError::into_inner);
    let found = known.as_ref().and_then(|known| known.get(&key)).cloned();
    drop(known);
    if let Some(found) = found {
        return Ok(found);
    }
    let made = make()?;
    let mut known = KNOWN.write().unwrap_or_else(PoisonError::into_inner);
    known.get_or_insert_default().insert(key, made.clone());
    Ok(made)
}

/// The wanted part of an operation as a program: the result, or the result and derivatives, from the input and
/// then the cotangent.
pub(crate) fn program_of<O: Op, T: Plain>(want: Want) -> Result<Arc<Recorded>, Error> {
    recorded_of(&const { Line::<T>::of::<O>() }, want)
}

/// The same of an operation without its types.
pub(crate) fn recorded_of<T: Plain>(line: &Line<T>, want: Want) -> Result<Arc<Recorded>, Error> {
    known_by(line.key(Known::Program(want)), &|| {
        if line.codes > 0 {
            return Err(Error::Program(Unrecordable::Codes));
        }
        if want == Want::Value {
            return listed(line.inputs, TRIALS, &line.eval);
        }
        let value = || recorded_of(line, Want::Value);
        match (line.derivatives, want) {
            (op::Derivative::ByHand, Want::Jacobian) => {
                Ok(recorded_of(line, Want::Vjp)?.value_jacobian_of_vjp(line.outputs))
            }
            (op::Derivative::Reverse, Want::Jacobian) => Ok(value()?.value_jacobian()),
            (op::Derivative::Forward, Want::Jacobian) => Ok(value()?.value_jacobian_forwards()),
            (op::Derivative::ByHand, Want::Vjp) => {
                listed(line.inputs + line.outputs, TRIALS, &|numbers| {
                    let (input, out_bar) = numbers.split_at(line.inputs);
                    (line.adjoint)(input, out_bar)
                })
            }
            (op::Derivative::ByHand, _) => listed(line.inputs, TRIALS, &|input| {
                (line.adjoint)(input, &vec![Sym::lit(1.0); line.outputs])
            }),
            (op::Derivative::Reverse, Want::Vjp) => Ok(value()?.value_vjp()),
            (op::Derivative::Reverse, _) => Ok(value()?.value_grad()),
            (op::Derivative::Forward, Want::Vjp) => Ok(value()?.value_vjp_forwards()),
            (op::Derivative::Forward, _) => Ok(value()?.value_grad_forwards()),
        }
    })
}

/// How batches compute what is wanted of an operation.
pub fn face_of<O, R: Item>(want: Want, framed: bool) -> Result<Arc<Face<R::Scalar>>, Error>
where
    O: Op<In<<R as Pack>::Scalar> = R>,
    O::Out<R::Scalar>: Item,
{
    let shaped = &const { Shaped::<R::Scalar>::of::<O, R>() };
    (R::Scalar::drivers().faced)(shaped, want, framed)
}

/// The same of an operation without its types.
pub(crate) fn faced<T: Real>(
    shaped: &Shaped<T>,
    want: Want,
    framed: bool,
) -> Result<Arc<Face<T>>, Error> {
    let line = &shaped.line;
    known_by(line.key(Known::Face(want, framed)), &|| {
        let compiled = (line.compiled)();
        if let Some(mut face) = compiled.and_then(|compiled| of_compiled(compiled, want)) {
            name(&mut face.arguments, shaped.arguments);
            return Ok(face);
        }
        let recorded = recorded_of(line, want)?;
        let mut face = of_recorded(want, (shaped.takes)(), shaped.outputs(), &recorded, framed)?;
        name(&mut face.arguments, shaped.arguments);
        for argument in &mut face.arguments {
            argument.bounds = compiled.and_then(outline);
        }
        Ok(face)
    })
}

/// The kernel for a GPU that computes the wanted part of an operation.
#[cfg(feature = "gpu")]
pub fn generated_of<O, R: Item>(
    want: Want,
    framed: bool,
) -> Result<Arc<Generated<R::Scalar>>, Error>
where
    O: Op<In<<R as Pack>::Scalar> = R>,
    O::Out<R::Scalar>: Item,
{
    generated(&const { Shaped::<R::Scalar>::of::<O, R>() }, want, framed)
}

/// The same of an operation without its types.
#[cfg(feature = "gpu")]
pub(crate) fn generated<T: Real>(
    shaped: &Shaped<T>,
    want: Want,
    framed: bool,
) -> Result<Arc<Generated<T>>, Error> {
    known_by(shaped.line.key(Known::Shader(want, framed)), &|| {
        let recorded = recorded_of(&shaped.line, want)?;
        let made = Generated::new(want, (shaped.takes)(), shaped.outputs(), &recorded, framed)?;
        Ok(made.named(shaped.arguments))
    })
}

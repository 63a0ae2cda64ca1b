//! What was made of an operation before: programs and faces are made once per operation and format.
use super::compiled::{of_compiled, outline};
use super::face::{Face, Want};
use super::recorded::of_recorded;
use crate::ad::program::record::record;
use crate::ad::program::recorded::Recorded;
use crate::ad::program::{Plain, Sym};
use crate::error::Error;
#[cfg(feature = "gpu")]
use crate::kernels::gpu::Generated;
use crate::kernels::op::{self, Op};
use crate::kernels::row::{Row, leaves_of};
use crate::{Fixed, Pack, Scalar};
use std::any::{Any, TypeId};
use std::collections::HashMap;
use std::sync::{Arc, PoisonError, RwLock};

/// What is kept of an operation.
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
    /// What a GPU is given of it, aligned or all pairs.
    #[cfg(feature = "gpu")]
    Shader(Want, bool),
    /// What a GPU is given of a fold.
    #[cfg(feature = "gpu")]
    FoldShader,
    /// What a GPU replays of an operation with a search.
    #[cfg(feature = "gpu")]
    Replays(Want),
}

/// What was asked for before, by operation and format.
type Kept = HashMap<(TypeId, TypeId, Known), Made>;
type Made = Arc<dyn Any + Send + Sync>;
static KNOWN: RwLock<Option<Kept>> = RwLock::new(None);

/// Something that is made once per operation and format.
pub(crate) fn known<O: 'static, T: 'static, X: Send + Sync + 'static>(
    key: Known,
    make: impl Fn() -> Result<X, Error>,
) -> Result<Arc<X>, Error> {
    let key = (TypeId::of::<O>(), TypeId::of::<T>(), key);
    let found = kept(key, &|| Ok(Arc::new(make()?)))?;
    Ok(found
        .downcast()
        .unwrap_or_else(|_| unreachable!("a key stands for one type")))
}

/// What was made before under a key, or is made now.
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

/// What is wanted of an operation, as a program: the result, or the result and slopes, from the input
/// and then the cotangent.
pub(crate) fn program_of<O: Op, T: Plain>(want: Want) -> Result<Arc<Recorded>, Error> {
    known::<O, T, _>(Known::Program(want), || {
        type In<O, T> = <O as Op>::In<Sym<T>>;
        type Out<O, T> = <O as Op>::Out<Sym<T>>;
        // Without an adjoint by hand the program fails to be finite, which nothing then hides.
        let by_hand = |x, out_bar| {
            let nothing = || {
                (
                    Out::<O, T>::filled(Sym::lit(f64::NAN)),
                    In::<O, T>::filled(Sym::lit(0.0)),
                )
            };
            O::adjoint(x, out_bar).unwrap_or_else(nothing)
        };
        if want == Want::Value {
            return record::<T, In<O, T>, Out<O, T>>(O::eval);
        }
        match (O::SLOPES, want) {
            (op::Slopes::ByHand, Want::Vjp) => {
                record(|(x, out_bar): (In<O, T>, Out<O, T>)| by_hand(x, out_bar))
            }
            (op::Slopes::ByHand, _) => {
                record(|x: In<O, T>| by_hand(x, Out::<O, T>::filled(Sym::lit(1.0))))
            }
            (op::Slopes::Reverse, Want::Vjp) => Ok(program_of::<O, T>(Want::Value)?.value_vjp()),
            (op::Slopes::Reverse, _) => Ok(program_of::<O, T>(Want::Value)?.value_grad()),
            (op::Slopes::Forward, Want::Vjp) => {
                Ok(program_of::<O, T>(Want::Value)?.value_vjp_forwards())
            }
            (op::Slopes::Forward, _) => Ok(program_of::<O, T>(Want::Value)?.value_grad_forwards()),
        }
    })
}

/// How batches compute what is wanted of an operation.
pub fn face_of<O, R: Row>(want: Want, framed: bool) -> Result<Arc<Face<R::Scalar>>, Error>
where
    O: Op<In<<R as Pack>::Scalar> = R>,
    O::Out<R::Scalar>: Row,
{
    known::<O, R::Scalar, _>(Known::Face(want, framed), || {
        if let Some(face) = O::compiled().and_then(|compiled| of_compiled(compiled, want)) {
            return Ok(face);
        }
        let recorded = program_of::<O, R::Scalar>(want)?;
        let outputs = leaves_of::<O::Out<R::Scalar>>();
        let outputs = outputs.iter().map(|leaf| leaf.fields).collect();
        let mut face = of_recorded(want, leaves_of::<R>(), outputs, &recorded, framed)?;
        for argument in &mut face.arguments {
            argument.bounds = O::compiled().and_then(outline);
        }
        Ok(face)
    })
}

/// What a GPU is given of what is wanted of an operation.
#[cfg(feature = "gpu")]
pub fn generated_of<O, R: Row>(want: Want, framed: bool) -> Result<Arc<Generated<R::Scalar>>, Error>
where
    O: Op<In<<R as Pack>::Scalar> = R>,
    O::Out<R::Scalar>: Row,
{
    known::<O, R::Scalar, _>(Known::Shader(want, framed), || {
        let recorded = program_of::<O, R::Scalar>(want)?;
        let outputs = leaves_of::<O::Out<R::Scalar>>();
        let outputs = outputs.iter().map(|leaf| leaf.fields).collect();
        Generated::new(want, leaves_of::<R>(), outputs, &recorded, framed)
    })
}

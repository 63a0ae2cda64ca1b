//! Recorded programs in batches.
use crate::Error;
use crate::ad::program::recorded::Recorded;
use crate::ad::program::{Plain, Program};
use crate::kernels::cpu::plan::{Face, Want, of_recorded};
#[cfg(feature = "gpu")]
use crate::kernels::gpu::Generated;
use crate::kernels::item::{Item, Leaf, Results, leaves_of};
use crate::kernels::op::{Ask, Runs};
use std::sync::{Arc, PoisonError};

/// Batches run programs as they run operations. The interpreter of a program is made once, for all its runs.
///
/// ```
/// use geograd::ad::program::{Program, Sym};
/// use geograd::kernels::{Cpu, One};
/// use geograd::Vec2;
/// let distance = Program::trace(|(p, q): (Vec2<Sym<f64>>, Vec2<Sym<f64>>)| (p - q).length())?;
/// let points = [Vec2::new(3.0, 4.0), Vec2::new(6.0, 8.0)];
/// let origin = One(Vec2::new(0.0, 0.0));
/// let (d, (by_point, _)) = Cpu::new().aligned(&distance.value_grad(), (&points, origin))?;
/// assert_eq!(d, [5.0, 10.0]);
/// assert!(by_point[0].distance(Vec2::new(0.6, 0.8)) < 1e-15);
/// # Ok::<(), geograd::Error>(())
/// ```
impl<In: Item, Out: Item<Scalar = In::Scalar>> Runs<In> for &Program<In, Out>
where
    In::Scalar: Plain,
{
    type Out = Out;
    fn face(&self, ask: Ask) -> Result<Arc<Face<In::Scalar>>, Error> {
        made(self, 0, ask, of_recorded)
    }
    #[cfg(feature = "gpu")]
    fn generated(&self, ask: Ask) -> Result<Arc<Generated<In::Scalar>>, Error> {
        made(self, 16, ask, Generated::new)
    }
}

/// Makes the code of a machine from a program: from the wanted part, the shapes that it takes, the numbers that
/// it gives, the recording, and `true` if frames are made once per shape.
type Make<T, M> = fn(Want, Vec<Leaf<T>>, Vec<usize>, &Recorded, bool) -> Result<M, Error>;

/// The code of a program, made once per machine; `machine` is the number of the machine.
fn made<In: Item, Out: Item<Scalar = In::Scalar>, M: Send + Sync + 'static>(
    program: &Program<In, Out>,
    machine: u8,
    ask: Ask,
    make: Make<In::Scalar, M>,
) -> Result<Arc<M>, Error>
where
    In::Scalar: Plain,
{
    let key = machine | ask.want as u8 | u8::from(ask.framed) << 3;
    let lock = || program.kept.lock().unwrap_or_else(PoisonError::into_inner);
    let found = lock()
        .iter()
        .find(|kept| kept.0 == key)
        .map(|kept| kept.1.clone());
    if let Some(found) = found.and_then(|found| found.downcast().ok()) {
        return Ok(found);
    }
    let outputs = Out::widths();
    let (value, want) = (program.recorded(), ask.want);
    let recorded = match want {
        Want::Value => value.clone(),
        Want::ValueGrad => value.value_grad(),
        Want::Jacobian => value.value_jacobian(),
        Want::Vjp => value.value_vjp(),
    };
    let made = make(want, leaves_of::<In>(), outputs, &recorded, ask.framed)?;
    let made = Arc::new(made);
    lock().push((key, made.clone()));
    Ok(made)
}

impl<In: Item, Out: Item<Scalar = In::Scalar>> Runs<In> for Program<In, Out>
where
    In::Scalar: Plain,
{
    type Out = Out;
    fn face(&self, ask: Ask) -> Result<Arc<Face<In::Scalar>>, Error> {
        (&self).face(ask)
    }
    #[cfg(feature = "gpu")]
    fn generated(&self, ask: Ask) -> Result<Arc<Generated<In::Scalar>>, Error> {
        (&self).generated(ask)
    }
}

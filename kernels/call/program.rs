//! Recorded programs in batches.
use crate::ad::program::Program;
use crate::kernels::call::modes::Function;
use crate::kernels::call::recording::{Body, Call, Recording};
use crate::kernels::row::item::{Item, Results, leaves_of};
use crate::{Error, Real};
use std::sync::Arc;

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
impl<In: Item, Out: Item<Scalar = In::Scalar>> Function<In> for &Program<In, Out>
where
    In::Scalar: Real,
{
    type Out = Out;
    fn call(&self) -> Result<Call<In::Scalar>, Error> {
        let kept = &self.kept.recording;
        let made = kept.get_or_init(|| {
            Arc::new(Recording::<In::Scalar>::new(
                leaves_of::<In>(),
                Out::widths(),
                &[],
                Body::Graph(Arc::new(self.recorded().clone())),
            ))
        });
        let recording = Arc::clone(made).downcast();
        Ok(Call::of(recording.unwrap_or_else(|_| {
            unreachable!("a program has one format")
        })))
    }
}

impl<In: Item, Out: Item<Scalar = In::Scalar>> Function<In> for Program<In, Out>
where
    In::Scalar: Real,
{
    type Out = Out;
    fn call(&self) -> Result<Call<In::Scalar>, Error> {
        (&self).call()
    }
}

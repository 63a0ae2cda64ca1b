//~ `.value_grad()` needs one number as result
//~ `.jacobian()` gives the gradient of 
use geograd::kernels::{ClosestPoints, Cpu, Op};
use geograd::{Error, Obb2};

pub fn derivatives(a: &[Obb2<f64>], b: &[Obb2<f64>]) -> Result<(), Error> {
    Cpu::new().aligned(ClosestPoints.value_grad(), (a, b))?;
    Ok(())
}

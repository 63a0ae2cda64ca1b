//~ is not an operation
//~ `operation!` makes an operation of a generic function, `Program::trace` a program of a closure
use geograd::kernels::Cpu;
use geograd::{Error, Obb2};

pub fn areas(shapes: &[Obb2<f64>]) -> Result<(), Error> {
    Cpu::new().aligned(|shape: Obb2<f64>| shape.area(), shapes)?;
    Ok(())
}

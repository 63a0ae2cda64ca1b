//~ is not an operation
//~ `function(f)` runs a plain generic function, `operation!` makes it an operation
use geograd::kernels::Cpu;
use geograd::{Error, Obb2};

pub fn areas(shapes: &[Obb2<f64>]) -> Result<(), Error> {
    Cpu::new().aligned(|shape: Obb2<f64>| shape.area(), shapes)?;
    Ok(())
}

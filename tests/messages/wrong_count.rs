//~ expected `(_, _)`, found `Obb2<f64>`
use geograd::prelude::*;

pub fn overlaps(shapes: &[Obb2<f64>]) -> Result<(), geograd::Error> {
    Cpu::new().aligned(Iou, shapes)?;
    Ok(())
}

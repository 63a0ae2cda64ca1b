//~ Obb2<f64>` is not a column
//~ one shape for all items, `One(shape)`
use geograd::prelude::*;

pub fn overlaps(shapes: &[Obb2<f64>], goal: Obb2<f64>) -> Result<(), geograd::Error> {
    Cpu::new().aligned(Iou, (shapes, goal))?;
    Ok(())
}

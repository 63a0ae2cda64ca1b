//~ `geograd::kernels::Iou` of `geograd::Obb2<f64>` and `geograd::Vec2<f64>` is not defined
//~ does not take these two shapes
//~ `geograd::kernels::Iou` implements `geograd::kernels::Binary<Aabb3<S>, YawBox3<S>>`
//~ a row adds shapes of your own
use geograd::prelude::*;

pub fn overlaps(shapes: &[Obb2<f64>], points: &[Vec2<f64>]) -> Result<(), geograd::Error> {
    Cpu::new().aligned(Iou, (shapes, points))?;
    Ok(())
}

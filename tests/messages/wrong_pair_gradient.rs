//~ expected `Obb2<f64>`, found `Vec2<f64>`
use geograd::prelude::*;

pub fn overlaps(shapes: &[Obb2<f64>], points: &[Vec2<f64>]) -> Result<(), geograd::Error> {
    Cpu::new().all_pairs(Iou.value_grad(), shapes, points)?;
    Ok(())
}

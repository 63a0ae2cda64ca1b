//! A user's program: every batch form of three operations in both formats.
use geograd::kernels::real::Real;
use geograd::kernels::{Centroid, IofObb2, IouAabb2, IouObb2, PairOp, RingOp, cpu, reduce};
use geograd::{Aabb2, Error, Fixed, Obb2, Vec2};

fn pairs<O: PairOp, T: Real>(a: &[O::A<T>], b: &[O::B<T>]) -> Result<f64, Error> {
    let values = cpu::aligned::<O, T>(a, b)?;
    let (_, p, _) = cpu::aligned_grad::<O, T>(a, b)?;
    let (_, q) = cpu::aligned_vjp::<O, T>(a, b, &values)?;
    let matrix = cpu::all_pairs::<O, T>(a, b)?;
    let grads = cpu::all_pairs_grad::<O, T>(a, b)?;
    let (r, _) = cpu::all_pairs_vjp::<O, T>(a, b, &matrix)?;
    let best = reduce::row_max::<O, T>(a, b)?;
    let other = reduce::column_max::<O, T>(a, b)?;
    let found = reduce::above::<O, T>(a, b, T::lit(0.5))?;
    let count = reduce::count_above::<O, T>(a, b, T::lit(0.5))?;
    let sum = reduce::sum::<O, T>(a, b)?;
    let (mean, s, _) = reduce::mean_grad::<O, T>(a, b)?;
    let slopes = p.len() + q.len() + r.len() + s.len() + grads.planes.len();
    Ok(sum + mean + (slopes + best.len() + other.len() + found.len()) as f64 + count as f64)
}

fn rings<O: RingOp, T: Real>(vertices: &[Vec2<T>], offsets: &[usize]) -> Result<usize, Error> {
    let values = cpu::ragged::<O, T>(vertices, offsets)?;
    let bars = cpu::ragged_vjp::<O, T>(vertices, offsets, &values)?;
    let grads = cpu::ragged_grad::<O, T>(vertices, offsets, &values)?;
    Ok(bars.len() + grads.0.len())
}

fn main() -> Result<(), Error> {
    let rotated = [Obb2::<f64>::new(0.0, 0.0, 4.0, 2.0, 0.3); 20];
    let single = [Obb2::<f32>::new(0.0, 0.0, 4.0, 2.0, 0.3); 20];
    let straight = [Aabb2::<f64>::new(0.0, 0.0, 4.0, 2.0); 20];
    let straight_single = [Aabb2::<f32>::new(0.0, 0.0, 4.0, 2.0); 20];
    let mut total = pairs::<IouObb2, f64>(&rotated, &rotated)?;
    total += pairs::<IouObb2, f32>(&single, &single)?;
    total += pairs::<IofObb2, f64>(&rotated, &rotated)?;
    total += pairs::<IofObb2, f32>(&single, &single)?;
    total += pairs::<IouAabb2, f64>(&straight, &straight)?;
    total += pairs::<IouAabb2, f32>(&straight_single, &straight_single)?;
    let corner = [
        Vec2::filled(0.0_f64),
        Vec2::new(4.0, 0.0),
        Vec2::new(0.0, 3.0),
    ];
    total += rings::<Centroid, f64>(&corner, &[0, 3])? as f64;
    let corner = [
        Vec2::filled(0.0_f32),
        Vec2::new(4.0, 0.0),
        Vec2::new(0.0, 3.0),
    ];
    total += rings::<Centroid, f32>(&corner, &[0, 3])? as f64;
    println!("{total}");
    Ok(())
}

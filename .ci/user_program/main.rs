//! A user's program: every batch form of three operations in both formats.
use geograd::kernels::real::Real;
use geograd::kernels::{Centroid, Cpu, IofObb2, IouAabb2, IouObb2, Op, RingOp, Single};
use geograd::{Aabb2, Error, Obb2, Vec2};

fn pairs<O, P, T>(op: O, a: &[P]) -> Result<f64, Error>
where
    O: Op<In<T> = (P, P), Out<T> = T>,
    P: Single<Scalar = T>,
    T: Real + Single<Scalar = T>,
{
    let (cpu, b) = (Cpu::new(), a);
    let values = cpu.aligned(op, (a, b))?;
    let (_, (p, _)) = cpu.aligned(op.value_grad(), (a, b))?;
    let (_, q) = cpu.aligned(op.vjp(), ((a, b), &values))?;
    let matrix = cpu.all_pairs(op, a, b)?;
    let grads = cpu.all_pairs(op.value_grad(), a, b)?;
    let (r, _) = cpu.all_pairs_vjp(op, a, b, matrix.values())?;
    let best = cpu.row_max(op, a, b)?;
    let other = cpu.column_max(op, a, b)?;
    let found = cpu.above(op, a, b, T::lit(0.5))?;
    let count = cpu.count_above(op, a, b, T::lit(0.5))?;
    let sum = cpu.sum(op, a, b)?;
    let (mean, s, _) = cpu.mean_grad(op, a, b)?;
    let slopes = p.len() + q.len() + r.len() + s.len() + grads.planes().len();
    Ok(sum + mean + (slopes + best.len() + other.len() + found.len()) as f64 + count as f64)
}

fn rings<O: RingOp, T: Real>(op: O, vertices: &[Vec2<T>], offsets: &[usize]) -> Result<f64, Error> {
    let cpu = Cpu::new();
    let values = cpu.ragged(op, vertices, offsets)?;
    let bars = cpu.ragged_vjp(op, vertices, offsets, &values)?;
    let grads = cpu.ragged_grad(op, vertices, offsets, &values)?;
    Ok((bars.len() + grads.0.len()) as f64)
}

fn main() -> Result<(), Error> {
    let rotated = [Obb2::<f64>::new(0.0, 0.0, 4.0, 2.0, 0.3); 20];
    let single = [Obb2::<f32>::new(0.0, 0.0, 4.0, 2.0, 0.3); 20];
    let straight = [Aabb2::<f64>::new(0.0, 0.0, 4.0, 2.0); 20];
    let straight_single = [Aabb2::<f32>::new(0.0, 0.0, 4.0, 2.0); 20];
    let mut total = pairs(IouObb2, &rotated)?;
    total += pairs(IouObb2, &single)?;
    total += pairs(IofObb2, &rotated)?;
    total += pairs(IofObb2, &single)?;
    total += pairs(IouAabb2, &straight)?;
    total += pairs(IouAabb2, &straight_single)?;
    let corner = [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)].map(|(x, y)| Vec2::new(x, y));
    total += rings::<_, f64>(Centroid, &corner, &[0, 3])?;
    let corner = [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)].map(|(x, y)| Vec2::new(x, y));
    total += rings::<_, f32>(Centroid, &corner, &[0, 3])?;
    println!("{total}");
    Ok(())
}

//! A user's program: every batch form of three operations in both formats.
use geograd::kernels::op::{ValueGrad, Vjp};
use geograd::kernels::{Centroid, Cpu, Fold, Function, Iof, Iou, Item, Single};
use geograd::{Aabb2, Error, Obb2, Real, Vec2};

fn pairs<O, P, T>(op: O, a: &[P]) -> Result<f64, Error>
where
    O: Function<(P, P), Out = T> + Copy,
    P: Single<Scalar = T>,
    T: Real + Single<Scalar = T>,
{
    let (cpu, b) = (Cpu::new(), a);
    let values = cpu.aligned(op, (a, b))?;
    let (_, (p, _)) = cpu.aligned(ValueGrad::of(op), (a, b))?;
    let (_, q) = cpu.aligned(Vjp::of(op), ((a, b), &values))?;
    let matrix = cpu.all_pairs(op, a, b)?;
    let grads = cpu.all_pairs(ValueGrad::of(op), a, b)?;
    let (r, _) = cpu.all_pairs_vjp(op, a, b, matrix.values())?;
    let best = cpu.row_max(op, a, b)?;
    let other = cpu.column_max(op, a, b)?;
    let found = cpu.above(op, a, b, T::lit(0.5))?;
    let count = cpu.count_above(op, a, b, T::lit(0.5))?;
    let sum = cpu.sum(op, a, b)?;
    let (mean, s, _) = cpu.mean_grad(op, a, b)?;
    let derivatives = p.len() + q.len() + r.len() + s.len() + grads.planes().len();
    Ok(sum + mean + (derivatives + best.len() + other.len() + found.len()) as f64 + count as f64)
}

fn rings<F, T>(fold: F, vertices: &[Vec2<T>], offsets: &[usize]) -> Result<f64, Error>
where
    F: Fold<Context<T> = [T; 0], Element<T> = Vec2<T>>,
    T: Real + Item,
{
    let cpu = Cpu::new();
    let values = cpu.ragged(fold, vertices, offsets)?;
    let bars = cpu.ragged_vjp(fold, vertices, offsets, &values)?;
    Ok((bars.len() + values.len()) as f64)
}

fn main() -> Result<(), Error> {
    let rotated = [Obb2::<f64>::new(0.0, 0.0, 4.0, 2.0, 0.3); 20];
    let single = [Obb2::<f32>::new(0.0, 0.0, 4.0, 2.0, 0.3); 20];
    let straight = [Aabb2::<f64>::new(0.0, 0.0, 4.0, 2.0); 20];
    let straight_single = [Aabb2::<f32>::new(0.0, 0.0, 4.0, 2.0); 20];
    let mut total = pairs(Iou, &rotated)?;
    total += pairs(Iou, &single)?;
    total += pairs(Iof, &rotated)?;
    total += pairs(Iof, &single)?;
    total += pairs(Iou, &straight)?;
    total += pairs(Iou, &straight_single)?;
    let corner = [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)].map(|(x, y)| Vec2::new(x, y));
    total += rings::<_, f64>(Centroid.over_ring(), &corner, &[0, 3])?;
    let corner = [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)].map(|(x, y)| Vec2::new(x, y));
    total += rings::<_, f32>(Centroid.over_ring(), &corner, &[0, 3])?;
    println!("{total}");
    Ok(())
}

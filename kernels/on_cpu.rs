//! The processor's side of [`Backend`](crate::kernels::Backend) and
//! [`resident`](crate::kernels::resident): batches of the operations that a GPU serves, in `f32`.
use crate::error::{Argument, Error};
use crate::kernels::gpu::GpuPair;
use crate::kernels::reduce::{Best, Found};
use crate::kernels::{Cpu, Table};

/// Both shapes of an operation.
pub type ShapeOf<O> = <O as GpuPair>::Shape;
/// Results and slopes of aligned pairs.
pub type AlignedGrads<O> = (Vec<f32>, Vec<ShapeOf<O>>, Vec<ShapeOf<O>>);
/// Results and slopes of all pairs.
pub type PairGrads<O> = Table<(f32, (ShapeOf<O>, ShapeOf<O>))>;
/// Slopes with respect to both lists.
pub type Bars<O> = (Vec<ShapeOf<O>>, Vec<ShapeOf<O>>);
/// A sum or mean of results, and slopes with respect to both lists.
pub type Loss<O> = (f64, Vec<ShapeOf<O>>, Vec<ShapeOf<O>>);

const CPU: Cpu = Cpu::new();

/// Results by the names that a GPU's calls give them.
fn named(done: Result<(), Error>, names: &[Argument]) -> Result<(), Error> {
    done.map_err(|error| match error {
        Error::Length {
            argument: Argument::Result(index),
            expected,
            found,
        } if index < names.len() => Error::Length {
            argument: names[index],
            expected,
            found,
        },
        error => error,
    })
}

/// Calls that only pass on: the macro lists them.
macro_rules! passed_on {
    ($($name:ident($($arg:ident: $type:ty),*) -> $out:ty = |$op:ident| $call:expr;)*) => { $(
        pub fn $name<O: GpuPair>($op: O, $($arg: $type),*) -> Result<$out, Error> {
            $call
        }
    )* };
}

passed_on! {
    aligned(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> Vec<f32> = |op| CPU.aligned(op, (a, b));
    aligned_into(a: &[ShapeOf<O>], b: &[ShapeOf<O>], values: &mut [f32]) -> ()
        = |op| named(CPU.aligned_into(op, (a, b), values), &[Argument::Values]);
    aligned_grad(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> AlignedGrads<O>
        = |op| CPU.aligned(op.value_grad(), (a, b)).map(|(values, (a_bar, b_bar))| (values, a_bar, b_bar));
    aligned_grad_into(
        a: &[ShapeOf<O>], b: &[ShapeOf<O>],
        values: &mut [f32], a_bar: &mut [ShapeOf<O>], b_bar: &mut [ShapeOf<O>]
    ) -> () = |op| {
        let into = (values, (a_bar, b_bar));
        let names = [Argument::Values, Argument::GradA, Argument::GradB];
        named(CPU.aligned_into(op.value_grad(), (a, b), into), &names)
    };
    aligned_vjp(a: &[ShapeOf<O>], b: &[ShapeOf<O>], upstream: &[f32]) -> Bars<O>
        = |op| CPU.aligned(op.vjp(), ((a, b), upstream));
    aligned_vjp_into(
        a: &[ShapeOf<O>], b: &[ShapeOf<O>], upstream: &[f32],
        a_bar: &mut [ShapeOf<O>], b_bar: &mut [ShapeOf<O>]
    ) -> () = |op| {
        let done = CPU.aligned_into(op.vjp(), ((a, b), upstream), (a_bar, b_bar));
        named(done, &[Argument::GradA, Argument::GradB])
    };
    all_pairs(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> Vec<f32>
        = |op| CPU.all_pairs(op, a, b).map(Table::into_planes);
    all_pairs_into(a: &[ShapeOf<O>], b: &[ShapeOf<O>], values: &mut [f32]) -> ()
        = |op| CPU.all_pairs_planes(op, a, b, values);
    all_pairs_grad(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> PairGrads<O>
        = |op| CPU.all_pairs(op.value_grad(), a, b);
    all_pairs_vjp(a: &[ShapeOf<O>], b: &[ShapeOf<O>], upstream: &[f32]) -> Bars<O>
        = |op| CPU.all_pairs_vjp(op, a, b, upstream);
    all_pairs_vjp_into(
        a: &[ShapeOf<O>], b: &[ShapeOf<O>], upstream: &[f32],
        a_bar: &mut [ShapeOf<O>], b_bar: &mut [ShapeOf<O>]
    ) -> () = |op| CPU.all_pairs_vjp_into(op, a, b, upstream, a_bar, b_bar);
    sum_grad(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> Loss<O> = |op| CPU.sum_grad(op, a, b);
    mean_grad(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> Loss<O> = |op| CPU.mean_grad(op, a, b);
    sum_grad_into(
        a: &[ShapeOf<O>], b: &[ShapeOf<O>], factor: f32,
        a_bar: &mut [ShapeOf<O>], b_bar: &mut [ShapeOf<O>]
    ) -> f64 = |op| CPU.sum_grad_into(op, a, b, factor, a_bar, b_bar);
    row_max(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> Vec<Best> = |op| CPU.row_max(op, a, b);
    column_max(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> Vec<Best> = |op| CPU.column_max(op, a, b);
    above(a: &[ShapeOf<O>], b: &[ShapeOf<O>], threshold: f32) -> Vec<Found>
        = |op| CPU.above(op, a, b, threshold);
    count_above(a: &[ShapeOf<O>], b: &[ShapeOf<O>], threshold: f32) -> u64
        = |op| CPU.count_above(op, a, b, threshold);
    sum(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> f64 = |op| CPU.sum(op, a, b);
    mean(a: &[ShapeOf<O>], b: &[ShapeOf<O>]) -> f64 = |op| CPU.mean(op, a, b);
}

use crate::Vec2;
use crate::kernels::op::RingOp;

/// One result per ring.
pub fn ragged<O: RingOp>(
    op: O,
    vertices: &[Vec2<f32>],
    offsets: &[usize],
) -> Result<Vec<O::Out<f32>>, Error> {
    CPU.ragged(op, vertices, offsets)
}
/// One cotangent per vertex.
pub fn ragged_vjp<O: RingOp>(
    op: O,
    vertices: &[Vec2<f32>],
    offsets: &[usize],
    upstream: &[O::Out<f32>],
) -> Result<Vec<Vec2<f32>>, Error> {
    CPU.ragged_vjp(op, vertices, offsets, upstream)
}

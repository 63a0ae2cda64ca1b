//! The adjoint of all pairs: derivatives summed for every shape, in a fixed order.
use super::operation::Generated;
use super::text::{KernelForm, SummedLists};
use super::uploaded::{PairDispatch, UploadedLists};
use crate::Error;
use crate::kernels::gpu::device::block::block_of;
use crate::kernels::gpu::device::context::Device;
use crate::kernels::gpu::device::seed::{PairSeed, sum_of};
use crate::kernels::gpu::device::work::{Commands, Params, groups};
use crate::kernels::gpu::device::written::{self, Kernel};
use std::sync::Arc;

/// Sums over all pairs: derivatives of both lists, shape by shape, and results.
struct Sums {
    bars: [Vec<f64>; 2],
    total: f64,
}

impl Device {
    /// Returns the derivatives of both lists. If one factor is the seed of all pairs and the body computes results with
    /// derivatives, it also returns the sum of all results. Sums within a dispatch are added in `f32`, sums over
    /// dispatches in `f64`, in a fixed order.
    pub(in crate::kernels::gpu::device) fn derivatives(
        &self,
        made: &Arc<Generated<f32>>,
        sides: &UploadedLists,
        seed: &PairSeed<'_>,
    ) -> Result<([Vec<f32>; 2], Option<f64>), Error> {
        let inner = &self.inner;
        let [rows, columns] = sides.counts();
        let passes = made.passes(inner.slots);
        let mut sums = Sums {
            bars: [rows * made.gives[0], columns * made.gives[1]].map(|n| vec![0.0; n]),
            total: 0.0,
        };
        for (k, block) in inner.cut(rows, columns, 4).into_iter().enumerate() {
            let (upstream, factor) = match seed {
                PairSeed::Numbers(numbers) => {
                    let own = block_of(&block, columns, numbers);
                    (Some(inner.guarded(|| Ok(inner.stored(&own)))?), 0.0)
                }
                // A matrix is split as the pairs are.
                PairSeed::Matrix(matrix) => (Some(matrix.blocks[k].1.clone()), 0.0),
                PairSeed::Factor(factor) => (None, *factor),
            };
            let operations = made.bodies.iter().map(|body| body.operations).max();
            for piece in sides.pieces(&block, operations.unwrap_or(1)) {
                for &of in &passes {
                    self.pull(made, of, &piece, upstream.as_ref(), factor, &mut sums)?;
                }
            }
        }
        let has_total = matches!(
            (&passes[..], seed),
            ([SummedLists::Both(_)], PairSeed::Factor(_))
        );
        let bars = sums
            .bars
            .map(|sums| sums.iter().map(|&x| x as f32 + 0.0).collect());
        Ok((bars, has_total.then_some(sums.total)))
    }

    /// Runs one dispatch and sums what it writes: a partial sum per strip for own shapes, one per workgroup for walked
    /// ones.
    fn pull(
        &self,
        made: &Arc<Generated<f32>>,
        of: SummedLists,
        piece: &PairDispatch<'_>,
        upstream: Option<&wgpu::Buffer>,
        factor: f32,
        sums: &mut Sums,
    ) -> Result<(), Error> {
        let inner = &self.inner;
        let seed = match upstream {
            Some(_) => written::SeedSource::Matrix,
            None => written::SeedSource::Factor,
        };
        let form = KernelForm::Derivatives(of, seed);
        let own = usize::from(of != SummedLists::Rows);
        let [wide, tall] = piece.groups(own, made.size(form));
        let partial = |list: usize, parts: usize| Partial {
            list,
            count: piece.counts[list],
            fields: made.gives[list],
            parts,
        };
        let partials = match of {
            SummedLists::Both(_) => vec![partial(own, tall), partial(1 - own, wide)],
            _ => vec![partial(own, tall)],
        };
        let rooms = inner.guarded(|| {
            let pipeline = made.pipeline(inner, form);
            let parts: Vec<_> = partials
                .iter()
                .map(|x| inner.storage(x.parts * x.numbers()))
                .collect();
            let mut buffers = vec![(1, piece.buffers[0]), (2, piece.buffers[1])];
            buffers.extend((5..).zip(&parts));
            buffers.extend(upstream.map(|upstream| (3, upstream)));
            // Bodies that compute results with derivatives also sum the results, column by column.
            let has_totals = matches!((of, upstream), (SummedLists::Both(_), None));
            let totals = has_totals.then(|| {
                let numbers = tall * piece.counts[own];
                (inner.storage(numbers), numbers)
            });
            buffers.extend(totals.as_ref().map(|(totals, _)| (4, totals)));
            let params = Params {
                factor,
                ..piece.params(own)
            };
            let mut work = Commands::new(inner);
            work.dispatch(&pipeline, params, &buffers, [wide as u32, tall as u32]);
            let folded = partials.iter().zip(&parts);
            let mut rooms: Vec<_> = folded
                .map(|(x, parts)| (x.folded(&mut work, parts), x.numbers()))
                .collect();
            work.submit()?;
            rooms.extend(totals);
            Ok(rooms)
        })?;
        let parts = rooms
            .iter()
            .map(|(room, numbers)| (room, 4 * *numbers as u64));
        let arrival = inner.bring(self, &parts.collect::<Vec<_>>())?;
        arrival.finish(|part, numbers| match partials.get(part) {
            Some(x) => x.add(
                numbers,
                &mut sums.bars[x.list][piece.firsts[x.list] * x.fields..],
            ),
            None => sums.total += sum_of(numbers),
        })
    }
}

/// Partial sums of derivatives of a list's shapes: part by part, and within a part field by field.
struct Partial {
    list: usize,
    count: usize,
    fields: usize,
    parts: usize,
}

impl Partial {
    /// Returns the length of a part.
    fn numbers(&self) -> usize {
        self.fields * self.count
    }

    /// Returns the sums over parts, in a new buffer.
    fn folded(&self, work: &mut Commands<'_>, parts: &wgpu::Buffer) -> wgpu::Buffer {
        let inner = work.inner;
        let pipeline = inner.written(Kernel::Fold, "fold_main");
        let to = inner.storage(self.numbers());
        let params = Params {
            own_count: self.count as u32,
            parts: self.parts as u32,
            fields: self.fields as u32,
            ..Params::default()
        };
        let size = [groups(self.count), self.fields as u32];
        work.dispatch(&pipeline, params, &[(3, parts), (4, &to)], size);
        to
    }

    /// Adds downloaded sums, which are field by field, to `sums`, which are shape by shape.
    fn add(&self, numbers: &[u32], sums: &mut [f64]) {
        let shapes = sums.chunks_exact_mut(self.fields.max(1)).take(self.count);
        for (i, shape) in shapes.enumerate() {
            for (field, sum) in shape.iter_mut().enumerate() {
                *sum += f64::from(f32::from_bits(numbers[field * self.count + i]));
            }
        }
    }
}

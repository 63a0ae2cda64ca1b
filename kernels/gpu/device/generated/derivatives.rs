//! The adjoint of all pairs: derivatives summed for every shape, in a fixed order.
use super::operation::Generated;
use super::template::Of;
use super::text::Form;
use super::uploaded::{Piece, Sides};
use crate::Error;
use crate::kernels::gpu::device::Device;
use crate::kernels::gpu::device::block::block_of;
use crate::kernels::gpu::device::seed::{Seed, sum_of};
use crate::kernels::gpu::device::work::{Params, Work, groups};
use crate::kernels::gpu::device::written::{self, Kernel};
use std::sync::Arc;

/// Sums of derivatives of both lists, shape by shape, and of results.
struct Sums {
    bars: [Vec<f64>; 2],
    total: f64,
}

impl Device {
    /// The numbers of the derivatives of both lists, and the sum of all results where one factor is the seed of all and
    /// the body gives results beside derivatives. Sums of a dispatch are added in `f32`, those of dispatches in `f64`,
    /// always in the same order.
    pub(in crate::kernels::gpu::device) fn derivatives(
        &self,
        made: &Arc<Generated<f32>>,
        sides: &Sides,
        seed: &Seed<'_>,
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
                Seed::Numbers(numbers) => {
                    let own = block_of(&block, columns, numbers);
                    (Some(inner.guarded(|| Ok(inner.stored(&own)))?), 0.0)
                }
                // A matrix is cut as the pairs are.
                Seed::Matrix(matrix) => (Some(matrix.blocks[k].1.clone()), 0.0),
                Seed::Factor(factor) => (None, *factor),
            };
            let operations = made.bodies.iter().map(|body| body.operations).max();
            for piece in sides.pieces(&block, operations.unwrap_or(1)) {
                for &of in &passes {
                    self.pull(made, of, &piece, upstream.as_ref(), factor, &mut sums)?;
                }
            }
        }
        let has_total = matches!((&passes[..], seed), ([Of::Both(_)], Seed::Factor(_)));
        let bars = sums
            .bars
            .map(|sums| sums.iter().map(|&x| x as f32 + 0.0).collect());
        Ok((bars, has_total.then_some(sums.total)))
    }

    /// One dispatch, and the sums of what it leaves: a partial sum per strip for own shapes, one per workgroup for walked
    /// ones.
    fn pull(
        &self,
        made: &Arc<Generated<f32>>,
        of: Of,
        piece: &Piece<'_>,
        upstream: Option<&wgpu::Buffer>,
        factor: f32,
        sums: &mut Sums,
    ) -> Result<(), Error> {
        let inner = &self.inner;
        let seed = match upstream {
            Some(_) => written::Seed::Matrix,
            None => written::Seed::Factor,
        };
        let form = Form::Derivatives(of, seed);
        let own = usize::from(of != Of::Rows);
        let counts = [own, 1 - own].map(|k| piece.counts[k]);
        let [wide, tall] = piece.groups(own, made.size(form));
        // Own shapes have a partial sum per strip.
        let mut lists = vec![(own, tall, counts[0])];
        if let Of::Both(_) = of {
            lists.push((1 - own, wide, counts[1]));
        }
        let (folded, totals) = inner.guarded(|| {
            let pipeline = made.pipeline(inner, form);
            let parts: Vec<_> = lists
                .iter()
                .map(|&(k, parts, count)| inner.storage(parts * made.gives[k] * count))
                .collect();
            let mut buffers = vec![(1, piece.buffers[0]), (2, piece.buffers[1])];
            buffers.extend((5..).zip(&parts));
            buffers.extend(upstream.map(|upstream| (3, upstream)));
            let totals = match (of, upstream) {
                (Of::Both(_), None) => Some(inner.storage(tall * counts[0])),
                _ => None,
            };
            buffers.extend(totals.as_ref().map(|totals| (4, totals)));
            let params = Params {
                factor,
                ..piece.params(own)
            };
            let mut work = Work::new(inner);
            work.dispatch(&pipeline, params, &buffers, [wide as u32, tall as u32]);
            let fold = inner.written(Kernel::Fold, "fold_main");
            let folded = lists.iter().zip(&parts).map(|(&(k, parts, count), from)| {
                let fields = made.gives[k];
                let to = inner.storage(fields * count);
                let params = Params {
                    own_count: count as u32,
                    parts: parts as u32,
                    fields: fields as u32,
                    ..Params::default()
                };
                let size = [groups(count), fields as u32];
                work.dispatch(&fold, params, &[(3, from), (4, &to)], size);
                to
            });
            let folded: Vec<_> = folded.collect();
            work.submit()?;
            Ok((folded, totals))
        })?;
        self.add(
            made,
            piece,
            &lists,
            &folded,
            totals.map(|x| (x, tall * counts[0])),
            sums,
        )
    }

    /// Brings the sums of a dispatch back and adds them to those of others.
    fn add(
        &self,
        made: &Generated<f32>,
        piece: &Piece<'_>,
        lists: &[(usize, usize, usize)],
        folded: &[wgpu::Buffer],
        totals: Option<(wgpu::Buffer, usize)>,
        sums: &mut Sums,
    ) -> Result<(), Error> {
        let mut parts: Vec<(&wgpu::Buffer, u64)> = Vec::new();
        for (&(k, _, count), buffer) in lists.iter().zip(folded) {
            parts.push((buffer, 4 * (made.gives[k] * count) as u64));
        }
        parts.extend(
            totals
                .as_ref()
                .map(|(buffer, numbers)| (buffer, 4 * *numbers as u64)),
        );
        self.inner.bring(self, &parts)?.finish(|part, numbers| {
            let Some(&(k, _, count)) = lists.get(part) else {
                sums.total += sum_of(numbers);
                return;
            };
            let fields = made.gives[k];
            let bars = sums.bars[k][piece.firsts[k] * fields..].chunks_exact_mut(fields.max(1));
            for (i, bar) in bars.take(count).enumerate() {
                for (field, sum) in bar.iter_mut().enumerate() {
                    *sum += f64::from(f32::from_bits(numbers[field * count + i]));
                }
            }
        })
    }
}

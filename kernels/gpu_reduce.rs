//! Reductions of all pairs on the GPU: the matrix is never written, so memory stays bounded.
use super::data::{Piece, parts};
use super::pairs::{ShapesOf, source_for};
use super::source::{GpuPair, Kernel, STRIP, Source};
use super::work::{Params, Work, groups};
use super::{Gpu, Inner, Pending};
use crate::kernels::GpuError;
pub use crate::kernels::reduce::Best;
use crate::kernels::reduce::Found;

/// The largest score of every row (or column) and where it is, on the GPU.
#[derive(Clone, Debug)]
pub struct Bests {
    gpu: Gpu,
    values: Vec<Piece>,
    indices: Vec<Piece>,
}

impl Bests {
    /// Starts bringing them back.
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn start_download(&self) -> Result<Pending<Vec<Best>>, GpuError> {
        let mut all = parts(&self.values, |n| n);
        all.extend(parts(&self.indices, |n| n));
        let arrival = self.gpu.inner.bring(&self.gpu, &all)?;
        let half = self.values.len();
        Ok(Pending::new(arrival, move |arrival| {
            let (mut values, mut indices): (Vec<f32>, Vec<u32>) = (Vec::new(), Vec::new());
            arrival.read(|part, numbers| {
                if part < half {
                    values.extend_from_slice(bytemuck::cast_slice(numbers));
                } else {
                    indices.extend_from_slice(numbers);
                }
            })?;
            let pairs = values.iter().zip(&indices);
            Ok(pairs
                .map(|(&value, &index)| Best {
                    value,
                    index: index as usize,
                })
                .collect())
        }))
    }

    /// Brings them back, in the order of the rows (or columns).
    ///
    /// # Errors
    ///
    /// What the device says.
    pub fn download(&self) -> Result<Vec<Best>, GpuError> {
        self.start_download()?.wait()
    }
}

/// One dispatch of a reduction: a run of own shapes by a run of walked ones.
#[derive(Clone, Copy, Debug)]
struct Sweep {
    own_piece: usize,
    own_start: usize,
    own_base: usize,
    own: usize,
    walked_piece: usize,
    walked_base: usize,
    walked: usize,
}

impl Sweep {
    fn strips(&self) -> usize {
        self.walked.div_ceil(STRIP)
    }

    /// The same in two, for own shapes that found more than a buffer holds.
    fn halves(self) -> (Sweep, Sweep) {
        let half = self.own / 2;
        let second = Sweep {
            own_start: self.own_start + half,
            own_base: self.own_base + half,
            own: self.own - half,
            ..self
        };
        (Sweep { own: half, ..self }, second)
    }

    fn params(&self) -> Params {
        Params {
            own_count: self.own as u32,
            own_start: self.own_start as u32,
            own_base: self.own_base as u32,
            loop_count: self.walked as u32,
            loop_base: self.walked_base as u32,
            parts: self.strips() as u32,
            ..Params::default()
        }
    }
}

impl Inner {
    /// How a reduction is cut: own shapes so that partial results fit a buffer.
    fn sweeps(&self, own: usize, walked: usize) -> Vec<Sweep> {
        // As a matrix with one column per strip and four numbers per entry; whole workgroups.
        let widest = self.chunk.min(walked).max(1);
        let pairs =
            (self.most_bytes as usize / 16 / widest.div_ceil(STRIP)).min((1 << 30) / widest);
        let most = (pairs.max(1)).min(self.chunk);
        let mut sweeps = Vec::new();
        let mut own_base = 0;
        while own_base < own {
            // Not beyond the end of the piece.
            let own_start = own_base % self.chunk;
            let count = most.min(own - own_base).min(self.chunk - own_start);
            for (walked_piece, walked_base) in (0..walked).step_by(self.chunk).enumerate() {
                sweeps.push(Sweep {
                    own_piece: own_base / self.chunk,
                    own_start,
                    own_base,
                    own: count,
                    walked_piece,
                    walked_base,
                    walked: self.chunk.min(walked - walked_base),
                });
            }
            own_base += count;
        }
        sweeps
    }
}

impl Gpu {
    /// The largest score of every row and its column; of several the first. An empty list of
    /// columns gives nothing to be the largest of and is refused.
    ///
    /// # Errors
    ///
    /// [`GpuError::ForeignBuffer`], [`GpuError::Input`] for rows without columns, or what the
    /// device says.
    pub fn row_max<O: GpuPair>(&self, a: &ShapesOf<O>, b: &ShapesOf<O>) -> Result<Bests, GpuError> {
        self.best::<O>(a, b, true)
    }

    /// The largest score of every column and its row; of several the first.
    ///
    /// # Errors
    ///
    /// As [`row_max`](Gpu::row_max), for columns without rows.
    pub fn column_max<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
    ) -> Result<Bests, GpuError> {
        self.best::<O>(a, b, false)
    }

    fn best<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        own_rows: bool,
    ) -> Result<Bests, GpuError> {
        self.owns(&a.gpu)?;
        self.owns(&b.gpu)?;
        crate::kernels::reduce::check_sides(a.len, b.len, own_rows)?;
        let (own, walked) = if own_rows { (a, b) } else { (b, a) };
        let inner = &self.inner;
        let source = Source {
            own_rows,
            ..source_for::<O>(Kernel::Reduce, a, b)
        };
        inner.guarded(|| {
            let pipeline = inner.pair_pipeline::<O>(source, "best_main");
            let gather = Source::of(Kernel::Gather, "any");
            let gather = inner.pair_pipeline::<O>(gather, "best_of_strips_main");
            let values = inner.pieces(own.len, 1);
            let indices = inner.pieces(own.len, 1);
            for sweep in inner.sweeps(own.len, walked.len) {
                let room = sweep.own * sweep.strips();
                let (part_values, part_indices) = (inner.storage(room), inner.storage(room));
                let mut work = Work::new(inner);
                let buffers = [
                    (1, &a.pieces[sweep.piece_of_a(own_rows)].buffer),
                    (2, &b.pieces[sweep.piece_of_b(own_rows)].buffer),
                    (4, &part_values),
                    (7, &part_indices),
                ];
                let size = [groups(sweep.own), sweep.strips() as u32];
                work.dispatch(&pipeline, sweep.params(), &buffers, size);
                let params = Params {
                    more: u32::from(sweep.walked_base > 0),
                    ..sweep.params()
                };
                let buffers = [
                    (3, &part_values),
                    (8, &part_indices),
                    (4, &values[sweep.own_piece].buffer),
                    (7, &indices[sweep.own_piece].buffer),
                ];
                work.dispatch(&gather, params, &buffers, [groups(sweep.own), 1]);
                work.submit()?;
            }
            Ok(Bests {
                gpu: self.clone(),
                values,
                indices,
            })
        })
    }

    /// Every pair whose score is above the threshold, row by row and within a row by column.
    ///
    /// Counted first, then written to places that follow from the counts, so the order is the same
    /// every time.
    ///
    /// # Errors
    ///
    /// [`GpuError::ForeignBuffer`], [`GpuError::Input`] for a threshold that is not a number, or
    /// what the device says.
    pub fn above<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        threshold: f32,
    ) -> Result<Vec<Found>, GpuError> {
        self.owns(&a.gpu)?;
        self.owns(&b.gpu)?;
        crate::kernels::reduce::check_threshold(threshold)?;
        let inner = &self.inner;
        let source = Source {
            own_rows: true,
            ..source_for::<O>(Kernel::Reduce, a, b)
        };
        let mut all: Vec<Found> = Vec::new();
        let columns = b.pieces.len();
        let mut sweeps = inner.sweeps(a.len, b.len);
        sweeps.reverse();
        while let Some(sweep) = sweeps.pop() {
            let counts_len = sweep.own * sweep.strips();
            let params = Params {
                threshold,
                ..sweep.params()
            };
            let size = [groups(sweep.own), sweep.strips() as u32];
            let (a, b) = (
                &a.pieces[sweep.own_piece].buffer,
                &b.pieces[sweep.walked_piece].buffer,
            );
            let (places, total) = inner.guarded(|| {
                let count = inner.pair_pipeline::<O>(source, "count_main");
                let gather = Source::of(Kernel::Gather, "any");
                let place = inner.pair_pipeline::<O>(gather, "places_main");
                let places = inner.storage(counts_len + 1);
                let total = inner.storage(1);
                let mut work = Work::new(inner);
                work.dispatch(&count, params, &[(1, a), (2, b), (7, &places)], size);
                let list = Params {
                    own_count: counts_len as u32,
                    ..Params::default()
                };
                work.dispatch(&place, list, &[(7, &places)], [1, 1]);
                work.copy(&places, 4 * counts_len as u64, &total, 4);
                work.submit()?;
                Ok((places, total))
            })?;
            let mut found = 0;
            inner
                .bring(self, &[(&total, 4)])?
                .finish(|_, numbers| found = numbers[0] as usize)?;
            if found == 0 {
                continue;
            }
            if 12 * found as u64 > inner.most_bytes && sweep.own > 1 {
                let (first, second) = sweep.halves();
                sweeps.extend([second, first]);
                continue;
            }
            let list = inner.guarded(|| {
                let write = inner.pair_pipeline::<O>(source, "write_main");
                let list = inner.storage(3 * found);
                let mut work = Work::new(inner);
                let buffers = [(1, a), (2, b), (4, &list), (7, &places)];
                work.dispatch(&write, params, &buffers, size);
                work.submit()?;
                Ok(list)
            })?;
            inner
                .bring(self, &[(&list, 12 * found as u64)])?
                .finish(|_, numbers| {
                    all.extend(numbers.chunks_exact(3).map(|entry| Found {
                        row: entry[0] as usize,
                        column: entry[1] as usize,
                        value: f32::from_bits(entry[2]),
                    }));
                })?;
        }
        if columns > 1 {
            // Columns came piece by piece.
            all.sort_by_key(|found| (found.row, found.column));
        }
        Ok(all)
    }

    /// How many pairs have a score above the threshold.
    ///
    /// # Errors
    ///
    /// As [`above`](Gpu::above).
    pub fn count_above<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        threshold: f32,
    ) -> Result<u64, GpuError> {
        crate::kernels::reduce::check_threshold(threshold)?;
        let mut count = 0;
        self.totals::<O>(a, b, "count_main", 7, threshold, |numbers| {
            count += numbers.iter().map(|&n| u64::from(n)).sum::<u64>();
        })?;
        Ok(count)
    }

    /// The sum of all scores: what a loss is made of. Up to 1024 scores are added in `f32`, those
    /// sums in `f64`, always in the same order.
    ///
    /// # Errors
    ///
    /// [`GpuError::ForeignBuffer`], or what the device says.
    pub fn sum<O: GpuPair>(&self, a: &ShapesOf<O>, b: &ShapesOf<O>) -> Result<f64, GpuError> {
        let mut sum = 0.0;
        self.totals::<O>(a, b, "sum_main", 4, 0.0, |numbers| {
            sum += numbers
                .iter()
                .map(|&n| f64::from(f32::from_bits(n)))
                .sum::<f64>();
        })?;
        Ok(sum)
    }

    /// The mean of all scores; zero where there are none.
    ///
    /// # Errors
    ///
    /// As [`sum`](Gpu::sum).
    pub fn mean<O: GpuPair>(&self, a: &ShapesOf<O>, b: &ShapesOf<O>) -> Result<f64, GpuError> {
        let count = a.len as f64 * b.len as f64;
        Ok(self.sum::<O>(a, b)? / count.max(1.0))
    }

    /// One number per row and strip, brought back.
    fn totals<O: GpuPair>(
        &self,
        a: &ShapesOf<O>,
        b: &ShapesOf<O>,
        entry: &'static str,
        binding: u32,
        threshold: f32,
        mut each: impl FnMut(&[u32]),
    ) -> Result<(), GpuError> {
        self.owns(&a.gpu)?;
        self.owns(&b.gpu)?;
        let inner = &self.inner;
        let source = Source {
            own_rows: true,
            ..source_for::<O>(Kernel::Reduce, a, b)
        };
        for sweep in inner.sweeps(a.len, b.len) {
            let room = sweep.own * sweep.strips();
            let totals = inner.guarded(|| {
                let pipeline = inner.pair_pipeline::<O>(source, entry);
                let totals = inner.storage(room);
                let mut work = Work::new(inner);
                let buffers = [
                    (1, &a.pieces[sweep.own_piece].buffer),
                    (2, &b.pieces[sweep.walked_piece].buffer),
                    (binding, &totals),
                ];
                let params = Params {
                    threshold,
                    ..sweep.params()
                };
                let size = [groups(sweep.own), sweep.strips() as u32];
                work.dispatch(&pipeline, params, &buffers, size);
                work.submit()?;
                Ok(totals)
            })?;
            inner
                .bring(self, &[(&totals, 4 * room as u64)])?
                .finish(|_, numbers| each(numbers))?;
        }
        Ok(())
    }
}

impl Sweep {
    fn piece_of_a(&self, own_rows: bool) -> usize {
        if own_rows {
            self.own_piece
        } else {
            self.walked_piece
        }
    }
    fn piece_of_b(&self, own_rows: bool) -> usize {
        if own_rows {
            self.walked_piece
        } else {
            self.own_piece
        }
    }
}

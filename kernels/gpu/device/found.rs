//! Reductions to the pairs whose score is above a threshold, as compact lists on the GPU.
use super::context::Device;
use super::download::DevicePending;
use super::download::downloads;
use super::reducer::Reducer;
use super::work::{Commands, Params};
use super::written::{Kernel, Take};
use crate::Error;
use crate::kernels::machine::Downloads;
use crate::kernels::machine::found::Found;

/// Pairs whose score is above a threshold, on the GPU.
#[derive(Clone, Debug)]
pub struct DeviceFounds {
    gpu: Device,
    /// Buffers of triples (row, column, score), with the number of triples.
    lists: Vec<(wgpu::Buffer, usize)>,
    /// `true` if a row's triples are split over pieces of columns.
    is_mixed: bool,
}

impl DeviceFounds {
    /// Starts the download of the pairs, ordered by row and then by column.
    ///
    /// # Errors
    ///
    /// The errors of the device.
    pub fn start_download(&self) -> Result<DevicePending<Vec<Found>>, Error> {
        let len = self.lists.iter().map(|list| list.1).sum();
        let is_mixed = self.is_mixed;
        let lists = self.lists.iter();
        let parts: Vec<_> = lists.map(|(list, n)| (list, BYTES * *n as u64)).collect();
        let arrival = self.gpu.inner.bring(&self.gpu, &parts)?;
        Ok(DevicePending::new(arrival, move |arrival| {
            let mut all = Vec::with_capacity(len);
            arrival.read(|_, numbers| {
                all.extend(numbers.chunks_exact(3).map(|entry| Found {
                    row: entry[0] as usize,
                    column: entry[1] as usize,
                    value: f32::from_bits(entry[2]),
                }));
            })?;
            if is_mixed {
                all.sort_by_key(|found| (found.row, found.column));
            }
            Ok(all)
        }))
    }
}

/// The size of a triple in bytes.
const BYTES: u64 = 12;

impl Downloads<Vec<Found>> for DeviceFounds {
    downloads!(Vec<Found>);
}

impl Reducer<'_> {
    /// Returns every pair above the threshold. A first pass counts, a second writes each pair to an index that follows
    /// from the counts, so the order is deterministic.
    pub fn above(mut self, threshold: f32) -> Result<DeviceFounds, Error> {
        let (gpu, inner) = (self.gpu, &self.gpu.inner);
        let mut all = DeviceFounds {
            gpu: gpu.clone(),
            lists: Vec::new(),
            is_mixed: self.sweeps.iter().any(|sweep| sweep.more),
        };
        self.sweeps.reverse();
        while let Some(sweep) = self.sweeps.pop() {
            let (places, total) = inner.guarded(|| {
                let count = self.pipeline(Take::Count);
                let place = inner.written(Kernel::Gather, "places_main");
                let places = inner.storage(sweep.room() + 1);
                let total = inner.storage(1);
                let mut work = Commands::new(inner);
                let buffers = sweep.buffers(&[(7, &places)]);
                work.dispatch(&count, sweep.params(threshold), &buffers, self.size(&sweep));
                let list = Params {
                    own_count: sweep.room() as u32,
                    ..Params::default()
                };
                work.dispatch(&place, list, &[(7, &places)], [1, 1]);
                work.copy(&places, 4 * sweep.room() as u64, &total, 4);
                work.submit()?;
                Ok((places, total))
            })?;
            let mut found = 0;
            inner
                .bring(gpu, &[(&total, 4)])?
                .finish(|_, numbers| found = numbers[0] as usize)?;
            if found == 0 {
                continue;
            }
            if BYTES * found as u64 > inner.most_bytes && sweep.own > 1 {
                let [first, second] = sweep.halves();
                self.sweeps.extend([second, first]);
                continue;
            }
            let list = inner.guarded(|| {
                let write = self.pipeline(Take::Found);
                let list = inner.storage(3 * found);
                let mut work = Commands::new(inner);
                let buffers = sweep.buffers(&[(4, &list), (7, &places)]);
                work.dispatch(&write, sweep.params(threshold), &buffers, self.size(&sweep));
                work.submit()?;
                Ok(list)
            })?;
            all.lists.push((list, found));
        }
        Ok(all)
    }
}

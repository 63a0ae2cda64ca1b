//! Batches of columns whose fields are separate in memory.
use super::forms::{Function, targets};
use super::rows::Rows;
use crate::Real;
use crate::error::Error;
use crate::kernels::cpu::work::{in_parallel, on_this_thread};
use crate::kernels::machine::count_of;

/// The number of items that are copied to rows at a time, few enough for the cache of a core.
const STRETCH: usize = 1 << 11;

/// A stretch of items, and the memory of its results.
struct Stretch<'a, T> {
    from: usize,
    count: usize,
    results: Vec<Option<&'a mut [T]>>,
    done: &'a mut Result<(), Error>,
}

impl<T: Real> Function<T> {
    /// Computes as [`aligned_into_new`](Function::aligned_into_new), for rows with separate fields: each stretch is
    /// copied to rows once, while it is in the cache.
    pub(super) fn by_stretches(
        &self,
        arguments: &[Rows<'_, T>],
        results: &mut [Option<&mut [T]>],
    ) -> Result<(), Error> {
        let count = self.named(count_of(&self.call()?, &self.listed(arguments)?))?;
        let gives = self.gives();
        targets(&gives, count, results)?;
        let mut done = vec![Ok(()); count.div_ceil(STRETCH)];
        let mut rests: Vec<Option<&mut [T]>> =
            results.iter_mut().map(|own| own.as_deref_mut()).collect();
        let mut work = Vec::with_capacity(done.len());
        for (k, done) in done.iter_mut().enumerate() {
            let from = k * STRETCH;
            let own = STRETCH.min(count - from);
            let mut parts = Vec::with_capacity(gives.len());
            for (rest, fields) in rests.iter_mut().zip(&gives) {
                let parted = rest.take().map(|whole| whole.split_at_mut(own * fields));
                let (part, after) = parted.unzip();
                parts.push(part);
                *rest = after;
            }
            work.push(Stretch {
                from,
                count: own,
                results: parts,
                done,
            });
        }
        in_parallel(work, |stretch: Stretch<'_, T>| {
            let items = stretch.from..stretch.from + stretch.count;
            let mut room: Vec<Vec<T>> = arguments.iter().map(|_| Vec::new()).collect();
            let own = arguments.iter().zip(&mut room);
            let rows: Vec<_> = own
                .map(|(argument, room)| argument.some(items.clone(), room))
                .collect();
            let mut results = stretch.results;
            *stretch.done = on_this_thread(|| self.aligned_into_new(&rows, &mut results));
        });
        let failed = done
            .into_iter()
            .enumerate()
            .find_map(|(k, done)| Some((k, done.err()?)));
        match failed {
            None => Ok(()),
            // The item is counted from the first of all items.
            Some((k, error)) => Err(match error {
                Error::Invalid {
                    argument,
                    item,
                    flaw,
                } => Error::Invalid {
                    argument,
                    item: item + k * STRETCH,
                    flaw,
                },
                other => other,
            }),
        }
    }
}

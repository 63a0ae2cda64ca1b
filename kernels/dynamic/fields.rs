//! Arguments whose fields lie apart in memory, such as the structs of Arrow.
use super::forms::{Function, targets};
use super::rows::Rows;
use crate::error::{Argument, Error};
use crate::kernels::cpu::checked::expect;
use crate::kernels::cpu::work::{on_this_thread, spread};
use crate::kernels::real::Real;

/// Items that are put into rows at a time: few enough that they stay in the cache of a core.
const STRETCH: usize = 1 << 11;

/// One argument of every item: rows, or a slice for every field of its shape.
#[derive(Clone, Copy, Debug)]
pub enum Fields<'a, T> {
    /// Fields one after another, row by row.
    Rows(Rows<'a, T>),
    /// Each field on its own, of all items.
    Apart(&'a [&'a [T]]),
}

impl<T: Real> Fields<'_, T> {
    fn fields(&self) -> usize {
        match self {
            Fields::Rows(rows) => rows.fields(),
            Fields::Apart(fields) => fields.len(),
        }
    }
    /// How many items it has; `None` for one that stands for all.
    fn count(&self, argument: Argument) -> Result<Option<usize>, Error> {
        match self {
            Fields::Rows(rows) => Ok(rows.count()),
            Fields::Apart(fields) => {
                let count = fields.first().map_or(0, |field| field.len());
                let mut lengths = fields.iter().map(|field| field.len());
                lengths.try_for_each(|found| expect(argument, count, found))?;
                Ok(Some(count))
            }
        }
    }
    /// Some items as rows, in the caller's memory where they have to be put together.
    fn rows<'s>(&'s self, items: std::ops::Range<usize>, room: &'s mut Vec<T>) -> Rows<'s, T> {
        match self {
            Fields::Rows(rows) if rows.count().is_none() => *rows,
            Fields::Rows(rows) => {
                let fields = rows.fields();
                Rows::new(
                    &rows.numbers()[items.start * fields..items.end * fields],
                    fields,
                )
            }
            Fields::Apart(fields) => {
                room.resize(items.len() * fields.len(), T::default());
                for (k, field) in fields.iter().enumerate() {
                    let places = room.iter_mut().skip(k).step_by(fields.len());
                    places
                        .zip(&field[items.clone()])
                        .for_each(|(place, &x)| *place = x);
                }
                Rows::new(room, fields.len())
            }
        }
    }
}

/// A stretch of items, and the places of its results.
struct Stretch<'a, T> {
    from: usize,
    count: usize,
    results: Vec<Option<&'a mut [T]>>,
    done: &'a mut Result<(), Error>,
}

impl<T: Real> Function<T> {
    /// [`aligned_into_new`](Function::aligned_into_new) of arguments whose fields may lie apart: stretch by stretch they
    /// become rows, so that no argument is copied as a whole. The same bits as of rows.
    ///
    /// # Errors
    ///
    /// As [`aligned_into`](Function::aligned_into); results may be written then.
    ///
    /// ```
    /// use geograd::kernels::dynamic::{Fields, Rows, operation};
    /// let iou = operation("iou_aabb2").and_then(|iou| iou.value::<f64>()).expect("is listed");
    /// let (low, right, zero) = ([0.0, 1.0], [2.0, 3.0], [0.0, 0.0]);
    /// let boxes = Fields::Apart(&[&low, &zero, &right, &[2.0, 2.0]]);
    /// let mut ious = [0.0; 2];
    /// iou.aligned_fields_into(&[boxes, Fields::Rows(Rows::one(&[0.0, 0.0, 2.0, 2.0]))], &mut [Some(&mut ious)])?;
    /// assert_eq!(ious, [1.0, 1.0 / 3.0]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn aligned_fields_into(
        &self,
        arguments: &[Fields<'_, T>],
        results: &mut [Option<&mut [T]>],
    ) -> Result<(), Error> {
        let takes = self.takes();
        if takes.len() != arguments.len() {
            return Err(Error::Arguments {
                expected: takes.len(),
                found: arguments.len(),
            });
        }
        let mut count = None;
        for (argument, (name, layout)) in arguments.iter().zip(&takes) {
            if argument.fields() != layout.fields() {
                return Err(Error::Fields {
                    argument: *name,
                    expected: layout.fields(),
                    found: argument.fields(),
                });
            }
            match (count, argument.count(*name)?) {
                (Some(expected), Some(found)) => expect(*name, expected, found)?,
                (None, own) => count = own,
                _ => {}
            }
        }
        let (count, gives) = (count.unwrap_or(1), self.gives());
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
        spread(work, |stretch: Stretch<'_, T>| {
            let items = stretch.from..stretch.from + stretch.count;
            let mut room: Vec<Vec<T>> = arguments.iter().map(|_| Vec::new()).collect();
            let own = arguments.iter().zip(&mut room);
            let rows: Vec<_> = own
                .map(|(argument, room)| argument.rows(items.clone(), room))
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
            // Counted from the first item of all.
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

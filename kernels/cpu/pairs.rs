//! Batches of all pairs over plain numbers, for every operation.
use crate::Real;
use crate::kernels::cpu::arch::flat;
use crate::kernels::cpu::blocks::QUAD;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::{BLOCK, Lane, TILE, tiles};
use crate::kernels::cpu::plan::{List, Plan, Shapes};
use crate::kernels::cpu::sweep::{PartColumns, RowChoice, RowPart, Sweep, Upstream};
use crate::kernels::cpu::work::{in_parallel, rows_per_piece};
use std::ops::Range;

/// An operation and both lists as numbers, checked.
pub struct Pairs<'a, T> {
    /// The plan by which a pair is computed.
    pub plan: &'a Plan<T>,
    /// The shapes of both lists.
    pub shapes: [Shapes<'a, T>; 2],
    /// For each list: `true` if some shapes are too extreme for kernels.
    pub rare: [bool; 2],
    /// `true` if pairs that are certainly apart may be left out.
    pub filter: bool,
}

impl<T: Real> Pairs<'_, T> {
    /// Returns the number of shapes of each list.
    pub fn counts(&self) -> [usize; 2] {
        self.shapes.each_ref().map(Shapes::len)
    }
    /// Returns `true` if pairs whose bounds do not meet may be left out.
    pub fn is_filtered(&self) -> bool {
        self.filter && self.plan.arguments.iter().all(|x| x.bounds.is_some())
    }
    /// Turns the filter off if the threshold is negative: a pair that is apart has result zero, which is above it.
    pub fn filter_above(&mut self, threshold: T) {
        self.filter &= threshold >= T::default();
    }
    /// Returns both lists, prepared.
    pub fn lists(&self) -> [List<'_, T>; 2] {
        let bounded = self.is_filtered();
        [0, 1].map(|k| {
            let own = &self.shapes[k];
            let whole = own.part(&(0..own.len()));
            List::new(&self.plan.arguments[k], whole, self.rare[k], bounded)
        })
    }
    /// Computes all pairs on all threads, in pieces of some rows, each with its own entry of `work`. Returns `true` if
    /// a filter was used, even if it left out no pair.
    pub fn sweep<W: Send>(
        &self,
        upstream: Option<Upstream<'_, T>>,
        work: Vec<W>,
        run: impl Fn(&Sweep<'_, T>, Range<usize>, W) + Send + Sync,
    ) -> bool {
        let [rows, _] = self.counts();
        let [a, b] = self.lists();
        let sweep = Sweep::new(self.plan, upstream, &a, &b);
        let piece = rows_per_piece(rows);
        let work = work.into_iter().enumerate().collect();
        in_parallel(work, |(i, work): (usize, W)| {
            run(&sweep, i * piece..rows.min((i + 1) * piece), work);
        });
        sweep.is_filtered()
    }
    /// Computes the rows that `choice` asks for, on this thread.
    pub fn chosen(&self, choice: &mut impl RowChoice<T>) {
        let [a, b] = self.lists();
        Sweep::new(self.plan, None, &a, &b).run_chosen(choice);
    }
}

/// Writes the results of a row into the row of every field. `room` is a buffer that is kept from call to call.
///
/// Picked results are put together in the cache before they leave in long runs: single stores would
/// wait for memory one by one.
fn put<T: Real>(part: &RowPart<'_, T>, room: &mut Vec<T>, rows: &mut [&mut [T]]) {
    let (first, width) = (part.stretch.start, part.stretch.len());
    match &part.columns {
        PartColumns::Run(run) => {
            for (k, row) in rows.iter_mut().enumerate() {
                let results = flat(part.results.field(k));
                row[run.clone()].copy_from_slice(&results[..width]);
            }
        }
        PartColumns::Picked(columns) if width <= BLOCK * TILE => {
            if let [row] = rows {
                let row = &mut row[part.stretch.clone()];
                row.fill(T::default());
                return (kernels_in::<T>().scatter)(part.results, columns, first, row, width);
            }
            room.clear();
            room.resize(rows.len() * width, T::default());
            (kernels_in::<T>().scatter)(part.results, columns, first, room, width);
            for (room, row) in room.chunks_exact(width).zip(rows) {
                row[part.stretch.clone()].copy_from_slice(room);
            }
        }
        // A stretch longer than a block, from a tree, has few results: they are stored one by one.
        PartColumns::Picked(columns) => {
            for (k, row) in rows.iter_mut().enumerate() {
                if part.is_first {
                    row.fill(T::default());
                }
                for (&j, &x) in columns.iter().zip(flat(part.results.field(k))) {
                    row[j as usize] = x;
                }
            }
        }
    }
}

/// Writes results, or results with derivatives: one row-major matrix per scalar, one after another.
pub fn planes<T: Real>(pairs: &Pairs<'_, T>, planes: &mut [T]) {
    let [rows, columns] = pairs.counts();
    if rows * columns == 0 {
        return;
    }
    let piece = rows_per_piece(rows) * columns;
    // Every piece takes its rows of every matrix.
    let mut work: Vec<Vec<&mut [T]>> = Vec::new();
    work.resize_with(rows.div_ceil(rows_per_piece(rows)), Vec::new);
    for plane in planes.chunks_mut(rows * columns) {
        for (work, part) in work.iter_mut().zip(plane.chunks_mut(piece)) {
            work.push(part);
        }
    }
    pairs.sweep(None, work, |sweep, rows, mut planes: Vec<&mut [T]>| {
        let (start, mut room) = (rows.start, Vec::new());
        if let [matrix] = &mut planes[..] {
            return sweep.run(rows, |part| {
                let row = &mut matrix[(part.row - start) * columns..][..columns];
                put(&part, &mut room, &mut [row]);
            });
        }
        sweep.run(rows, |part| {
            let at = (part.row - start) * columns;
            let rows = planes.iter_mut().map(|plane| &mut plane[at..][..columns]);
            put(&part, &mut room, &mut rows.collect::<Vec<_>>());
        });
    });
}

/// The layout of sums of derivatives in lanes. A filtered sweep with an upstream yields picked columns alone, any other
/// one runs alone: each has its own layout.
#[derive(Clone, Copy)]
enum SumLayout {
    /// In tiles, field by field.
    Tiles,
    /// Item by item: the numbers of an item contiguous, padded to a multiple of four, so that single items can be added
    /// to.
    Items,
}

impl SumLayout {
    fn of(filtered: bool) -> Self {
        match filtered {
            true => SumLayout::Items,
            false => SumLayout::Tiles,
        }
    }
    /// Returns number `k` of an item that has `fields` numbers.
    #[inline]
    fn number<T: Copy>(self, lanes: &[Lane<T>], fields: usize, item: usize, k: usize) -> T {
        match self {
            SumLayout::Tiles => lanes[item / TILE * fields + k].0[item % TILE],
            SumLayout::Items => flat(lanes)[item * fields.next_multiple_of(QUAD) + k],
        }
    }
}

/// Returns the sum of sixteen numbers by pairwise halving.
#[inline]
fn folded<T: Real>(mut numbers: [T; TILE]) -> T {
    let mut half = TILE / 2;
    while half > 0 {
        for i in 0..half {
            let other = numbers[i + half];
            numbers[i] += other;
        }
        half /= 2;
    }
    numbers[0].canonical()
}

/// Writes the derivatives of the sum of upstream times scores, with respect to every shape of both lists.
///
/// A row has sixteen sums; column `j` is added to sum `j` modulo sixteen. A column has one sum per piece of rows. Both
/// layouts add in one fixed order.
pub fn pull_back<T: Real>(
    pairs: &Pairs<'_, T>,
    upstream: Upstream<'_, T>,
    a_bar: &mut [T],
    b_bar: &mut [T],
) {
    let [rows, columns] = pairs.counts();
    if rows * columns == 0 {
        a_bar.fill(T::default());
        b_bar.fill(T::default());
        return;
    }
    let fields = [0, 1].map(|k| pairs.plan.arguments[k].fields);
    // Both layouts fit.
    let [wide, width] = fields.map(|n| n.next_multiple_of(QUAD));
    let width = tiles(columns) * width;
    let piece = rows_per_piece(rows);
    let mut partials = vec![Lane::default(); rows.div_ceil(piece) * width];
    let work = a_bar
        .chunks_mut(piece * fields[0])
        .zip(partials.chunks_mut(width))
        .collect();
    type Work<'a, T> = (&'a mut [T], &'a mut [Lane<T>]);
    let filtered = pairs.sweep(
        Some(upstream),
        work,
        |sweep, rows, (a_bar, column_sums): Work<'_, T>| {
            let start = rows.start;
            let mut row_sums = vec![Lane::default(); rows.len() * wide];
            sweep.run(rows, |part| {
                let row_sums = &mut row_sums[(part.row - start) * wide..][..wide];
                match part.columns {
                    PartColumns::Run(run) => {
                        let sums = &mut column_sums[run.start / TILE * fields[1]..];
                        (kernels_in::<T>().accumulate)(
                            part.results,
                            fields,
                            run.len(),
                            row_sums,
                            sums,
                        );
                    }
                    PartColumns::Picked(columns) => {
                        let add = kernels_in::<T>().accumulate_picked;
                        add(part.results, fields, columns, row_sums, column_sums);
                    }
                }
            });
            let lay = SumLayout::of(sweep.is_filtered());
            let bars = a_bar.chunks_exact_mut(fields[0]);
            for (bar, sums) in bars.zip(row_sums.chunks_exact(wide)) {
                for (k, x) in bar.iter_mut().enumerate() {
                    let sums = |i| lay.number(sums, fields[0], i, k);
                    *x = folded(std::array::from_fn(sums));
                }
            }
        },
    );
    // Adding piece after piece fixes the order of the sum.
    let (total, others) = partials.split_at_mut(width);
    for partial in others.chunks(width) {
        for (sum, part) in total.iter_mut().zip(partial) {
            for (x, &part) in sum.0.iter_mut().zip(&part.0) {
                *x += part;
            }
        }
    }
    let lay = SumLayout::of(filtered);
    for (j, bar) in b_bar.chunks_exact_mut(fields[1]).enumerate() {
        for (k, x) in bar.iter_mut().enumerate() {
            *x = lay.number(total, fields[1], j, k).canonical();
        }
    }
}

//! Batches of all pairs over plain numbers: the same code for every operation.
use crate::kernels::cpu::blocks::QUAD;
use crate::kernels::cpu::lane::{Lane, TILE};
use crate::kernels::cpu::plan::{List, Plan};
use crate::kernels::cpu::sweep::{BLOCK, Form, Part, Sweep};
use crate::kernels::cpu::work::{rows_per_piece, spread};
use crate::kernels::real::Real;
use std::borrow::Cow;
use std::ops::Range;

/// An operation and both lists as numbers, checked.
pub struct Pairs<'a, T: Clone + 'static> {
    /// How it is computed.
    pub plan: Plan<T>,
    /// The shapes of both lists.
    pub numbers: [Cow<'a, [T]>; 2],
    /// Whether some are too rare for kernels.
    pub rare: [bool; 2],
    /// Whether pairs that are apart for certain may be left out.
    pub filter: bool,
}

impl<T: Real> Pairs<'_, T> {
    /// How many shapes each list has.
    pub fn counts(&self) -> [usize; 2] {
        [0, 1].map(|k| self.numbers[k].len() / self.plan.shapes[k].fields)
    }
    fn lists(&self) -> [List<'_, T>; 2] {
        let bounded = self.filter && self.plan.shapes.iter().all(|x| x.bounds.is_some());
        [0, 1].map(|k| {
            List::new(
                &self.plan.shapes[k],
                &self.numbers[k],
                self.rare[k],
                bounded,
            )
        })
    }
    /// Computes all pairs piece by piece, on all threads: each piece is some rows and what `work`
    /// has for it.
    pub fn sweep<W: Send>(
        &self,
        form: Form,
        work: Vec<W>,
        run: impl Fn(&Sweep<'_, T>, Range<usize>, W) + Send + Sync,
    ) {
        let [rows, _] = self.counts();
        let [a, b] = self.lists();
        let sweep = Sweep::new(&self.plan, form, &a, &b);
        let piece = rows_per_piece(rows);
        let work = work.into_iter().enumerate().collect();
        spread(work, |(i, work): (usize, W)| {
            run(&sweep, i * piece..rows.min((i + 1) * piece), work);
        });
    }
}

/// Copies one field of results to numbers side by side.
#[inline]
pub fn copy_field<T: Real>(results: &[Lane<T>], fields: usize, field: usize, to: &mut [T]) {
    for (to, tile) in to.chunks_mut(TILE).zip(results.chunks(fields)) {
        match to.first_chunk_mut() {
            Some(whole) => *whole = tile[field].0,
            None => to.copy_from_slice(&tile[field].0[..to.len()]),
        }
    }
}

/// Puts one field of a row's results into the row.
#[inline]
pub fn put<T: Real>(part: &Part<'_, T>, fields: usize, field: usize, row: &mut [T]) {
    let (columns, results, stretch) = match part {
        Part::Run {
            first,
            count,
            results,
        } => {
            return copy_field(results, fields, field, &mut row[*first..][..*count]);
        }
        Part::Picked {
            stretch,
            columns,
            results,
        } => (columns, results, stretch.clone()),
    };
    let scatter = |to: &mut [T], first: usize| {
        for (columns, tile) in columns.chunks(TILE).zip(results.chunks_exact(fields)) {
            for (&j, &x) in columns.iter().zip(&tile[field].0) {
                if let Some(place) = to.get_mut(j as usize - first) {
                    *place = x;
                }
            }
        }
    };
    if stretch.len() > BLOCK * TILE {
        row[stretch].fill(T::default());
        scatter(row, 0);
    } else if !stretch.is_empty() {
        // Put together in the cache: single stores would wait for memory one by one.
        let mut room = [T::default(); BLOCK * TILE];
        scatter(&mut room, stretch.start);
        row[stretch.clone()].copy_from_slice(&room[..stretch.len()]);
    } else {
        scatter(row, 0);
    }
}

/// Scores, row by row.
pub fn values<T: Real>(pairs: &Pairs<'_, T>, values: &mut [T]) {
    let [rows, columns] = pairs.counts();
    if rows * columns == 0 {
        return;
    }
    let work = values.chunks_mut(rows_per_piece(rows) * columns).collect();
    pairs.sweep(Form::Values, work, |sweep, rows, values: &mut [T]| {
        let start = rows.start;
        sweep.run(rows, |row, part| {
            put(
                &part,
                1,
                0,
                &mut values[(row - start) * columns..][..columns],
            );
        });
    });
}

/// Scores, row by row, and one such matrix per slope.
pub fn grads<T: Real>(pairs: &Pairs<'_, T>, values: &mut [T], planes: &mut [T]) {
    let [rows, columns] = pairs.counts();
    if rows * columns == 0 {
        return;
    }
    let fields = pairs.plan.slope_fields();
    let piece = rows_per_piece(rows) * columns;
    // Every piece gets its rows of every matrix.
    let mut work: Vec<Vec<&mut [T]>> = values.chunks_mut(piece).map(|part| vec![part]).collect();
    for plane in planes.chunks_mut(rows * columns) {
        for (work, part) in work.iter_mut().zip(plane.chunks_mut(piece)) {
            work.push(part);
        }
    }
    pairs.sweep(
        Form::Slopes,
        work,
        |sweep, rows, mut planes: Vec<&mut [T]>| {
            let start = rows.start;
            sweep.run(rows, |row, part| {
                for (field, plane) in planes.iter_mut().enumerate() {
                    let row = &mut plane[(row - start) * columns..][..columns];
                    put(&part, fields, field, row);
                }
            });
        },
    );
}

/// An upstream matrix: row `i` starts at `i * step`. With a step of zero all rows are the same one.
#[derive(Clone, Copy)]
pub struct Upstream<'a, T> {
    /// The numbers.
    pub slopes: &'a [T],
    /// From row to row.
    pub step: usize,
}

/// Slopes of the sum of upstream times scores, with respect to every shape of both lists.
///
/// Of a row sixteen sums are kept, column `j` counts for sum `j` modulo sixteen; of a column one per
/// piece of rows. All are added in a fixed order. Where pairs are left out sums lie item by item in
/// memory, for a few columns at a time; otherwise field by field.
pub fn pull_back<T: Real>(
    pairs: &Pairs<'_, T>,
    upstream: Upstream<'_, T>,
    a_bar: &mut [T],
    b_bar: &mut [T],
) {
    let [rows, columns] = pairs.counts();
    a_bar.fill(T::default());
    b_bar.fill(T::default());
    if rows * columns == 0 {
        return;
    }
    let fields = [0, 1].map(|k| pairs.plan.shapes[k].fields);
    let strides = fields.map(|n| n.next_multiple_of(QUAD));
    // Room for either way of lying.
    let width = columns.next_multiple_of(TILE) * strides[1];
    let piece = rows_per_piece(rows);
    let mut partials = vec![T::default(); rows.div_ceil(piece) * columns * fields[1]];
    let work = a_bar
        .chunks_mut(piece * fields[0])
        .zip(partials.chunks_mut(columns * fields[1]))
        .collect();
    type Work<'a, T> = (&'a mut [T], &'a mut [T]);
    pairs.sweep(
        Form::Sums,
        work,
        |sweep, rows, (a_bar, b_bar): Work<'_, T>| {
            let start = rows.start;
            let mut row_sums = vec![Lane::default(); rows.len() * strides[0]];
            let mut column_sums = vec![Lane::default(); width / TILE];
            sweep.run(rows, |row, part| {
                let row_sums = &mut row_sums[(row - start) * strides[0]..][..strides[0]];
                let upstream = &upstream.slopes[row * upstream.step..][..columns];
                match part {
                    Part::Run {
                        first,
                        count,
                        results,
                    } => {
                        let sums = &mut column_sums[first / TILE * fields[1]..];
                        let upstream = &upstream[first..][..count];
                        (T::kernels().accumulate)(results, fields, upstream, row_sums, sums);
                    }
                    Part::Picked {
                        columns, results, ..
                    } => {
                        let add = T::kernels().accumulate_picked;
                        add(
                            results,
                            fields,
                            columns,
                            upstream,
                            row_sums,
                            &mut column_sums,
                        );
                    }
                }
            });
            // Where the sums of field k of an item lie.
            let place =
                |stride: usize, fields: usize, item: usize, k: usize| match sweep.is_filtered() {
                    true => item * stride + k,
                    false => (item / TILE * fields + k) * TILE + item % TILE,
                };
            let number = |lanes: &[Lane<T>], at: usize| lanes[at / TILE].0[at % TILE];
            for (bar, sums) in a_bar
                .chunks_exact_mut(fields[0])
                .zip(row_sums.chunks_exact(strides[0]))
            {
                for (k, x) in bar.iter_mut().enumerate() {
                    let sum = (0..TILE).fold(T::default(), |sum, i| {
                        sum + number(sums, place(strides[0], fields[0], i, k))
                    });
                    *x = sum.canonical();
                }
            }
            for (j, bar) in b_bar.chunks_exact_mut(fields[1]).enumerate() {
                for (k, x) in bar.iter_mut().enumerate() {
                    *x = number(&column_sums, place(strides[1], fields[1], j, k));
                }
            }
        },
    );
    // Piece after piece, so the order of the sum is fixed.
    for partial in partials.chunks(columns * fields[1]) {
        for (x, &part) in b_bar.iter_mut().zip(partial) {
            *x += part;
        }
    }
    for x in b_bar {
        *x = x.canonical();
    }
}

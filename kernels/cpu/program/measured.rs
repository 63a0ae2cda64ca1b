//! Programs in batches, for tests and measurements: from rows of numbers to rows of numbers, on one thread.
use crate::ad::program::Program;
use crate::ad::program::recorded::Recorded;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::{BLOCK, Lane, Planes, ResultTiles, TILE, Tiles, planes, tiles};
use crate::kernels::cpu::maker::{Maker, OverRows};
use crate::kernels::cpu::program::rowwise::{ArgumentRows, ResultRows};
use crate::kernels::cpu::program::split::{Subgraph, split};
use crate::kernels::cpu::program::{Interpreter, Skipping};
use crate::{Real, Unrecordable};

/// Options of a program's execution. They do not change the bits of results.
#[derive(Clone, Copy, Debug, Default)]
pub struct Execution {
    /// `true` to compute numbers that depend on one argument once per item of that argument, beforehand.
    pub frames: bool,
    /// The condition under which blocks skip nodes.
    pub skipping: Skipping,
    /// The number of lanes of a slot; `None` for the usual one.
    pub width: Option<usize>,
    /// `true` to use machine code from the first item on.
    pub native: bool,
}

/// Sets the number of tiles, of sixteen items each, after which programs become machine code.
pub fn compile_after(tiles: usize) {
    super::compile_after(tiles);
}

/// A recorded function.
#[derive(Clone, Debug)]
pub struct Trial(Recorded);

impl Trial {
    /// Creates it from the recording of a program.
    #[must_use]
    pub fn of<In, Out>(program: &Program<In, Out>) -> Trial {
        Trial(program.recorded().clone())
    }
    /// Returns the results for one input, node by node.
    #[must_use]
    pub fn run<T: Real>(&self, inputs: &[T]) -> Vec<T> {
        self.0.run(inputs)
    }
    /// Prepares it for batches. `fields` is the number of scalars of each argument.
    ///
    /// # Errors
    ///
    /// If it has too many instructions, or too many numbers live at a time.
    pub fn ready(&self, fields: &[usize], execution: Execution) -> Result<Ready, Unrecordable> {
        let value = &self.0.value;
        let made = |piece: &Subgraph, fields: &[usize], skipping| {
            let made = Interpreter::new(&piece.graph, fields, &piece.outputs, skipping)?;
            let made = made.with_native(execution.native);
            Ok(match execution.width {
                Some(width) => made.with_width(width),
                None => made,
            })
        };
        let whole = Subgraph {
            graph: value.graph.clone(),
            outputs: value.outputs.clone(),
        };
        if !execution.frames {
            return Ok(Ready {
                fields: fields.to_vec(),
                frames: None,
                body: made(&whole, fields, execution.skipping)?,
                results: whole.outputs.len(),
            });
        }
        let parts = split(&whole.graph, fields, fields.len(), &whole.outputs, |_| true);
        let widths = parts.widths;
        let frames =
            parts
                .frames
                .iter()
                .zip(fields)
                .zip(&widths)
                .map(|((frame, &fields), &width)| {
                    Ok((made(frame, &[fields], Skipping::Never)?, width))
                });
        Ok(Ready {
            fields: fields.to_vec(),
            frames: Some(frames.collect::<Result<_, Unrecordable>>()?),
            body: made(&parts.body, &widths, execution.skipping)?,
            results: whole.outputs.len(),
        })
    }
}

/// A program ready for batches.
#[derive(Debug)]
pub struct Ready {
    fields: Vec<usize>,
    frames: Option<Vec<(Interpreter, usize)>>,
    body: Interpreter,
    results: usize,
}

/// Items of an argument, ready to be computed from.
#[derive(Debug)]
pub struct Prepared<T> {
    lanes: Vec<Lane<T>>,
    fields: usize,
}

impl Ready {
    /// Returns the numbers of instructions and of slots, without frames.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        self.body.size()
    }
    /// Returns the instructions, one per line.
    #[must_use]
    pub fn listing(&self) -> String {
        let lines = self.body.tape().code.iter();
        lines
            .map(|code| format!("{:?} {:?} <- {:?}\n", code.op, code.to, code.from))
            .collect()
    }
    /// Returns the items of an argument from rows of numbers, with frames if there are any.
    #[must_use]
    pub fn items<T: Real>(&self, argument: usize, rows: &[T]) -> Prepared<T> {
        let fields = self.fields[argument];
        let count = tiles(rows.len() / fields);
        let mut lanes = vec![Lane::default(); count * fields];
        (kernels_in::<T>().bring)(rows, fields, &mut lanes);
        let Some((frame, width)) = self.frames.as_ref().map(|frames| &frames[argument]) else {
            return Prepared { lanes, fields };
        };
        let mut made = vec![Lane::default(); count * width];
        frame.prepare(&[Tiles::new(&lanes, fields)], &mut made);
        Prepared {
            lanes: made,
            fields: *width,
        }
    }
    /// Returns the results of `count` items, field by field; an argument of one tile stands for all.
    #[must_use]
    pub fn compute<T: Real>(&self, count: usize, items: &[Prepared<T>]) -> Vec<T> {
        let mut rows = vec![T::default(); count * self.results];
        let mut lanes = vec![Lane::default(); planes(self.results)];
        for (block, rows) in rows.chunks_mut(BLOCK * TILE * self.results).enumerate() {
            let from = |items| Prepared::from(items, block * BLOCK);
            let inputs: Vec<Tiles<'_, T>> = items.iter().map(from).collect();
            self.make(&inputs, &mut lanes, tiles(rows.len() / self.results));
            (kernels_in::<T>().take)(Planes(&lanes), self.results, rows, self.results);
        }
        rows
    }
    /// Returns the results of `count` items, from one column of numbers per argument; a column of one number stands for
    /// all. The program has no frames, and its arguments have one number each.
    #[must_use]
    pub fn columns<T: Real>(&self, count: usize, columns: &[&[T]]) -> Vec<Vec<T>> {
        let mut given = Vec::new();
        for &rows in columns {
            given.push(ArgumentRows {
                rows,
                fields: 1,
                is_one: rows.len() < count,
            });
        }
        // Results of users' programs may begin at any address, too.
        let mut all = vec![vec![T::default(); count + 1]; self.results];
        let mut wanted: Vec<ResultRows<'_, T>> =
            all.iter_mut().map(|x| (Some(&mut x[1..]), 1)).collect();
        self.body.over_rows(&given, count, 0, &mut wanted, false);
        all.iter_mut().for_each(|x| x.rotate_left(1));
        all.iter_mut().for_each(|x| x.truncate(count));
        all
    }
    /// Computes the items `times` times, for measurements.
    pub fn repeat<T: Real>(&self, items: &[Prepared<T>], times: usize) {
        let mut lanes = vec![Lane::default(); planes(self.results)];
        let inputs: Vec<Tiles<'_, T>> = items.iter().map(|x| Prepared::from(x, 0)).collect();
        for _ in 0..times {
            self.make(&inputs, &mut lanes, BLOCK);
        }
    }
    fn make<T: Real>(&self, inputs: &[Tiles<'_, T>], lanes: &mut [Lane<T>], tiles: usize) {
        self.body.make(inputs, ResultTiles { lanes, tiles });
    }
}

impl<T: Real> Prepared<T> {
    /// Returns the tiles from number `tile` on.
    fn from(&self, tile: usize) -> Tiles<'_, T> {
        match self.lanes.len() == self.fields {
            true => Tiles::one(&self.lanes),
            false => Tiles::new(&self.lanes[tile * self.fields..], self.fields),
        }
    }
}

//! Programs in batches, for tests and measurements: rows of numbers in, rows of numbers out, on one thread.
use crate::ad::program::Program;
use crate::ad::program::recorded::Recorded;
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::{BLOCK, Lane, Planes, Results, TILE, Tiles, planes, tiles};
use crate::kernels::cpu::maker::{Maker, OverRows};
use crate::kernels::cpu::program::rowwise::{Given, Wanted};
use crate::kernels::cpu::program::split::{Piece, split};
use crate::kernels::cpu::program::{Interpreted, Skipping};
use crate::{Real, Unrecordable};

/// How a program is carried out. Results are the same bits any way.
#[derive(Clone, Copy, Debug, Default)]
pub struct Way {
    /// `true` if what depends on one argument alone is computed before, once per item.
    pub frames: bool,
    /// When blocks leave out what they do not need.
    pub skipping: Skipping,
    /// Lanes of a slot, if not as usual.
    pub width: Option<usize>,
    /// `true` for machine code, from the first item on.
    pub native: bool,
}

/// Sets after how many tiles of sixteen items programs become machine code.
pub fn compile_after(tiles: usize) {
    super::compile_after(tiles);
}

/// A recorded function.
#[derive(Clone, Debug)]
pub struct Trial(Recorded);

impl Trial {
    /// Takes the recording of a program.
    #[must_use]
    pub fn of<In, Out>(program: &Program<In, Out>) -> Trial {
        Trial(program.recorded().clone())
    }
    /// Returns the results for one input, node by node.
    #[must_use]
    pub fn run<T: Real>(&self, inputs: &[T]) -> Vec<T> {
        self.0.run(inputs)
    }
    /// Makes it ready for batches. `fields` says how many numbers each argument has.
    ///
    /// # Errors
    ///
    /// If it has too many instructions, or numbers at a time.
    pub fn ready(&self, fields: &[usize], way: Way) -> Result<Ready, Unrecordable> {
        let value = &self.0.value;
        let made = |piece: &Piece, fields: &[usize], skipping| {
            let made = Interpreted::new(&piece.graph, fields, &piece.outputs, skipping)?;
            let made = made.with_native(way.native);
            Ok(match way.width {
                Some(width) => made.with_width(width),
                None => made,
            })
        };
        let whole = Piece {
            graph: value.graph.clone(),
            outputs: value.outputs.clone(),
        };
        if !way.frames {
            return Ok(Ready {
                fields: fields.to_vec(),
                frames: None,
                body: made(&whole, fields, way.skipping)?,
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
            body: made(&parts.body, &widths, way.skipping)?,
            results: whole.outputs.len(),
        })
    }
}

/// A program ready for batches.
#[derive(Debug)]
pub struct Ready {
    fields: Vec<usize>,
    frames: Option<Vec<(Interpreted, usize)>>,
    body: Interpreted,
    results: usize,
}

/// Items of an argument, ready to be computed from.
#[derive(Debug)]
pub struct Prepared<T> {
    lanes: Vec<Lane<T>>,
    fields: usize,
}

impl Ready {
    /// Returns how many instructions and slots it has, without those of frames.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        self.body.size()
    }
    /// Returns the instructions, one to a line.
    #[must_use]
    pub fn listing(&self) -> String {
        let lines = self.body.tape().code.iter();
        lines
            .map(|code| format!("{:?} {:?} <- {:?}\n", code.op, code.to, code.from))
            .collect()
    }
    /// Items of an argument, from rows of numbers; their frames, where there are frames.
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
    /// Results of so many items, number by number in rows; an argument of one tile stands for all.
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
    /// Results of so many items, from columns of numbers and a column for each; a column of one number stands for all.
    /// The program has no frames, and arguments of one number.
    #[must_use]
    pub fn columns<T: Real>(&self, count: usize, columns: &[&[T]]) -> Vec<Vec<T>> {
        let mut given = Vec::new();
        for &rows in columns {
            given.push(Given {
                rows,
                fields: 1,
                is_one: rows.len() < count,
            });
        }
        // Columns of other programs begin anywhere, too.
        let mut all = vec![vec![T::default(); count + 1]; self.results];
        let mut wanted: Vec<Wanted<'_, T>> =
            all.iter_mut().map(|x| (Some(&mut x[1..]), 1)).collect();
        self.body.over_rows(&given, count, 0, &mut wanted, false);
        all.iter_mut().for_each(|x| x.rotate_left(1));
        all.iter_mut().for_each(|x| x.truncate(count));
        all
    }
    /// Computes items over and over, for measuring.
    pub fn repeat<T: Real>(&self, items: &[Prepared<T>], times: usize) {
        let mut lanes = vec![Lane::default(); planes(self.results)];
        let inputs: Vec<Tiles<'_, T>> = items.iter().map(|x| Prepared::from(x, 0)).collect();
        for _ in 0..times {
            self.make(&inputs, &mut lanes, BLOCK);
        }
    }
    fn make<T: Real>(&self, inputs: &[Tiles<'_, T>], lanes: &mut [Lane<T>], tiles: usize) {
        self.body.make(inputs, Results { lanes, tiles });
    }
}

impl<T: Real> Prepared<T> {
    /// From a tile on.
    fn from(&self, tile: usize) -> Tiles<'_, T> {
        match self.lanes.len() == self.fields {
            true => Tiles::one(&self.lanes),
            false => Tiles::new(&self.lanes[tile * self.fields..], self.fields),
        }
    }
}

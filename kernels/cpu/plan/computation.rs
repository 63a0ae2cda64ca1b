//! A plan: the preparation of shapes, alone and in lists, and the maker of blocks of results.
use crate::Real;
use crate::error::{Argument, Flaw};
use crate::kernels::cpu::formats::kernels_in;
use crate::kernels::cpu::lane::{Lane, LaneBuffer, TILE, Tiles};
use crate::kernels::cpu::maker::Maker;
use crate::kernels::cpu::overlaps::BOUNDS;
use crate::kernels::machine::Column;
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::item::{Leaf, Quick, STRETCH};
use std::ops::Range;
use std::sync::Arc;

/// A function from shapes in tiles to numbers in tiles.
pub type Prepare<T> = Arc<dyn Fn(Tiles<'_, T>, &mut [Lane<T>]) + Send + Sync>;

/// A function from shapes and prepared shapes to their bounds, all in tiles.
pub type Outline<T> = Arc<dyn Fn([Tiles<'_, T>; 2], &mut [Lane<T>]) + Send + Sync>;

/// The preparation of every shape of a column.
#[derive(Clone)]
pub struct Preparation<T> {
    /// The operation's name of the argument, if it has one.
    pub name: Option<&'static str>,
    /// The number of scalars of a shape.
    pub fields: usize,
    /// The number of scalars of a prepared shape, and the preparation; `None` if shapes are used as they are.
    pub frame: Option<(usize, Prepare<T>)>,
    /// The bounds of shapes in the plane; `None` where pairs that are apart have nonzero results.
    pub bounds: Option<Outline<T>>,
    /// A quick test of shapes, if there is one: `true` only if all are valid and of ordinary size. It may reject some that
    /// are.
    pub all_ordinary: Option<fn(&[T]) -> bool>,
    /// The flaw of a shape that is not valid.
    pub check: fn(&[T]) -> Result<(), Flaw>,
    /// `true` if a valid shape is too rare for kernels.
    pub is_rare: fn(&[T]) -> bool,
}

impl<T> Preparation<T> {
    /// Returns the number of scalars of a prepared shape.
    pub fn frame_fields(&self) -> usize {
        self.frame.as_ref().map_or(self.fields, |frame| frame.0)
    }
    /// Returns `true` if a quick test finds all of some shapes valid and of ordinary size.
    pub fn are_ordinary(&self, numbers: &[T]) -> bool {
        self.all_ordinary.is_some_and(|test| test(numbers))
    }
    /// Returns the name that errors have for this argument, number `k` of the operation's.
    pub fn argument(&self, k: usize) -> Argument {
        self.name.map_or(Argument::input(k), Argument::named)
    }
}

impl<T: Real> Preparation<T> {
    /// Returns the preparation of a shape that is used as it is.
    pub fn plain(leaf: Leaf<T>) -> Self {
        Preparation {
            name: None,
            fields: leaf.fields,
            frame: None,
            bounds: None,
            all_ordinary: quick(leaf.quick),
            check: leaf.check,
            is_rare: |_| false,
        }
    }
}

/// Returns the kernel of a quick test.
fn quick<T: Real>(test: Quick) -> Option<fn(&[T]) -> bool> {
    Some(match test {
        Quick::Never => return None,
        Quick::Always => |_| true,
        Quick::Finite => |x| (kernels_in::<T>().all_finite)(x),
        Quick::Aabb2 => |x| (kernels_in::<T>().all_aabb2)(x),
        Quick::Obb2 => |x| (kernels_in::<T>().all_ordinary_obb2)(x),
        Quick::Upright => |x| (kernels_in::<T>().all_common_upright)(x),
        Quick::Obb3 => |x| (kernels_in::<T>().all_common_obb3)(x),
        Quick::Quads => |x| (kernels_in::<T>().all_convex_quads)(x),
    })
}

/// Sets the names that an operation has for its arguments, if it has one for each.
pub(crate) fn name<T>(arguments: &mut [Preparation<T>], names: &[&'static str]) {
    if arguments.len() == names.len() {
        for (argument, &name) in arguments.iter_mut().zip(names) {
            argument.name = Some(name);
        }
    }
}

/// The scalar code for an item beyond the kernels' range: the numbers of its shapes, the cotangents of its result, and
/// a buffer for the result, with derivatives if wanted.
pub type Rare<T> = Box<dyn Fn(&[&[T]], &[T], &mut [T]) + Send + Sync>;

/// The computation of an operation in batches.
pub struct Plan<T> {
    /// One preparation per argument.
    pub(crate) arguments: Vec<Preparation<T>>,
    /// The number of scalars of every shape in a result.
    pub(crate) gives: Vec<usize>,
    /// The number of scalars of the maker's output that come before the result.
    pub(crate) skipped: usize,
    /// The computation of results from prepared shapes.
    pub(crate) maker: Box<dyn Maker<T>>,
    /// The steepest cotangent that the maker takes.
    pub(crate) steepest: f64,
    /// The scalar code of shapes, or of cotangents, beyond the maker's range.
    pub(crate) rare: Option<Rare<T>>,
}

impl<T> Plan<T> {
    /// Returns the number of scalars that the maker writes per item.
    pub(crate) fn made(&self) -> usize {
        self.skipped + self.gives.iter().sum::<usize>()
    }
    /// Returns the plan of an operation from its arguments and outputs. In the maker's output the value comes before
    /// its derivatives.
    pub(super) fn new(
        mode: Mode,
        arguments: Vec<Preparation<T>>,
        outputs: Vec<usize>,
        maker: Box<dyn Maker<T>>,
    ) -> Self {
        let derivatives: Vec<usize> = arguments.iter().map(|x| x.fields).collect();
        let skipped = mode.skipped(&outputs);
        let gives = mode.gives(&derivatives, &outputs);
        Plan {
            arguments,
            gives,
            skipped,
            maker,
            steepest: f64::INFINITY,
            rare: None,
        }
    }
}

/// A range of shapes of a column, read in place.
pub struct Shapes<'a, T> {
    column: &'a Column<'a, T>,
    items: Range<usize>,
}

impl<'a, T: Real> Shapes<'a, T> {
    /// Returns all shapes of a column.
    pub fn of(column: &'a Column<'a, T>) -> Self {
        Shapes {
            column,
            items: 0..column.len(),
        }
    }
    /// Returns some of these shapes, counted from the first.
    pub fn part(&self, items: &Range<usize>) -> Self {
        let from = self.items.start;
        Shapes {
            column: self.column,
            items: from + items.start..from + items.end,
        }
    }
    /// Returns the number of shapes.
    pub fn len(&self) -> usize {
        self.items.len()
    }
    /// Returns the numbers of some shapes: in place if they are contiguous, else written into `room`.
    pub fn numbers<'r>(&'r self, items: Range<usize>, room: &'r mut Vec<T>) -> &'r [T] {
        self.column.numbers(self.part(&items).items, room)
    }
}

/// A list of shapes, prepared.
pub struct List<'a, T: Real> {
    /// The shapes.
    pub shapes: Shapes<'a, T>,
    /// The number of shapes.
    pub count: usize,
    /// Prepared shapes in tiles.
    pub frames: LaneBuffer<T>,
    /// The number of scalars of a prepared shape.
    pub frame_fields: usize,
    /// Bounds in tiles. Padding meets nothing, the bounds of a rare shape meet everything. `None` without use for them.
    pub bounds: Option<LaneBuffer<T>>,
    /// The indices of shapes beyond the kernels' range, ascending.
    pub rare: Vec<u32>,
}

impl<'a, T: Real> List<'a, T> {
    /// Prepares shapes. `rare` is `true` if some may be beyond the kernels' range, `bounded` if bounds are wanted.
    pub fn new(
        preparation: &Preparation<T>,
        shapes: Shapes<'a, T>,
        rare: bool,
        bounded: bool,
    ) -> Self {
        let (fields, count) = (preparation.fields, shapes.len());
        let tiles = count.div_ceil(TILE);
        let mut lanes = LaneBuffer::new(tiles * fields);
        let (mut room, mut rare_ones) = (Vec::new(), Vec::new());
        for start in (0..count).step_by(STRETCH) {
            let items = start..count.min(start + STRETCH);
            let to = start / TILE * fields..items.end.div_ceil(TILE) * fields;
            let numbers = shapes.numbers(items, &mut room);
            (kernels_in::<T>().bring)(numbers, fields, &mut lanes[to]);
            if rare {
                let all = numbers.chunks_exact(fields).enumerate();
                let found = all.filter(|(_, shape)| (preparation.is_rare)(shape));
                rare_ones.extend(found.map(|(i, _)| (start + i) as u32));
            }
        }
        let frame_fields = preparation.frame_fields();
        let mut frames = LaneBuffer::new(0);
        if let Some((_, make)) = &preparation.frame {
            frames = LaneBuffer::new(tiles * frame_fields);
            make(Tiles::new(&lanes, fields), &mut frames);
        }
        let mut list = List {
            shapes,
            count,
            frames,
            frame_fields,
            bounds: None,
            rare: rare_ones,
        };
        if let (Some(make), true) = (&preparation.bounds, bounded) {
            let mut bounds = LaneBuffer::new(tiles * BOUNDS);
            let frames = Tiles::new(&list.frames, frame_fields);
            make([Tiles::new(&lanes, fields), frames], &mut bounds);
            // Finite, so that they meet the bounds of shapes but not the infinite ones of padding.
            let everything = [
                T::lit(-T::format().largest()),
                T::lit(T::format().largest()),
            ];
            let nowhere = [T::lit(f64::INFINITY), T::lit(f64::NEG_INFINITY)];
            for (items, [low, high]) in [
                (list.rare.clone(), everything),
                ((count as u32..(tiles * TILE) as u32).collect(), nowhere),
            ] {
                for i in items {
                    let (t, i) = (i as usize / TILE * BOUNDS, i as usize % TILE);
                    for k in 0..BOUNDS {
                        bounds[t + k].0[i] = if k < 2 { low } else { high };
                    }
                }
            }
            list.bounds = Some(bounds);
        }
        if preparation.frame.is_none() {
            list.frames = lanes;
        }
        list
    }
    /// Returns the number of scalars of a row of [`picking`](List::picking), a multiple of four.
    pub fn stride(&self) -> usize {
        self.frame_fields.next_multiple_of(4)
    }
    /// Returns the prepared shapes as rows of numbers, to gather from.
    pub fn picking(&self) -> LaneBuffer<T> {
        let stride = self.stride();
        let mut picking = LaneBuffer::new(self.count.div_ceil(TILE) * stride);
        // Sixteen rows take as many lanes as a row has numbers.
        let rows = picking.chunks_exact_mut(stride.max(1));
        for (rows, tile) in rows.zip(self.frames.chunks_exact(self.frame_fields.max(1))) {
            for i in 0..TILE {
                for (k, lane) in tile.iter().enumerate() {
                    let at = i * stride + k;
                    rows[at / TILE].0[at % TILE] = lane.0[i];
                }
            }
        }
        picking
    }
    /// Returns a shape's numbers: in place if they are contiguous, else written into `room`.
    pub fn shape<'r>(&'r self, i: usize, room: &'r mut Vec<T>) -> &'r [T] {
        self.shapes.numbers(i..i + 1, room)
    }
    /// Broadcasts a prepared shape to all places of a tile.
    pub fn broadcast(&self, i: usize, tile: &mut [Lane<T>]) {
        let from = &self.frames[i / TILE * self.frame_fields..];
        (kernels_in::<T>().broadcast)(from, i % TILE, tile);
    }
    /// Returns a shape's bounds.
    pub fn bounds_of(&self, i: usize) -> Option<[T; BOUNDS]> {
        let tile = self.bounds.as_ref()?[i / TILE * BOUNDS..].first_chunk::<BOUNDS>()?;
        Some(tile.each_ref().map(|lane| lane.0[i % TILE]))
    }
    /// Returns `true` if a shape is beyond the kernels' range.
    pub fn is_rare(&self, i: usize) -> bool {
        self.rare.binary_search(&(i as u32)).is_ok()
    }
}

//! A list of shapes made ready for kernels.
use super::computation::Preparation;
use crate::kernels::cpu::lane::{Kept, Lane, Lent, TILE, Tiles};
use crate::kernels::cpu::overlaps::BOUNDS;
use crate::kernels::real::Real;

/// A list of shapes, prepared.
pub struct List<'a, T: Kept> {
    /// The shapes' numbers.
    pub numbers: &'a [T],
    /// Numbers per shape.
    pub fields: usize,
    /// How many shapes.
    pub count: usize,
    /// Prepared shapes in tiles.
    pub frames: Lent<T>,
    /// Numbers per prepared shape.
    pub frame_fields: usize,
    /// Bounds in tiles; nothing meets those that fill up the last one, everything those of rare
    /// shapes. `None` where they are of no use.
    pub bounds: Option<Lent<T>>,
    /// Which shapes kernels do not serve, ascending.
    pub rare: Vec<u32>,
}

impl<'a, T: Real> List<'a, T> {
    /// Prepares shapes. `rare` says whether some may be too rare for kernels.
    pub fn new(plan: &Preparation<T>, numbers: &'a [T], rare: bool, bounded: bool) -> Self {
        let fields = plan.fields;
        let count = numbers.len() / fields;
        let tiles = count.div_ceil(TILE);
        let mut shapes = Lent::new(tiles * fields);
        (T::kernels().bring)(numbers, fields, &mut shapes);
        let frame_fields = plan.frame_fields();
        let mut frames = Lent::new(0);
        if let Some((_, make)) = &plan.frame {
            frames = Lent::new(tiles * frame_fields);
            make(Tiles::new(&shapes, fields), &mut frames);
        }
        let mut list = List {
            numbers,
            fields,
            count,
            frames,
            frame_fields,
            bounds: None,
            rare: Vec::new(),
        };
        if rare {
            let all = numbers.chunks_exact(fields).enumerate();
            let rare = all.filter(|(_, shape)| (plan.is_rare)(shape));
            list.rare = rare.map(|(i, _)| i as u32).collect();
        }
        if let (Some(make), true) = (&plan.bounds, bounded) {
            let mut bounds = Lent::new(tiles * BOUNDS);
            let frames = Tiles::new(&list.frames, frame_fields);
            make([Tiles::new(&shapes, fields), frames], &mut bounds);
            // Finite, so that not even everything meets what is nowhere.
            let everything = [T::lit(-T::LARGEST), T::lit(T::LARGEST)];
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
        if plan.frame.is_none() {
            list.frames = shapes;
        }
        list
    }
    /// Numbers of a shape among [`picking`](List::picking): a multiple of four.
    pub fn stride(&self) -> usize {
        self.frame_fields.next_multiple_of(4)
    }
    /// Prepared shapes as rows of numbers, for picking some.
    pub fn picking(&self) -> Lent<T> {
        let stride = self.stride();
        let mut picking = Lent::new(self.count.div_ceil(TILE) * stride);
        // Rows of a tile take as many lanes as a row has numbers.
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
    /// A shape's numbers.
    pub fn shape(&self, i: usize) -> &'a [T] {
        &self.numbers[i * self.fields..][..self.fields]
    }
    /// A prepared shape in every place of a tile.
    pub fn spread(&self, i: usize, tile: &mut [Lane<T>]) {
        let from = &self.frames[i / TILE * self.frame_fields..];
        (T::kernels().spread)(from, i % TILE, tile);
    }
    /// A shape's bounds.
    pub fn bounds_of(&self, i: usize) -> Option<[T; BOUNDS]> {
        let tile = self.bounds.as_ref()?[i / TILE * BOUNDS..].first_chunk::<BOUNDS>()?;
        Some(tile.each_ref().map(|lane| lane.0[i % TILE]))
    }
    /// `true` if kernels do not serve a shape.
    pub fn is_rare(&self, i: usize) -> bool {
        self.rare.binary_search(&(i as u32)).is_ok()
    }
}

//! Aligned items over plain numbers, block by block: the same code for every operation.
use crate::kernels::cpu::lane::{Lane, Planes, Results, TILE, Tiles, planes, tiles, with_lanes};
use crate::kernels::cpu::plan::{Plan, Room};
use crate::kernels::real::Real;

/// Items per block: with their results few enough for the innermost cache.
const ITEMS: usize = 256;

/// Aligned pairs as numbers, and where their results go.
pub struct Aligned<'a, T> {
    /// The shapes of both lists.
    pub shapes: [&'a [T]; 2],
    /// Whether some may be too rare for kernels.
    pub rare: [bool; 2],
    /// Where results go.
    pub values: Option<&'a mut [T]>,
    /// Where slopes go.
    pub bars: Option<[&'a mut [T]; 2]>,
    /// What slopes are multiplied by.
    pub upstream: Option<&'a [T]>,
}

/// Computes aligned pairs on the calling thread.
pub fn compute<T: Real>(plan: &Plan<T>, mut work: Aligned<'_, T>) {
    let fields = [0, 1].map(|k| plan.shapes[k].fields);
    let frames = [0, 1].map(|k| plan.shapes[k].frame_fields());
    let wide = match work.bars {
        Some(_) => plan.slope_fields(),
        None => 1,
    };
    let count = work.shapes[0].len() / fields[0];
    let most = tiles(count.min(ITEMS));
    let lanes = most * (1 + fields[0] + fields[1] + frames[0] + frames[1]) + planes(wide);
    with_lanes(lanes, |lanes| {
        let (own_a, lanes) = lanes.split_at_mut(most * fields[0]);
        let (own_b, lanes) = lanes.split_at_mut(most * fields[1]);
        let (frames_a, lanes) = lanes.split_at_mut(most * frames[0]);
        let (frames_b, lanes) = lanes.split_at_mut(most * frames[1]);
        let (seeds, results) = lanes.split_at_mut(most);
        let mut room = Room::new();
        for first in (0..count).step_by(ITEMS) {
            let items = first..count.min(first + ITEMS);
            let of = |k: usize| &work.shapes[k][items.start * fields[k]..items.end * fields[k]];
            let a = prepared(plan, 0, of(0), own_a, frames_a);
            let b = prepared(plan, 1, of(1), own_b, frames_b);
            let upstream = work.upstream.map(|upstream| &upstream[items.clone()]);
            let inputs = match upstream {
                Some(upstream) => {
                    (T::kernels().bring)(upstream, 1, &mut *seeds);
                    vec![a, b, Tiles::new(&*seeds, 1)]
                }
                None => vec![a, b],
            };
            let maker = match work.bars {
                Some(_) => &plan.slopes,
                None => &plan.scores,
            };
            let mut out = Results {
                lanes: &mut *results,
                tiles: tiles(items.len()),
            };
            maker.make(&mut room, &inputs, out.again());
            if work.rare != [false; 2] {
                mend(plan, [of(0), of(1)], upstream, out, wide);
            }
            let results = Planes(&*results);
            if let Some(values) = &mut work.values {
                (T::kernels().take)(results, 1, &mut values[items.clone()], 1);
            }
            if let Some(bars) = &mut work.bars {
                let mut from = 1;
                for (bars, fields) in bars.iter_mut().zip(fields) {
                    let bars = &mut bars[items.start * fields..items.end * fields];
                    (T::kernels().take)(results.from(from), fields, bars, fields);
                    from += fields;
                }
            }
        }
    });
}

/// A block's shapes in tiles, prepared.
fn prepared<'a, T: Real>(
    plan: &Plan<T>,
    side: usize,
    numbers: &[T],
    own: &'a mut [Lane<T>],
    frames: &'a mut [Lane<T>],
) -> Tiles<'a, T> {
    let plan = &plan.shapes[side];
    let width = tiles(numbers.len() / plan.fields);
    (T::kernels().bring)(numbers, plan.fields, &mut own[..width * plan.fields]);
    match &plan.frame {
        None => Tiles::new(own, plan.fields),
        Some((fields, make)) => {
            let frames = &mut frames[..width * fields];
            make(Tiles::new(own, plan.fields), frames);
            Tiles::new(frames, *fields)
        }
    }
}

/// Puts the right results of rare pairs in their places.
fn mend<T: Real>(
    plan: &Plan<T>,
    shapes: [&[T]; 2],
    upstream: Option<&[T]>,
    mut out: Results<'_, T>,
    wide: usize,
) {
    let Some(rare) = &plan.rare else { return };
    let [a, b] = &plan.shapes;
    let mut one = vec![T::default(); wide];
    let items = shapes[0]
        .chunks_exact(a.fields)
        .zip(shapes[1].chunks_exact(b.fields));
    for (i, (own_a, own_b)) in items.enumerate() {
        if (a.is_rare)(own_a) || (b.is_rare)(own_b) {
            let out_bar = upstream.map_or(T::one(), |upstream| upstream[i]);
            rare(own_a, own_b, out_bar, &mut one);
            for (k, &x) in one.iter().enumerate() {
                if let Some(lane) = out.lane(i / TILE, k) {
                    lane.0[i % TILE] = x;
                }
            }
        }
    }
}

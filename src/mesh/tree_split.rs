//! The split of faces among the children of a node, by a binned surface-area heuristic.

/// The number of bins along each axis.
const BINS: usize = 16;
/// From this depth on parts are halved, so that no order of sizes makes a tree deep.
const DEEP: usize = 20;

/// Bounds along the three axes.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// The lower ends.
    pub low: [f32; 3],
    /// The upper ends.
    pub high: [f32; 3],
}

impl Bounds {
    /// Returns the bounds of nothing.
    pub fn none() -> Self {
        Bounds {
            low: [f32::INFINITY; 3],
            high: [f32::NEG_INFINITY; 3],
        }
    }
    /// Returns the bounds of a triangle.
    pub fn of(corners: [[f32; 3]; 3]) -> Self {
        let mut all = Self::none();
        for corner in corners {
            all = all.with(&Bounds {
                low: corner,
                high: corner,
            });
        }
        all
    }
    /// Returns the bounds of both.
    #[inline]
    pub fn with(mut self, other: &Bounds) -> Self {
        for k in 0..3 {
            self.low[k] = if other.low[k] < self.low[k] {
                other.low[k]
            } else {
                self.low[k]
            };
            self.high[k] = if other.high[k] > self.high[k] {
                other.high[k]
            } else {
                self.high[k]
            };
        }
        self
    }
    /// Returns half of the surface's area; zero for nothing.
    fn area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|k| self.high[k] - self.low[k]);
        if x < 0.0 {
            return 0.0;
        }
        x * y + y * z + z * x
    }
    /// Returns twice the middle along an axis.
    #[inline]
    fn twice_middle(&self, axis: usize) -> f32 {
        self.low[axis] + self.high[axis]
    }
}

fn around(items: &[u32], bounds: &[Bounds]) -> Bounds {
    let all = items.iter().map(|&i| &bounds[i as usize]);
    all.fold(Bounds::none(), |all, own| all.with(own))
}

/// Returns up to eight ranges of items, each a child, and brings the items into their order. Ranges of more than eight
/// items are split, the one of largest surface first.
pub fn parts(items: &mut [u32], bounds: &[Bounds], depth: usize) -> Vec<(usize, usize)> {
    let mut parts = vec![(0, items.len())];
    let mut areas = vec![around(items, bounds).area()];
    while parts.len() < 8 {
        let splittable = (0..parts.len()).filter(|&k| parts[k].1 - parts[k].0 > 8);
        let Some(k) = splittable.max_by(|&i, &j| areas[i].total_cmp(&areas[j])) else {
            break;
        };
        let (start, end) = parts[k];
        let middle = start + split(&mut items[start..end], bounds, depth);
        parts[k].1 = middle;
        parts.push((middle, end));
        areas[k] = around(&items[start..middle], bounds).area();
        areas.push(around(&items[middle..end], bounds).area());
    }
    parts
}

/// Returns the cost of some items in packets of eight.
fn cost(bounds: &Bounds, count: usize) -> f32 {
    bounds.area() * count.div_ceil(8) as f32
}

/// Brings items into two parts and returns the length of the first one; neither is empty.
fn split(items: &mut [u32], bounds: &[Bounds], depth: usize) -> usize {
    let middle = |i: u32, axis: usize| bounds[i as usize].twice_middle(axis);
    let mut best = (f32::INFINITY, 0, 0, 0.0, 0.0);
    let mut widest = (0.0, 0);
    for axis in 0..3 {
        let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
        for &i in &*items {
            let x = middle(i, axis);
            low = if x < low { x } else { low };
            high = if x > high { x } else { high };
        }
        if high - low > widest.0 {
            widest = (high - low, axis);
        }
        // The largest index stays below the number of bins.
        let scale = BINS as f32 * 0.999_9 / (high - low);
        if !scale.is_finite() || depth >= DEEP {
            continue;
        }
        let mut bins = [(Bounds::none(), 0); BINS];
        for &i in &*items {
            let bin = &mut bins[bin_of(middle(i, axis), low, scale)];
            *bin = (bin.0.with(&bounds[i as usize]), bin.1 + 1);
        }
        let mut right_costs = [0.0; BINS];
        let mut right = (Bounds::none(), 0);
        for k in (1..BINS).rev() {
            right = (right.0.with(&bins[k].0), right.1 + bins[k].1);
            right_costs[k] = cost(&right.0, right.1);
        }
        let mut left = (Bounds::none(), 0);
        for k in 1..BINS {
            left = (left.0.with(&bins[k - 1].0), left.1 + bins[k - 1].1);
            let total = cost(&left.0, left.1) + right_costs[k];
            if total < best.0 && left.1 > 0 && left.1 < items.len() {
                best = (total, axis, k, low, scale);
            }
        }
    }
    let (_, axis, first_right, low, scale) = best;
    if best.0.is_finite() {
        let mut left = 0;
        for k in 0..items.len() {
            if bin_of(middle(items[k], axis), low, scale) < first_right {
                items.swap(k, left);
                left += 1;
            }
        }
        return left;
    }
    let half = items.len() / 2;
    let axis = widest.1;
    items.select_nth_unstable_by(half, |&i, &j| {
        middle(i, axis).total_cmp(&middle(j, axis)).then(i.cmp(&j))
    });
    half
}

/// Returns the bin of a place.
#[inline]
fn bin_of(x: f32, low: f32, scale: f32) -> usize {
    (((x - low) * scale) as usize).min(BINS - 1)
}

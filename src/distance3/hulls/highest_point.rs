//! Points as columns of coordinates, for the highest one along a direction.
use crate::Vec3;
use crate::distance::edge::scale_of;
use crate::scalar::largest;
use smallvec::SmallVec;

/// The number of points that are compared at once.
const LANES: usize = 4;

/// The coordinates of some points, one list per axis.
type Group = [[f64; LANES]; 3];

/// The number of groups up to which they need no heap: those of two hulls of 32 points.
const GROUPS: usize = 16;

/// The columns of one or two lists of points.
#[derive(Debug, Default)]
pub(in crate::distance3) struct PointGroups {
    groups: SmallVec<[Group; GROUPS]>,
}

/// Points in groups, each with the columns of its coordinates. The last group repeats the first point.
#[derive(Clone, Copy, Debug)]
pub(in crate::distance3) struct PointColumns<'a> {
    groups: &'a [Group],
    /// The number of points.
    count: usize,
}

/// Returns the numbers of the points of a group, given the first of them, as `f64`, which vectors compare with heights.
#[inline(always)]
fn named(first: f64) -> [f64; LANES] {
    [first, first + 1.0, first + 2.0, first + 3.0]
}

/// Returns the heights of a group along a direction.
#[inline(always)]
fn heights([x, y, z]: &Group, way: Vec3<f64>) -> [f64; LANES] {
    std::array::from_fn(|lane| way.x * x[lane] + way.y * y[lane] + way.z * z[lane])
}

/// Returns the largest of some numbers.
#[inline(always)]
fn most_of([p, q, r, s]: [f64; LANES]) -> f64 {
    let more = |one: f64, two: f64| if one > two { one } else { two };
    more(more(p, q), more(r, s))
}

/// Returns the numbers of a group where its heights are the top, else infinity.
#[inline(always)]
fn numbers_at(top: f64, heights: &[f64; LANES], numbers: [f64; LANES]) -> [f64; LANES] {
    std::array::from_fn(|lane| match heights[lane] == top {
        true => numbers[lane],
        false => f64::INFINITY,
    })
}

/// Returns a whole number below 2³²; 0 for infinity.
#[inline(always)]
fn whole(number: f64) -> usize {
    // The unit of a sum of this size is one, so its last bits are the number.
    const UNITS: f64 = (1_u64 << 52) as f64;
    (number + UNITS).to_bits() as u32 as usize
}

/// Returns the lanes of one list or of another one.
#[inline(always)]
fn chosen(
    first: [f64; LANES],
    second: [f64; LANES],
    is_first: impl Fn(f64, f64) -> bool,
) -> [f64; LANES] {
    std::array::from_fn(|lane| match is_first(first[lane], second[lane]) {
        true => first[lane],
        false => second[lane],
    })
}

/// Returns the columns of some points.
#[inline(always)]
fn group_of(at: impl Fn(usize) -> Vec3<f64>) -> Group {
    let mut group = [[0.0; LANES]; 3];
    let [xs, ys, zs] = &mut group;
    for (lane, ((x, y), z)) in xs.iter_mut().zip(ys).zip(zs).enumerate() {
        Vec3 {
            x: *x,
            y: *y,
            z: *z,
        } = at(lane);
    }
    group
}

impl PointGroups {
    /// Creates room for some numbers of points.
    pub fn with_room<const N: usize>(counts: [usize; N]) -> Self {
        let groups = counts.into_iter().map(|count| count.div_ceil(LANES)).sum();
        PointGroups {
            groups: SmallVec::with_capacity(groups),
        }
    }
    /// Adds a list of points, by their numbers below a count that is not zero.
    #[inline]
    pub fn add(&mut self, count: usize, at: impl Fn(usize) -> Vec3<f64>) {
        let whole = count / LANES * LANES;
        for first in (0..whole).step_by(LANES) {
            self.groups.push(group_of(|lane| at(first + lane)));
        }
        if whole < count {
            let last = |lane| {
                if whole + lane < count {
                    whole + lane
                } else {
                    0
                }
            };
            self.groups.push(group_of(|lane| at(last(lane))));
        }
    }
    /// Multiplies all coordinates by a power of two that makes the largest about one, and returns it; `None` if one is not
    /// finite.
    pub fn scale(&mut self) -> Option<f64> {
        let (mut most, mut none) = ([0.0_f64; LANES], [0.0; LANES]);
        for group in &self.groups {
            for column in group {
                for lane in 0..LANES {
                    let x = column[lane];
                    most[lane] = if x.abs() > most[lane] {
                        x.abs()
                    } else {
                        most[lane]
                    };
                    // NaN of a number that is not finite.
                    none[lane] += x * 0.0;
                }
            }
        }
        let scale = scale_of::<f64>(largest(most));
        for group in &mut self.groups {
            for column in group {
                for x in column {
                    *x *= scale;
                }
            }
        }
        ((none[0] + none[1]) + (none[2] + none[3]) == 0.0).then_some(scale)
    }
    /// Returns a list of points, given how many points were added before.
    pub fn columns(&self, before: usize, count: usize) -> PointColumns<'_> {
        let start = before.div_ceil(LANES);
        PointColumns {
            groups: &self.groups[start..start + count.div_ceil(LANES)],
            count,
        }
    }
}

impl PointColumns<'_> {
    /// Returns a point by its number; the first one for numbers of no point.
    #[inline]
    pub fn point(&self, k: usize) -> Vec3<f64> {
        let k = if k < self.count { k } else { 0 };
        let ([x, y, z], lane) = (&self.groups[k / LANES], k % LANES);
        Vec3::new(x[lane], y[lane], z[lane])
    }
    /// Returns all points, in order.
    pub fn points(&self) -> Vec<Vec3<f64>> {
        (0..self.count).map(|k| self.point(k)).collect()
    }
    /// Returns the number of the first of the highest points along a direction, and the point.
    #[inline(always)]
    pub fn highest(&self, way: Vec3<f64>) -> (usize, Vec3<f64>) {
        // Vectors of three numbers would go through memory.
        let number = self.number_of_highest(way.x, way.y, way.z);
        (number, self.point(number))
    }
    /// Returns the number of the first of the highest points along a direction.
    fn number_of_highest(&self, x: f64, y: f64, z: f64) -> usize {
        let way = Vec3::new(x, y, z);
        let first = match self.groups {
            // Most hulls have few points, whose heights stay in registers.
            [one, two] => {
                let heights = [heights(one, way), heights(two, way)];
                let top = most_of(chosen(heights[0], heights[1], |one, two| one > two));
                let own = [
                    numbers_at(top, &heights[0], named(0.0)),
                    numbers_at(top, &heights[1], named(LANES as f64)),
                ];
                chosen(own[0], own[1], |one, two| one < two)
            }
            groups => {
                let mut most = [f64::NEG_INFINITY; LANES];
                for group in groups {
                    most = chosen(heights(group, way), most, |height, most| height > most);
                }
                let top = most_of(most);
                // Heights again, which is faster than numbers that follow every comparison.
                let (mut first, mut numbers) = ([f64::INFINITY; LANES], named(0.0));
                for group in groups {
                    let own = numbers_at(top, &heights(group, way), numbers);
                    first = chosen(own, first, |own, first| own < first);
                    numbers = std::array::from_fn(|lane| numbers[lane] + LANES as f64);
                }
                first
            }
        };
        let less = |one: f64, two: f64| if one < two { one } else { two };
        let number = less(less(first[0], first[1]), less(first[2], first[3]));
        let number = whole(number);
        // Along a direction that is no number none is the highest.
        if number < self.count { number } else { 0 }
    }
    /// Returns how many points are no lower than a height along a direction.
    #[inline]
    pub fn count_above(&self, way: Vec3<f64>, least: f64) -> usize {
        let mut counts = [0.0; LANES];
        for group in self.groups {
            let heights = heights(group, way);
            for lane in 0..LANES {
                counts[lane] += if heights[lane] >= least { 1.0 } else { 0.0 };
            }
        }
        // The last group repeats the first point.
        let repeats = self.groups.len() * LANES - self.count;
        let [first, ..] = heights(&self.groups[0], way);
        let count = whole((counts[0] + counts[1]) + (counts[2] + counts[3]));
        if first >= least {
            count - repeats
        } else {
            count
        }
    }
    /// Calls a function with the numbers of the points that are no lower than a height along a direction, in order.
    #[inline]
    pub fn above(&self, way: Vec3<f64>, least: f64, mut take: impl FnMut(usize)) {
        for (k, group) in self.groups.iter().enumerate() {
            for (lane, height) in heights(group, way).into_iter().enumerate() {
                if height >= least && k * LANES + lane < self.count {
                    take(k * LANES + lane);
                }
            }
        }
    }
    /// Returns about the middle of all points: the last group repeats the first one.
    pub fn middle(&self) -> Vec3<f64> {
        let mut sums = [[0.0; LANES]; 3];
        for group in self.groups {
            for axis in 0..3 {
                for lane in 0..LANES {
                    sums[axis][lane] += group[axis][lane];
                }
            }
        }
        let [x, y, z] = sums;
        let sum = |[p, q, r, s]: [f64; LANES]| (p + q) + (r + s);
        Vec3::new(sum(x), sum(y), sum(z)) * (1.0 / (self.groups.len() * LANES) as f64)
    }
}

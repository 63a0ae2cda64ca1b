//! Points as columns of coordinates, for the highest one along a direction.
use crate::Vec3;
use crate::distance::edge::scale_of;
use crate::scalar::largest;

/// The number of points that are compared at once.
const LANES: usize = 4;

/// The coordinates of some points, one list per axis.
type Group = [[f64; LANES]; 3];

/// The columns of one or two lists of points.
#[derive(Debug, Default)]
pub(in crate::distance3) struct PointGroups {
    groups: Vec<Group>,
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
    [0, 1, 2, 3].map(|lane| first + f64::from(lane))
}

/// Returns the heights of a group along a direction.
#[inline(always)]
fn heights([x, y, z]: &Group, way: Vec3<f64>) -> [f64; LANES] {
    std::array::from_fn(|lane| way.x * x[lane] + way.y * y[lane] + way.z * z[lane])
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

impl PointGroups {
    /// Creates room for some numbers of points.
    pub fn with_room<const N: usize>(counts: [usize; N]) -> Self {
        let groups = counts.into_iter().map(|count| count.div_ceil(LANES)).sum();
        PointGroups {
            groups: Vec::with_capacity(groups),
        }
    }
    /// Adds a list of points, by their numbers below a count that is not zero.
    #[inline]
    pub fn add(&mut self, count: usize, at: impl Fn(usize) -> Vec3<f64>) {
        for first in (0..count).step_by(LANES) {
            let mut group = [[0.0; LANES]; 3];
            let [xs, ys, zs] = &mut group;
            for (lane, ((x, y), z)) in xs.iter_mut().zip(ys).zip(zs).enumerate() {
                let k = first + lane;
                Vec3 {
                    x: *x,
                    y: *y,
                    z: *z,
                } = at(if k < count { k } else { 0 });
            }
            self.groups.push(group);
        }
    }
    /// Multiplies all coordinates by a power of two that makes the largest about one, and returns it.
    pub fn scale(&mut self) -> f64 {
        let mut most = [0.0_f64; LANES];
        for column in self.groups.iter().flatten() {
            most = chosen(column.map(f64::abs), most, |x, most| x > most);
        }
        let scale = scale_of::<f64>(largest(most));
        for column in self.groups.iter_mut().flatten() {
            *column = column.map(|x| x * scale);
        }
        scale
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
        let mut most = [f64::NEG_INFINITY; LANES];
        for group in self.groups {
            most = chosen(heights(group, way), most, |height, most| height > most);
        }
        let top = most.into_iter().fold(f64::NEG_INFINITY, f64::max);
        // Heights again, which is faster than numbers that follow every comparison.
        let (mut first, mut numbers) = ([f64::INFINITY; LANES], named(0.0));
        for group in self.groups {
            let heights = heights(group, way);
            let own = std::array::from_fn(|lane| match heights[lane] == top {
                true => numbers[lane],
                false => f64::INFINITY,
            });
            first = chosen(own, first, |own, first| own < first);
            numbers = numbers.map(|number| number + LANES as f64);
        }
        let number = first.into_iter().fold(f64::INFINITY, f64::min) as usize;
        // Along a direction that is no number none is the highest.
        if number < self.count { number } else { 0 }
    }
    /// Returns how many points are no lower than a height along a direction.
    #[inline]
    pub fn count_above(&self, way: Vec3<f64>, least: f64) -> usize {
        let (mut counts, mut numbers) = ([0.0; LANES], named(0.0));
        for group in self.groups {
            let heights = heights(group, way);
            for lane in 0..LANES {
                let is_above = heights[lane] >= least && numbers[lane] < self.count as f64;
                counts[lane] += if is_above { 1.0 } else { 0.0 };
            }
            numbers = numbers.map(|number| number + LANES as f64);
        }
        counts.iter().sum::<f64>() as usize
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
            for (sums, column) in sums.iter_mut().zip(group) {
                for (sum, x) in sums.iter_mut().zip(column) {
                    *sum += x;
                }
            }
        }
        let sum = |lanes: &[f64; LANES]| lanes.iter().sum::<f64>();
        Vec3::new(sum(&sums[0]), sum(&sums[1]), sum(&sums[2]))
            * (1.0 / (self.groups.len() * LANES) as f64)
    }
}

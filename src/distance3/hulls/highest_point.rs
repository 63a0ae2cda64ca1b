//! Points as columns of coordinates, for the highest one along a direction.
use crate::Vec3;

/// The number of points that are compared at once.
const LANES: usize = 4;

/// The coordinates of some points, one list per axis.
type Group = [[f64; LANES]; 3];

/// Points in groups, each with the columns of its coordinates. The last group repeats the first point.
#[derive(Debug)]
pub(in crate::distance3) struct PointColumns {
    groups: Vec<Group>,
    /// The number of points.
    count: usize,
}

/// Returns the heights of a group along a direction.
#[inline(always)]
fn heights([x, y, z]: &Group, way: Vec3<f64>) -> [f64; LANES] {
    std::array::from_fn(|lane| way.x * x[lane] + way.y * y[lane] + way.z * z[lane])
}

impl PointColumns {
    /// Returns points relative to another one.
    pub fn new(points: &[Vec3<f64>], from: Vec3<f64>) -> Self {
        let mut all = vec![[[0.0; LANES]; 3]; points.len().div_ceil(LANES)];
        let padded = all.len() * LANES;
        for k in 0..padded {
            let arm = points[if k < points.len() { k } else { 0 }] - from;
            let [x, y, z] = &mut all[k / LANES];
            (x[k % LANES], y[k % LANES], z[k % LANES]) = (arm.x, arm.y, arm.z);
        }
        PointColumns {
            groups: all,
            count: points.len(),
        }
    }
    /// Returns a point by its number.
    #[inline]
    pub fn point(&self, k: usize) -> Vec3<f64> {
        let ([x, y, z], lane) = (&self.groups[k / LANES], k % LANES);
        Vec3::new(x[lane], y[lane], z[lane])
    }
    /// Returns the number of the first of the highest points along a direction, and the point.
    #[inline]
    pub fn highest(&self, way: Vec3<f64>) -> (usize, Vec3<f64>) {
        let (mut most, mut places) = ([f64::NEG_INFINITY; LANES], [0.0; LANES]);
        for (k, group) in self.groups.iter().enumerate() {
            let heights = heights(group, way);
            for lane in 0..LANES {
                let higher = heights[lane] > most[lane];
                most[lane] = if higher { heights[lane] } else { most[lane] };
                places[lane] = if higher { k as f64 } else { places[lane] };
            }
        }
        let top = most.into_iter().fold(f64::NEG_INFINITY, f64::max);
        // The first of those that are equally high.
        let numbers = (0..LANES).filter(|&lane| most[lane] == top);
        let numbers = numbers.map(|lane| places[lane] as usize * LANES + lane);
        let found = numbers.min();
        let number = found.unwrap_or(0);
        (number, self.point(number))
    }
    /// Calls a function with the numbers of the points that are no lower than a height along a direction, in order.
    #[inline]
    pub fn above(&self, way: Vec3<f64>, least: f64, mut take: impl FnMut(usize)) {
        for (k, group) in self.groups.iter().enumerate() {
            let heights = heights(group, way);
            if heights
                .iter()
                .fold(false, |any, &height| any | (height >= least))
            {
                for (lane, height) in heights.into_iter().enumerate() {
                    if height >= least && k * LANES + lane < self.count {
                        take(k * LANES + lane);
                    }
                }
            }
        }
    }
    /// Returns the middle of all points.
    pub fn middle(&self) -> Vec3<f64> {
        let mut sums = [[0.0; LANES]; 3];
        for group in &self.groups {
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

//! Points as columns of coordinates, for the highest one along a direction.
use crate::Vec3;

/// The number of points that are compared at once.
const LANES: usize = 4;

/// Points in groups, each with the columns of its coordinates. The last group repeats the first point.
#[derive(Debug)]
pub(in crate::distance3) struct PointColumns(Vec<[[f64; LANES]; 3]>);

impl PointColumns {
    /// Returns points relative to another one.
    pub fn new(points: &[Vec3<f64>], from: Vec3<f64>) -> Self {
        let group = |points: &[Vec3<f64>], first: Vec3<f64>| {
            let arm: [Vec3<f64>; LANES] =
                std::array::from_fn(|k| *points.get(k).unwrap_or(&first) - from);
            [arm.map(|p| p.x), arm.map(|p| p.y), arm.map(|p| p.z)]
        };
        let groups = points.chunks(LANES);
        PointColumns(groups.map(|chunk| group(chunk, points[0])).collect())
    }
    /// Returns a point by its number.
    pub fn point(&self, k: usize) -> Vec3<f64> {
        let [x, y, z] = self.0[k / LANES].map(|column| column[k % LANES]);
        Vec3::new(x, y, z)
    }
    /// Returns the number of the highest point along a direction, and the point.
    pub fn highest(&self, way: Vec3<f64>) -> (usize, Vec3<f64>) {
        let (mut most, mut at) = ([f64::NEG_INFINITY; LANES], [0_u64; LANES]);
        for (group, [x, y, z]) in (0_u64..).zip(&self.0) {
            for lane in 0..LANES {
                let height = way.x * x[lane] + way.y * y[lane] + way.z * z[lane];
                let above = height > most[lane];
                most[lane] = if above { height } else { most[lane] };
                at[lane] = if above { group } else { at[lane] };
            }
        }
        let mut best = 0;
        for lane in 1..LANES {
            if most[lane] > most[best] {
                best = lane;
            }
        }
        let group = &self.0[at[best] as usize];
        let [x, y, z] = [0, 1, 2].map(|axis| group[axis][best]);
        // A point that fills the last group is the first one.
        let number = at[best] as usize * LANES + best;
        (number, Vec3::new(x, y, z))
    }
}

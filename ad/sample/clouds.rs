//! Random polylines and clouds of space, and their hard cases.
use crate::Vec3;
use crate::ad::declared::Kind;
use crate::ad::sample::{Draw, Sample};

/// Returns points from triples of coordinates.
fn points(all: &[[f64; 3]]) -> Vec<Vec3<f64>> {
    all.iter().map(|&[x, y, z]| Vec3::new(x, y, z)).collect()
}

impl Sample for Vec<Vec3<f64>> {
    fn ordinary(draw: &mut Draw) -> Self {
        // Some are too long for a whole Jacobian.
        let n = match draw.below(64) {
            0 => 20 + draw.below(300),
            _ => 2 + draw.below(6),
        };
        let flat = draw.once_in(6);
        let mut all: Vec<Vec3<f64>> = (0..n)
            .map(|_| {
                let [x, y, z] = [0; 3].map(|_| draw.within(-1.0, 1.0));
                Vec3::new(x, y, if flat { 0.5 } else { z })
            })
            .collect();
        if draw.once_in(8) {
            let i = draw.below(n);
            all.insert(i, all[i]);
        }
        all
    }
    fn hard() -> Vec<Self> {
        vec![
            points(&[
                [0.0, 0.0, 0.0],
                [4.0, 0.0, 0.0],
                [0.0, 3.0, 0.0],
                [0.0, 0.0, 2.0],
            ]),
            points(&[
                [0.0, 0.0, 0.0],
                [2.0, 0.0, 0.0],
                [2.0, 0.0, 0.0],
                [1.0, 1.0, 1.0],
            ]),
            points(&[[0.0, 0.0, 0.0], [1.0, 0.5, 0.25], [2.0, 1.0, 0.5]]),
            points(&[[1.0, 2.0, 3.0], [1.0, 2.0, 3.0], [1.0, 2.0, 3.0]]),
            points(&[[0.0, 0.0, 0.0], [50.0, 0.0, 0.0], [50.0, 1e-3, 1e-6]]),
            points(&[[0.0, 0.0, 0.0], [1.0, 2.0, -1.0]]),
            points(&[[0.5, 0.25, -3.0]]),
            points(&[]),
            points(&[
                [0.0, 0.0, 0.0],
                [1.0, 0.0, 0.0],
                [1.0, 1e-9, 0.0],
                [0.0, 2e-9, 1e-9],
            ]),
            points(&[
                [1e5, 0.0, 0.0],
                [0.0, 1e5, 0.0],
                [-1e5, 0.0, 1.0],
                [0.0, -1e5, -1.0],
            ]),
        ]
    }
    fn kinds(&self) -> Vec<Kind> {
        [Kind::X, Kind::Y, Kind::Z].repeat(self.len())
    }
    fn scales(&self) -> Vec<f64> {
        let parts = |p: &Vec3<f64>| [p.x, p.y, p.z];
        let bounds = |k: usize| {
            let axis = self.iter().map(|p| parts(p)[k]);
            axis.fold((f64::MAX, f64::MIN), |(low, high), x| {
                (low.min(x), high.max(x))
            })
        };
        let size = (0..3)
            .map(|k| bounds(k).1 - bounds(k).0)
            .fold(0.0, f64::max);
        // A cloud that is one point has no size: its distance from the origin stands for it.
        let place = self
            .iter()
            .flat_map(parts)
            .fold(0.0, |most: f64, x| most.max(x.abs()));
        let size = if size > 0.0 { size } else { place };
        vec![if size > 0.0 { size } else { 1.0 }; 3 * self.len()]
    }
    fn inside(&self) -> bool {
        self.iter().all(|point| point.is_finite())
    }
}

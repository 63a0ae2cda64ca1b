//! Convex hulls of space to test with.
use crate::ad::declared::Kind;
use crate::ad::sample::{Draw, Sample};
use crate::error::Validate;
use crate::{Hull3, Vec3};

/// Returns a random point of a box about the origin.
fn point(draw: &mut Draw, half: Vec3<f64>) -> Vec3<f64> {
    let mut along = |half: f64| draw.within(-half, half);
    Vec3::new(along(half.x), along(half.y), along(half.z))
}

/// Returns a hull of random points of a box, which is anywhere near the origin.
fn in_box<const N: usize>(draw: &mut Draw, half: Vec3<f64>) -> Hull3<f64, N> {
    let count = 1 + draw.below(N);
    // Mostly with a volume.
    let count = if draw.once_in(4) {
        count
    } else {
        N.min(count + 3)
    };
    let center = point(draw, Vec3::new(1.0, 1.0, 1.0));
    let vertices: Vec<_> = (0..count).map(|_| center + point(draw, half)).collect();
    Hull3::from_vertices(&vertices)
}

impl<const N: usize> Sample for Hull3<f64, N> {
    fn ordinary(draw: &mut Draw) -> Self {
        let mut half = || draw.within(0.2, 1.2);
        let half = Vec3::new(half(), half(), half());
        in_box(draw, half)
    }
    fn thin(draw: &mut Draw) -> Self {
        let high = draw.magnitude(1e-6, 1e-2);
        in_box(draw, Vec3::new(1.0, 0.5, high))
    }
    fn hard() -> Vec<Self> {
        let corner = |k: usize| {
            let side = |bit: usize| (k >> bit & 1) as f64;
            Vec3::new(side(0), side(1), side(2))
        };
        let cube: Vec<_> = (0..8).map(corner).collect();
        let [x, y, z] = [corner(1), corner(2), corner(4)];
        let shapes = [
            cube.clone(),
            // A corner of the cube, with points inside, on a face and on an edge.
            vec![
                Vec3::zero(),
                x,
                y,
                z,
                (x + y) * 0.25,
                (x + y + z) * 0.125,
                z * 0.5,
            ],
            // Flat, on a line, at one place.
            vec![Vec3::zero(), x * 2.0, y * 2.0, (x + y) * 0.5],
            vec![x, x + z * 2.0, x + z],
            vec![y, y],
        ];
        let mut all = Vec::new();
        for shape in &shapes {
            for (scale, shift) in [(1.0, 0.0), (1e-6, 1.0)] {
                let moved = |&v: &Vec3<f64>| v * scale + Vec3::new(shift, -shift, 0.0);
                let vertices: Vec<_> = shape.iter().map(moved).collect();
                all.push(Hull3::from_vertices(&vertices));
            }
        }
        all
    }
    fn kinds(&self) -> Vec<Kind> {
        [Kind::X, Kind::Y, Kind::Z].repeat(N)
    }
    fn scales(&self) -> Vec<f64> {
        let size = self.bounding().size();
        let size = size.x.max(size.y).max(size.z);
        vec![if size > 0.0 { size } else { 1.0 }; 3 * N]
    }
    fn inside(&self) -> bool {
        self.validate().is_ok()
    }
}

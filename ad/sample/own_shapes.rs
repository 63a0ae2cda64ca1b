//! Random shapes of the library, pairs of them, and their hard cases.
use crate::ad::declared::Kind;
use crate::ad::sample::several::{together, units};
use crate::ad::sample::{Draw, Sample, Sampler};
use crate::arrays::sort_few;
use crate::error::Validate;
use crate::{Aabb2, ConvexPolygon, Obb2, Rotation2, Vec2};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// Returns a scale that is never zero.
fn positive(x: f64) -> f64 {
    if x > 0.0 { x } else { 1.0 }
}

impl Sample for Obb2<f64> {
    fn ordinary(draw: &mut Draw) -> Self {
        let heading = match draw.below(6) {
            0 => FRAC_PI_4 * draw.below(8) as f64,
            _ => draw.within(-PI, PI),
        };
        let (width, height) = (draw.within(0.2, 3.0), draw.within(0.2, 3.0));
        let (x, y) = (draw.within(-1.2, 1.2), draw.within(-1.2, 1.2));
        Obb2::new(x, y, width, height, heading)
    }
    fn thin(draw: &mut Draw) -> Self {
        let size = Vec2::new(draw.magnitude(1.0, 50.0), draw.magnitude(1e-3, 0.1));
        Obb2 {
            size,
            ..Self::ordinary(draw)
        }
    }
    fn beside(&self, draw: &mut Draw) -> Self {
        // Side along side, or corner to corner if `along` has its largest value.
        let other = Self::ordinary(draw);
        let reach = (self.size + other.size) * 0.5;
        let across = if draw.once_in(2) { -1.0 } else { 1.0 };
        let along = if draw.once_in(4) {
            across
        } else {
            draw.within(-1.0, 1.0)
        };
        let local = if draw.once_in(2) {
            Vec2::new(reach.x * across, reach.y * along)
        } else {
            Vec2::new(reach.x * along, reach.y * across)
        };
        Obb2 {
            center: self.world_from_local() * local,
            heading: self.heading,
            ..other
        }
    }
    fn hard() -> Vec<Self> {
        vec![
            Obb2::new(0.0, 0.0, 2.0, 1.0, 0.0),
            Obb2::new(0.0, 0.0, 1.0, 0.5, 0.0),
            Obb2::new(0.5, 0.25, 1.0, 0.5, 0.0),
            Obb2::new(2.0, 0.0, 2.0, 1.0, 0.0),
            Obb2::new(2.0, 1.0, 2.0, 1.0, 0.0),
            Obb2::new(1.0, 0.0, 2.0, 1.0, 0.0),
            Obb2::new(0.0, 0.0, 2.0, 1.0, FRAC_PI_2),
            Obb2::new(0.0, 0.0, 2.0, 1.0, PI),
            Obb2::new(0.25, 0.125, 1.5, 1.5, FRAC_PI_4),
            Obb2::new(0.0, 0.0, 2.0, 1.0, 1e-9),
            Obb2::new(0.0, 0.0, 2.0, 1.0, 1e-5),
            Obb2::new(0.0, 0.0, 50.0, 1e-3, 0.0),
            Obb2::new(0.0, 0.0, 50.0, 1e-3, 1e-6),
            Obb2::new(0.0, 2e-4, 50.0, 1e-3, 0.0),
            Obb2::new(0.25, 0.0, 0.0, 1.0, 0.0),
            Obb2::new(0.25, 0.125, 0.0, 0.0, 0.0),
            Obb2::new(9.0, 9.0, 2.0, 1.0, 0.5),
            Obb2::new(0.3, -0.2, 1.4, 0.9, 0.7),
            Obb2::new(0.0, 0.0, 1e5, 2e5, 0.1),
        ]
    }
    fn kinds(&self) -> Vec<Kind> {
        vec![Kind::X, Kind::Y, Kind::Length, Kind::Length, Kind::Angle]
    }
    fn scales(&self) -> Vec<f64> {
        let size = positive(self.size.x.max(self.size.y));
        let width = if self.size.x > 0.0 { self.size.x } else { size };
        let height = if self.size.y > 0.0 { self.size.y } else { size };
        let place = (width.sqrt() * height.sqrt()).max(1e-3 * size);
        vec![place, place, width, height, place / size]
    }
    fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        vec![self.corners().map(|p| [p.x, p.y]).to_vec()]
    }
    fn inside(&self) -> bool {
        self.validate().is_ok()
    }
}

impl Sample for Aabb2<f64> {
    fn ordinary(draw: &mut Draw) -> Self {
        let (x, y) = (draw.within(-1.0, 1.0), draw.within(-1.0, 1.0));
        let (width, height) = (draw.within(0.2, 3.0), draw.within(0.2, 3.0));
        Aabb2::new(x, y, x + width, y + height)
    }
    fn thin(draw: &mut Draw) -> Self {
        let (x, y) = (draw.within(-1.0, 1.0), draw.within(-1.0, 1.0));
        let (width, height) = (draw.magnitude(1.0, 50.0), draw.magnitude(1e-3, 0.1));
        Aabb2::new(x, y, x + width, y + height)
    }
    fn beside(&self, draw: &mut Draw) -> Self {
        let size = Self::ordinary(draw).size();
        let beside = |low: f64, high: f64, size: f64, before: bool| {
            if before {
                (low - size, low)
            } else {
                (high, high + size)
            }
        };
        let x = beside(self.min.x, self.max.x, size.x, draw.once_in(2));
        let y = beside(self.min.y, self.max.y, size.y, draw.once_in(2));
        // Corner to corner, or side along side.
        let low = draw.within(-size.x, self.size().x);
        match draw.below(3) {
            0 => Aabb2::new(x.0, y.0, x.1, y.1),
            1 => Aabb2::new(self.min.x + low, y.0, self.min.x + low + size.x, y.1),
            _ => {
                let low = draw.within(-size.y, self.size().y);
                Aabb2::new(x.0, self.min.y + low, x.1, self.min.y + low + size.y)
            }
        }
    }
    fn hard() -> Vec<Self> {
        vec![
            Aabb2::new(0.0, 0.0, 2.0, 1.0),
            Aabb2::new(0.5, 0.25, 1.0, 0.75),
            Aabb2::new(0.0, 0.0, 1.0, 1.0),
            Aabb2::new(0.0, 0.25, 2.0, 0.5),
            Aabb2::new(1.0, 0.0, 3.0, 1.0),
            Aabb2::new(2.0, 0.0, 4.0, 1.0),
            Aabb2::new(2.0, 1.0, 4.0, 2.0),
            Aabb2::new(-2.0, -1.0, 0.0, 0.0),
            Aabb2::new(0.7, 0.3, 2.9, 1.7),
            Aabb2::new(1.0, 0.0, 1.0, 1.0),
            Aabb2::new(1.0, 0.5, 1.0, 0.5),
            Aabb2::new(-25.0, 0.5, 25.0, 0.501),
            Aabb2::new(0.0, 0.0, 1e5, 1e5),
            Aabb2::new(9.0, 9.0, 11.0, 10.0),
        ]
    }
    fn kinds(&self) -> Vec<Kind> {
        vec![Kind::X, Kind::Y, Kind::X, Kind::Y]
    }
    fn scales(&self) -> Vec<f64> {
        let size = self.size();
        let both = positive(size.x.max(size.y));
        let x = if size.x > 0.0 { size.x } else { both };
        let y = if size.y > 0.0 { size.y } else { both };
        vec![x, y, x, y]
    }
    fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        vec![self.corners().map(|p| [p.x, p.y]).to_vec()]
    }
    fn inside(&self) -> bool {
        self.validate().is_ok()
    }
}

/// Returns a ring from pairs of coordinates.
fn ring(points: &[[f64; 2]]) -> Vec<Vec2<f64>> {
    points.iter().map(|&[x, y]| Vec2::new(x, y)).collect()
}

impl Sample for Vec<Vec2<f64>> {
    fn ordinary(draw: &mut Draw) -> Self {
        // Some are too long for a whole Jacobian.
        let n = match draw.below(64) {
            0 => 25 + draw.below(575),
            _ => 3 + draw.below(6),
        };
        let star = draw.once_in(2);
        let mut points: Vec<Vec2<f64>> = (0..n)
            .map(|i| {
                if star {
                    let angle = 2.0 * PI * (i as f64 + 0.8 * draw.unit()) / n as f64;
                    let reach = draw.within(0.3, 1.5);
                    Vec2::new(reach * angle.cos(), reach * angle.sin())
                } else {
                    Vec2::new(draw.within(-1.0, 1.0), draw.within(-1.0, 1.0))
                }
            })
            .collect();
        if draw.once_in(8) {
            let i = draw.below(n);
            points.insert(i, points[i]);
        }
        points
    }
    fn hard() -> Vec<Self> {
        vec![
            ring(&[[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]]),
            ring(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
            ring(&[[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]),
            ring(&[[0.0, 0.0], [2.0, 0.0], [2.0, 0.0], [1.0, 1.0]]),
            ring(&[[0.0, 0.0], [0.0, 0.0], [0.0, 0.0], [2.0, 1.0], [1.0, 3.0]]),
            ring(&[[0.0, 0.0], [1.0, 0.5], [2.0, 1.0]]),
            ring(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]),
            ring(&[
                [0.0, 0.0],
                [2.0, 0.0],
                [2.0, 1.0],
                [1.0, 1.0],
                [1.0, 2.0],
                [0.0, 2.0],
            ]),
            ring(&[[0.0, 0.0], [50.0, 0.0], [50.0, 1e-3], [0.0, 1e-3]]),
            ring(&[[1.0, 2.0], [1.0, 2.0], [1.0, 2.0]]),
            ring(&[[0.0, 0.0], [1.0, 2.0]]),
            ring(&[[0.5, 0.25]]),
            ring(&[]),
            ring(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1e-9], [0.0, 2e-9]]),
            ring(&[[1e5, 0.0], [0.0, 1e5], [-1e5, 0.0], [0.0, -1e5]]),
        ]
    }
    fn kinds(&self) -> Vec<Kind> {
        [Kind::X, Kind::Y].repeat(self.len())
    }
    fn scales(&self) -> Vec<f64> {
        let size = Aabb2::around(self).map_or(1.0, |bounds| {
            let size = bounds.size();
            // A ring that is one point has no size: its distance from the origin stands for it.
            let place = bounds.min.x.abs().max(bounds.min.y.abs());
            positive(if size.x.max(size.y) > 0.0 {
                size.x.max(size.y)
            } else {
                place
            })
        });
        vec![size; 2 * self.len()]
    }
    fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        vec![self.iter().map(|p| [p.x, p.y]).collect()]
    }
    fn inside(&self) -> bool {
        self.iter().all(|point| point.is_finite())
    }
}

impl Sample for Vec2<f64> {
    fn ordinary(draw: &mut Draw) -> Self {
        Vec2::new(draw.within(-2.0, 2.0), draw.within(-2.0, 2.0))
    }
    fn hard() -> Vec<Self> {
        vec![
            Vec2::new(0.0, 0.0),
            Vec2::new(1.0, 0.0),
            Vec2::new(0.0, -1.0),
            Vec2::new(0.5, 0.5),
            Vec2::new(0.3, -0.2),
        ]
    }
    fn kinds(&self) -> Vec<Kind> {
        vec![Kind::X, Kind::Y]
    }
    fn scales(&self) -> Vec<f64> {
        vec![positive(self.x.abs().max(self.y.abs())); 2]
    }
    fn inside(&self) -> bool {
        self.is_finite()
    }
}

impl Sample for Rotation2<f64> {
    fn ordinary(draw: &mut Draw) -> Self {
        let angle = match draw.below(6) {
            0 => FRAC_PI_4 * draw.below(8) as f64,
            _ => draw.within(-PI, PI),
        };
        Rotation2::from_angle(angle)
    }
    fn hard() -> Vec<Self> {
        let angles = [0.0, FRAC_PI_2, PI, FRAC_PI_4, 1e-9, 1e-5, 0.7];
        angles.map(Rotation2::from_angle).to_vec()
    }
    fn kinds(&self) -> Vec<Kind> {
        vec![Kind::DirectionX, Kind::DirectionY]
    }
    fn scales(&self) -> Vec<f64> {
        vec![1.0; 2]
    }
    fn inside(&self) -> bool {
        self.validate().is_ok()
    }
}

/// Returns a convex polygon on an ellipse: corners at sorted angles.
fn on_ellipse<const N: usize>(draw: &mut Draw, wide: f64, high: f64) -> ConvexPolygon<f64, N> {
    let count = 3 + draw.below(N.saturating_sub(2).max(1));
    let mut angles: Vec<f64> = (0..count.min(N))
        .map(|k| (k as f64 + draw.within(0.1, 0.9)) * 2.0 * PI / count as f64)
        .collect();
    sort_few(&mut angles, |a, b| a.total_cmp(b).is_lt());
    let turn = Rotation2::from_angle(draw.within(-PI, PI));
    let center = Vec2::new(draw.within(-1.0, 1.0), draw.within(-1.0, 1.0));
    let corners = angles.iter().map(|angle| {
        let (sin, cos) = angle.sin_cos();
        center + turn * Vec2::new(wide * cos, high * sin)
    });
    ConvexPolygon::from_vertices(&corners.collect::<Vec<_>>())
}

impl<const N: usize> Sample for ConvexPolygon<f64, N> {
    fn ordinary(draw: &mut Draw) -> Self {
        let (wide, high) = (draw.within(0.2, 1.5), draw.within(0.2, 1.5));
        on_ellipse(draw, wide, high)
    }
    fn thin(draw: &mut Draw) -> Self {
        let high = draw.magnitude(1e-6, 1e-2);
        on_ellipse(draw, 1.0, high)
    }
    fn hard() -> Vec<Self> {
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let triangle = [(0.0, 0.0), (2.0, 0.0), (1.0, 1.0)];
        let kite = [(0.0, 0.0), (1.0, -0.5), (3.0, 0.0), (1.0, 0.5)];
        let mut all = Vec::new();
        for shape in [&square[..], &triangle, &kite] {
            for (scale, shift) in [(1.0, 0.0), (1.0, 1024.0), (1e-6, 0.0), (1e6, 0.0)] {
                let moved = |&(x, y): &(f64, f64)| Vec2::new(x * scale + shift, y * scale - shift);
                let corners: Vec<_> = shape.iter().map(moved).collect();
                all.push(ConvexPolygon::from_vertices(&corners));
            }
        }
        all.retain(Sample::inside);
        all
    }
    fn kinds(&self) -> Vec<Kind> {
        [Kind::X, Kind::Y].repeat(N)
    }
    fn scales(&self) -> Vec<f64> {
        let bounds = self.bounding();
        let size = (bounds.max.x - bounds.min.x).max(bounds.max.y - bounds.min.y);
        vec![size; 2 * N]
    }
    fn inside(&self) -> bool {
        self.validate().is_ok()
    }
    fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        vec![self.as_slice().iter().map(|v| [v.x, v.y]).collect()]
    }
}

impl<A: Sample, B: Sample> Sample for (A, B) {
    fn ordinary(draw: &mut Draw) -> Self {
        (A::ordinary(draw), B::ordinary(draw))
    }
    fn thin(draw: &mut Draw) -> Self {
        match draw.below(3) {
            0 => (A::thin(draw), B::ordinary(draw)),
            1 => (A::ordinary(draw), B::thin(draw)),
            _ => (A::thin(draw), B::thin(draw)),
        }
    }
    fn touching(draw: &mut Draw) -> Self {
        let pair = (A::draw(draw), B::draw(draw));
        if pair.0.kinds() != pair.1.kinds() {
            return pair;
        }
        let beside = pair.1.refill(&pair.0.beside(draw).scalars());
        (pair.0, beside)
    }
    fn draw(draw: &mut Draw) -> Self {
        if draw.once_in(16) {
            return Self::touching(draw);
        }
        let pair = (A::draw(draw), B::draw(draw));
        if pair.0.kinds() != pair.1.kinds() || !draw.once_in(3) {
            return pair;
        }
        // Snaps some numbers of the second shape to those of the first, exactly or nearly.
        let off = if draw.once_in(2) {
            0.0
        } else {
            draw.magnitude(1e-13, 1e-2)
        };
        let (a, mut b) = (pair.0.scalars(), pair.1.scalars());
        for i in 0..b.len() {
            if draw.once_in(2) {
                b[i] = a[i] + off * draw.within(-1.0, 1.0);
            }
        }
        let snapped = (pair.0.clone(), pair.1.refill(&b));
        if snapped.inside() { snapped } else { pair }
    }
    fn hard() -> Vec<Self> {
        // Loops, since every adapter of an iterator would be compiled for every pair.
        let (first, second) = (A::hard(), B::hard());
        let mut all = Vec::with_capacity(first.len() * second.len());
        for x in first {
            for y in &second {
                all.push((x.clone(), y.clone()));
            }
        }
        all
    }
    fn kinds(&self) -> Vec<Kind> {
        [self.0.kinds(), self.1.kinds()].concat()
    }
    fn scales(&self) -> Vec<f64> {
        together([self.0.scales(), self.1.scales()].concat(), &self.kinds())
    }
    fn extents(&self) -> Vec<f64> {
        [self.0.extents(), self.1.extents()].concat()
    }
    fn units(&self) -> Vec<f64> {
        units(&self.extents(), &self.kinds())
    }
    fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        [self.0.outlines(), self.1.outlines()].concat()
    }
    fn inside(&self) -> bool {
        self.0.inside() && self.1.inside()
    }
    fn samplers() -> Vec<Sampler> {
        [A::samplers(), B::samplers()].concat()
    }
}

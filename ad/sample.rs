//! Where functions are checked: seeded random inputs, hard cases of every shape, shrinking.
//!
//! A generator of our own keeps the library free of dependencies and the samples the same on every
//! machine. Random pairs are snapped to each other now and then, so that ties, touching sides and
//! near ties come up without being asked for; whole inputs are moved far away and scaled, because
//! that is where digits are lost.
use crate::ad::symmetry::Kind;
use crate::ad::trace::Number;
use crate::error::Validate;
use crate::{Aabb2, Obb2, Pack, Vec2};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// A small seeded generator of random numbers (SplitMix64).
#[derive(Clone, Debug)]
pub struct Draw(u64);

impl Draw {
    /// From a seed; the same seed gives the same numbers on every machine.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let mut draw = Draw(seed);
        draw.bits();
        draw
    }
    /// Sixty-four random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    /// A number in `[0, 1)`.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }
    /// A number in `[low, high)`.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
    /// A positive number in `[low, high)`, all magnitudes alike.
    pub fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        self.within(low.ln(), high.ln()).exp()
    }
    /// A whole number below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }
    /// True once in `n` times.
    pub fn once_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }
}

/// An input the harness can make up by itself.
pub trait Sample: Pack<Scalar = f64> + std::fmt::Debug {
    /// A random one, of about unit size near the origin.
    fn draw(draw: &mut Draw) -> Self;
    /// The cases at which geometry fails.
    fn hard() -> Vec<Self>;
    /// What each number is.
    fn kinds(&self) -> Vec<Kind>;
    /// For each number, the length over which the function may be expected to change.
    fn scales(&self) -> Vec<f64>;
    /// For each number, the largest number of the same unit that it is added to: the size of the
    /// shape for its coordinates, one for angles.
    fn extents(&self) -> Vec<f64> {
        let (kinds, scales) = (self.kinds(), self.scales());
        let largest = (0..kinds.len())
            .filter(|&i| kinds[i] != Kind::Angle)
            .fold(0.0_f64, |m, i| m.max(scales[i]));
        let extent = |kind: &Kind| if *kind == Kind::Angle { 1.0 } else { largest };
        kinds.iter().map(extent).collect()
    }
    /// For each number, its unit: the size of the smaller shape for lengths, one for angles.
    fn units(&self) -> Vec<f64> {
        self.extents()
    }
    /// Whether it is valid.
    fn inside(&self) -> bool;
    /// What to draw of it.
    fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        Vec::new()
    }
}

/// Moves a whole input: rotation about the origin, then scaling, then translation.
#[must_use]
pub fn moved(x: &[f64], kinds: &[Kind], angle: f64, scale: f64, shift: [f64; 2]) -> Vec<f64> {
    let (sin, cos) = if angle == 0.0 {
        (0.0, 1.0)
    } else {
        angle.sin_cos()
    };
    (0..x.len())
        .map(|i| match kinds[i] {
            Kind::X => (cos * x[i] - sin * x[i + 1]) * scale + shift[0],
            Kind::Y => (sin * x[i - 1] + cos * x[i]) * scale + shift[1],
            Kind::Length => x[i] * scale,
            Kind::Angle => x[i] + angle,
        })
        .collect()
}

/// A random input, moved and scaled now and then.
pub fn random<X: Sample>(draw: &mut Draw) -> X {
    let x = X::draw(draw);
    let scale = match draw.below(16) {
        0 => 1e-4,
        1 => 1e-12,
        2 => 1e5,
        3 => draw.magnitude(1e-6, 1e6),
        _ => 1.0,
    };
    let shift = match draw.below(12) {
        0 => [1e5, -1e5],
        1 => [draw.within(-1e3, 1e3), draw.within(-1e3, 1e3)],
        _ => [0.0, 0.0],
    };
    let placed = x.refill(&moved(
        &x.scalars(),
        &x.kinds(),
        0.0,
        scale,
        shift.map(|s| s * scale),
    ));
    if placed.inside() { placed } else { x }
}

/// The hard cases as they are, turned, scaled and moved away.
pub fn hard_cases<X: Sample>() -> Vec<X> {
    let plain = X::hard();
    let turns = plain
        .first()
        .is_some_and(|x| x.kinds().contains(&Kind::Angle));
    let places = [
        (0.0, 1.0, [0.0, 0.0]),
        (0.0, 1.0, [1e5, 3.0]),
        (0.0, 1e-4, [0.0, 0.0]),
        (0.0, 1e-12, [0.0, 0.0]),
        (0.0, 1e5, [-7e5, 1e5]),
        (0.3, 1.0, [0.0, 0.0]),
        (FRAC_PI_2, 1.0, [0.0, 0.0]),
    ];
    let mut all = Vec::new();
    for (angle, scale, shift) in places {
        if angle != 0.0 && !turns {
            continue;
        }
        for x in &plain {
            let there = x.refill(&moved(&x.scalars(), &x.kinds(), angle, scale, shift));
            if there.inside() {
                all.push(there);
            }
        }
    }
    all
}

/// Simpler inputs, simplest first: fewer elements, then fewer digits. For shrinking.
pub fn simpler<S: Number, X: Pack<Scalar = S>>(x: &X) -> impl Iterator<Item = X> {
    let list: Vec<S> = x.scalars();
    let rounded = (0..list.len()).flat_map(move |i| {
        let (at, list) = (list[i].widen(), list.clone());
        let power = if at == 0.0 {
            1.0
        } else {
            10_f64.powi(at.abs().log10().floor() as i32)
        };
        let simple = [
            0.0,
            at.signum(),
            at.round(),
            (at / power).round() * power,
            (at * 64.0).round() / 64.0,
        ];
        // Simpler means fewer digits, or it might go round in circles.
        let simple = simple.into_iter().filter(move |s| digits(*s) < digits(at));
        simple.map(move |simple| {
            let mut simpler = list.clone();
            simpler[i] = S::nearest(simple);
            x.refill(&simpler)
        })
    });
    x.fewer().chain(rounded)
}

/// How long a number is when written out.
fn digits(x: f64) -> usize {
    if x == 0.0 { 0 } else { format!("{x:e}").len() }
}

/// A scale that is never zero.
fn positive(x: f64) -> f64 {
    if x > 0.0 { x } else { 1.0 }
}

impl Sample for Obb2<f64> {
    fn draw(draw: &mut Draw) -> Self {
        let heading = match draw.below(6) {
            0 => FRAC_PI_4 * draw.below(8) as f64,
            _ => draw.within(-PI, PI),
        };
        let (mut width, mut height) = (draw.within(0.2, 3.0), draw.within(0.2, 3.0));
        if draw.once_in(10) {
            (width, height) = (draw.magnitude(1.0, 50.0), draw.magnitude(1e-3, 0.1));
        }
        Obb2::new(
            draw.within(-1.2, 1.2),
            draw.within(-1.2, 1.2),
            width,
            height,
            heading,
        )
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
    fn draw(draw: &mut Draw) -> Self {
        let (x, y) = (draw.within(-1.0, 1.0), draw.within(-1.0, 1.0));
        let (mut width, mut height) = (draw.within(0.2, 3.0), draw.within(0.2, 3.0));
        if draw.once_in(10) {
            (width, height) = (draw.magnitude(1.0, 50.0), draw.magnitude(1e-3, 0.1));
        }
        Aabb2::new(x, y, x + width, y + height)
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

/// A ring from pairs of coordinates.
fn ring(points: &[[f64; 2]]) -> Vec<Vec2<f64>> {
    points.iter().map(|&[x, y]| Vec2::new(x, y)).collect()
}

impl Sample for Vec<Vec2<f64>> {
    fn draw(draw: &mut Draw) -> Self {
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
            positive(size.x.max(size.y))
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
    fn draw(draw: &mut Draw) -> Self {
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

impl<A: Sample, B: Sample> Sample for (A, B) {
    fn draw(draw: &mut Draw) -> Self {
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
        let b = B::hard();
        A::hard()
            .iter()
            .flat_map(|x| b.iter().map(|y| (x.clone(), y.clone())))
            .collect()
    }
    fn kinds(&self) -> Vec<Kind> {
        [self.0.kinds(), self.1.kinds()].concat()
    }
    fn scales(&self) -> Vec<f64> {
        // The smaller shape says over what lengths things change; a turn moves the far end of the
        // larger one.
        let (a, b, kinds) = (self.0.scales(), self.1.scales(), self.kinds());
        let own = [a, b].concat();
        let lengths = || {
            own.iter()
                .zip(&kinds)
                .filter(|(_, kind)| **kind != Kind::Angle)
        };
        let place = lengths().fold(f64::INFINITY, |m, (s, k)| match k {
            Kind::X | Kind::Y => m.min(*s),
            _ => m,
        });
        let largest = lengths().fold(0.0_f64, |m, (s, _)| m.max(*s));
        own.iter()
            .zip(&kinds)
            .map(|(own, kind)| match kind {
                Kind::Angle => (10.0 * place / largest).clamp(1e-9, 1.0),
                _ if place.is_finite() => own.min(10.0 * place),
                _ => *own,
            })
            .collect()
    }
    fn extents(&self) -> Vec<f64> {
        [self.0.extents(), self.1.extents()].concat()
    }
    fn units(&self) -> Vec<f64> {
        let (own, kinds) = (self.extents(), self.kinds());
        let lengths = own
            .iter()
            .zip(&kinds)
            .filter(|(_, kind)| **kind != Kind::Angle);
        let least = lengths.fold(f64::INFINITY, |m, (extent, _)| m.min(*extent));
        kinds
            .iter()
            .map(|kind| if *kind == Kind::Angle { 1.0 } else { least })
            .collect()
    }
    fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        [self.0.outlines(), self.1.outlines()].concat()
    }
    fn inside(&self) -> bool {
        self.0.inside() && self.1.inside()
    }
}

//! The outline to be fitted, and what the fit starts from.
use geograd::{Polygon, Vec2};
use std::f64::consts::TAU;

/// The polygon that is fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A convex polygon, to the outline without its hole.
    Convex,
    /// A polygon with a hole.
    Hole,
}

impl Shape {
    pub fn named(name: &str) -> Result<Self, String> {
        let all = [Shape::Convex, Shape::Hole];
        let found = all.into_iter().find(|shape| shape.name() == name);
        found.ok_or_else(|| "it is convex or hole".into())
    }
    pub fn name(self) -> &'static str {
        match self {
            Shape::Convex => "convex",
            Shape::Hole => "hole",
        }
    }
}

#[derive(Clone, Debug)]
pub struct Target {
    pub shape: Shape,
    /// The outline.
    pub outline: Polygon<f64>,
    /// The polygon that is to become like it.
    pub start: Polygon<f64>,
}

/// Numbers in `[0, 1)` from a seed.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Points around a place at a distance that depends on the angle.
fn around(
    middle: Vec2<f64>,
    count: usize,
    radius: impl Fn(f64) -> f64,
) -> impl Iterator<Item = Vec2<f64>> {
    (0..count).map(move |k| {
        let angle = TAU * k as f64 / count as f64;
        let (sin, cos) = angle.sin_cos();
        middle + Vec2::new(cos, sin) * radius(angle)
    })
}

impl Target {
    pub fn new(seed: u64, shape: Shape) -> Self {
        let mut dice = Dice(seed);
        let waves = [2.0_f64, 3.0, 5.0]
            .map(|n| (n, dice.roll() * TAU, (0.1 + 0.2 * dice.roll()) / n.sqrt()));
        let radius = move |angle: f64| {
            let wave = |(n, phase, high): (f64, f64, f64)| high * (n * angle + phase).cos();
            1.0 + waves.map(wave).iter().sum::<f64>()
        };
        let turn = dice.roll() * TAU;
        let hole = Vec2::new(turn.cos(), turn.sin()) * 0.12;
        let mut outline = Polygon::new();
        outline.push(around(Vec2::zero(), 72, radius));
        let mut start = Polygon::new();
        let aside = Vec2::new(0.25, -0.15);
        match shape {
            Shape::Convex => start.push(around(aside, 12, |_| 0.6)),
            Shape::Hole => {
                let squeezed = move |angle: f64| 0.3 + 0.08 * (2.0 * angle + turn).cos();
                outline.push(around(hole, 32, squeezed));
                start.push(around(aside, 32, |_| 0.7));
                start.push(around(aside, 14, |_| 0.15));
            }
        }
        Target {
            shape,
            outline,
            start,
        }
    }
}

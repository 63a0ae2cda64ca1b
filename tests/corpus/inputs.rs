//! The inputs at which a function of the corpus is checked, and the error of a gradient there.
use crate::corpus::function::Function;
use geograd::ad::check::sample::Draw;

/// Random inputs of a function, unless told otherwise.
pub const RANDOM: usize = 16;
/// How far from a kink inputs near it are, in widths of the domain.
pub const NEAR: [f64; 2] = [1e-2, 1e-4];
/// A gradient that differs from the right one by no more is the same one with its terms in another order.
pub const ROUNDING: f64 = 1e-12;
/// How far a derivative at a kink may lie outside of those found nearby, which are not all of them.
const AT_KINK: f64 = 0.1;

/// Inputs with what is right at each of them.
pub struct Inputs {
    /// Random ones first, then kinks, then inputs near kinks.
    pub points: Vec<Vec<f64>>,
    /// For each number of the input, the size that its derivative usually has: the largest one.
    pub usual: Vec<f64>,
    right: Vec<Right>,
}

/// The right derivatives at an input.
enum Right {
    /// This gradient.
    One(Vec<f64>),
    /// Whatever lies between gradients nearby, along these directions: direction, least and largest derivative.
    Between(Vec<(Vec<f64>, [f64; 2])>),
}

impl Inputs {
    /// Inputs of a function, drawn from a seed.
    #[must_use]
    pub fn new(function: &Function, random: usize, seed: u64) -> Self {
        let mut draw = Draw::new(seed ^ name_bits(function.name));
        let domain = function.domain;
        let widths: Vec<f64> = domain.iter().map(|[low, high]| high - low).collect();
        let mut points: Vec<Vec<f64>> = (0..random)
            .map(|_| {
                domain
                    .iter()
                    .map(|&[low, high]| draw.within(low, high))
                    .collect()
            })
            .collect();
        let gradient = |x: &[f64]| (function.gradient)(x);
        let mut right: Vec<Right> = points.iter().map(|x| Right::One(gradient(x))).collect();
        for kink in function.kinks {
            points.push(kink.to_vec());
            right.push(Right::between(function, kink, &widths, &mut draw));
        }
        for kink in function.kinks {
            for near in NEAR {
                let beside = |((x, width), [low, high]): ((&f64, &f64), &[f64; 2])| {
                    (x + near * width * draw.within(-1.0, 1.0)).clamp(*low, *high)
                };
                let x: Vec<f64> = kink.iter().zip(&widths).zip(domain).map(beside).collect();
                right.push(Right::One(gradient(&x)));
                points.push(x);
            }
        }
        let mut usual = vec![0.0_f64; domain.len()];
        for x in &points {
            for (usual, g) in usual.iter_mut().zip(gradient(x)) {
                *usual = usual.max(g.abs());
            }
        }
        Inputs {
            points,
            usual,
            right,
        }
    }
    /// How wrong a gradient is: the largest error of a derivative, in units of the largest derivative with respect to
    /// the same number. Zero for one that is right, infinite for one that is not finite.
    pub fn error(&self, gradient: &dyn Fn(&[f64]) -> Vec<f64>) -> f64 {
        let mut worst = 0.0_f64;
        for (x, right) in self.points.iter().zip(&self.right) {
            let g = gradient(x);
            if g.len() != x.len() || !g.iter().all(|g| g.is_finite()) {
                return f64::INFINITY;
            }
            worst = worst.max(right.error(&g, &self.usual));
        }
        worst
    }
}

impl Inputs {
    /// `true` if a gradient is finite, and each of its errors is a jump as large between neighbours in the last digit
    /// of the input. Such a gradient is wrong at single inputs only, or by rounding only.
    #[must_use]
    pub fn unsteady(&self, gradient: &dyn Fn(&[f64]) -> Vec<f64>) -> bool {
        let mut draw = Draw::new(0);
        self.points.iter().zip(&self.right).all(|(x, right)| {
            let here = gradient(x);
            let error = right.error(&here, &self.usual);
            let (finite, here) = (here.iter().all(|g| g.is_finite()), Right::One(here));
            let mut jump = || {
                let moved = |x: &f64| {
                    if draw.once_in(2) {
                        x.next_up()
                    } else {
                        x.next_down()
                    }
                };
                let beside: Vec<f64> = x.iter().map(moved).collect();
                here.error(&gradient(&beside), &self.usual)
            };
            finite && (error <= ROUNDING || (0..4).any(|_| jump() >= 0.1 * error))
        })
    }
}

impl Right {
    /// Gradients around a kink, and the derivatives that they bound along the axes, between pairs of them, and
    /// elsewhere.
    fn between(function: &Function, kink: &[f64], widths: &[f64], draw: &mut Draw) -> Self {
        let n = kink.len();
        let random =
            |draw: &mut Draw| -> Vec<f64> { (0..n).map(|_| draw.within(-1.0, 1.0)).collect() };
        let mut around: Vec<Vec<f64>> = vec![(function.gradient)(kink)];
        for _ in 0..400 {
            let step = random(draw);
            let x: Vec<f64> = (0..n)
                .map(|i| kink[i] + 1e-6 * widths[i] * step[i])
                .collect();
            around.push((function.gradient)(&x));
        }
        let mut directions: Vec<Vec<f64>> = Vec::new();
        let axis = |i: usize| (0..n).map(move |k| f64::from(k == i));
        for i in 0..n {
            directions.push(axis(i).collect());
            for j in 0..i {
                directions.push(axis(i).zip(axis(j)).map(|(a, b)| a + b).collect());
                directions.push(axis(i).zip(axis(j)).map(|(a, b)| a - b).collect());
            }
        }
        directions.extend((0..n).map(|_| random(draw)));
        let bounded = directions.into_iter().map(|d| {
            let derivatives = around.iter().map(|g| along(g, &d));
            let none = [f64::INFINITY, f64::NEG_INFINITY];
            let bounds = derivatives.fold(none, |[low, high], s| [low.min(s), high.max(s)]);
            (d, bounds)
        });
        Right::Between(bounded.collect())
    }
    fn error(&self, g: &[f64], usual: &[f64]) -> f64 {
        match self {
            Right::One(right) => (0..g.len())
                .filter(|&i| g[i] != right[i])
                .map(|i| (g[i] - right[i]).abs() / size(usual[i]))
                .fold(0.0, f64::max),
            Right::Between(bounds) => bounds
                .iter()
                .map(|(d, [low, high])| {
                    let derivative = along(g, d);
                    let unit = (0..g.len())
                        .map(|i| (usual[i] * d[i]).abs())
                        .fold(0.0, f64::max);
                    (low - derivative).max(derivative - high) / size(unit)
                })
                .filter(|&error| error > AT_KINK)
                .fold(0.0, f64::max),
        }
    }
}

/// A unit: of derivatives that are all zero, one.
fn size(usual: f64) -> f64 {
    if usual > 0.0 { usual } else { 1.0 }
}

fn along(g: &[f64], direction: &[f64]) -> f64 {
    g.iter().zip(direction).map(|(g, d)| g * d).sum()
}

/// Some bits of a name: each function has inputs of its own.
pub(crate) fn name_bits(name: &str) -> u64 {
    name.bytes().fold(0xcbf2_9ce4_8422_2325, |h, b| {
        (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3)
    })
}

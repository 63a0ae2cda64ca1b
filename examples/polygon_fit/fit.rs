//! Gradient descent on the vertices of a polygon.
use crate::target::{Shape, Target};
use geograd::ad::adjoint::overlap_rings::iou_vjp;
use geograd::distance::ring::{EdgeFold, fold_ring};
use geograd::overlap_polygon::rings::iou;
use geograd::shape::edges;
use geograd::{Pack, Polygon, Scalar, Vec2};

/// What is made small.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss {
    /// One less the intersection over union.
    Overlap,
    /// Mean squared distances of points of either border from the other one.
    Distance,
}

impl Loss {
    pub fn named(name: &str) -> Result<Self, String> {
        let all = [Loss::Overlap, Loss::Distance];
        let found = all.into_iter().find(|loss| loss.name() == name);
        found.ok_or_else(|| "it is overlap or distance".into())
    }
    pub fn name(self) -> &'static str {
        match self {
            Loss::Overlap => "overlap",
            Loss::Distance => "distance",
        }
    }
    /// The loss and its slopes by the vertices of a polygon.
    fn with_slopes(self, polygon: &Polygon<f64>, outline: &Polygon<f64>) -> (f64, Vec<Vec2<f64>>) {
        match self {
            Loss::Overlap => {
                // The adjoint by hand.
                let mut bars = vec![Vec2::zero(); polygon.vertices().len()];
                let mut unused = vec![Vec2::zero(); outline.vertices().len()];
                let iou = iou_vjp(polygon, outline, -1.0, &mut bars, &mut unused);
                (1.0 - iou, bars)
            }
            Loss::Distance => {
                // Any generic function can be differentiated.
                let of = |p: Polygon<_>| between(&p, &outline.lift());
                let (loss, slopes) = geograd::gradient(of, polygon.clone());
                (loss, slopes.vertices().to_vec())
            }
        }
    }
}

/// The distance from a point to the nearest border.
fn distance<S: Scalar<Mask = bool>>(point: Vec2<S>, polygon: &Polygon<S>) -> S {
    let rings = polygon.rings();
    let all = rings.iter().map(|ring| fold_ring(point, ring));
    all.fold(EdgeFold::empty(), EdgeFold::join).distance()
}

/// The mean squared distance of vertices and middles of edges of one polygon from the border of another.
fn one_way<S: Scalar<Mask = bool>>(from: &Polygon<S>, to: &Polygon<S>) -> S {
    let (mut sum, mut count) = (S::zero(), 0.0);
    let rings = from.rings();
    for [start, end] in rings.iter().flat_map(|ring| edges(ring)) {
        let middle = (start + end) * S::lit(0.5);
        sum += distance(start, to).squared() + distance(middle, to).squared();
        count += 2.0;
    }
    sum * S::lit(1.0 / count)
}

fn between<S: Scalar<Mask = bool>>(a: &Polygon<S>, b: &Polygon<S>) -> S {
    one_way(a, b) + one_way(b, a)
}

/// Where a fit stands.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    pub loss: f64,
    pub iou: f64,
}

#[derive(Clone, Debug)]
pub struct Fit {
    pub target: Target,
    pub loss: Loss,
    /// The start, and after every step.
    pub steps: Vec<Step>,
    /// The polygon at the end.
    pub found: Polygon<f64>,
}

/// How far vertices move in the first steps, and in the last ones.
const PACE: [f64; 2] = [0.02, 0.0005];

impl Fit {
    pub fn run(target: Target, loss: Loss, iterations: usize, mut done: impl FnMut()) -> Self {
        let mut found = target.start.clone();
        let mut steps = Vec::new();
        let count = found.vertices().len();
        // Adam: steps in units of how large slopes have been lately.
        let (mut mean, mut square) = (vec![Vec2::zero(); count], vec![Vec2::zero(); count]);
        for k in 0..=iterations {
            let (value, slopes) = loss.with_slopes(&found, &target.outline);
            let score = iou(&found, &target.outline);
            steps.push(Step {
                loss: value,
                iou: score,
            });
            if k == iterations {
                break;
            }
            let progress = k as f64 / iterations as f64;
            let pace = PACE[0] * (PACE[1] / PACE[0]).powf(progress);
            let fresh = [
                1.0 - 0.9_f64.powi(k as i32 + 1),
                1.0 - 0.99_f64.powi(k as i32 + 1),
            ];
            for (i, slope) in slopes.into_iter().enumerate() {
                mean[i] = mean[i] * 0.9 + slope * 0.1;
                square[i] = square[i] * 0.99 + Vec2::new(slope.x.powi(2), slope.y.powi(2)) * 0.01;
                let step = |mean: f64, square: f64| {
                    let size = (square / fresh[1]).sqrt().max(1e-9);
                    pace * mean / fresh[0] / size
                };
                let way = Vec2::new(step(mean[i].x, square[i].x), step(mean[i].y, square[i].y));
                found.vertices_mut()[i] += -way;
            }
            if target.shape == Shape::Convex {
                make_convex(found.vertices_mut());
            }
            done();
        }
        Fit {
            target,
            loss,
            steps,
            found,
        }
    }
}

/// Moves vertices that turn inwards to the line between their neighbours, until none does.
fn make_convex(ring: &mut [Vec2<f64>]) {
    let n = ring.len();
    for _ in 0..8 {
        let mut changed = false;
        for k in 0..n {
            let (before, after) = (ring[(k + n - 1) % n], ring[(k + 1) % n]);
            let (along, arm) = (after - before, ring[k] - before);
            if along.perp_dot(arm) > 0.0 {
                let share = (along.dot(arm) / along.length_squared()).clamp(0.0, 1.0);
                ring[k] = before + along * share;
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
}

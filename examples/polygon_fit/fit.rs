//! Gradient descent on the vertices of a polygon.
use crate::target::{Shape, Target};
use geograd::ad::adjoint::overlap_rings::iou_vjp;
use geograd::distance::ring::distance_to_ring;
use geograd::overlap_polygon::holed::iou;
use geograd::predicate::{Turn, turn};
use geograd::shape::edges;
use geograd::{Pack, Polygon, Scalar, Vec2};

/// The loss that a fit minimizes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss {
    /// One less the intersection over union.
    Overlap,
    /// Mean squared distances of points of each ring from the same one of the outline, and back.
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
    fn of(self, polygon: &Polygon<f64>, outline: &Polygon<f64>) -> f64 {
        match self {
            Loss::Overlap => 1.0 - iou(polygon, outline),
            Loss::Distance => between(polygon, outline),
        }
    }
    /// The derivatives of the loss by the vertices of a polygon.
    fn derivatives(self, polygon: &Polygon<f64>, outline: &Polygon<f64>) -> Vec<Vec2<f64>> {
        match self {
            Loss::Overlap => {
                // The adjoint by hand.
                let mut bars = vec![Vec2::zero(); polygon.vertices().len()];
                let mut unused = vec![Vec2::zero(); outline.vertices().len()];
                iou_vjp(polygon, outline, -1.0, &mut bars, &mut unused);
                bars
            }
            Loss::Distance => {
                // Any generic function can be differentiated.
                let of = |p: Polygon<_>| between(&p, &outline.lift());
                let (_, derivatives) = geograd::gradient(of, polygon.clone());
                derivatives.vertices().to_vec()
            }
        }
    }
}

/// The mean squared distance of vertices and middles of edges of one ring from another one.
fn one_way<S: Scalar<Mask = bool>>(from: &[Vec2<S>], to: &[Vec2<S>]) -> S {
    let mut sum = S::zero();
    for [start, end] in edges(from) {
        let middle = (start + end) * S::lit(0.5);
        sum += distance_to_ring(start, to).squared() + distance_to_ring(middle, to).squared();
    }
    sum * S::lit(0.5 / from.len() as f64)
}

/// The sum over outer rings and holes, both ways.
fn between<S: Scalar<Mask = bool>>(a: &Polygon<S>, b: &Polygon<S>) -> S {
    let (a, b) = (a.rings(), b.rings());
    let mut sum = S::zero();
    for (p, q) in a.iter().zip(b.iter()) {
        sum += one_way(p, q) + one_way(q, p);
    }
    sum
}

/// The state of a fit.
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

/// The longest way of a vertex in a step, at first and at most.
const PACE: f64 = 0.05;
/// How far vertices even out along the border in a step, as a share of their way to the middle between
/// both neighbours.
const EVEN: f64 = 0.1;
/// How often a step that does not help is halved.
const HALVINGS: usize = 16;

impl Fit {
    pub fn run(target: Target, loss: Loss, iterations: usize, mut done: impl FnMut()) -> Self {
        let outline = &target.outline;
        let mut found = target.start.clone();
        let mut value = loss.of(&found, outline);
        let mut steps = vec![Step {
            loss: value,
            iou: iou(&found, outline),
        }];
        let mut pace = PACE;
        for _ in 0..iterations {
            let way = descent(&found, &loss.derivatives(&found, outline));
            for _ in 0..HALVINGS {
                let next = moved(&found, &way, pace, target.shape);
                let less = loss.of(&next, outline);
                if less < value && is_simple(&next) {
                    (found, value) = (next, less);
                    pace = (1.5 * pace).min(PACE);
                    break;
                }
                pace *= 0.5;
            }
            steps.push(Step {
                loss: value,
                iou: iou(&found, outline),
            });
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

/// The direction of descent, the longest way of a vertex being one. Neighbours take part in each other's
/// derivatives, so that borders stay smooth.
fn descent(polygon: &Polygon<f64>, derivatives: &[Vec2<f64>]) -> Vec<Vec2<f64>> {
    let mut way: Vec<_> = derivatives.iter().map(|&derivative| -derivative).collect();
    let mut start = 0;
    for &end in polygon.ends() {
        let ring = &mut way[start..end];
        let n = ring.len();
        let before = ring.to_vec();
        for (k, here) in ring.iter_mut().enumerate() {
            let beside = before[(k + n - 1) % n] + before[(k + 1) % n];
            *here = before[k] * 0.5 + beside * 0.25;
        }
        start = end;
    }
    let longest = way.iter().map(|way| way.length()).fold(0.0, f64::max);
    let scale = if longest > 0.0 { 1.0 / longest } else { 0.0 };
    way.into_iter().map(|way| way * scale).collect()
}

/// The polygon after a step.
fn moved(polygon: &Polygon<f64>, way: &[Vec2<f64>], pace: f64, shape: Shape) -> Polygon<f64> {
    let mut next = polygon.clone();
    for (vertex, &way) in next.vertices_mut().iter_mut().zip(way) {
        *vertex += way * pace;
    }
    let mut start = 0;
    for &end in polygon.ends() {
        let ring = &mut next.vertices_mut()[start..end];
        let (n, before) = (ring.len(), ring.to_vec());
        for (k, here) in ring.iter_mut().enumerate() {
            let (left, right) = (before[(k + n - 1) % n], before[(k + 1) % n]);
            let along = (right - left).normalize_or_zero();
            let middle = (left + right) * 0.5 - before[k];
            *here += along * (middle.dot(along) * EVEN * (pace / PACE));
        }
        if shape == Shape::Convex {
            make_convex(ring);
        }
        start = end;
    }
    next
}

/// `true` if no two edges cross.
fn is_simple(polygon: &Polygon<f64>) -> bool {
    let rings = polygon.rings();
    let all: Vec<_> = rings.iter().flat_map(edges).collect();
    let sides = |[a, b]: [Vec2<f64>; 2], [p, q]: [Vec2<f64>; 2]| {
        matches!(
            (turn(a, b, p), turn(a, b, q)),
            (Turn::Left, Turn::Right) | (Turn::Right, Turn::Left)
        )
    };
    let crosses = |&e: &[Vec2<f64>; 2], &f: &[Vec2<f64>; 2]| sides(e, f) && sides(f, e);
    (0..all.len()).all(|i| all[..i].iter().all(|f| !crosses(&all[i], f)))
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

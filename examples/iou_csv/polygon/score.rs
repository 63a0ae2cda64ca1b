//! Scores of two simple polygons, and their derivatives by the vertices of both.
use super::part::{Derivatives, bounding_area, diagonal, diameter, hull, intersection, own_areas};
use super::simple::{Polygon, unit};
use crate::metric::{Enclosing, Metric};
use common::compute::Number;
use geograd::ad::adjoint::ring::centroid_vjp;
use geograd::{Vec2, ring};

/// The score, and its derivatives where they are wanted.
pub fn score<T: Number>(
    metric: Metric,
    a: &Polygon<T>,
    b: &Polygon<T>,
    derivatives: Option<&mut Derivatives<T>>,
) -> T {
    let scale = unit(a.bounds.join(b.bounds));
    if scale == T::one() {
        return ordinary(metric, a, b, derivatives);
    }
    let (a, b) = (a.scaled(scale), b.scaled(scale));
    let Some(derivatives) = derivatives else {
        return ordinary(metric, &a, &b, None);
    };
    let score = ordinary(metric, &a, &b, Some(derivatives));
    for by in derivatives.a.iter_mut().chain(&mut derivatives.b) {
        *by = Vec2::new((by.x * scale).saturated(), (by.y * scale).saturated());
    }
    score
}

/// The score of polygons of ordinary size.
fn ordinary<T: Number>(
    metric: Metric,
    a: &Polygon<T>,
    b: &Polygon<T>,
    mut derivatives: Option<&mut Derivatives<T>>,
) -> T {
    let (zero, one) = (T::zero(), T::one());
    let inter = intersection(a, b, derivatives.is_some());
    let union = a.area + b.area - inter.value;
    // A polygon without area shares nothing.
    let empty = T::lit(T::format().empty());
    let over = |x: T, y: T| if y > empty { x / y } else { zero };
    let same = is_same(a, b);
    let iou = match same && a.area > empty {
        true => one,
        false => over(inter.value, union),
    };
    let mut add = |part: &Derivatives<T>, factor: T| {
        if let Some(derivatives) = &mut derivatives {
            derivatives.add(part, factor);
        }
    };
    if metric == Metric::Iof {
        add(&inter.derivatives, over(one, a.area));
        // At most one, whatever the rounding.
        let iof = over(inter.value, a.area).least(one);
        add(&own_areas(a, b, [over(-iof, a.area), zero]), one);
        return if same && a.area > empty { one } else { iof };
    }
    // dr = ((1 + r) dI − r (dA + dB)) / U. For the same polygon twice the terms cancel.
    if !same {
        let each = over(-iou, union);
        add(&inter.derivatives, over(one + iou, union));
        add(&own_areas(a, b, [each, each]), one);
    }
    match metric {
        Metric::Iou | Metric::Iof | Metric::Ciou(_) | Metric::Eiou(_) => iou,
        Metric::Giou(around) => {
            let hull = match around {
                Enclosing::Aabb => bounding_area(a, b),
                Enclosing::Rect | Enclosing::Hull => hull(a, b),
            };
            let (by_union, by_hull) = (
                over(one, hull.value),
                over(over(-union, hull.value), hull.value),
            );
            add(&inter.derivatives, -by_union);
            add(&own_areas(a, b, [by_union, by_union]), one);
            add(&hull.derivatives, by_hull);
            // Rounding can leave the hull a little smaller than what it encloses.
            iou - over((hull.value - union).most(zero), hull.value)
        }
        Metric::Diou(_) | Metric::DiouBox => {
            let around = match metric {
                Metric::Diou(Enclosing::Hull | Enclosing::Rect) => diameter(a, b),
                _ => diagonal(a, b),
            };
            let (from, to) = (ring::centroid(&a.vertices), ring::centroid(&b.vertices));
            let way = to - from;
            let per = |x: T| over(x, around.value);
            let share = per(way.x).squared() + per(way.y).squared();
            add(&around.derivatives, per(share + share));
            let pull = Vec2::new(per(per(way.x)), per(per(way.y))) * T::lit(2.0);
            let mut centers = Derivatives::new(a, b);
            centroid_vjp(&a.vertices, pull, &mut centers.a);
            centroid_vjp(&b.vertices, -pull, &mut centers.b);
            add(&centers, one);
            iou - share.least(one)
        }
    }
}

/// `true` if both have the same vertices in the same order, from any start.
fn is_same<T: Number>(a: &Polygon<T>, b: &Polygon<T>) -> bool {
    let n = a.count();
    let from = |start: usize| (0..n).all(|k| a.vertices[k] == b.vertices[(start + k) % n]);
    a.bounds == b.bounds && n == b.count() && (0..n).any(from)
}

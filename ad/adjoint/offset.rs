//! Adjoint of offsets: cotangents of the vertices of a result go back to the input and the distance.
use super::boolean::{overlay_vjp, valid_vjp};
use super::polygon::perimeter_vjp as polygon_perimeter_vjp;
use super::ring::signed_area_vjp;
use crate::offset::{
    Before, Bend, Laid, OffsetTrace, Plan, ValidOffsetTrace, cut_share, directions, offset_replay,
    right,
};
use crate::polygon::{self, Polygon, Rings};
use crate::{Scalar, Vec2};

/// Writes the cotangents of the input of [`offset_replay`], one per vertex, from those of
/// the vertices of the result, one ring after the other; returns the cotangent of the distance.
///
/// The overlay passes a cotangent to the raw rings, each raw vertex to its corner and so to three vertices and the
/// distance. With the normal `n` and the direction `u` of an edge of length `l`, `ū` collects what its two ends receive,
/// and the ends of the edge get `±(ū − u (u · ū)) / l`.
///
/// # Panics
///
/// When the record is of another input, or a list of cotangents is too short.
pub fn offset_vjp<'a, S: Scalar>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    trace: &OffsetTrace,
    out_bar: &[Vec2<S>],
    rings_bar: &mut [Vec2<S>],
) -> S {
    pulled(
        rings.into(),
        d,
        &trace.laid,
        rings_bar,
        |a, b, into_a, into_b| {
            overlay_vjp(a, b, &trace.result, out_bar, into_a, into_b);
        },
    )
}

/// Writes the cotangents of the input of [`valid_offset_replay`](crate::offset::valid_offset_replay), one per vertex, from
/// those of the vertices of the result, one part and one ring after the other; returns the cotangent of the distance.
///
/// # Panics
///
/// When the record is of another input, or a list of cotangents is too short.
pub fn valid_offset_vjp<'a, S: Scalar>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    trace: &ValidOffsetTrace,
    out_bar: &[Vec2<S>],
    rings_bar: &mut [Vec2<S>],
) -> S {
    pulled(
        rings.into(),
        d,
        &trace.laid,
        rings_bar,
        |a, b, into_a, into_b| {
            valid_vjp(a, b, &trace.result, out_bar, into_a, into_b);
        },
    )
}

/// Returns the area of an offset, in squared units of length, and the cotangent of the distance; writes those of the
/// input, one per vertex.
///
/// ```
/// # #[cfg(feature = "boolean")] {
/// use geograd::{Aabb2, Vec2, ad::adjoint::offset::offset_area_vjp, offset::{Join, OffsetStyle, offset_search}};
/// let square = Aabb2::new(0.0, 0.0, 4.0, 4.0).corners();
/// let style = OffsetStyle { join: Join::Mitre(2.0), ..OffsetStyle::default() };
/// let trace = offset_search(&square, 1.0, &style)?;
/// let mut bars = [Vec2::zero(); 4];
/// assert_eq!(offset_area_vjp(&square, 1.0, &trace, 1.0, &mut bars), (36.0, 24.0));
/// assert_eq!(bars[0], Vec2::new(-3.0, -3.0));
/// # }
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Panics
///
/// When the record is of another input, or the list of cotangents is too short.
pub fn offset_area_vjp<'a, S: Scalar>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    trace: &OffsetTrace,
    out_bar: S,
    rings_bar: &mut [Vec2<S>],
) -> (S, S) {
    let rings = rings.into();
    let shape = offset_replay(rings, d, trace);
    let mut bars = vec![Vec2::zero(); shape.vertices().len()];
    let mut start = 0;
    for ring in shape.rings().iter() {
        signed_area_vjp(ring, out_bar, &mut bars[start..start + ring.len()]);
        start += ring.len();
    }
    let by_distance = offset_vjp(rings, d, trace, &bars, rings_bar);
    (polygon::signed_area(&shape), by_distance)
}

/// Returns the perimeter of an offset, in units of length, and the cotangent of the distance; writes those of the input,
/// one per vertex.
///
/// # Panics
///
/// When the record is of another input, or the list of cotangents is too short.
pub fn offset_perimeter_vjp<'a, S: Scalar>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    trace: &OffsetTrace,
    out_bar: S,
    rings_bar: &mut [Vec2<S>],
) -> (S, S) {
    let rings = rings.into();
    let shape = offset_replay(rings, d, trace);
    let mut bars = vec![Vec2::zero(); shape.vertices().len()];
    polygon_perimeter_vjp(&shape, out_bar, &mut bars);
    let by_distance = offset_vjp(rings, d, trace, &bars, rings_bar);
    (polygon::perimeter(&shape), by_distance)
}

/// Pulls cotangents back through the raw rings and the union before them; `of_result` writes those of both inputs of the
/// boolean operation.
fn pulled<S: Scalar>(
    rings: Rings<'_, S>,
    d: S,
    laid: &Laid,
    rings_bar: &mut [Vec2<S>],
    of_result: impl FnOnce(&Polygon<S>, &Polygon<S>, &mut [Vec2<S>], &mut [Vec2<S>]),
) -> S {
    let polygon = laid.polygon(rings);
    let [a, b] = laid.inputs(&polygon, d);
    let zeros = |of: &Polygon<S>| vec![Vec2::zero(); of.vertices().len()];
    let (mut a_bar, mut b_bar) = (zeros(&a), zeros(&b));
    of_result(&a, &b, &mut a_bar, &mut b_bar);
    let raw_bar = match laid.plan.is_inward {
        // After the frame.
        true => &b_bar[4..],
        false => &a_bar[..],
    };
    let mut bars = Raw {
        points: polygon.vertices(),
        bars: zeros(&polygon),
        radius_bar: S::zero(),
    };
    bars.pull(laid, d, raw_bar);
    let Raw {
        bars, radius_bar, ..
    } = bars;
    pulled_before(rings, &laid.before, &bars, rings_bar);
    laid.plan.radius(radius_bar).saturated().canonical()
}

/// Writes the cotangents of an input from those of the polygon that is offset.
pub(super) fn pulled_before<S: Scalar>(
    rings: Rings<'_, S>,
    before: &Before,
    bars: &[Vec2<S>],
    rings_bar: &mut [Vec2<S>],
) {
    let nothing = Rings::flat(&[], &[]);
    match before {
        Before::Given => {
            for (bar, found) in rings_bar[..bars.len()].iter_mut().zip(bars) {
                *bar = found.saturated().canonical();
            }
        }
        Before::United(trace) => overlay_vjp(rings, nothing, trace, bars, rings_bar, &mut []),
        Before::Valid(trace) => valid_vjp(rings, nothing, trace, bars, rings_bar, &mut []),
    }
}

/// The cotangents of the vertices that raw rings are of, and of the distance by which these move.
struct Raw<'a, S> {
    points: &'a [Vec2<S>],
    bars: Vec<Vec2<S>>,
    radius_bar: S,
}

impl<S: Scalar> Raw<'_, S> {
    fn pull(&mut self, laid: &Laid, d: S, raw_bar: &[Vec2<S>]) {
        let r = laid.plan.radius(d);
        let mut rest = raw_bar;
        for walk in &laid.plan.walks {
            let n = walk.len();
            let ways = directions(self.points, walk);
            let mut way_bars = vec![Vec2::zero(); n];
            for k in 0..n {
                let (vertex, bend) = walk[k];
                let before = (k + n - 1) % n;
                let (own, others) = rest.split_at(bend.count());
                rest = others;
                let both = [ways[before].0, ways[k].0];
                let sum = own.iter().fold(Vec2::zero(), |sum, &bar| sum + bar);
                self.bars[vertex] += sum;
                let (u_bar, w_bar) = self.corner(both, r, bend, own, &laid.plan);
                way_bars[before] += u_bar;
                way_bars[k] += w_bar;
            }
            for k in 0..n {
                let ((way, length), bar) = (ways[k], way_bars[k]);
                let across = bar - way * way.dot(bar);
                let across = Vec2::new(across.x.over(length), across.y.over(length));
                self.bars[walk[k].0] -= across;
                self.bars[walk[(k + 1) % n].0] += across;
            }
        }
    }
    /// Returns the cotangents of the directions of the edges at a corner from those of its raw vertices, and adds that of
    /// the distance.
    fn corner(
        &mut self,
        [u, w]: [Vec2<S>; 2],
        r: S,
        bend: Bend,
        own: &[Vec2<S>],
        plan: &Plan,
    ) -> (Vec2<S>, Vec2<S>) {
        let [n, m] = [u, w].map(right);
        // Cotangents of the directions apart from their normals, then of the normals.
        let (mut u_bar, mut w_bar) = (Vec2::zero(), Vec2::zero());
        let (mut n_bar, mut m_bar) = (Vec2::zero(), Vec2::zero());
        // The first and last raw vertex are ends of the moved edges, but for a tip.
        let (first, last) = (own[0], own[own.len() - 1]);
        if bend != Bend::Tip {
            m_bar += last * r;
            self.radius_bar += last.dot(m);
            if bend != Bend::Straight {
                n_bar += first * r;
                self.radius_bar += first.dot(n);
            }
        }
        match bend {
            Bend::Straight | Bend::Inner | Bend::Bevel => {}
            Bend::Tip => {
                let whole = n + m;
                let square = whole.length_squared();
                let share = (r + r).over(square);
                let share_bar = first.dot(whole).over(square);
                let share_bar = share_bar + share_bar;
                let of_whole = first * share - whole * (share * share_bar);
                n_bar += of_whole;
                m_bar += of_whole;
                self.radius_bar += share_bar;
            }
            Bend::Round(count) => {
                for (&bar, turn) in own[1..].iter().zip(&plan.turns[..count]) {
                    let [cos, sin] = turn.map(S::lit);
                    let back = Vec2::new(bar.x * cos + bar.y * sin, bar.y * cos - bar.x * sin);
                    n_bar += back * r;
                    self.radius_bar += back.dot(n);
                }
            }
            Bend::Cut => {
                let share = cut_share(u, w, plan.limit);
                let along_bar = first.dot(u) - last.dot(w);
                u_bar += first * (r * share);
                w_bar -= last * (r * share);
                self.radius_bar += share * along_bar;
                let across = u - w;
                let square = across.length_squared();
                let of_share = (r * along_bar).over(square);
                let by_square = S::lit(plan.limit).over(square.root()) - share;
                let of_across = across * (of_share * (by_square + by_square));
                let of_cross = -(of_share + of_share);
                u_bar += of_across + m * of_cross;
                w_bar -= of_across + n * of_cross;
            }
            Bend::Square => {
                let sum = first + last;
                u_bar += sum * r;
                self.radius_bar += sum.dot(u);
            }
        }
        // A normal is a direction turned right: its cotangent turns back.
        (u_bar - right(n_bar), w_bar - right(m_bar))
    }
}

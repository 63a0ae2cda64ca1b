//! Adjoint of the area and the perimeter of offsets with exact arcs, by the motion of the border.
//!
//! A point of an edge of length `L` at the share `t`, moved by `r` along the normal `n`, moves along `n` by
//! `(1 − t) n·a' + t n·b' + r'`; a point of the arc about `c` by `m·c' + r'`, `m` being the direction from `c`. The area
//! changes by the integral of these (Reynolds): with `s` and `t` the shares of both ends of what is left of an edge,
//!
//! ```text
//! edge:       a  n L (u − v)    b  n L v    r  L u          u = t − s,  v = (t² − s²) / 2
//! arc p → q:  c  (q − p) turned right       r  r · sweep
//! ```
//!
//! The perimeter changes by the integral of curvature times motion, and at a crossing, where the border turns by `θ`, by
//! `tan(θ/2)` times the sum of both motions. No crossing is differentiated, so no digits are lost where curves cross at a
//! small angle. Inward `r` is the negative distance, and the area counts the other side.
use super::offset::{offset_area_vjp, offset_perimeter_vjp, pulled_before};
use crate::offset::{
    OffsetCurve, OffsetMeasures, PieceEnd, RoundBorder, RoundOffsetTrace, RoundWay, right, sweep,
};
use crate::polygon::Rings;
use crate::{Scalar, Vec2};

/// Returns the area and the perimeter of an offset with round corners and ends, and the cotangent of the distance; writes
/// those of the input, one per vertex. `trace` is the record of `round_offset_search` or `round_path_offset_search`.
///
/// ```
/// # #[cfg(feature = "boolean")] {
/// use geograd::ad::adjoint::round_offset::round_offset_vjp;
/// use geograd::{Aabb2, Vec2, offset::{OffsetMeasures, OffsetStyle, round_offset_search}};
/// let square = Aabb2::new(0.0_f64, 0.0, 4.0, 4.0).corners();
/// let trace = round_offset_search(&square, 1.0, &OffsetStyle::default())?;
/// let (bar, mut bars) = (OffsetMeasures { area: 1.0, perimeter: 0.0 }, [Vec2::zero(); 4]);
/// let (measures, by_distance) = round_offset_vjp(&square, 1.0, &trace, bar, &mut bars);
/// // The area grows by the perimeter.
/// assert!((by_distance - measures.perimeter).abs() < 1e-14);
/// assert!((bars[0] - Vec2::new(-3.0, -3.0)).length() < 1e-14);
/// # }
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Panics
///
/// When the record is of another input, or the list of cotangents is too short.
pub fn round_offset_vjp<'a, S: Scalar>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    trace: &RoundOffsetTrace,
    out_bar: OffsetMeasures<S>,
    rings_bar: &mut [Vec2<S>],
) -> (OffsetMeasures<S>, S) {
    let rings = rings.into();
    let (before, all) = match &trace.way {
        RoundWay::Arcs(before, all) => (before, all),
        RoundWay::Chords(trace) => {
            let (area, of_area) = offset_area_vjp(rings, d, trace, out_bar.area, rings_bar);
            let mut bars = vec![Vec2::zero(); rings_bar.len()];
            let (perimeter, of_perimeter) =
                offset_perimeter_vjp(rings, d, trace, out_bar.perimeter, &mut bars);
            for (bar, other) in rings_bar.iter_mut().zip(bars) {
                *bar += other;
            }
            return (OffsetMeasures { area, perimeter }, of_area + of_perimeter);
        }
    };
    let polygon = before.polygon(rings);
    let border = RoundBorder::new(polygon.vertices(), d, all);
    let side = if all.is_inward { -S::one() } else { S::one() };
    let mut motion = Motion {
        border: &border,
        // The derivative of an area by a local coordinate is a length.
        area_bar: border.seen.outer(out_bar.area * side),
        perimeter_bar: out_bar.perimeter,
        bars: vec![Vec2::zero(); polygon.vertices().len()],
        radius_bar: S::zero(),
    };
    for piece in &all.pieces {
        let [p, q] = border.ends(piece);
        match piece.curve {
            OffsetCurve::Side(side) => motion.side_integral(side, p.at, q.at),
            OffsetCurve::Arc(arc) => motion.arc_integral(arc, [p.at, q.at], [p.way, q.way]),
        }
        if let PieceEnd::At(other) = piece.from {
            let turn = motion.half_turn(other, piece.curve, p.at);
            motion.moved(piece.curve, p.at, turn);
        }
        if let PieceEnd::At(other) = piece.to {
            let turn = motion.half_turn(piece.curve, other, q.at);
            motion.moved(piece.curve, q.at, turn);
        }
    }
    let Motion {
        bars, radius_bar, ..
    } = motion;
    pulled_before(rings, before, &bars, rings_bar);
    let measures = border.outer(border.measures());
    (measures, (radius_bar * side).saturated().canonical())
}

/// Sums of what the motion of each curve changes.
struct Motion<'a, S> {
    border: &'a RoundBorder<'a, S>,
    area_bar: S,
    perimeter_bar: S,
    bars: Vec<Vec2<S>>,
    radius_bar: S,
}

impl<S: Scalar> Motion<'_, S> {
    /// Adds to both ends of a side.
    fn add_to_side(&mut self, side: u32, at_start: Vec2<S>, at_end: Vec2<S>) {
        let [i, j] = self.border.all.edges[side as usize / 2];
        let (i, j) = if side.is_multiple_of(2) {
            (i, j)
        } else {
            (j, i)
        };
        self.bars[i as usize] += at_start;
        self.bars[j as usize] += at_end;
    }
    /// Adds to the center of an arc.
    fn add_to_arc(&mut self, arc: u32, bar: Vec2<S>) {
        let all = self.border.all;
        let [low, high] = all.arcs[arc as usize].centers.map(|k| k as usize);
        let share = S::lit(1.0 / (high - low) as f64);
        for &k in &all.centers[low..high] {
            self.bars[k as usize] += bar * share;
        }
    }
    /// Returns the share of a side at which a point moved from it lies.
    fn share(&self, side: u32, at: Vec2<S>) -> S {
        let (start, way, length) = self.border.side(side);
        (at - start).dot(way).over(length)
    }
    fn side_integral(&mut self, side: u32, p: Vec2<S>, q: Vec2<S>) {
        let (_, way, length) = self.border.side(side);
        let [s, t] = [p, q].map(|at| self.share(side, at));
        let (whole, later) = (t - s, (t * t - s * s).halved());
        let across = right(way) * (length * self.area_bar);
        self.add_to_side(side, across * (whole - later), across * later);
        self.radius_bar += length * whole * self.area_bar;
    }
    fn arc_integral(&mut self, arc: u32, [p, q]: [Vec2<S>; 2], [from, to]: [Vec2<S>; 2]) {
        let sweep = sweep(from, to);
        self.add_to_arc(
            arc,
            right(q - p) * self.area_bar + right(to - from) * self.perimeter_bar,
        );
        self.radius_bar += sweep * (self.border.r * self.area_bar + self.perimeter_bar);
    }
    /// Returns the direction of the border on a curve at a point.
    fn direction(&self, curve: OffsetCurve, at: Vec2<S>) -> Vec2<S> {
        match curve {
            OffsetCurve::Side(side) => self.border.side(side).1,
            OffsetCurve::Arc(arc) => {
                let way = at - self.border.center(arc);
                let r = self.border.r;
                Vec2::new(-way.y.over(r), way.x.over(r))
            }
        }
    }
    /// Returns the tangent of half the turn from one curve to another one, times the cotangent of the perimeter.
    fn half_turn(&self, before: OffsetCurve, after: OffsetCurve, at: Vec2<S>) -> S {
        let (u, w) = (self.direction(before, at), self.direction(after, at));
        let whole = S::one() + u.dot(w);
        // Curves that touch turn by half a turn: a root at zero, which has no derivative.
        let touch = whole.at_most(S::zero());
        let tangent = u.perp_dot(w).over(S::select(touch, S::one(), whole));
        S::select(touch, S::zero(), tangent) * self.perimeter_bar
    }
    /// Adds a multiple of the motion of a curve along its normal at a point.
    fn moved(&mut self, curve: OffsetCurve, at: Vec2<S>, by: S) {
        self.radius_bar += by;
        match curve {
            OffsetCurve::Side(side) => {
                let share = self.share(side, at);
                let across = right(self.border.side(side).1) * by;
                self.add_to_side(side, across * (S::one() - share), across * share);
            }
            OffsetCurve::Arc(arc) => {
                self.add_to_arc(arc, right(self.direction(curve, at)) * by);
            }
        }
    }
}

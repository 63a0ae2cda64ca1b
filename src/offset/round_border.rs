//! The border of an offset with exact arcs, from its record in any scalar.
use super::round_trace::{OffsetArc, OffsetCurve, OffsetPiece, PieceEnd, RoundPieces, RoundWay};
use super::{RoundOffsetTrace, offset_replay, right};
use crate::polygon::{self, Rings};
use crate::reference::{Reference, bounds_of};
use crate::{Scalar, Vec2};

/// The area and the perimeter of an offset.
#[derive(Clone, Copy, Debug, Default, PartialEq, crate::Shape)]
pub struct OffsetMeasures<S> {
    /// The area, in squared units of length.
    pub area: S,
    /// The length of the border, holes included, in units of length.
    pub perimeter: S,
}

/// Returns the frame of the vertices and all that is within a distance of them.
pub(super) fn frame_around<S: Scalar>(points: &[Vec2<S>], r: S) -> Reference<S> {
    let Some(mut bounds) = bounds_of(points) else {
        return Reference::of_ring(&[]);
    };
    let reach = Vec2::new(r, r).constant();
    (bounds.min, bounds.max) = (bounds.min - reach, bounds.max + reach);
    Reference::of_bounds(bounds)
}

/// The end of a piece: the point, and on an arc the direction there from its center.
#[derive(Clone, Copy)]
pub(crate) struct EndPlace<S> {
    pub at: Vec2<S>,
    pub way: Vec2<S>,
}

/// A record with the numbers of its curves, in local coordinates.
pub(crate) struct RoundBorder<'a, S> {
    pub seen: Reference<S>,
    pub all: &'a RoundPieces,
    /// The distance by which edges move.
    pub r: S,
    /// The start of each edge, its direction and its length.
    edges: Vec<(Vec2<S>, Vec2<S>, S)>,
    centers: Vec<Vec2<S>>,
}

impl<'a, S: Scalar> RoundBorder<'a, S> {
    pub fn new(points: &[Vec2<S>], d: S, all: &'a RoundPieces) -> Self {
        let distance = if all.is_inward { -d } else { d };
        let seen = frame_around(points, distance);
        let places: Vec<_> = points.iter().map(|&v| seen.place(v)).collect();
        RoundBorder {
            seen,
            ..RoundBorder::local(&places, distance.halved() * seen.scale, all)
        }
    }
    /// Returns the border of points that are local already, moved outward by a distance.
    pub fn local(places: &[Vec2<S>], r: S, all: &'a RoundPieces) -> Self {
        let edge = |&[i, j]: &[u32; 2]| {
            let (start, end) = (places[i as usize], places[j as usize]);
            let way = end - start;
            let length = way.length();
            let way = Vec2::new(way.x.over(length), way.y.over(length));
            (start, way, length)
        };
        let center = |arc: &OffsetArc| {
            let [low, high] = arc.centers.map(|k| k as usize);
            match &all.centers[low..high] {
                &[only] => places[only as usize],
                these => {
                    let share = S::lit(1.0 / these.len() as f64);
                    let add = |sum, &k: &u32| sum + places[k as usize] * share;
                    these.iter().fold(Vec2::zero(), add)
                }
            }
        };
        RoundBorder {
            seen: Reference::of_ring(&[]),
            r,
            edges: all.edges.iter().map(edge).collect(),
            centers: all.arcs.iter().map(center).collect(),
            all,
        }
    }
    /// Returns the start of a side before it moves, its direction and its length.
    pub fn side(&self, side: u32) -> (Vec2<S>, Vec2<S>, S) {
        let (start, way, length) = self.edges[side as usize / 2];
        match side % 2 {
            0 => (start, way, length),
            _ => (start + way * length, -way, length),
        }
    }
    pub fn center(&self, arc: u32) -> Vec2<S> {
        self.centers[arc as usize]
    }
    fn moved_start(&self, side: u32) -> Vec2<S> {
        let (start, way, _) = self.side(side);
        start + right(way) * self.r
    }
    /// Returns the point where one curve ends and another one starts.
    fn meeting(&self, ends: OffsetCurve, starts: OffsetCurve) -> Vec2<S> {
        match (ends, starts) {
            (OffsetCurve::Side(a), OffsetCurve::Side(b)) => {
                let (u, w) = (self.side(a).1, self.side(b).1);
                let (p, q) = (self.moved_start(a), self.moved_start(b));
                p + u * (q - p).perp_dot(w).over(u.perp_dot(w))
            }
            (OffsetCurve::Arc(a), OffsetCurve::Arc(b)) => {
                let (p, q) = (self.center(a), self.center(b));
                let (half, length) = ((q - p) * S::lit(0.5), (q - p).length());
                let far = length.halved();
                let high = root_of((self.r - far) * (self.r + far));
                let across = right(q - p);
                p + half + Vec2::new(across.x.over(length), across.y.over(length)) * high
            }
            (OffsetCurve::Side(side), OffsetCurve::Arc(arc)) => self.on_side(side, arc, false),
            (OffsetCurve::Arc(arc), OffsetCurve::Side(side)) => self.on_side(side, arc, true),
        }
    }
    /// Returns the point where a side enters or leaves a disc.
    fn on_side(&self, side: u32, arc: u32, leaves: bool) -> Vec2<S> {
        let (u, start) = (self.side(side).1, self.moved_start(side));
        let seen = self.center(arc) - start;
        let high = seen.perp_dot(u);
        let root = root_of((self.r - high) * (self.r + high));
        let along = seen.dot(u);
        start + u * if leaves { along + root } else { along - root }
    }
    /// Returns both ends of a piece.
    pub fn ends(&self, piece: &OffsetPiece) -> [EndPlace<S>; 2] {
        let own = |is_start: bool| match piece.curve {
            OffsetCurve::Side(side) => {
                let (start, way, length) = self.side(side);
                let place = if is_start {
                    start
                } else {
                    start + way * length
                };
                EndPlace {
                    at: place + right(way) * self.r,
                    way: right(way),
                }
            }
            OffsetCurve::Arc(arc) => {
                let sides = self.all.arcs[arc as usize].sides;
                let way = right(self.side(sides[usize::from(!is_start)]).1);
                EndPlace {
                    at: self.center(arc) + way * self.r,
                    way,
                }
            }
        };
        let crossing = |at: Vec2<S>| {
            let way = match piece.curve {
                OffsetCurve::Side(side) => right(self.side(side).1),
                OffsetCurve::Arc(arc) => {
                    let way = at - self.center(arc);
                    Vec2::new(way.x.over(self.r), way.y.over(self.r))
                }
            };
            EndPlace { at, way }
        };
        [
            match piece.from {
                PieceEnd::Own => own(true),
                PieceEnd::At(other) => crossing(self.meeting(other, piece.curve)),
            },
            match piece.to {
                PieceEnd::Own => own(false),
                PieceEnd::At(other) => crossing(self.meeting(piece.curve, other)),
            },
        ]
    }
    /// Returns both measures in local units; the area is positive for an outward offset.
    pub fn measures(&self) -> OffsetMeasures<S> {
        let (mut twice, mut perimeter) = (S::zero(), S::zero());
        for piece in &self.all.pieces {
            let [p, q] = self.ends(piece);
            match piece.curve {
                OffsetCurve::Side(side) => {
                    twice += p.at.perp_dot(q.at);
                    perimeter += (q.at - p.at).dot(self.side(side).1);
                }
                OffsetCurve::Arc(arc) => {
                    let sweep = sweep(p.way, q.way);
                    twice += self.center(arc).perp_dot(q.at - p.at) + self.r * self.r * sweep;
                    perimeter += self.r * sweep;
                }
            }
        }
        OffsetMeasures {
            area: twice.halved(),
            perimeter,
        }
    }
    /// Returns local measures in the caller's units.
    pub fn outer(&self, local: OffsetMeasures<S>) -> OffsetMeasures<S> {
        let area = self.seen.outer(self.seen.outer(local.area));
        let perimeter = self.seen.outer(local.perimeter);
        OffsetMeasures {
            area: if self.all.is_inward { -area } else { area }.canonical(),
            perimeter: perimeter.canonical(),
        }
    }
}

/// Returns the angle from one direction to another one counter-clockwise, up to half a turn; a little less than zero where
/// a rounding turns it.
pub(crate) fn sweep<S: Scalar>(from: Vec2<S>, to: Vec2<S>) -> S {
    let sweep = from.perp_dot(to).atan2(from.dot(to));
    let whole = sweep + S::lit(std::f64::consts::TAU);
    S::select(sweep.below(S::lit(-1.0)), whole, sweep)
}

/// Returns the square root, of zero for a number that rounding makes negative.
fn root_of<S: Scalar>(x: S) -> S {
    S::select(x.above(S::zero()), x, S::zero()).root()
}

/// Returns the area and the perimeter of an offset with round corners and ends, from the input, the distance and the record
/// of `round_offset_search` or `round_path_offset_search`.
///
/// Duals pass through crossings here; [`round_offset_vjp`](crate::ad::adjoint::round_offset::round_offset_vjp) has
/// derivatives without, which lose no digits where curves cross at a small angle.
///
/// # Panics
///
/// When the record names a ring or a vertex that is not there: it is of another input.
#[must_use]
pub fn round_offset_replay<'a, S: Scalar>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    trace: &RoundOffsetTrace,
) -> OffsetMeasures<S> {
    let rings = rings.into();
    match &trace.way {
        RoundWay::Arcs(before, all) => {
            let polygon = before.polygon(rings);
            let border = RoundBorder::new(polygon.vertices(), d, all);
            border.outer(border.measures())
        }
        RoundWay::Chords(trace) => {
            let shape = offset_replay(rings, d, trace);
            OffsetMeasures {
                area: polygon::signed_area(&shape),
                perimeter: polygon::perimeter(&shape),
            }
        }
    }
}

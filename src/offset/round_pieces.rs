//! The rest of each side and each arc, less the capsules over all other edges.
//!
//! The border of all within a radius of a polygon is the raw offset less the inside of the capsules over the other edges:
//! the way from a moved point back to its edge leaves the polygon through an edge that is nearer than the radius. Curves
//! that touch by construction (a side and the arc at its end) are told apart by what they are, not by numbers.
//!
//! Each curve is decided by itself, so wrong decisions leave the border open. It is closed if every crossing is the end of
//! one piece and the start of another one, and each end of a curve goes over into its neighbour: without that there is no
//! record. Where a crossing is next to a smooth joint, roundings choose its name, and places decide.
use super::capsules::{Around, Name, Sector, Taken, Track};
use super::edge_cells::EdgeCells;
use super::right;
use super::round_border::RoundBorder;
use super::round_closing::{Left, close, in_order};
use super::round_corners::{Corners, Joint, OpenCorner};
use super::round_trace::{OffsetArc, OffsetCurve, OffsetPiece, PieceEnd, RoundPieces};
use crate::{Scalar, Vec2};

/// The edges before and after a curve that are tried first: they take most curves whole.
const NEIGHBOURS: u32 = 6;

/// How far a replayed end may be from where the search saw it, in local units: a touch of depth 2⁻⁵² is found within the
/// root of it.
const SLACK: f64 = 1e-6;

struct Search<'a> {
    corners: &'a Corners,
    cells: EdgeCells,
    r: f64,
    /// The last curve that an edge was compared with.
    seen: Vec<u32>,
    stamp: u32,
    taken: Vec<Taken>,
    left: Vec<Left>,
}

/// Returns the record of the border; `None` if its pieces do not close. Points are local, as the radius is.
pub(super) fn round_pieces(
    corners: &Corners,
    points: &[Vec2<f64>],
    r: f64,
    is_inward: bool,
) -> Option<RoundPieces> {
    let ends: Vec<_> = corners.edges.iter().map(|edge| edge.ends).collect();
    let mut search = Search {
        corners,
        cells: EdgeCells::new(&ends, r),
        r,
        seen: vec![0; ends.len()],
        stamp: 0,
        taken: Vec::new(),
        left: Vec::new(),
    };
    for side in corners.sides() {
        search.side(side);
    }
    for corner in &corners.arcs {
        search.arc(corner);
    }
    let mut left = search.left;
    if !close(corners, &mut left) {
        return None;
    }
    let contours = in_order(corners, &mut left);
    let record = RoundPieces {
        contours,
        is_inward,
        ..recorded(corners, &left)?
    };
    // Each end is where the search saw it: no crossing was taken for another one.
    let border = RoundBorder::local(points, r, &record);
    let is_near = |(piece, own): (&OffsetPiece, &Left)| {
        let found = border.ends(piece).map(|end| end.at);
        (0..2).all(|k| (found[k] - own.ends[k]).length() <= SLACK)
    };
    let all_near = record.pieces.iter().zip(&left).all(is_near);
    all_near.then_some(record)
}

impl Search<'_> {
    fn side(&mut self, side: u32) {
        let (corners, r) = (self.corners, self.r);
        let own = side / 2;
        let [start, _] = corners.side_ends(side);
        let way = corners.side_way(side);
        let length = corners.edges[own as usize].length;
        let track = Track {
            start: start + right(way) * r,
            way,
            length,
        };
        let end = track.start + way * length;
        let around = Around::new((track.start + end) * 0.5, length * 0.5, r);
        let places = corners.side_places(side);
        let is_gone = self.tried(own, [track.start, end], |edge, taken| {
            let shared = [0, 1].map(|k| edge.places.contains(&places[k]));
            let capsule = match shared {
                [true, true] => return false,
                [false, false] => {
                    if let Some(is_gone) = around.decides(edge) {
                        return is_gone;
                    }
                    edge.part_of_track(&track, r, None)
                }
                [at_start, _] => {
                    let k = usize::from(!at_start);
                    let is_inner = corners.joints[side as usize][k] == Joint::Inner;
                    if !is_inner || !corners.is_right_of(side, edge.number, places[k]) {
                        return false;
                    }
                    // It covers the side's own end.
                    let mut part = edge.part_of_track(&track, r, Some(places[k]));
                    if let Some(part) = &mut part {
                        if at_start {
                            part.low = f64::NEG_INFINITY;
                        } else {
                            part.high = f64::INFINITY;
                        }
                    }
                    part
                }
            };
            let Some(part) = capsule else { return false };
            taken.push(part);
            part.low <= 0.0 && part.high >= length
        });
        if !is_gone {
            self.keep(Name::Side(side), length, |t| track.start + way * t);
        }
    }
    fn arc(&mut self, corner: &OpenCorner) {
        let (corners, r, place) = (self.corners, self.r, corner.place);
        let [before, after] = corner.sides;
        let center = corners.side_ends(after)[0];
        let [from, to] = [before, after].map(|side| right(corners.side_way(side)));
        let sweep = super::round_border::sweep(from, to);
        let arc = Sector {
            center,
            from,
            sweep,
        };
        let middle = center + arc.way(0.5 * sweep) * r;
        let around = Around::new(middle, 2.0 * r * Scalar::sin(0.25 * sweep), r);
        let is_gone = self.tried(after / 2, [center; 2], |edge, taken| {
            if edge.places.contains(&place) {
                return false;
            }
            match around.decides(edge) {
                Some(is_gone) => is_gone,
                None => edge.parts_of_sector(&arc, r, taken),
            }
        });
        if !is_gone && sweep > 0.0 {
            self.keep(Name::Circle(place), sweep, |angle| {
                center + arc.way(angle) * r
            });
        }
    }
    /// Tries the edges near a curve, whose ends are the corners of a box less the radius; `true` once one takes all.
    fn tried(
        &mut self,
        own: u32,
        ends: [Vec2<f64>; 2],
        mut take: impl FnMut(&super::capsules::Capsule, &mut Vec<Taken>) -> bool,
    ) -> bool {
        self.stamp += 1;
        self.taken.clear();
        let (edges, stamp) = (&self.corners.edges, self.stamp);
        let (seen, taken) = (&mut self.seen, &mut self.taken);
        seen[own as usize] = stamp;
        let mut of = |k: u32| {
            std::mem::replace(&mut seen[k as usize], stamp) != stamp
                && take(&edges[k as usize], taken)
        };
        let count = edges.len() as u32;
        for step in 1..=NEIGHBOURS.min(count - 1) {
            if of((own + step) % count) || of((own + count - step) % count) {
                return true;
            }
        }
        // An arc reaches one radius beyond its center.
        let reach = if ends[0] == ends[1] { 2.0 } else { 1.0 } * self.r;
        let mut is_gone = false;
        self.cells.near(ends, reach * (1.0 + 1e-9), |k| {
            is_gone = of(k);
            is_gone
        });
        is_gone
    }
    /// Adds what is left of a curve that begins at zero.
    fn keep(&mut self, curve: Name, end: f64, place: impl Fn(f64) -> Vec2<f64>) {
        self.taken.sort_unstable_by(|a, b| a.low.total_cmp(&b.low));
        let (mut at, mut from) = (0.0, None);
        let mut add = |low: f64, high: f64, from: Option<Name>, to: Option<Name>| {
            self.left.push(Left {
                curve,
                from,
                to,
                ends: [place(low), place(high)],
            });
        };
        for part in &self.taken {
            if part.low > at && at < end {
                add(at, part.low, from, Some(part.by[0]));
            }
            if part.high > at {
                (at, from) = (part.high, Some(part.by[1]));
            }
        }
        if at < end {
            add(at, end, from, None);
        }
    }
}

impl Corners {
    /// Returns `true` if an edge leaves a place to the right of a side.
    fn is_right_of(&self, side: u32, edge: u32, place: u32) -> bool {
        use crate::predicate::{Turn, turn_between};
        let other = &self.edges[edge as usize];
        let [p, q] = other.ends;
        let away = if other.places[0] == place {
            [p, q]
        } else {
            [q, p]
        };
        turn_between(self.side_ends(side), away) == Turn::Right
    }
}

/// Returns the record of pieces: places become arcs.
fn recorded(corners: &Corners, left: &[Left]) -> Option<RoundPieces> {
    let mut made = RoundPieces {
        edges: corners.vertices.clone(),
        ..RoundPieces::default()
    };
    for corner in &corners.arcs {
        let [before, after] = corner.sides;
        let (first, last) = (
            corners.side_vertices(before)[1],
            corners.side_vertices(after)[0],
        );
        let low = made.centers.len() as u32;
        made.centers.extend(corners.between(first, last));
        made.arcs.push(OffsetArc {
            sides: corner.sides,
            centers: [low, made.centers.len() as u32],
        });
    }
    let curve = |name: Name| match name {
        Name::Side(side) => Some(OffsetCurve::Side(side)),
        Name::Circle(place) => corners.arc(place).map(OffsetCurve::Arc),
    };
    let end = |name: Option<Name>| match name {
        None => Some(PieceEnd::Own),
        Some(name) => curve(name).map(PieceEnd::At),
    };
    for piece in left {
        made.pieces.push(OffsetPiece {
            curve: curve(piece.curve)?,
            from: end(piece.from)?,
            to: end(piece.to)?,
        });
    }
    Some(made)
}

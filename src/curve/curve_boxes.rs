//! Boxes around the pieces of a path, for searches of many points.
use super::curve_nearest::{CurvePlace, closest_of};
use super::curve_path::CurvePath;
use super::curve_piece::CurvePiece;
use super::curve_winding::{crossings, of_chord};
use crate::polygon::box_ends::{Ends, NOWHERE, joined, squared_gap};
use crate::polygon::box_tree::{BoxTree, FEW};
use crate::{Scalar, Vec2};

/// The pieces of a path with boxes around stretches of them, for nearest places and winding numbers of many points.
///
/// Results are those of the path's own functions, in a time that grows with the logarithm of the number of pieces.
///
/// ```
/// use geograd::{Circle, Vec2, curve::{CurveBoxes, CurvePath}};
/// let ring = CurvePath::circle(Circle::new(Vec2::new(0.0_f64, 0.0), 2.0));
/// let boxes = CurveBoxes::of(&ring);
/// let point = Vec2::new(0.5, -5.0);
/// assert_eq!(boxes.closest(point), ring.closest(point));
/// assert_eq!(boxes.winding_number(Vec2::new(0.5, 0.5)), 1);
/// ```
#[derive(Clone, Debug)]
pub struct CurveBoxes {
    pieces: Vec<CurvePiece<f64>>,
    tree: BoxTree,
    /// The straight lines that close open contours.
    closing: Vec<[Vec2<f64>; 2]>,
}

impl CurveBoxes {
    /// Creates the boxes of a path, in time in proportion to the number of its pieces.
    #[must_use]
    pub fn of<S: Scalar<Mask = bool>>(path: &CurvePath<S>) -> Self {
        let wide = |v: Vec2<S>| {
            let x = |x: S| x.widened().unwrap_or(f64::NAN);
            Vec2::new(x(v.x), x(v.y))
        };
        let pieces: Vec<_> = path.pieces().map(CurvePiece::widened).collect();
        let contours = path.contours().into_iter();
        let ends = contours.map(|contour| [wide(contour.end()), wide(contour.start)]);
        let mut tree = BoxTree::default();
        let around = |own: &[CurvePiece<f64>]| own.iter().copied().map(reach).fold(NOWHERE, joined);
        tree.replace(pieces.chunks(FEW).map(around));
        CurveBoxes {
            closing: ends.filter(|[end, start]| end != start).collect(),
            pieces,
            tree,
        }
    }
    /// Returns the pieces of the path, in order.
    #[must_use]
    pub fn pieces(&self) -> &[CurvePiece<f64>] {
        &self.pieces
    }
    /// Returns the place of the path that is nearest to a point; `None` for a path without pieces. The first one of equally
    /// near ones counts. Numbers are finite: others have any place.
    #[must_use]
    pub fn closest(&self, point: Vec2<f64>) -> Option<CurvePlace> {
        let at = [[point.x; 2], [point.y; 2]];
        let mut best: Option<(CurvePlace, f64)> = None;
        self.tree.whole()?;
        let mut limit = f64::INFINITY;
        let mut left = vec![(0.0, self.tree.top())];
        while let Some((gap, node)) = left.pop() {
            if gap > limit {
                continue;
            }
            if node.level > 0 {
                self.tree.push_near(node, at, limit, &mut left);
                continue;
            }
            for piece in node.items(self.pieces.len()) {
                let curve = self.pieces[piece];
                if squared_gap(reach(curve), at) > limit {
                    continue;
                }
                let (place, found) = closest_of(curve, point);
                let is_nearer = best.is_none_or(|(other, least)| {
                    found < least || found == least && piece < other.piece
                });
                if is_nearer {
                    best = Some((CurvePlace { piece, ..place }, found));
                    limit = beyond(found);
                }
            }
        }
        best.map(|(place, _)| place)
    }
    /// Returns how often all contours wind around a point, counter-clockwise ones positive. A straight line closes a
    /// contour that is open.
    #[must_use]
    pub fn winding_number(&self, point: Vec2<f64>) -> i32 {
        let lines = self.closing.iter();
        let mut sum = lines.map(|&[from, to]| of_chord(from, to, point)).sum();
        if self.tree.whole().is_none() {
            return sum;
        }
        // Pieces to the left of the point, below it or above it do not cross the ray along x.
        let meets = |[x, y]: Ends| !(x[1] < point.x || y[1] < point.y || point.y < y[0]);
        let mut left = vec![self.tree.top()];
        while let Some(node) = left.pop() {
            if !meets(self.tree.at(node)) {
                continue;
            }
            if node.level > 0 {
                left.extend(self.tree.children(node));
                continue;
            }
            for &piece in &self.pieces[node.items(self.pieces.len())] {
                sum += crossings(piece, point, 0);
            }
        }
        sum
    }
}

/// Returns the squared gap beyond which nothing is as near as a distance: roundings of either are below 1e-13 of it, and
/// squares that have none are not compared.
pub(super) fn beyond(found: f64) -> f64 {
    found * found * (1.0 + 1e-13) + f64::MIN_POSITIVE
}

/// Returns a box that holds the control points of a piece, and with them the piece.
pub(super) fn reach(piece: CurvePiece<f64>) -> Ends {
    let around = |all: &[Vec2<f64>]| {
        let ends = all.iter().map(|p| [[p.x; 2], [p.y; 2]]);
        ends.fold(NOWHERE, joined)
    };
    match piece {
        CurvePiece::Line(line) => around(&[line.from, line.to]),
        CurvePiece::Quadratic(curve) => around(&curve.points),
        CurvePiece::Cubic(curve) => around(&curve.points),
        CurvePiece::Arc(arc) => {
            // A circle about the middle of the chord holds an arc of any sweep.
            let half = arc.height();
            let reach = half.length().max((arc.to - arc.from).length());
            let middle = arc.from.lerp(arc.to, 0.5) - half * 0.5;
            let corner = Vec2::new(reach, reach) * 2.0;
            around(&[middle - corner, middle + corner])
        }
    }
}

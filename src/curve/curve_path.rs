//! Paths of pieces that share their ends, in the words of SVG.
use super::bezier::{Cubic2, Quadratic2};
use super::circle_arc::{Arc2, parts_of_sweep};
use super::curve_piece::CurvePiece;
use crate::error::{Field, Flaw, Validate};
use crate::{Circle, Pack, Scalar, Segment2, Vec2};

/// One step of a path: to a point, from where the step before ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CurveElement<S> {
    /// Begins a contour at a point.
    MoveTo(Vec2<S>),
    /// A straight line to a point.
    LineTo(Vec2<S>),
    /// A quadratic Bézier curve by its control point and its end.
    QuadTo(Vec2<S>, Vec2<S>),
    /// A cubic Bézier curve by both control points and its end.
    CurveTo(Vec2<S>, Vec2<S>, Vec2<S>),
    /// A circular arc by its end and its [bulge](Arc2).
    ArcTo(Vec2<S>, S),
    /// A straight line back to the start of the contour, which it closes. The next step begins there.
    Close,
}

/// A path of straight lines, Bézier curves and circular arcs, in one or more contours.
///
/// Neighbours share their ends, and a derivative by a path is a path: the sum at a joint is one vector.
///
/// ```
/// use geograd::{Vec2, curve::CurvePath};
/// let at = |x: f64, y| Vec2::new(x, y);
/// let stadium = CurvePath::at(at(0.0, 0.0)).line_to(at(2.0, 0.0)).arc_to(at(2.0, 2.0), 1.0);
/// let stadium = stadium.line_to(at(0.0, 2.0)).arc_to(at(0.0, 0.0), 1.0);
/// assert!((stadium.signed_area() - (4.0 + std::f64::consts::PI)).abs() < 1e-14);
/// assert!(stadium.contains(at(2.9, 1.0)) && !stadium.contains(at(2.9, 0.1)));
/// let (length, by) = geograd::gradient(|path: CurvePath<_>| path.length(), stadium);
/// assert!((length - (4.0 + std::f64::consts::TAU)).abs() < 1e-14);
/// assert_eq!(by.elements().len(), 5);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePath<S> {
    elements: Vec<CurveElement<S>>,
}

impl<S> CurvePath<S> {
    /// Creates a path that begins at a point, without pieces.
    #[must_use]
    pub fn at(start: Vec2<S>) -> Self {
        CurvePath {
            elements: vec![CurveElement::MoveTo(start)],
        }
    }
    /// Creates a path from its steps.
    ///
    /// # Errors
    ///
    /// [`Flaw::Broken`] when the first step does not begin a contour. A path without steps is valid.
    pub fn from_elements(elements: Vec<CurveElement<S>>) -> Result<Self, Flaw> {
        match elements.first() {
            None | Some(CurveElement::MoveTo(_)) => Ok(CurvePath { elements }),
            Some(_) => Err(Flaw::Broken(
                Field::VALUE.within_item(0).within("elements"),
                "does not begin a contour",
            )),
        }
    }
    /// Returns the steps.
    #[must_use]
    pub fn elements(&self) -> &[CurveElement<S>] {
        &self.elements
    }
    fn with(mut self, element: CurveElement<S>) -> Self {
        self.elements.push(element);
        self
    }
    /// Begins another contour at a point.
    #[must_use]
    pub fn move_to(self, start: Vec2<S>) -> Self {
        self.with(CurveElement::MoveTo(start))
    }
    /// Adds a straight line to a point.
    #[must_use]
    pub fn line_to(self, to: Vec2<S>) -> Self {
        self.with(CurveElement::LineTo(to))
    }
    /// Adds a quadratic Bézier curve to a point.
    #[must_use]
    pub fn quad_to(self, control: Vec2<S>, to: Vec2<S>) -> Self {
        self.with(CurveElement::QuadTo(control, to))
    }
    /// Adds a cubic Bézier curve to a point.
    #[must_use]
    pub fn curve_to(self, first: Vec2<S>, second: Vec2<S>, to: Vec2<S>) -> Self {
        self.with(CurveElement::CurveTo(first, second, to))
    }
    /// Adds a circular arc to a point, by its [bulge](Arc2).
    #[must_use]
    pub fn arc_to(self, to: Vec2<S>, bulge: S) -> Self {
        self.with(CurveElement::ArcTo(to, bulge))
    }
    /// Closes the contour by a straight line to its start, of length zero where it is there already.
    #[must_use]
    pub fn close(self) -> Self {
        self.with(CurveElement::Close)
    }
}

impl<S: Scalar<Mask = bool>> CurvePath<S> {
    /// Creates the path of an arc about a centre, from an angle in radians on, by a sweep in radians: positive
    /// counter-clockwise. A sweep of more than half a turn has two arcs, one of more than a full turn is a full turn.
    ///
    /// ```
    /// use geograd::{Vec2, curve::CurvePath};
    /// let round = CurvePath::arc(Vec2::new(1.0, 2.0), 3.0, 0.5, -9.0);
    /// assert!((round.length() - 6.0 * std::f64::consts::PI).abs() < 1e-14);
    /// assert!((round.signed_area() + 9.0 * std::f64::consts::PI).abs() < 1e-14);
    /// ```
    #[must_use]
    pub fn arc(center: Vec2<S>, radius: S, start: S, sweep: S) -> Self {
        let (count, part) = parts_of_sweep(sweep);
        let at = |k: usize| {
            let (sin, cos) = (start + part * S::lit(k as f64)).sin_cos();
            center + Vec2::new(cos, sin) * radius
        };
        let bulge = (part * S::lit(0.25)).tan();
        (1..=count).fold(CurvePath::at(at(0)), |path, k| path.arc_to(at(k), bulge))
    }
    /// Creates the closed path around a disc, counter-clockwise from its right end, of two arcs.
    #[must_use]
    pub fn circle(circle: Circle<S>) -> Self {
        let reach = Vec2::new(circle.radius, S::zero());
        let (right, left) = (circle.center + reach, circle.center - reach);
        let both = CurvePath::at(right).arc_to(left, S::one());
        both.arc_to(right, S::one()).close()
    }
    /// Adds a circular arc in SVG's end-point notation, as [`Arc2::svg`].
    #[must_use]
    pub fn svg_arc_to(
        self,
        radius: S,
        is_large: bool,
        is_counter_clockwise: bool,
        to: Vec2<S>,
    ) -> Self {
        let bulge = Arc2::svg(self.end(), radius, is_large, is_counter_clockwise, to).bulge;
        self.arc_to(to, bulge)
    }
    /// Returns the point where the next step begins; the origin for a path without steps.
    fn end(&self) -> Vec2<S> {
        let mut walk = Walk::default();
        for element in &self.elements {
            walk.piece(*element);
        }
        walk.end
    }
    /// Returns the pieces in order, one for every step but those that begin a contour.
    pub fn pieces(&self) -> impl Iterator<Item = CurvePiece<S>> + '_ {
        self.started_pieces().map(|(piece, _)| piece)
    }
    /// Returns the pieces in order, each with the start of its contour.
    pub(crate) fn started_pieces(&self) -> impl Iterator<Item = (CurvePiece<S>, Vec2<S>)> + '_ {
        let mut walk = Walk::default();
        self.elements.iter().filter_map(move |element| {
            let piece = walk.piece(*element)?;
            Some((piece, walk.start))
        })
    }
    /// Returns a piece by its number; `None` beyond the last one.
    #[must_use]
    pub fn piece(&self, number: usize) -> Option<CurvePiece<S>> {
        self.pieces().nth(number)
    }
    /// Returns the contours: of each its start and its pieces.
    pub(super) fn contours(&self) -> Vec<Contour<S>> {
        let mut walk = Walk::default();
        let mut all: Vec<Contour<S>> = Vec::new();
        // A step after the end of a contour begins another one at the same start.
        let mut is_open = false;
        for &element in &self.elements {
            let piece = walk.piece(element);
            if piece.is_none() || !is_open {
                all.push(Contour {
                    start: walk.start,
                    pieces: Vec::new(),
                    is_closed: false,
                });
                is_open = true;
            }
            if let (Some(piece), Some(contour)) = (piece, all.last_mut()) {
                contour.pieces.push(piece);
                if matches!(element, CurveElement::Close) {
                    contour.is_closed = true;
                    is_open = false;
                }
            }
        }
        all
    }
    /// Returns the path that runs through all pieces in the other direction, contours in the same order.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let mut elements = Vec::with_capacity(self.elements.len());
        for contour in self.contours() {
            let is_closed = contour.is_closed;
            // The line that closes a contour closes it in the other direction, too.
            let pieces = &contour.pieces[..contour.pieces.len() - usize::from(is_closed)];
            let end = pieces.last().map_or(contour.start, CurvePiece::end);
            elements.push(CurveElement::MoveTo(end));
            for piece in pieces.iter().rev() {
                elements.push(match piece.reversed() {
                    CurvePiece::Line(line) => CurveElement::LineTo(line.to),
                    CurvePiece::Quadratic(Quadratic2 { points: [_, b, c] }) => {
                        CurveElement::QuadTo(b, c)
                    }
                    CurvePiece::Cubic(Cubic2 {
                        points: [_, b, c, d],
                    }) => CurveElement::CurveTo(b, c, d),
                    CurvePiece::Arc(arc) => CurveElement::ArcTo(arc.to, arc.bulge),
                });
            }
            if is_closed {
                elements.push(CurveElement::Close);
            }
        }
        CurvePath { elements }
    }
}

/// A contour: pieces, each of which begins where the one before ends.
pub(super) struct Contour<S> {
    pub start: Vec2<S>,
    pub pieces: Vec<CurvePiece<S>>,
    /// `true` if its last piece is the line that closes it.
    pub is_closed: bool,
}

impl<S: Scalar<Mask = bool>> Contour<S> {
    /// Returns the end of its last piece.
    pub fn end(&self) -> Vec2<S> {
        self.pieces.last().map_or(self.start, CurvePiece::end)
    }
}

/// The places at which the next step and the contour begin.
struct Walk<S> {
    start: Vec2<S>,
    end: Vec2<S>,
}

impl<S: Scalar> Default for Walk<S> {
    fn default() -> Self {
        Walk {
            start: Vec2::zero(),
            end: Vec2::zero(),
        }
    }
}

impl<S: Copy> Walk<S> {
    /// Returns the piece of the next step; `None` for one that begins a contour.
    fn piece(&mut self, element: CurveElement<S>) -> Option<CurvePiece<S>> {
        let from = self.end;
        let (piece, to) = match element {
            CurveElement::MoveTo(start) => {
                *self = Walk { start, end: start };
                return None;
            }
            CurveElement::LineTo(to) => (Segment2::new(from, to).into(), to),
            CurveElement::QuadTo(b, to) => (Quadratic2::new(from, b, to).into(), to),
            CurveElement::CurveTo(b, c, to) => (Cubic2::new(from, b, c, to).into(), to),
            CurveElement::ArcTo(to, bulge) => (Arc2::new(from, to, bulge).into(), to),
            CurveElement::Close => (Segment2::new(from, self.start).into(), self.start),
        };
        self.end = to;
        Some(piece)
    }
}

impl<S: Clone> Pack for CurvePath<S> {
    type Scalar = S;
    type With<T: Clone> = CurvePath<T>;
    fn remake<T: Clone>(&self, f: &mut impl FnMut(&S) -> T) -> CurvePath<T> {
        let of = |element: &CurveElement<S>| match element {
            CurveElement::MoveTo(a) => CurveElement::MoveTo(moved(a, f)),
            CurveElement::LineTo(a) => CurveElement::LineTo(moved(a, f)),
            CurveElement::QuadTo(a, b) => {
                let a = moved(a, f);
                CurveElement::QuadTo(a, moved(b, f))
            }
            CurveElement::CurveTo(a, b, c) => {
                let (a, b) = (moved(a, f), moved(b, f));
                CurveElement::CurveTo(a, b, moved(c, f))
            }
            CurveElement::ArcTo(a, bulge) => {
                let a = moved(a, f);
                CurveElement::ArcTo(a, f(bulge))
            }
            CurveElement::Close => CurveElement::Close,
        };
        CurvePath {
            elements: self.elements.iter().map(of).collect(),
        }
    }
    fn each(&mut self, f: &mut impl FnMut(&mut S)) {
        for element in &mut self.elements {
            let (points, bulge): (Vec<&mut Vec2<S>>, Option<&mut S>) = match element {
                CurveElement::MoveTo(a) | CurveElement::LineTo(a) => (vec![a], None),
                CurveElement::QuadTo(a, b) => (vec![a, b], None),
                CurveElement::CurveTo(a, b, c) => (vec![a, b, c], None),
                CurveElement::ArcTo(a, bulge) => (vec![a], Some(bulge)),
                CurveElement::Close => (vec![], None),
            };
            for point in points {
                f(&mut point.x);
                f(&mut point.y);
            }
            if let Some(bulge) = bulge {
                f(bulge);
            }
        }
    }
}

fn moved<S, T>(v: &Vec2<S>, f: &mut impl FnMut(&S) -> T) -> Vec2<T> {
    let x = f(&v.x);
    Vec2::new(x, f(&v.y))
}

impl<S: Scalar<Mask = bool>> Validate for CurvePath<S> {
    /// Returns the first step with a number that is not finite.
    fn validate(&self) -> Result<(), Flaw> {
        for (k, element) in self.elements.iter().enumerate() {
            let one = CurvePath {
                elements: vec![*element],
            };
            for x in one.scalars() {
                if !x.finite() {
                    let field = Field::VALUE.within_item(k).within("elements");
                    return Err(Flaw::NotFinite(field));
                }
            }
        }
        Ok(())
    }
}

//! Measures of whole paths: length, area, bounds, nearest places, winding numbers, chords.
use super::curve_boxes::{beyond, reach};
use super::curve_nearest::{CurvePlace, closest_of};
use super::curve_path::{Contour, CurvePath};
use super::curve_piece::CurvePiece;
use super::curve_winding::{crossings, of_chord};
use crate::error::Error;
use crate::polygon::box_ends::squared_gap;
use crate::{Aabb2, Scalar, Vec2};

impl<S: Scalar<Mask = bool>> CurvePath<S> {
    /// Returns the length of all pieces, at least 0. Kinks as for [`CurvePiece::length`].
    #[must_use]
    pub fn length(&self) -> S {
        let sum = self.pieces().map(CurvePiece::length);
        sum.fold(S::zero(), |sum, length| sum + length).canonical()
    }
    /// Returns the length of each piece, at least 0, in order. Kinks as for [`CurvePiece::length`].
    ///
    /// ```
    /// use geograd::{Vec2, curve::CurvePath};
    /// let at = |x: f64, y| Vec2::new(x, y);
    /// let path = CurvePath::at(at(0.0, 0.0)).line_to(at(3.0, 4.0)).arc_to(at(5.0, 4.0), 1.0);
    /// assert_eq!(path.lengths(), [5.0, std::f64::consts::PI]);
    /// ```
    #[must_use]
    pub fn lengths(&self) -> Vec<S> {
        self.pieces().map(CurvePiece::length).collect()
    }
    /// Returns the signed area of all contours, positive counter-clockwise. A straight line from its end closes a contour that
    /// is open, as SVG fills it.
    ///
    /// Green's theorem over every piece, exact but for rounding. It is smooth in all control points.
    #[must_use]
    pub fn signed_area(&self) -> S {
        let mut sum = S::zero();
        for Contour { start, pieces, .. } in self.contours() {
            let mut twice = S::zero();
            for piece in pieces {
                // Relative to the start, so that the place of a path costs no digits.
                twice += (piece.start() - start).perp_dot(piece.end() - start);
                sum += piece.signed_area();
            }
            sum += twice.halved();
        }
        sum.canonical()
    }
    /// Returns the smallest axis-aligned box around the path; `None` for a path without steps.
    ///
    /// Kinks as for [`CurvePiece::bounding`].
    #[must_use]
    pub fn bounding(&self) -> Option<Aabb2<S>> {
        let all = self.contours().into_iter().flat_map(|contour| {
            let start = Aabb2 {
                min: contour.start,
                max: contour.start,
            };
            let own = contour.pieces.into_iter().map(CurvePiece::bounding);
            Some(own.reduce(join).unwrap_or(start))
        });
        all.reduce(join)
    }
    /// Returns the place of the path that is nearest to a point; `None` for a path without pieces. The first one of
    /// equally near ones counts.
    ///
    /// Pieces whose control points are all farther than what was found are skipped. [`CurveBoxes`](super::CurveBoxes) find
    /// places of many points sooner.
    ///
    /// ```
    /// use geograd::{Circle, Vec2, curve::CurvePath};
    /// let ring = CurvePath::circle(Circle::new(Vec2::new(0.0_f64, 0.0), 2.0));
    /// let point = Vec2::new(0.0, -5.0);
    /// let place = ring.closest(point).expect("it has pieces");
    /// assert_eq!(place.piece, 1);
    /// let by = geograd::gradient(|p| ring_distance(p, place), point).1;
    /// assert!((by.y + 1.0).abs() < 1e-15);
    ///
    /// # use geograd::{Scalar, curve::CurvePlace};
    /// fn ring_distance<S: Scalar<Mask = bool>>(point: Vec2<S>, place: CurvePlace) -> S {
    ///     let center = Vec2::new(S::zero(), S::zero());
    ///     CurvePath::circle(Circle::new(center, S::lit(2.0))).distance_replay(point, place)
    /// }
    /// ```
    #[must_use]
    pub fn closest(&self, point: Vec2<S>) -> Option<CurvePlace> {
        let wide = |x: S| x.widened().unwrap_or(f64::NAN);
        let point = Vec2::new(wide(point.x), wide(point.y));
        let at = [[point.x; 2], [point.y; 2]];
        let mut best: Option<(CurvePlace, f64)> = None;
        for (number, piece) in self.pieces().enumerate() {
            let piece = piece.widened();
            if best.is_some_and(|(_, found)| squared_gap(reach(piece), at) > beyond(found)) {
                continue;
            }
            let (place, found) = closest_of(piece, point);
            if best.is_none_or(|(_, least)| found < least) {
                let place = CurvePlace {
                    piece: number,
                    ..place
                };
                best = Some((place, found));
            }
        }
        best.map(|(place, _)| place)
    }
    /// Returns the point at a place that a [search](Self::closest) found, with the derivatives of the nearest point.
    ///
    /// # Panics
    ///
    /// When the path has no such piece.
    #[must_use]
    pub fn closest_replay(&self, point: Vec2<S>, place: CurvePlace) -> Vec2<S> {
        self.found(place).closest_replay(point, place)
    }
    /// Returns the distance of a point from the place that a [search](Self::closest) found, with derivatives.
    ///
    /// # Panics
    ///
    /// When the path has no such piece.
    #[must_use]
    pub fn distance_replay(&self, point: Vec2<S>, place: CurvePlace) -> S {
        self.found(place).distance_replay(point, place)
    }
    fn found(&self, place: CurvePlace) -> CurvePiece<S> {
        let piece = self.piece(place.piece);
        piece.unwrap_or_else(|| panic!("the path has no piece {}", place.piece))
    }
    /// Returns the distance of a point from the path, at least 0; `None` for a path without pieces. Kinks as for
    /// [`CurvePiece::distance`].
    #[must_use]
    pub fn distance(&self, point: Vec2<S>) -> Option<S> {
        let place = self.closest(point)?;
        Some(self.distance_replay(point, place))
    }
    /// Returns how often all contours wind around a point, counter-clockwise ones positive. A straight line closes a
    /// contour that is open.
    ///
    /// A point within a few roundings of the path may count as on either side.
    #[must_use]
    pub fn winding_number(&self, point: Vec2<S>) -> i32 {
        let wide = |v: Vec2<S>| {
            let x = |x: S| x.widened().unwrap_or(f64::NAN);
            Vec2::new(x(v.x), x(v.y))
        };
        let point = wide(point);
        let mut sum = 0;
        for contour in self.contours() {
            sum += of_chord(wide(contour.end()), wide(contour.start), point);
            for piece in contour.pieces {
                sum += crossings(piece.widened(), point, 0);
            }
        }
        sum
    }
    /// Returns `true` if the path winds around a point: the rule `nonzero`. For the rule `evenodd` see whether the
    /// [winding number](Self::winding_number) is odd.
    #[must_use]
    pub fn contains(&self, point: Vec2<S>) -> bool {
        self.winding_number(point) != 0
    }
    /// Returns how many chords follow each piece to within a tolerance, as [`CurvePiece::chords`].
    ///
    /// # Errors
    ///
    /// As [`CurvePiece::chords`], and [`Error::TooLarge`] for more than 2²⁸ chords of all pieces.
    pub fn chords(&self, tolerance: f64) -> Result<Vec<usize>, Error> {
        let counts: Vec<usize> = self
            .pieces()
            .map(|piece| piece.chords(tolerance))
            .collect::<Result<_, _>>()?;
        match counts.iter().sum::<usize>() >> 28 {
            0 => Ok(counts),
            _ => Err(Error::TooLarge),
        }
    }
    /// Returns the vertices of every contour, with so many chords for each piece: a record of [`chords`](Self::chords), or
    /// any. A contour that ends by [`CurveElement::Close`](super::CurveElement::Close) is a ring, whose first vertex is
    /// not repeated.
    #[must_use]
    pub fn flattened(&self, counts: &[usize]) -> Vec<Vec<Vec2<S>>> {
        let mut counts = counts.iter();
        let of = |contour: Contour<S>| {
            let mut all = vec![contour.start];
            for piece in &contour.pieces {
                piece.extend_by_chords(counts.next().copied().unwrap_or(1), &mut all);
            }
            if contour.is_closed {
                all.pop();
                let is_start =
                    |v: &Vec2<S>| v.x.equals(contour.start.x) && v.y.equals(contour.start.y);
                // The line that closes it has length zero.
                if all.len() > 1 && all.last().is_some_and(is_start) {
                    all.pop();
                }
            }
            all
        };
        self.contours().into_iter().map(of).collect()
    }
    /// Returns the vertices of every contour, with chords within a tolerance of the path.
    ///
    /// The number of chords is constant for derivatives: results jump, by less than the tolerance, where it changes.
    ///
    /// # Errors
    ///
    /// As [`chords`](Self::chords).
    ///
    /// ```
    /// use geograd::{Circle, Vec2, curve::CurvePath, ring};
    /// let wheel = CurvePath::circle(Circle::new(Vec2::new(0.0_f64, 0.0), 1.0));
    /// let rings = wheel.flatten(1e-4)?;
    /// assert_eq!((rings.len(), rings[0].len()), (1, 224));
    /// assert!((ring::signed_area(&rings[0]) - std::f64::consts::PI).abs() < 1e-3);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn flatten(&self, tolerance: f64) -> Result<Vec<Vec<Vec2<S>>>, Error> {
        Ok(self.flattened(&self.chords(tolerance)?))
    }
}

fn join<S: Scalar>(a: Aabb2<S>, b: Aabb2<S>) -> Aabb2<S> {
    Aabb2 {
        min: a.min.least(b.min),
        max: a.max.most(b.max),
    }
}

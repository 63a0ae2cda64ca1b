//! The cores of shapes: a point, a part of a line, a polygon, a box.
use super::beam::{Beam, Inside};
use super::corners::{Core, edge_near, face_deep};
use super::edge::{Edge, scale_of, size_of, unit};
use super::share::{Ahead, Best, Deepest, Nearest};
use crate::arrays::Each;
use crate::{Rotation2, Scalar, Vec2};

/// One point.
#[derive(Clone, Copy, Debug)]
pub struct PointCore<S>(pub Vec2<S>);

impl<S: Scalar> Core<S> for PointCore<S> {
    type Corners = [Vec2<S>; 1];
    type Away = [Vec2<S>; 0];
    const DIMENSION: usize = 0;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn anchor(&self) -> Vec2<S> {
        self.0
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extent(&self, from: Vec2<S>) -> S::Primal {
        size_of(self.0 - from)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn placed(self, from: Vec2<S>, scale: S) -> Self {
        PointCore((self.0 - from) * scale)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn corners(&self) -> [Vec2<S>; 1] {
        [self.0]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn away(&self) -> [Vec2<S>; 0] {
        []
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn near(&self, corners: &[Vec2<S>]) -> Best<S, Nearest<S>> {
        Best::least(corners.iter().map(|&corner| {
            let apart = corner - self.0;
            Best::of(
                apart.length_squared(),
                Nearest {
                    apart,
                    on_a: self.0,
                    on_b: corner,
                },
            )
        }))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inside(&self, beam: Beam<S>, radius: S) -> Inside<S> {
        Inside::disc(beam, self.0, radius)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deep<B: Core<S>>(&self, other: &B) -> Best<S, Deepest<S>> {
        face_deep(Edge::between(self.0, self.0), Vec2::zero(), other)
    }
}

/// A piece of a line: with two corners a segment, with one corner and one direction a ray, with one
/// corner and two directions a line.
#[derive(Clone, Copy, Debug)]
pub struct EdgeCore<S, const CORNERS: usize, const AWAY: usize> {
    pub(super) edge: Edge<S>,
    /// The second corner, if there is one. The sum of start and vector would be rounded, but edges that share a corner
    /// have distance zero.
    to: Vec2<S>,
}

impl<S: Scalar> EdgeCore<S, 2, 0> {
    /// Returns the segment between two points.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn segment(from: Vec2<S>, to: Vec2<S>) -> Self {
        EdgeCore {
            edge: Edge::between(from, to),
            to,
        }
    }
}

impl<S: Scalar, const AWAY: usize> EdgeCore<S, 1, AWAY> {
    /// Returns the ray, or the line, from a point in a direction.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn endless(from: Vec2<S>, direction: Vec2<S>) -> Self {
        let large = S::largest();
        EdgeCore {
            edge: Edge {
                from,
                // The direction has a length near one, in any unit of the other numbers.
                along: direction * scale_of::<S>(size_of(direction)),
                low: if AWAY == 2 { -large } else { S::zero() },
                high: large,
            },
            to: from,
        }
    }
}

impl<S: Scalar, const CORNERS: usize, const AWAY: usize> Core<S> for EdgeCore<S, CORNERS, AWAY> {
    type Corners = [Vec2<S>; CORNERS];
    type Away = [Vec2<S>; AWAY];
    const DIMENSION: usize = 1;
    const BOUNDED: bool = AWAY == 0;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn anchor(&self) -> Vec2<S> {
        self.edge.from
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extent(&self, from: Vec2<S>) -> S::Primal {
        size_of(self.edge.from - from).most(size_of(self.to - from))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn placed(self, from: Vec2<S>, scale: S) -> Self {
        let Edge { along, .. } = self.edge;
        EdgeCore {
            edge: Edge {
                from: (self.edge.from - from) * scale,
                along: if AWAY == 0 { along * scale } else { along },
                ..self.edge
            },
            to: (self.to - from) * scale,
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn corners(&self) -> [Vec2<S>; CORNERS] {
        std::array::from_fn(|k| if k == 0 { self.edge.from } else { self.to })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn away(&self) -> [Vec2<S>; AWAY] {
        let along = self.edge.along;
        std::array::from_fn(|k| if k == 0 { along } else { -along })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn near(&self, corners: &[Vec2<S>]) -> Best<S, Nearest<S>> {
        edge_near(self.edge, corners)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inside(&self, beam: Beam<S>, radius: S) -> Inside<S> {
        let Edge { from, along, .. } = self.edge;
        Inside::strip(beam, from, along, radius, AWAY < 2, AWAY == 0)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deep<B: Core<S>>(&self, other: &B) -> Best<S, Deepest<S>> {
        let normal = unit(self.edge.along.perp());
        let [left, right] = [normal, -normal].each_as(|normal| face_deep(self.edge, normal, other));
        left.most(right)
    }
}

/// A convex polygon of at most N corners, in either order; corners may be repeated. With `TRIANGLE` it has three, and
/// what turns clockwise when coordinates are rounded is turned back.
#[derive(Clone, Copy, Debug)]
pub struct PolygonCore<S, const N: usize, const TRIANGLE: bool = false>(pub [Vec2<S>; N]);

impl<S: Scalar, const N: usize, const TRIANGLE: bool> PolygonCore<S, N, TRIANGLE> {
    /// Returns the corners counter-clockwise, at their positions.
    ///
    /// The orientation is computed at the corner of the two shorter sides, where its rounding is smallest relative to
    /// their product. The normal of a short side depends on it.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn turned(&self) -> [Vec2<S>; N] {
        let mut corners = self.0;
        if !TRIANGLE {
            return counter_clockwise(corners);
        }
        let [a, b, c] = [corners[0], corners[1], corners[2]];
        let (p, q, r) = (b - a, c - b, a - c);
        let [first, second, third] = [p, q, r].each_as(|side| side.length_squared().primal());
        let turn = |side: Vec2<S>, next: Vec2<S>| side.perp_dot(next).primal();
        let longest = first.most(second).most(third);
        let turn = S::Primal::select(
            third.equals(longest),
            turn(p, q),
            S::Primal::select(first.equals(longest), turn(q, r), turn(r, p)),
        );
        let clockwise = S::from_primal(turn).below(S::zero());
        corners[1] = Vec2::select(clockwise, c, b);
        corners[2] = Vec2::select(clockwise, b, c);
        corners
    }
}

impl<S: Scalar, const N: usize, const TRIANGLE: bool> Core<S> for PolygonCore<S, N, TRIANGLE> {
    type Corners = [Vec2<S>; N];
    type Away = [Vec2<S>; 0];
    const DIMENSION: usize = 2;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn anchor(&self) -> Vec2<S> {
        self.0[0]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extent(&self, from: Vec2<S>) -> S::Primal {
        self.0.iter().fold(S::Primal::zero(), |most, &corner| {
            most.most(size_of(corner - from))
        })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn placed(self, from: Vec2<S>, scale: S) -> Self {
        PolygonCore(self.0.each_as(|corner| (corner - from) * scale))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn corners(&self) -> [Vec2<S>; N] {
        self.0
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn away(&self) -> [Vec2<S>; 0] {
        []
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn near(&self, corners: &[Vec2<S>]) -> Best<S, Nearest<S>> {
        Best::least(
            (0..N).map(|i| edge_near(Edge::between(self.0[i], self.0[(i + 1) % N]), corners)),
        )
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inside(&self, beam: Beam<S>, _: S) -> Inside<S> {
        Inside::polygon(beam, &self.turned())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deep<B: Core<S>>(&self, other: &B) -> Best<S, Deepest<S>> {
        let corners = self.turned();
        Best::most_of((0..N).map(|i| {
            let face = Edge::between(corners[i], corners[(i + 1) % N]);
            face_deep(face, -unit(face.along.perp()), other)
        }))
    }
}

/// Returns the corners of a convex polygon counter-clockwise; the first one stays.
///
/// All corners turn to one side, and the sum of their turns has its sign. Each turn is divided by the sizes of its two
/// sides, so that a corner of short sides counts as one of long sides. Repeated corners have turn zero.
#[cfg_attr(not(debug_assertions), inline(always))]
fn counter_clockwise<S: Scalar, const N: usize>(mut corners: [Vec2<S>; N]) -> [Vec2<S>; N] {
    let zero = S::Primal::zero();
    let given = corners.each_as(|corner| Vec2::new(corner.x.primal(), corner.y.primal()));
    let (mut before, mut turn) = (Vec2::zero(), zero);
    // Twice around: the first round finds the last side that has a length.
    for i in 0..2 * N {
        let side = given[(i + 1) % N] - given[i % N];
        let size = side.x.magnitude().most(side.y.magnitude());
        let none = size.at_most(zero);
        let scale = S::Primal::select(none, S::Primal::one(), size).binade();
        let side = side * scale;
        if i >= N {
            turn += before.perp_dot(side);
        }
        before = Vec2::select(none, before, side);
    }
    let clockwise = S::from_primal(turn).below(S::zero());
    let reversed = corners;
    for k in 1..N {
        corners[k] = Vec2::select(clockwise, reversed[N - k], corners[k]);
    }
    corners
}

/// The orientation of a box: along the axes, or turned by a rotation.
pub(crate) trait Turn<S: Scalar>: Copy {
    /// Turns a vector from the box's own axes to the world's.
    fn out(&self, v: Vec2<S>) -> Vec2<S>;
    /// Turns a vector from the world's axes to the box's own.
    fn back(&self, v: Vec2<S>) -> Vec2<S>;
}

/// Not turned.
#[derive(Clone, Copy, Debug)]
pub struct Upright;

impl<S: Scalar> Turn<S> for Upright {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn out(&self, v: Vec2<S>) -> Vec2<S> {
        v
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn back(&self, v: Vec2<S>) -> Vec2<S> {
        v
    }
}

impl<S: Scalar> Turn<S> for Rotation2<S> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn out(&self, v: Vec2<S>) -> Vec2<S> {
        *self * v
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn back(&self, v: Vec2<S>) -> Vec2<S> {
        self.inverse() * v
    }
}

/// A box: a corner is compared with it in its own frame, by four comparisons.
#[derive(Clone, Copy, Debug)]
pub struct BoxCore<S, R> {
    /// The centre.
    pub center: Vec2<S>,
    /// Half its size.
    pub half: Vec2<S>,
    /// Its orientation.
    pub turn: R,
}

/// Returns the normals of the faces of a box, how far the faces are from the centre, and half their lengths.
#[cfg_attr(not(debug_assertions), inline(always))]
fn faces<S: Scalar, R: Turn<S>>(of: &BoxCore<S, R>) -> [(Vec2<S>, S, S); 4] {
    let (right, up) = (
        of.turn.out(Vec2::new(S::one(), S::zero())),
        of.turn.out(Vec2::new(S::zero(), S::one())),
    );
    let Vec2 { x, y } = of.half;
    [(right, x, y), (-right, x, y), (up, y, x), (-up, y, x)]
}

/// Returns the distance in front of each face of a box at which another core begins.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn faces_deep<S: Scalar, R: Turn<S>, B: Core<S>>(
    of: &BoxCore<S, R>,
    other: &B,
) -> [Best<S, Deepest<S>>; 4] {
    faces(of).each_as(|(normal, half, side)| {
        let face = Edge {
            from: of.center + normal * half,
            along: normal.perp(),
            low: -side,
            high: side,
        };
        face_deep(face, normal, other)
    })
}

impl<S: Scalar, R: Turn<S>> Core<S> for BoxCore<S, R> {
    type Corners = [Vec2<S>; 4];
    type Away = [Vec2<S>; 0];
    const DIMENSION: usize = 2;
    const SYMMETRIC: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn anchor(&self) -> Vec2<S> {
        self.center
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extent(&self, from: Vec2<S>) -> S::Primal {
        size_of(self.center - from) + (self.half.x.primal() + self.half.y.primal())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn placed(self, from: Vec2<S>, scale: S) -> Self {
        BoxCore {
            center: (self.center - from) * scale,
            half: self.half * scale,
            turn: self.turn,
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn corners(&self) -> [Vec2<S>; 4] {
        let Vec2 { x, y } = self.half;
        let (near, far) = (
            self.turn.out(Vec2::new(x, -y)),
            self.turn.out(Vec2::new(x, y)),
        );
        [
            self.center - far,
            self.center + near,
            self.center + far,
            self.center - near,
        ]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn away(&self) -> [Vec2<S>; 0] {
        []
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn near(&self, corners: &[Vec2<S>]) -> Best<S, Nearest<S>> {
        Best::least(corners.iter().map(|&corner| {
            let local = self.turn.back(corner - self.center);
            let beside = |x: S, half: S| S::select(x.below(S::zero()), x + half, x - half);
            let outside = |x: S, half: S| x.unsigned().above(half);
            let pick = |x: S, half: S| S::select(outside(x, half), beside(x, half), S::zero());
            let apart = Vec2::new(pick(local.x, self.half.x), pick(local.y, self.half.y));
            let turned = self.turn.out(apart);
            let on_self = self.center + self.turn.out(local - apart);
            Best::of(
                apart.length_squared(),
                Nearest {
                    apart: turned,
                    on_a: on_self,
                    on_b: corner,
                },
            )
        }))
    }
    /// Returns the largest squared distance: the farthest corner of a box is on the other side along both axes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn far(&self, corners: &[Vec2<S>]) -> Best<S, S> {
        Best::most_of(corners.iter().map(|&corner| {
            let local = self.turn.back(corner - self.center);
            let way = Vec2::new(
                local.x.magnitude() + self.half.x,
                local.y.magnitude() + self.half.y,
            );
            let square = way.length_squared();
            Best::of(square, square)
        }))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inside(&self, beam: Beam<S>, _: S) -> Inside<S> {
        faces(self)
            .into_iter()
            .fold(Inside::everywhere(), |inside, (normal, half, _)| {
                inside.behind(beam, self.center + normal * half, normal)
            })
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deep<B: Core<S>>(&self, other: &B) -> Best<S, Deepest<S>> {
        Best::most_of(faces_deep(self, other).into_iter())
    }
    /// Returns the lowest point of the box without its corners, by half the projections of its diagonals. Corners that
    /// tie are replaced by their middle.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lowest(&self, normal: Vec2<S>) -> Best<S, Ahead<S>> {
        let own = self.turn.back(normal);
        let (x, y) = (own.x * self.half.x, own.y * self.half.y);
        let side = |x: S, half: S| {
            let none = x.equals(S::zero());
            S::select(none, S::zero(), (-half).signed_as(x))
        };
        let corner = Vec2::new(side(x, self.half.x), side(y, self.half.y));
        let ahead = normal.dot(self.center) - (x.magnitude() + y.magnitude());
        Best::of(
            ahead,
            Ahead {
                ahead,
                on_b: self.center + self.turn.out(corner),
            },
        )
    }
}

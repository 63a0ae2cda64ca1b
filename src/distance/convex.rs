//! What distances ask of a shape: a convex core of few corners, inflated by a radius.
use super::edge::{Edge, choose, reach, size_of};
use super::share::{Ahead, Best, Deepest, Nearest};
use crate::intersection::span::{Beam, Inside};
use crate::{Rotation2, Scalar, Vec2};

/// A convex shape: every point at most [`radius`](Convex::radius) from its [`core`](Convex::core).
///
/// Points, lines, rays, segments, triangles, boxes, circles, capsules and arrays of corners are. The
/// functions of [`distance`](mod@crate::distance) and [`intersection`](crate::intersection) take any
/// two of them; those of distances are methods, too.
///
/// ```
/// use geograd::distance::Convex;
/// use geograd::{Circle, Obb2, Segment2, Vec2};
/// let car = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0);
/// let tree = Circle::new(Vec2::new(0.0, 4.0), 1.0);
/// assert_eq!(car.distance(tree), 2.0);
/// assert_eq!(tree.signed_distance(tree.center), -1.0);
/// let curb = Segment2::new(Vec2::new(2.5, -9.0), Vec2::new(2.5, 9.0));
/// assert_eq!(car.closest_points(curb).on_b.x, 2.5);
/// ```
pub trait Convex<S: Scalar>: Copy {
    /// What is inflated.
    type Core: Core<S>;
    /// Whether the radius may be other than zero.
    const ROUND: bool = false;
    /// What is inflated.
    fn core(self) -> Self::Core;
    /// By how much; not negative.
    #[inline(always)]
    fn radius(&self) -> S {
        S::zero()
    }
    /// The distance, 0 where the shapes touch or overlap: [`distance`](super::distance()).
    #[must_use]
    #[inline]
    fn distance<B: Convex<S>>(self, other: B) -> S {
        super::distance(self, other)
    }
    /// The square of the distance: [`distance_squared`](super::distance_squared).
    #[must_use]
    #[inline]
    fn distance_squared<B: Convex<S>>(self, other: B) -> S {
        super::distance_squared(self, other)
    }
    /// The distance, or minus the depth of overlap: [`signed_distance`](super::signed_distance).
    #[must_use]
    #[inline]
    fn signed_distance<B: Convex<S>>(self, other: B) -> S {
        super::signed_distance(self, other)
    }
    /// A point of each, nearest to each other: [`closest_points`](super::closest_points).
    #[must_use]
    #[inline]
    fn closest_points<B: Convex<S>>(self, other: B) -> super::ClosestPoints<S> {
        super::closest_points(self, other)
    }
    /// How deep the shapes overlap, and the way out: [`penetration`](super::penetration).
    #[must_use]
    #[inline]
    fn penetration<B: Convex<S>>(self, other: B) -> super::Penetration<S> {
        super::penetration(self, other)
    }
    /// The longest distance: [`farthest_distance`](super::farthest_distance).
    #[must_use]
    #[inline]
    fn farthest_distance<B: Convex<S>>(self, other: B) -> S {
        super::farthest_distance(self, other)
    }
}

/// The core of a convex shape: the hull of some corners and of some directions in which it has no
/// end.
///
/// Two halves make every distance: what the faces and edges of one core are to the corners of the
/// other, and the same the other way round.
pub trait Core<S: Scalar>: Copy {
    /// The corners, in an array.
    type Corners: AsRef<[Vec2<S>]>;
    /// The directions without end, in an array.
    type Away: AsRef<[Vec2<S>]>;
    /// 0 for a point, 1 for a piece of a line, 2 for what has an area.
    const DIMENSION: usize;
    /// Whether it ends in every direction.
    const BOUNDED: bool = true;
    /// A point of it, or near it, from which the others are seen.
    fn anchor(&self) -> Vec2<S>;
    /// How far its corners are from a point at most, coordinate by coordinate, as a constant.
    fn extent(&self, from: Vec2<S>) -> S::Primal;
    /// The core seen from a point, in other units.
    #[must_use]
    fn placed(self, from: Vec2<S>, scale: S) -> Self;
    /// The corners; counter-clockwise where there are more than two.
    fn corners(&self) -> Self::Corners;
    /// The directions without end.
    fn away(&self) -> Self::Away;
    /// The corner that is nearest to an edge of this core, and where.
    fn near(&self, corners: &[Vec2<S>]) -> Best<S, Nearest<S>>;
    /// Where a line is inside of the core or, for a piece of a line, of the strip that far to both
    /// sides of it.
    fn inside(&self, beam: Beam<S>, radius: S) -> Inside<S>;
    /// The least of `normal · point` over the corners, and the corner.
    #[inline(always)]
    fn lowest(&self, normal: Vec2<S>) -> Best<S, Ahead<S>> {
        Best::least(self.corners().as_ref().iter().map(|&on_b| {
            let ahead = normal.dot(on_b);
            Best::of(ahead, Ahead { ahead, on_b })
        }))
    }
    /// The face that parts this core best from another one.
    fn deep<B: Core<S>>(&self, other: &B) -> Best<S, Deepest<S>>;
}

/// The nearest of some corners to an edge.
#[inline(always)]
fn edge_near<S: Scalar>(edge: Edge<S>, corners: &[Vec2<S>]) -> Best<S, Nearest<S>> {
    Best::least(corners.iter().map(|&corner| {
        let found = reach(edge, corner - edge.from);
        let on_self = edge.from + edge.along * found.t;
        Best::of(
            found.apart.length_squared(),
            Nearest {
                apart: found.apart,
                on_a: on_self,
                on_b: corner,
            },
        )
    }))
}

/// How far in front of a face another core begins. The normal points out and has length one, or zero
/// where the face has no length: such a face parts nothing.
#[inline(always)]
fn face_deep<S: Scalar, B: Core<S>>(
    face: Edge<S>,
    normal: Vec2<S>,
    other: &B,
) -> Best<S, Deepest<S>> {
    let first = other.lowest(normal);
    let none = normal.x.equals(S::zero()) & normal.y.equals(S::zero());
    let away = other.away();
    let useless = away.as_ref().iter().fold(none, |useless, direction| {
        useless | normal.dot(*direction).below(S::zero())
    });
    let height = normal.dot(face.from);
    // The middle of the corners that tie may lie beyond the end of the face, though some point between
    // them does not; or it lies before another face of the same line.
    let lowest = first.mean();
    let foot = reach(face, lowest.on_b - face.from);
    let on_a = face.from + face.along * foot.t;
    let beyond = (foot.free - foot.t).magnitude() * S::from_primal(size_of(face.along));
    Best {
        value: S::select(useless, S::lit(-S::LARGEST), first.value - height),
        sum: Deepest {
            ahead: first.sum.ahead - height * first.count,
            normal,
            on_a,
            on_b: on_a + normal * (lowest.ahead - height),
            beyond,
        },
        count: first.count,
    }
}

/// The vector with length one; zero for a vector so short that it counts as none.
#[inline(always)]
pub(crate) fn unit<S: Scalar>(v: Vec2<S>) -> Vec2<S> {
    let square = v.length_squared();
    let none = square.at_most(S::lit(S::EPSILON.powi(4)));
    let length = S::select(none, S::one(), square).root();
    let unit = Vec2::new(v.x.over(length), v.y.over(length));
    choose(none, Vec2::zero(), unit)
}

/// One point.
#[derive(Clone, Copy, Debug)]
pub struct PointCore<S>(pub Vec2<S>);

impl<S: Scalar> Core<S> for PointCore<S> {
    type Corners = [Vec2<S>; 1];
    type Away = [Vec2<S>; 0];
    const DIMENSION: usize = 0;
    #[inline(always)]
    fn anchor(&self) -> Vec2<S> {
        self.0
    }
    #[inline(always)]
    fn extent(&self, from: Vec2<S>) -> S::Primal {
        size_of(self.0 - from)
    }
    #[inline(always)]
    fn placed(self, from: Vec2<S>, scale: S) -> Self {
        PointCore((self.0 - from) * scale)
    }
    #[inline(always)]
    fn corners(&self) -> [Vec2<S>; 1] {
        [self.0]
    }
    #[inline(always)]
    fn away(&self) -> [Vec2<S>; 0] {
        []
    }
    #[inline(always)]
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
    #[inline(always)]
    fn inside(&self, beam: Beam<S>, radius: S) -> Inside<S> {
        Inside::disc(beam, self.0, radius)
    }
    #[inline(always)]
    fn deep<B: Core<S>>(&self, other: &B) -> Best<S, Deepest<S>> {
        face_deep(Edge::between(self.0, self.0), Vec2::zero(), other)
    }
}

/// A piece of a line: with two corners a segment, with one corner and one direction a ray, with one
/// corner and two directions a line.
#[derive(Clone, Copy, Debug)]
pub struct EdgeCore<S, const CORNERS: usize, const AWAY: usize> {
    edge: Edge<S>,
}

impl<S: Scalar> EdgeCore<S, 2, 0> {
    /// The segment between two points.
    #[inline(always)]
    pub fn segment(from: Vec2<S>, to: Vec2<S>) -> Self {
        EdgeCore {
            edge: Edge::between(from, to),
        }
    }
}

impl<S: Scalar, const AWAY: usize> EdgeCore<S, 1, AWAY> {
    /// The ray, or the line, from a point in a direction.
    #[inline(always)]
    pub fn endless(from: Vec2<S>, direction: Vec2<S>) -> Self {
        let large = S::lit(S::LARGEST);
        EdgeCore {
            edge: Edge {
                from,
                // Of a length near one, whatever the unit of the rest.
                along: direction * super::edge::scale_of::<S>(size_of(direction)),
                low: if AWAY == 2 { -large } else { S::zero() },
                high: large,
            },
        }
    }
}

impl<S: Scalar, const CORNERS: usize, const AWAY: usize> Core<S> for EdgeCore<S, CORNERS, AWAY> {
    type Corners = [Vec2<S>; CORNERS];
    type Away = [Vec2<S>; AWAY];
    const DIMENSION: usize = 1;
    const BOUNDED: bool = AWAY == 0;
    #[inline(always)]
    fn anchor(&self) -> Vec2<S> {
        self.edge.from
    }
    #[inline(always)]
    fn extent(&self, from: Vec2<S>) -> S::Primal {
        let arm = self.edge.from - from;
        if AWAY == 0 {
            size_of(arm).most(size_of(arm + self.edge.along))
        } else {
            size_of(arm)
        }
    }
    #[inline(always)]
    fn placed(self, from: Vec2<S>, scale: S) -> Self {
        let Edge { along, .. } = self.edge;
        EdgeCore {
            edge: Edge {
                from: (self.edge.from - from) * scale,
                along: if AWAY == 0 { along * scale } else { along },
                ..self.edge
            },
        }
    }
    #[inline(always)]
    fn corners(&self) -> [Vec2<S>; CORNERS] {
        let Edge { from, along, .. } = self.edge;
        std::array::from_fn(|k| if k == 0 { from } else { from + along })
    }
    #[inline(always)]
    fn away(&self) -> [Vec2<S>; AWAY] {
        let along = self.edge.along;
        std::array::from_fn(|k| if k == 0 { along } else { -along })
    }
    #[inline(always)]
    fn near(&self, corners: &[Vec2<S>]) -> Best<S, Nearest<S>> {
        edge_near(self.edge, corners)
    }
    #[inline(always)]
    fn inside(&self, beam: Beam<S>, radius: S) -> Inside<S> {
        let Edge { from, along, .. } = self.edge;
        Inside::strip(beam, from, along, radius, AWAY < 2, AWAY == 0)
    }
    #[inline(always)]
    fn deep<B: Core<S>>(&self, other: &B) -> Best<S, Deepest<S>> {
        let normal = unit(self.edge.along.perp());
        let [left, right] = [normal, -normal].map(|normal| face_deep(self.edge, normal, other));
        left.most(right)
    }
}

/// A convex polygon of at most N corners, counter-clockwise; corners may be repeated.
#[derive(Clone, Copy, Debug)]
pub struct PolygonCore<S, const N: usize>(pub [Vec2<S>; N]);

impl<S: Scalar, const N: usize> Core<S> for PolygonCore<S, N> {
    type Corners = [Vec2<S>; N];
    type Away = [Vec2<S>; 0];
    const DIMENSION: usize = 2;
    #[inline(always)]
    fn anchor(&self) -> Vec2<S> {
        self.0[0]
    }
    #[inline(always)]
    fn extent(&self, from: Vec2<S>) -> S::Primal {
        self.0.iter().fold(S::Primal::zero(), |most, &corner| {
            most.most(size_of(corner - from))
        })
    }
    #[inline(always)]
    fn placed(self, from: Vec2<S>, scale: S) -> Self {
        PolygonCore(self.0.map(|corner| (corner - from) * scale))
    }
    #[inline(always)]
    fn corners(&self) -> [Vec2<S>; N] {
        self.0
    }
    #[inline(always)]
    fn away(&self) -> [Vec2<S>; 0] {
        []
    }
    #[inline(always)]
    fn near(&self, corners: &[Vec2<S>]) -> Best<S, Nearest<S>> {
        Best::least(
            (0..N).map(|i| edge_near(Edge::between(self.0[i], self.0[(i + 1) % N]), corners)),
        )
    }
    #[inline(always)]
    fn inside(&self, beam: Beam<S>, _: S) -> Inside<S> {
        Inside::polygon(beam, &self.0)
    }
    #[inline(always)]
    fn deep<B: Core<S>>(&self, other: &B) -> Best<S, Deepest<S>> {
        Best::most_of((0..N).map(|i| {
            let face = Edge::between(self.0[i], self.0[(i + 1) % N]);
            face_deep(face, -unit(face.along.perp()), other)
        }))
    }
}

/// How a box is turned: not at all, or by a rotation.
pub trait Turn<S: Scalar>: Copy {
    /// From the box's own axes to the world's.
    fn out(&self, v: Vec2<S>) -> Vec2<S>;
    /// From the world's axes to the box's own.
    fn back(&self, v: Vec2<S>) -> Vec2<S>;
}

/// Not turned.
#[derive(Clone, Copy, Debug)]
pub struct Upright;

impl<S: Scalar> Turn<S> for Upright {
    #[inline(always)]
    fn out(&self, v: Vec2<S>) -> Vec2<S> {
        v
    }
    #[inline(always)]
    fn back(&self, v: Vec2<S>) -> Vec2<S> {
        v
    }
}

impl<S: Scalar> Turn<S> for Rotation2<S> {
    #[inline(always)]
    fn out(&self, v: Vec2<S>) -> Vec2<S> {
        *self * v
    }
    #[inline(always)]
    fn back(&self, v: Vec2<S>) -> Vec2<S> {
        self.inverse() * v
    }
}

/// A box: what it does with a corner it does in its own frame, where it is four comparisons.
#[derive(Clone, Copy, Debug)]
pub struct BoxCore<S, R> {
    /// The centre.
    pub center: Vec2<S>,
    /// Half its size.
    pub half: Vec2<S>,
    /// How it is turned.
    pub turn: R,
}

impl<S: Scalar, R: Turn<S>> BoxCore<S, R> {
    /// The normals of the faces, how far the faces are from the centre, and half their lengths.
    #[inline(always)]
    fn faces(&self) -> [(Vec2<S>, S, S); 4] {
        let (right, up) = (
            self.turn.out(Vec2::new(S::one(), S::zero())),
            self.turn.out(Vec2::new(S::zero(), S::one())),
        );
        let Vec2 { x, y } = self.half;
        [(right, x, y), (-right, x, y), (up, y, x), (-up, y, x)]
    }
}

impl<S: Scalar, R: Turn<S>> Core<S> for BoxCore<S, R> {
    type Corners = [Vec2<S>; 4];
    type Away = [Vec2<S>; 0];
    const DIMENSION: usize = 2;
    #[inline(always)]
    fn anchor(&self) -> Vec2<S> {
        self.center
    }
    #[inline(always)]
    fn extent(&self, from: Vec2<S>) -> S::Primal {
        size_of(self.center - from) + (self.half.x.primal() + self.half.y.primal())
    }
    #[inline(always)]
    fn placed(self, from: Vec2<S>, scale: S) -> Self {
        BoxCore {
            center: (self.center - from) * scale,
            half: self.half * scale,
            turn: self.turn,
        }
    }
    #[inline(always)]
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
    #[inline(always)]
    fn away(&self) -> [Vec2<S>; 0] {
        []
    }
    #[inline(always)]
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
    #[inline(always)]
    fn inside(&self, beam: Beam<S>, _: S) -> Inside<S> {
        self.faces()
            .into_iter()
            .fold(Inside::everywhere(), |inside, (normal, half, _)| {
                inside.behind(beam, self.center + normal * half, normal)
            })
    }
    #[inline(always)]
    fn deep<B: Core<S>>(&self, other: &B) -> Best<S, Deepest<S>> {
        Best::most_of(self.faces().into_iter().map(|(normal, half, side)| {
            let face = Edge {
                from: self.center + normal * half,
                along: normal.perp(),
                low: -side,
                high: side,
            };
            face_deep(face, normal, other)
        }))
    }
    /// Without the corners: half the diagonals' projections. Corners that tie are their middle.
    #[inline(always)]
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

//! Rays and segments against triangles, by signs that rounding does not change.
//!
//! Seen along the ray a triangle is three points of a plane, and the ray is the origin. It hits the triangle where the
//! origin is on one side of all edges, or on them. An edge of two triangles has two common points, with opposite signs.
//! The sign of a value within its rounding comes from numbers of twice the digits, and a value within their rounding
//! counts as zero: on the border. So neither edges nor vertices of a closed surface let a ray through.
use super::Hit3;
use crate::arrays::Each;
use crate::distance::edge::scale_of;
use crate::distance3::near::size_of;
use crate::scalar::{Guard, largest};
use crate::shape::{Ray3, Segment3, Triangle3};
use crate::twofold::Twofold;
use crate::{Mask, Scalar, Vec3};

/// A vector of twice the digits.
type Wide3<P> = [Twofold<P>; 3];

/// A line from a point, and its end if it has one, in plain numbers.
#[derive(Clone, Copy)]
struct Sight<P> {
    from: Vec3<P>,
    way: Vec3<P>,
    to: Option<Vec3<P>>,
}

/// The powers of two that bring differences of points and the direction near one.
#[derive(Clone, Copy)]
struct LineUnits<P> {
    place: P,
    way: P,
}

/// The sides of a line relative to three edges.
#[derive(Clone, Copy)]
struct EdgeSides<P: Scalar> {
    values: [P; 3],
    /// The sizes of the coordinates in their products.
    reach: [P; 3],
    /// `true` if a value may have another sign, or too few digits.
    doubt: P::Mask,
}

/// The height of a point behind a triangle's plane.
#[derive(Clone, Copy)]
struct PlaneHeight<P: Scalar> {
    place: Vec3<P>,
    value: P,
    /// The product of the sizes of two edges.
    size: P,
    /// `true` if the value may have another sign.
    doubt: P::Mask,
}

impl<P: Scalar<Primal = P>> PlaneHeight<P> {
    /// Replaces the value by one computed with twice the digits where its sign is in doubt; it is zero in the plane.
    #[inline(always)]
    fn settled(self, doubt: P::Mask, triangle: [Vec3<P>; 3], unit: P) -> Self {
        // The vector from the point may be much shorter than the edges, and so is its rounding error.
        let near = scale_of::<P>(size_of(triangle[0] - self.place));
        let exact = wide_behind(self.place, triangle, [unit, near]);
        let exact = unless_zero(exact, self.size, 256.0);
        PlaneHeight {
            value: P::select(doubt, exact, self.value),
            ..self
        }
    }
}

/// Returns `true` where a number is at most a part of another one.
#[inline(always)]
fn within<P: Scalar>(x: P, of: P, part: f64) -> P::Mask {
    x.unsigned().at_most(of * P::lit(part))
}

/// Returns a number of twice the digits, zero if it is within `roundings` of its roundings.
#[inline(always)]
fn unless_zero<P: Scalar>(x: P, of: P, roundings: f64) -> P {
    let zero = within(x, of, roundings * P::format().epsilon().powi(2));
    P::select(zero, P::zero(), x)
}

#[inline(always)]
fn plain<S: Scalar>(v: Vec3<S>) -> Vec3<S::Primal> {
    Vec3::new(v.x.primal(), v.y.primal(), v.z.primal())
}

/// Returns the larger coordinate of a pair, without sign.
#[inline(always)]
fn most_of<P: Scalar>([x, y]: [P; 2]) -> P {
    x.unsigned().most(y.unsigned())
}

impl<P: Scalar<Primal = P>> Sight<P> {
    /// Returns the axis along which the direction is longest comes last; the order around stays.
    #[inline(always)]
    fn turned(self, [a, b, c]: [Vec3<P>; 3]) -> (Self, [Vec3<P>; 3]) {
        let [x, y, z] = [self.way.x, self.way.y, self.way.z].map(Scalar::unsigned);
        let by_z = x.at_most(z) & y.at_most(z);
        let by_x = y.at_most(x);
        let pick = |z: P, x: P, y: P| P::select(by_z, z, P::select(by_x, x, y));
        let turn = |v: Vec3<P>| {
            Vec3::new(
                pick(v.x, v.y, v.z),
                pick(v.y, v.z, v.x),
                pick(v.z, v.x, v.y),
            )
        };
        let sight = Sight {
            from: turn(self.from),
            way: turn(self.way),
            to: self.to.map(turn),
        };
        (sight, [turn(a), turn(b), turn(c)])
    }

    /// Returns the vector from one point to another, in twice the digits.
    #[inline(always)]
    fn arm(from: Vec3<P>, to: Vec3<P>, unit: P) -> Wide3<P> {
        [(to.x, from.x), (to.y, from.y), (to.z, from.z)]
            .map(|(to, from)| Twofold::difference(to, from).scaled(unit))
    }

    /// Returns the sides of the edges bc, ca, ab on which the line passes, times the direction's last coordinate.
    #[inline(always)]
    fn sides(self, corners: [Vec3<P>; 3], units: LineUnits<P>) -> EdgeSides<P> {
        let d = self.way * units.way;
        let seen = corners.each_as(|corner| {
            let arm = (corner - self.from) * units.place;
            [arm.y * d.z - arm.z * d.y, arm.z * d.x - arm.x * d.z]
        });
        let size = seen.each_as(most_of);
        // The edges opposite to a, b, c.
        let pairs = [(1, 2), (2, 0), (0, 1)];
        let values = pairs.map(|(i, j)| seen[i][0] * seen[j][1] - seen[i][1] * seen[j][0]);
        let reach = pairs.map(|(i, j)| size[i] + size[j]);
        // Factors of a relative coordinate are below 4. Three roundings of each product and one of their difference
        // leave 64 ε of a coordinate. Twice that and the roundings of a side, of coordinates below 32, are less than
        // 192 ε.
        let close = [0, 1, 2].map(|k| within(values[k], reach[k], 192.0 * P::format().epsilon()));
        // Weights by sides lose as many digits as the triangle looks thin.
        let [u, v, w] = values;
        let (low, high) = (u.least(v).least(w), u.most(v).most(w));
        let crossed = low.at_least(P::zero()) | high.at_most(P::zero());
        let square = size[0].most(size[1]).most(size[2]).squared();
        let area = (u + v + w).unsigned();
        let thin = crossed & area.at_most(square * P::lit(1.0 / 256.0));
        EdgeSides {
            values,
            reach,
            doubt: close[0] | close[1] | close[2] | thin,
        }
    }

    /// Returns the sides in twice the digits: to 320 ε² of the relative coordinates.
    #[cold]
    #[inline(never)]
    fn wide_sides(self, corners: [Vec3<P>; 3], units: LineUnits<P>) -> [P; 3] {
        let d: Wide3<P> = match self.to {
            Some(to) => Self::arm(self.from, to, units.way),
            None => [self.way.x, self.way.y, self.way.z].map(|x| Twofold::of(x * units.way)),
        };
        let seen = corners.map(|corner| {
            let [x, y, z] = Self::arm(self.from, corner, units.place);
            [
                Twofold::cross([y, z], [d[1], d[2]]),
                Twofold::cross([z, x], [d[2], d[0]]),
            ]
        });
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| Twofold::cross(seen[i], seen[j]).high)
    }
}

/// Returns the height of a point behind a triangle's plane, times twice the area. All in plain numbers, in units of the
/// edges and of the vector from the point.
#[inline(always)]
fn behind<P: Scalar<Primal = P>>(
    place: Vec3<P>,
    [a, b, c]: [Vec3<P>; 3],
    [unit, near]: [P; 2],
) -> PlaneHeight<P> {
    let (p, q) = ((b - a) * unit, (c - a) * unit);
    let value = p.cross(q).dot((a - place) * near);
    let size = size_of(p) * size_of(q);
    // Coordinates of the arm are below 4; roundings of the cross product and of the sum reach 100 ε.
    let doubt = within(value, size, 128.0 * P::format().epsilon());
    PlaneHeight {
        place,
        value,
        size,
        doubt,
    }
}

/// Returns the height behind the plane in twice the digits: to 138 ε² of the edges' product.
#[cold]
#[inline(never)]
fn wide_behind<P: Scalar<Primal = P>>(
    place: Vec3<P>,
    [a, b, c]: [Vec3<P>; 3],
    [unit, near]: [P; 2],
) -> P {
    let (p, q) = (Sight::arm(a, b, unit), Sight::arm(a, c, unit));
    let arm = Sight::arm(place, a, near);
    let part =
        |i: usize, j: usize, k: usize| Twofold::cross([p[i], p[j]], [q[i], q[j]]).times(arm[k]);
    part(1, 2, 0).plus(part(2, 0, 1)).plus(part(0, 1, 2)).high
}

/// Returns the point at which a line from a point hits a triangle; before its end, if it has one.
#[inline(always)]
fn hit<S: Scalar>(ray: Ray3<S>, end: Option<Vec3<S>>, triangle: Triangle3<S>) -> Hit3<S> {
    let corners = triangle.corners();
    let arms = corners.each_as(|corner| corner - ray.point);
    let place = scale_of::<S>(largest(arms.each_as(|arm| S::from_primal(size_of(arm)))));
    let way = scale_of::<S>(size_of(ray.direction));
    let units = LineUnits {
        place: place.primal(),
        way: way.primal(),
    };
    let sight = Sight {
        from: plain(ray.point),
        way: plain(ray.direction),
        to: end.map(plain),
    };
    let flat = corners.each_as(plain);
    let (turned, turned_corners) = sight.turned(flat);
    let EdgeSides {
        values: mut sides,
        reach,
        doubt,
    } = turned.sides(turned_corners, units);
    let mut start = behind(sight.from, flat, [units.place; 2]);
    let mut stop = sight.to.map(|to| {
        let near = scale_of(size_of(flat[0] - to));
        behind(to, flat, [units.place, near])
    });
    // One truth for all signs, so that a batch leaves out all digits beyond the first ones where no item needs them.
    let doubt = doubt | start.doubt;
    let doubt = stop.as_ref().map_or(doubt, |stop| doubt | stop.doubt);
    if doubt.any() {
        let exact = turned.wide_sides(turned_corners, units);
        sides = [0, 1, 2].each_as(|k| {
            let exact = unless_zero(exact[k], reach[k], 512.0);
            S::Primal::select(doubt, exact, sides[k])
        });
        start = start.settled(doubt, flat, units.place);
        stop = stop.map(|stop| stop.settled(doubt, flat, units.place));
    }

    let zero = S::Primal::zero();
    let [u, v, w] = sides.each_as(|side| side.at_least(zero));
    let [x, y, z] = sides.each_as(|side| side.at_most(zero));
    let total = sides[0] + sides[1] + sides[2];
    let last = turned.way.z * units.way;
    let crossed = ((u & v & w) | (x & y & z)) & !total.equals(zero);
    // The rate of approach to the plane has the sign of the sides, seen along the last axis.
    let rises = total.signed_as(last).above(zero);
    let reached = |behind: S::Primal| S::Primal::select(rises, behind, -behind).at_least(zero);
    let mut found = crossed & reached(start.value);
    // The mean of the corners by their weights, which is between them even if rounding makes the weights.
    let over = S::Primal::select(found, total * last, S::Primal::one());
    let along = |corner: Vec3<S::Primal>| (corner.z - turned.from.z) * units.place;
    let [a, b, c] = turned_corners.each_as(along);
    let t = (a * sides[0] + b * sides[1] + c * sides[2]).over(over);
    let mut t = S::Primal::select(start.value.equals(zero), zero, t.most(zero));
    let one = units.place.over(units.way);
    let mut last_point = None;
    if let Some(stop) = stop {
        let at_end = stop.value.equals(zero);
        found = found & reached(-stop.value);
        t = S::Primal::select(at_end, one, t.least(one));
        last_point = Some((found & at_end, stop.place));
    }

    // Slopes are those of the plane.
    let [p, q] = [triangle.b - triangle.a, triangle.c - triangle.a].each_as(|edge| edge * place);
    let normal = p.cross(q);
    let rate = S::Primal::select(found, total.over(last), S::Primal::one());
    let ahead = S::select(found, normal.dot(arms[0] * place), S::zero()).with_primal(t * rate);
    let rate = S::select(found, normal.dot(ray.direction * way), S::one()).with_primal(rate);
    let t = (ahead.over(rate).with_primal(t) * way)
        .over(place)
        .saturated();
    let unit = normal.normalize_or_zero();
    let facing = Vec3::select(rises, -unit, unit);
    let mut point = ray.point_at(S::select(found, t, S::zero()));
    if let Some((at_end, to)) = last_point {
        let value = Vec3::select(at_end, to, plain(point));
        point = Vec3::new(
            point.x.with_primal(value.x),
            point.y.with_primal(value.y),
            point.z.with_primal(value.z),
        );
    }
    let guard = Guard::of(&ray).and(&triangle);
    let guard = end.map_or(guard, |end| guard.and(&end));
    guard.result(Hit3 {
        parameter: S::select(found, t, S::largest()).canonical(),
        point: point.canonical(),
        normal: Vec3::select(found, facing, Vec3::zero()).canonical(),
        kind: S::select(found, S::one(), S::zero()),
    })
}

/// Returns the point of a triangle that a ray hits; its border belongs to it.
///
/// The border is that of the given numbers, to a part of ε² of the terms of the signs. Rays through a vertex or an edge
/// hit every triangle there that is not edge-on, and none passes between triangles that share one. A triangle without
/// area is missed, and one seen edge-on; both are decided alike. Points of hits lie between the corners.
///
/// ```
/// use geograd::{Ray3, Triangle3, Vec3, intersection3::first_hit_triangle};
/// let [a, b, c] = [Vec3::new(0.0, 0.0, 4.0), Vec3::new(4.0, 0.0, 4.0), Vec3::new(0.0, 4.0, 4.0)];
/// let beam = Ray3::new(Vec3::new(1.0, 1.0, 0.0), Vec3::new(0.0, 0.0, 2.0));
/// let hit = first_hit_triangle(beam, Triangle3::new(a, b, c));
/// assert_eq!((hit.kind, hit.parameter, hit.point), (1.0, 2.0, Vec3::new(1.0, 1.0, 4.0)));
/// assert_eq!(hit.normal, Vec3::new(0.0, 0.0, -1.0));
/// ```
#[must_use]
#[inline]
pub fn first_hit_triangle<S: Scalar>(ray: Ray3<S>, triangle: Triangle3<S>) -> Hit3<S> {
    hit(ray, None, triangle)
}

/// Returns the point in which a segment meets a triangle; both ends and the border belong to them. The parameter is the
/// fraction of the way from start to end.
///
/// As for [rays](first_hit_triangle), on the line through both ends: a triangle without area is missed, one seen
/// edge-on, and by a segment of length zero. An end in the triangle is the point itself.
///
/// ```
/// use geograd::{Segment3, Triangle3, Vec3, intersection3::first_hit_of_segment};
/// let [a, b, c] = [Vec3::new(0.0, 0.0, 1.0), Vec3::new(4.0, 0.0, 1.0), Vec3::new(0.0, 4.0, 1.0)];
/// let post = Segment3::new(Vec3::new(1.0, 1.0, 0.0), Vec3::new(1.0, 1.0, 4.0));
/// let hit = first_hit_of_segment(post, Triangle3::new(a, b, c));
/// assert_eq!((hit.kind, hit.parameter, hit.point), (1.0, 0.25, Vec3::new(1.0, 1.0, 1.0)));
/// let short = Segment3::new(post.start, Vec3::new(1.0, 1.0, 0.5));
/// assert_eq!(first_hit_of_segment(short, Triangle3::new(a, b, c)).kind, 0.0);
/// ```
#[must_use]
#[inline]
pub fn first_hit_of_segment<S: Scalar>(segment: Segment3<S>, triangle: Triangle3<S>) -> Hit3<S> {
    let ray = Ray3::new(segment.start, segment.vector());
    hit(ray, Some(segment.end), triangle)
}

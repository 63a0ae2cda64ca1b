//! Proofs of distances in space: two points at the distance, and a plane that separates the bodies by it.
//!
//! Points of the bodies bound their distance from above, a plane between them bounds it from below. A body has only its
//! extent along a direction, so that no formula under test is used. `compare/proof` compares a value with the bounds.
use crate::Vec3;

type Vector = Vec3<f64>;

/// A circle that belongs to a body: the end of a cylinder, the base of a cone.
#[derive(Clone, Copy, Debug)]
struct Rim {
    center: Vector,
    axis: Vector,
    radius: f64,
}

/// An ellipsoid, as half of its extents along three directions of length one.
#[derive(Clone, Copy, Debug)]
struct Ellipsoid {
    center: Vector,
    axes: [Vector; 3],
    half: [f64; 3],
}

impl Ellipsoid {
    /// Returns the largest coordinate along a direction.
    fn reach(&self, normal: Vector) -> f64 {
        let along = |k: usize| self.axes[k].dot(normal) * self.half[k];
        self.center.dot(normal) + Vec3::new(along(0), along(1), along(2)).length()
    }
    /// Returns the normal of the surface of this shape that passes through a point.
    fn normal(&self, point: Vector) -> Vector {
        let arm = point - self.center;
        let part = |k: usize| match self.half[k] > 0.0 {
            true => self.axes[k] * (self.axes[k].dot(arm) / self.half[k] / self.half[k]),
            false => Vec3::zero(),
        };
        part(0) + part(1) + part(2)
    }
}

/// A convex body of space: the hull of corners, circles and ellipsoids, without end along some directions, inflated by a
/// radius.
#[derive(Clone, Debug)]
pub struct Body {
    corners: Vec<Vector>,
    /// The directions of its edges; any two may span a face.
    ways: Vec<Vector>,
    endless: Vec<Vector>,
    rims: Vec<Rim>,
    ellipsoids: Vec<Ellipsoid>,
    radius: f64,
}

/// The measure that a proof is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Proved {
    /// The distance; 0 where the bodies touch or overlap.
    Distance,
    /// Its square.
    SquaredDistance,
    /// The distance, or minus the depth of overlap.
    SignedDistance,
}

/// The proof of a distance: the bodies, and the points given as nearest.
#[derive(Clone, Debug)]
pub struct Proof {
    /// The function.
    pub measure: Proved,
    /// The bodies.
    pub bodies: [Body; 2],
    /// A point of each, if a companion of the function returns them.
    pub points: Option<[Vec3<f64>; 2]>,
}

fn difference_of_all(corners: &[Vector]) -> Vec<Vector> {
    let pairs = corners.iter().enumerate();
    pairs
        .flat_map(|(i, &p)| corners[..i].iter().map(move |&q| p - q))
        .collect()
}

/// Returns the vector scaled to length one; `None` for zero.
fn unit(v: Vector) -> Option<Vector> {
    let size = v.x.abs().max(v.y.abs()).max(v.z.abs());
    let length = (v * (1.0 / size)).length() * size;
    (length.is_finite() && length > 0.0).then(|| v * (1.0 / length))
}

/// Returns the part of a vector that is orthogonal to another one.
fn aside(v: Vector, from: Vector) -> Vector {
    match unit(from) {
        Some(from) => v - from * from.dot(v),
        None => v,
    }
}

/// A cosine below which a direction is orthogonal to another one.
const ORTHOGONAL: f64 = 1e-14;

impl Body {
    /// Creates the hull of a few corners: planes along every three of them are tried.
    #[must_use]
    pub fn hull(corners: &[Vec3<f64>], radius: f64) -> Self {
        Body {
            corners: corners.to_vec(),
            ways: difference_of_all(corners),
            endless: Vec::new(),
            rims: Vec::new(),
            ellipsoids: Vec::new(),
            radius,
        }
    }
    /// Creates a box, given the vectors from its centre to three faces, with edges rounded by a radius.
    #[must_use]
    pub fn boxed(
        center: Vec3<f64>,
        arms: [Vec3<f64>; 3],
        axes: [Vec3<f64>; 3],
        radius: f64,
    ) -> Self {
        let corner = |n: usize| {
            let side = |k: usize| arms[k] * if n >> k & 1 == 1 { 1.0 } else { -1.0 };
            center + side(0) + side(1) + side(2)
        };
        Body {
            corners: (0..8).map(corner).collect(),
            ways: axes.to_vec(),
            endless: Vec::new(),
            rims: Vec::new(),
            ellipsoids: Vec::new(),
            radius,
        }
    }
    /// Creates the ray from a point along a direction, or the whole line if `both_sides` holds.
    #[must_use]
    pub fn line(point: Vec3<f64>, direction: Vec3<f64>, both_sides: bool) -> Self {
        let mut endless = vec![direction];
        endless.extend(both_sides.then_some(-direction));
        Body {
            corners: vec![point],
            ways: vec![direction],
            endless,
            rims: Vec::new(),
            ellipsoids: Vec::new(),
            radius: 0.0,
        }
    }
    /// Creates the half-space of all points with `normal · point <= offset`.
    #[must_use]
    pub fn half_space(normal: Vec3<f64>, offset: f64) -> Self {
        let scale = 1.0 / normal.x.abs().max(normal.y.abs()).max(normal.z.abs());
        let (normal, offset) = (normal * scale, offset * scale);
        let [u, v] = across(normal);
        Body {
            corners: vec![normal * (offset / normal.length_squared())],
            ways: vec![u, v],
            endless: vec![-normal, u, -u, v, -v],
            rims: Vec::new(),
            ellipsoids: Vec::new(),
            radius: 0.0,
        }
    }
    /// Creates a cylinder between two points.
    #[must_use]
    pub fn cylinder(start: Vec3<f64>, end: Vec3<f64>, radius: f64) -> Self {
        let axis = unit(end - start).unwrap_or_else(Vec3::zero);
        let rim = |center| Rim {
            center,
            axis,
            radius,
        };
        Body {
            corners: Vec::new(),
            ways: vec![axis],
            endless: Vec::new(),
            rims: vec![rim(start), rim(end)],
            ellipsoids: Vec::new(),
            radius: 0.0,
        }
    }
    /// Creates a cone.
    #[must_use]
    pub fn cone(apex: Vec3<f64>, base: Vec3<f64>, radius: f64) -> Self {
        let axis = unit(base - apex).unwrap_or_else(Vec3::zero);
        Body {
            corners: vec![apex],
            ..Body::disc(base, axis, radius)
        }
    }
    /// Creates a flat disc.
    #[must_use]
    pub fn disc(center: Vec3<f64>, normal: Vec3<f64>, radius: f64) -> Self {
        let axis = unit(normal).unwrap_or_else(Vec3::zero);
        Body {
            corners: Vec::new(),
            ways: vec![axis],
            endless: Vec::new(),
            rims: vec![Rim {
                center,
                axis,
                radius,
            }],
            ellipsoids: Vec::new(),
            radius: 0.0,
        }
    }
    /// Creates an ellipsoid, given half of its extents along directions of length one.
    #[must_use]
    pub fn ellipsoid(center: Vec3<f64>, half: [f64; 3], axes: [Vec3<f64>; 3]) -> Self {
        Body {
            corners: Vec::new(),
            ways: axes.to_vec(),
            endless: Vec::new(),
            rims: Vec::new(),
            ellipsoids: vec![Ellipsoid { center, axes, half }],
            radius: 0.0,
        }
    }
    /// Returns the largest coordinate of its points along a direction of length one.
    fn reach(&self, normal: Vector) -> f64 {
        let ends = |way: &Vector| unit(*way).is_none_or(|way| normal.dot(way) <= ORTHOGONAL);
        if !self.endless.iter().all(ends) {
            return f64::INFINITY;
        }
        let corners = self.corners.iter().map(|&p| normal.dot(p));
        let rims = self.rims.iter();
        let rims =
            rims.map(|rim| rim.center.dot(normal) + rim.radius * aside(normal, rim.axis).length());
        let round = self.ellipsoids.iter().map(|round| round.reach(normal));
        let all = corners.chain(rims).chain(round);
        all.fold(f64::NEG_INFINITY, f64::max) + self.radius
    }
    /// Returns its largest coordinate plus its radii.
    fn size(&self) -> f64 {
        let size = |p: &Vector| p.x.abs().max(p.y.abs()).max(p.z.abs());
        let rims = self.rims.iter().map(|rim| size(&rim.center) + rim.radius);
        let largest = |half: [f64; 3]| half[0].max(half[1]).max(half[2]);
        let round = self.ellipsoids.iter();
        let round = round.map(|round| size(&round.center) + largest(round.half));
        self.corners
            .iter()
            .map(size)
            .chain(rims)
            .chain(round)
            .fold(0.0, f64::max)
            + self.radius
    }
    /// Returns the body in other units.
    fn scaled(&self, by: f64) -> Self {
        let all = |list: &[Vector]| list.iter().map(|&v| v * by).collect();
        let rim = |rim: &Rim| Rim {
            center: rim.center * by,
            radius: rim.radius * by,
            ..*rim
        };
        let round = |round: &Ellipsoid| Ellipsoid {
            center: round.center * by,
            half: round.half.map(|half| half * by),
            ..*round
        };
        Body {
            corners: all(&self.corners),
            ways: self.ways.clone(),
            endless: self.endless.clone(),
            rims: self.rims.iter().map(rim).collect(),
            ellipsoids: self.ellipsoids.iter().map(round).collect(),
            radius: self.radius * by,
        }
    }
    /// Returns corners and directions of edges; circles are replaced by their section in the planes towards some
    /// points.
    fn flat(&self, towards: &[Vector]) -> (Vec<Vector>, Vec<Vector>) {
        let (mut corners, mut ways) = (self.corners.clone(), self.ways.clone());
        let mut section = self.corners.clone();
        for p in towards.iter().filter(|_| !self.rims.is_empty()) {
            for rim in &self.rims {
                let off = unit(aside(aside(*p - rim.center, rim.axis), rim.axis));
                let off = off.unwrap_or(across(rim.axis)[0]);
                ways.extend([off, rim.axis.cross(off)]);
                section.extend([rim.center + off * rim.radius, rim.center - off * rim.radius]);
            }
        }
        if !self.rims.is_empty() {
            ways.extend(difference_of_all(&section));
            corners = section;
        }
        (corners, ways)
    }
    /// Returns `true` if it is a point, inflated or not.
    fn is_point(&self) -> bool {
        self.corners.len() == 1 && self.is_flat() && self.endless.is_empty()
    }
    /// Returns `true` if it has no circles and no ellipsoids.
    fn is_flat(&self) -> bool {
        self.rims.is_empty() && self.ellipsoids.is_empty()
    }
    /// Returns a lower bound of the distance of a point from the body, by its faces and edges; 0 inside.
    fn outside(&self, point: Vector) -> f64 {
        let (_, ways) = self.flat(&[point]);
        let mut normals = ways.clone();
        for (i, u) in ways.iter().enumerate() {
            normals.extend(ways[..i].iter().map(|v| u.cross(*v)));
        }
        normals.extend(self.ellipsoids.iter().map(|round| round.normal(point)));
        let signed = normals.into_iter().filter_map(unit).flat_map(|n| [n, -n]);
        let gaps = signed.map(|n| n.dot(point) - self.reach(n));
        gaps.fold(0.0, f64::max)
    }
}

/// Returns two directions orthogonal to another one and to each other.
fn across(axis: Vector) -> [Vector; 2] {
    let least = axis.x.abs().min(axis.y.abs()).min(axis.z.abs());
    let other = match least {
        x if x == axis.x.abs() => Vec3::new(1.0, 0.0, 0.0),
        y if y == axis.y.abs() => Vec3::new(0.0, 1.0, 0.0),
        _ => Vec3::new(0.0, 0.0, 1.0),
    };
    let u = unit(axis.cross(other)).unwrap_or(other);
    [u, unit(axis.cross(u)).unwrap_or_else(Vec3::zero)]
}

/// The bounds that a proof gives for a distance, in the unit of length.
pub(crate) struct ProvedBounds {
    /// The gap of the plane that separates the bodies best: at most the signed distance. For bodies with flat faces,
    /// edges and corners it equals the signed distance, for others where they are apart.
    pub parted: f64,
    /// `true` if it equals the signed distance where the bodies overlap, too.
    pub is_depth: bool,
    /// The distance of the points, and the larger distance of a point from its body.
    pub points: Option<[f64; 2]>,
    /// The largest coordinate.
    pub size: f64,
}

impl Proof {
    /// Returns `true` if lines or rays are among the bodies.
    pub(crate) fn is_endless(&self) -> bool {
        self.bodies.iter().any(|body| !body.endless.is_empty())
    }
    /// Returns the bounds that it proves; `None` if no plane separates the bodies by a finite number, as for lines that
    /// cross.
    pub(crate) fn bounds(&self) -> Option<ProvedBounds> {
        let size = self.bodies[0].size().max(self.bodies[1].size());
        if !size.is_finite() {
            return None;
        }
        // So that no product over- or underflows.
        let unit_size = match size {
            0.0 => 1.0,
            size => size.log2().ceil().exp2(),
        };
        let [a, b] = [0, 1].map(|k| self.bodies[k].scaled(1.0 / unit_size));
        let parted = best(&a, &b) * unit_size;
        let points = self.points.map(|points| {
            let [p, q] = points.map(|p| p * (1.0 / unit_size));
            let off = a.outside(p).max(b.outside(q));
            [(q - p).length() * unit_size, off * unit_size]
        });
        parted.is_finite().then_some(ProvedBounds {
            parted,
            is_depth: !curved(&a, &b),
            points,
            size,
        })
    }
}

/// Returns `true` if planes along faces, edges and sections of circles do not suffice.
fn curved(a: &Body, b: &Body) -> bool {
    let round = |own: &Body, other: &Body| {
        !own.ellipsoids.is_empty() || !own.rims.is_empty() && !other.is_point()
    };
    round(a, b) || round(b, a)
}

/// The number of sections of a range that leave nothing of it.
const SECTIONS: usize = 76;

/// Returns the largest value of a function that rises to one summit, between two numbers, and its place: by golden
/// sections.
fn summit(low: f64, high: f64, of: &mut dyn FnMut(f64) -> f64) -> (f64, f64) {
    let share = (5.0_f64.sqrt() - 1.0) / 2.0;
    let (mut low, mut high) = (low, high);
    let at = |low: f64, high: f64| [high - share * (high - low), low + share * (high - low)];
    let [mut x, mut y] = at(low, high);
    let (mut of_x, mut of_y) = (of(x), of(y));
    for _ in 0..SECTIONS {
        if of_x < of_y {
            (low, x, of_x) = (x, y, of_y);
            y = at(low, high)[1];
            of_y = of(y);
        } else {
            (high, y, of_y) = (y, x, of_x);
            x = at(low, high)[0];
            of_x = of(x);
        }
    }
    if of_x < of_y { (of_y, y) } else { (of_x, x) }
}

/// Returns the gap of the best plane whose normal is less than 70° from a direction.
///
/// The gap along a vector is a concave function of it, so that the gap along the direction of a vector has one summit in
/// a plane of vectors, where it is positive.
fn best_near(gap: &dyn Fn(Vector) -> f64, normal: Vector) -> f64 {
    let [x, y] = across(normal);
    let rated = |s: f64, t: f64| {
        let way = normal + x * s + y * t;
        let length = way.length();
        let found = gap(way * (1.0 / length));
        if found < 0.0 { found * length } else { found }
    };
    let mut most = f64::NEG_INFINITY;
    let along = &mut |s: f64| {
        let (found, _) = summit(-2.7, 2.7, &mut |t| rated(s, t));
        most = most.max(found);
        found
    };
    summit(-2.7, 2.7, along);
    most
}

/// Returns the gap of the plane that separates two bodies best. It tries planes along faces and pairs of edges, and
/// planes normal to the vectors from corner to corner and from corner to edge.
fn best(a: &Body, b: &Body) -> f64 {
    let centers = |body: &Body| -> Vec<Vector> {
        let rims = body.rims.iter().map(|rim| rim.center);
        let round = body.ellipsoids.iter().map(|round| round.center);
        let corners = body.corners.iter().copied();
        corners.chain(rims).chain(round).collect()
    };
    let round =
        |body: &Body| -> Vec<Vector> { body.ellipsoids.iter().map(|round| round.center).collect() };
    let (mut corners_a, ways_a) = a.flat(&centers(b));
    let (mut corners_b, ways_b) = b.flat(&centers(a));
    corners_a.extend(round(a));
    corners_b.extend(round(b));
    let ways: Vec<Vector> = ways_a.into_iter().chain(ways_b).collect();
    let mut normals = ways.clone();
    for (i, u) in ways.iter().enumerate() {
        // Twice, since the product of directions that are nearly parallel is mostly rounding.
        let product = |v: &Vector| aside(aside(aside(u.cross(*v), *u), *v), *u);
        normals.extend(ways[..i].iter().map(product));
    }
    // For bodies on one line or in one point any orthogonal direction will do.
    normals.extend(ways.iter().flat_map(|&way| across(way)));
    normals.extend(across(Vec3::zero()));
    for p in &corners_a {
        for q in &corners_b {
            let way = *q - *p;
            normals.push(way);
            normals.extend(ways.iter().map(|u| aside(aside(way, *u), *u)));
        }
    }
    let gap = |n: Vector| -b.reach(-n) - a.reach(n);
    let both = normals.into_iter().filter_map(unit);
    let signed = both.flat_map(|n| [n, -n]).map(|n| (gap(n), n));
    let Some((most, normal)) = signed.max_by(|p, q| p.0.total_cmp(&q.0)) else {
        return f64::NEG_INFINITY;
    };
    match curved(a, b) {
        true => most.max(best_near(&gap, normal)),
        false => most,
    }
}

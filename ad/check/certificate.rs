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

/// A convex body of space: the hull of corners and circles, without end along some directions, inflated by a radius.
#[derive(Clone, Debug)]
pub struct Body {
    corners: Vec<Vector>,
    /// The directions of its edges; any two may span a face.
    ways: Vec<Vector>,
    endless: Vec<Vector>,
    rims: Vec<Rim>,
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
            radius: 0.0,
        }
    }
    /// Creates a cone.
    #[must_use]
    pub fn cone(apex: Vec3<f64>, base: Vec3<f64>, radius: f64) -> Self {
        let axis = unit(base - apex).unwrap_or_else(Vec3::zero);
        Body {
            corners: vec![apex],
            ways: vec![axis],
            endless: Vec::new(),
            rims: vec![Rim {
                center: base,
                axis,
                radius,
            }],
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
        corners.chain(rims).fold(f64::NEG_INFINITY, f64::max) + self.radius
    }
    /// Returns its largest coordinate plus its radii.
    fn size(&self) -> f64 {
        let size = |p: &Vector| p.x.abs().max(p.y.abs()).max(p.z.abs());
        let rims = self.rims.iter().map(|rim| size(&rim.center) + rim.radius);
        self.corners
            .iter()
            .map(size)
            .chain(rims)
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
        Body {
            corners: all(&self.corners),
            ways: self.ways.clone(),
            endless: self.endless.clone(),
            rims: self.rims.iter().map(rim).collect(),
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
    /// Returns a lower bound of the distance of a point from the body, by its faces and edges; 0 inside.
    fn outside(&self, point: Vector) -> f64 {
        let (_, ways) = self.flat(&[point]);
        let mut normals = ways.clone();
        for (i, u) in ways.iter().enumerate() {
            normals.extend(ways[..i].iter().map(|v| u.cross(*v)));
        }
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
    /// edges and corners it equals the signed distance.
    pub parted: f64,
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
            points,
            size,
        })
    }
}

/// Returns the gap of the plane that separates two bodies best. It tries planes along faces and pairs of edges, and
/// planes normal to the vectors from corner to corner and from corner to edge.
fn best(a: &Body, b: &Body) -> f64 {
    let centers = |body: &Body| -> Vec<Vector> {
        let rims = body.rims.iter().map(|rim| rim.center);
        body.corners.iter().copied().chain(rims).collect()
    };
    let (corners_a, ways_a) = a.flat(&centers(b));
    let (corners_b, ways_b) = b.flat(&centers(a));
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
    both.fold(f64::NEG_INFINITY, |most, n| most.max(gap(n)).max(gap(-n)))
}

//! Convex bodies of space, as proofs see them: by their extent along a direction.
use crate::Vec3;

pub(super) type Vector = Vec3<f64>;

/// A circle that belongs to a body: the end of a cylinder, the base of a cone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    center: Vector,
    axis: Vector,
    radius: f64,
}

/// An ellipsoid, as half of its extents along three directions of length one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ellipsoid {
    center: Vector,
    axes: [Vector; 3],
    half: [f64; 3],
}

impl Ellipsoid {
    /// Returns the farthest point along a direction.
    fn farthest(&self, normal: Vector) -> Vector {
        let along = |k: usize| self.axes[k].dot(normal) * self.half[k];
        let seen = unit(Vec3::new(along(0), along(1), along(2))).unwrap_or_else(Vec3::zero);
        let parts = [seen.x, seen.y, seen.z].into_iter().zip(self.half);
        let axes = self.axes.into_iter().zip(parts);
        axes.fold(self.center, |at, (axis, (share, half))| {
            at + axis * (share * half)
        })
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
    pub(super) corners: Vec<Vector>,
    /// The directions of its edges; any two may span a face.
    pub(super) ways: Vec<Vector>,
    pub(super) endless: Vec<Vector>,
    pub(super) rims: Vec<Rim>,
    pub(super) ellipsoids: Vec<Ellipsoid>,
    radius: f64,
}

fn difference_of_all(corners: &[Vector]) -> Vec<Vector> {
    let pairs = corners.iter().enumerate();
    pairs
        .flat_map(|(i, &p)| corners[..i].iter().map(move |&q| p - q))
        .collect()
}

/// Returns the vector scaled to length one; `None` for zero.
pub(super) fn unit(v: Vector) -> Option<Vector> {
    let size = v.x.abs().max(v.y.abs()).max(v.z.abs());
    let length = (v * (1.0 / size)).length() * size;
    (length.is_finite() && length > 0.0).then(|| v * (1.0 / length))
}

/// Returns the part of a vector that is orthogonal to another one.
pub(super) fn aside(v: Vector, from: Vector) -> Vector {
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
    pub(super) fn reach(&self, normal: Vector) -> f64 {
        let ends = |way: &Vector| unit(*way).is_none_or(|way| normal.dot(way) <= ORTHOGONAL);
        if !self.endless.iter().all(ends) {
            return f64::INFINITY;
        }
        let corners = self.corners.iter().map(|&p| normal.dot(p));
        let rims = self.rims.iter();
        let rims =
            rims.map(|rim| rim.center.dot(normal) + rim.radius * aside(normal, rim.axis).length());
        let round = self.ellipsoids.iter();
        let round = round.map(|round| normal.dot(round.farthest(normal)));
        let all = corners.chain(rims).chain(round);
        all.fold(f64::NEG_INFINITY, f64::max) + self.radius
    }
    /// Returns its farthest point along a direction of length one, if it ends.
    pub(super) fn farthest(&self, normal: Vector) -> Vector {
        let corners = self.corners.iter().copied();
        let rims = self.rims.iter().map(|rim| {
            // The part across is mostly rounding where it is short, and then along the axis as well.
            let off = unit(aside(normal, rim.axis)).map(|off| aside(off, rim.axis));
            let off = off.filter(|off| off.length() > 0.9);
            rim.center + off.unwrap_or_else(Vec3::zero) * rim.radius
        });
        let round = self.ellipsoids.iter().map(|round| round.farthest(normal));
        let all = corners.chain(rims).chain(round).map(|p| (normal.dot(p), p));
        let farthest = all.max_by(|p, q| p.0.total_cmp(&q.0));
        farthest.map_or(Vec3::zero(), |farthest| farthest.1) + normal * self.radius
    }
    /// Returns its largest coordinate plus its radii.
    pub(super) fn size(&self) -> f64 {
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
    pub(super) fn scaled(&self, by: f64) -> Self {
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
    pub(super) fn flat(&self, towards: &[Vector]) -> (Vec<Vector>, Vec<Vector>) {
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
    /// Returns its corners and the centres of its circles and ellipsoids.
    pub(super) fn points(&self) -> Vec<Vector> {
        let rims = self.rims.iter().map(|rim| rim.center);
        let round = self.ellipsoids.iter().map(|round| round.center);
        let corners = self.corners.iter().copied();
        corners.chain(rims).chain(round).collect()
    }
    /// Returns `true` if it is a point, inflated or not.
    pub(super) fn is_point(&self) -> bool {
        self.corners.len() == 1 && self.is_flat() && self.endless.is_empty()
    }
    /// Returns `true` if it has no circles and no ellipsoids.
    fn is_flat(&self) -> bool {
        self.rims.is_empty() && self.ellipsoids.is_empty()
    }
    /// Returns a lower bound of the distance of a point from the body, by its faces and edges; 0 inside.
    pub(super) fn outside(&self, point: Vector) -> f64 {
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
pub(super) fn across(axis: Vector) -> [Vector; 2] {
    let least = axis.x.abs().min(axis.y.abs()).min(axis.z.abs());
    let other = match least {
        x if x == axis.x.abs() => Vec3::new(1.0, 0.0, 0.0),
        y if y == axis.y.abs() => Vec3::new(0.0, 1.0, 0.0),
        _ => Vec3::new(0.0, 0.0, 1.0),
    };
    let u = unit(axis.cross(other)).unwrap_or(other);
    [u, unit(axis.cross(u)).unwrap_or_else(Vec3::zero)]
}

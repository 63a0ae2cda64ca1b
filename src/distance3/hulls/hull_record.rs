//! The record of a search: the features of two hulls that are nearest, or that lie in the planes that part them best.
use crate::Vec3;

/// The most features that share a derivative. Faces whose overlap has more corners leave out some of them.
pub const MOST: usize = 16;

/// The kinds of two features that are nearest, the one of a first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FeaturePair {
    /// Two corners.
    Corners,
    /// A corner and an edge.
    CornerEdge,
    /// An edge and a corner.
    EdgeCorner,
    /// A corner and a face, whose corners are clockwise seen from a's side of the plane: from outside of b
    /// counter-clockwise.
    CornerFace,
    /// A face and a corner.
    FaceCorner,
    /// Two edges; the cross product of the vectors along them points from a to b.
    Edges,
}

/// Two features, by the numbers of corners. Missing ones repeat the first. The first corner of a face is opposite to
/// the longest of the three sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct HullFeatures {
    /// Their kinds.
    pub pair: FeaturePair,
    /// The corners of the one of a.
    pub a: [u8; 3],
    /// The corners of the one of b.
    pub b: [u8; 3],
    /// The number of the plane in which they are; 0 if the hulls are apart.
    pub plane: u8,
}

/// The decisions of a search for the relation of two hulls.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct HullRecord {
    /// The features; the first `count` of them matter.
    features: [HullFeatures; MOST],
    /// The number of features that tie.
    count: u8,
    /// `true` if planes give the relation of the hulls, which overlap or touch.
    pub inside: bool,
}

impl HullFeatures {
    /// Returns features by the numbers of their corners, of shapes with up to 256 of them.
    pub(super) fn new(pair: FeaturePair, a: &[usize], b: &[usize]) -> Self {
        let named = |corners: &[usize]| {
            let at = |k: usize| corners.get(k).or(corners.first()).map_or(0, |&k| k as u8);
            [at(0), at(1), at(2)]
        };
        HullFeatures {
            pair,
            a: named(a),
            b: named(b),
            plane: 0,
        }
    }
    /// Exchanges a and b.
    pub(super) fn flipped(self) -> Self {
        let HullFeatures { pair, a, b, plane } = self;
        let (pair, a) = match pair {
            FeaturePair::Corners => (FeaturePair::Corners, a),
            FeaturePair::CornerEdge => (FeaturePair::EdgeCorner, a),
            FeaturePair::EdgeCorner => (FeaturePair::CornerEdge, a),
            FeaturePair::CornerFace => (FeaturePair::FaceCorner, a),
            FeaturePair::FaceCorner => (FeaturePair::CornerFace, a),
            FeaturePair::Edges => (FeaturePair::Edges, a),
        };
        HullFeatures {
            pair,
            a: b,
            b: a,
            plane,
        }
    }
}

impl HullRecord {
    /// Returns the record of features that tie; of the first corners for none.
    pub(super) fn new(all: &[HullFeatures], inside: bool) -> Self {
        let none = HullFeatures::new(FeaturePair::Corners, &[], &[]);
        let mut features = [none; MOST];
        for (place, &found) in features.iter_mut().zip(all) {
            *place = found;
        }
        HullRecord {
            features,
            count: all.len().clamp(1, MOST) as u8,
            inside,
        }
    }
    /// Returns `true` if a feature has one of two corners: a corner of a, a corner of b.
    pub(crate) fn names(&self, [of_a, of_b]: [Option<usize>; 2]) -> bool {
        let has = |corners: [u8; 3], corner: Option<usize>| {
            corner.is_some_and(|corner| corners.iter().any(|&name| usize::from(name) == corner))
        };
        self.features()
            .iter()
            .any(|features| has(features.a, of_a) || has(features.b, of_b))
    }
    /// Returns the features that tie.
    #[must_use]
    pub fn features(&self) -> &[HullFeatures] {
        &self.features[..usize::from(self.count)]
    }
}

/// Returns the three of some corners of a face that span the largest triangle, nearly: the two farthest from each
/// other and the one farthest from their line. The first is opposite to the longest side; they are counter-clockwise
/// seen from the side to which `up` points.
pub(crate) fn spanning(
    at: impl Fn(usize) -> Vec3<f64>,
    face: &[usize],
    up: Vec3<f64>,
) -> [usize; 3] {
    let (mut ends, mut longest) = ([face[0]; 2], -1.0);
    for (k, &i) in face.iter().enumerate() {
        for &j in &face[k + 1..] {
            let square = (at(j) - at(i)).length_squared();
            if square > longest {
                (ends, longest) = ([i, j], square);
            }
        }
    }
    let [from, to] = ends;
    let along = at(to) - at(from);
    let (mut apex, mut widest) = (from, -1.0);
    for &k in face {
        let square = along.cross(at(k) - at(from)).length_squared();
        if k != from && k != to && square > widest {
            (apex, widest) = (k, square);
        }
    }
    let normal = (at(from) - at(apex)).cross(at(to) - at(apex));
    match normal.dot(up) < 0.0 {
        true => [apex, to, from],
        false => [apex, from, to],
    }
}

/// The number of corners of a face up to which all triangles of them are compared.
const FEW: usize = 8;

/// Returns the three corners of a face around a point's foot that span the largest triangle; only these give the
/// derivative by corners that a face has which stops to be flat. The ring is counter-clockwise seen from `above`; the
/// result as [`spanning`] returns it.
pub(in crate::distance3) fn around(
    points: &[Vec3<f64>],
    ring: &[usize],
    (above, up): (Vec3<f64>, Vec3<f64>),
    point: Vec3<f64>,
) -> [usize; 3] {
    let n = ring.len();
    let mut best = (spanning(|k| points[k], ring, up), -1.0);
    let side = |p: usize, q: usize| {
        let (p, q) = (points[p], points[q]);
        above.dot((q - p).cross(point - p))
    };
    let mut compare = |[i, j, k]: [usize; 3]| {
        if side(i, j) < 0.0 || side(j, k) < 0.0 || side(k, i) < 0.0 {
            return;
        }
        let area = (points[j] - points[i])
            .cross(points[k] - points[i])
            .length_squared();
        if area > best.1 {
            best = ([i, j, k], area);
        }
    };
    for i in 0..if n > FEW { 1 } else { n } {
        for j in i + 1..n {
            let ends = if n > FEW {
                j + 1..(j + 2).min(n)
            } else {
                j + 1..n
            };
            for k in ends {
                compare([ring[i], ring[j], ring[k]]);
            }
        }
    }
    spanning(|k| points[k], &best.0, up)
}

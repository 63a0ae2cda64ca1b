//! Solids that a mesh has distances from.
use super::mesh_column::plain;
use crate::distance3::{Bracket, FaceBracket, PointPair3, closest_points, distance};
use crate::{
    Aabb3, Capsule3, Hull3, Obb3, Pack, RoundBox3, Scalar, Segment3, Sphere, Tetrahedron,
    Triangle3, Vec3,
};

/// A box of any orientation that, inflated by a radius, is around a solid: plain numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidBounds {
    /// The centre of the box.
    pub center: Vec3<f64>,
    /// The directions of its edges: of length one, at right angles.
    pub axes: [Vec3<f64>; 3],
    /// Half its size along these.
    pub half: [f64; 3],
    /// The radius by which it is inflated.
    pub radius: f64,
}

/// The directions of coordinates.
const UPRIGHT: [Vec3<f64>; 3] = [
    Vec3::new(1.0, 0.0, 0.0),
    Vec3::new(0.0, 1.0, 0.0),
    Vec3::new(0.0, 0.0, 1.0),
];

/// The depth by which bodies clearly meet, and the length of axes with digits enough, relative to their size. An edge has
/// an error of 2⁻⁵² of the size, an axis of this length one of some 10⁻¹¹.
const CLEAR: f64 = 1e-10;
const SHORT: f64 = 1e-5;

impl SolidBounds {
    /// Returns the bounds of an axis-aligned box.
    #[must_use]
    pub fn upright<S: Scalar<Mask = bool>>(bounds: Aabb3<S>) -> Self {
        let (low, high) = (plain(bounds.min), plain(bounds.max));
        let half = high * 0.5 - low * 0.5;
        SolidBounds {
            center: low + half,
            axes: UPRIGHT,
            half: [half.x, half.y, half.z],
            radius: 0.0,
        }
    }
    /// Returns the bounds of the ball around a segment.
    #[must_use]
    pub fn around_segment<S: Scalar<Mask = bool>>(segment: Segment3<S>, radius: S) -> Self {
        let (start, end) = (plain(segment.start), plain(segment.end));
        let half = end * 0.5 - start * 0.5;
        let length = half.length();
        let along = half.normalize_or_zero();
        // The coordinate along which the segment goes least is not parallel to it.
        let least = (0..3).min_by(|&i, &j| {
            let part = |k: usize| along.dot(UPRIGHT[k]).abs();
            part(i).total_cmp(&part(j))
        });
        let side = along.cross(UPRIGHT[least.unwrap_or(0)]).normalize_or_zero();
        let axes = match length > 0.0 {
            true => [along, side, along.cross(side)],
            false => UPRIGHT,
        };
        SolidBounds {
            center: start + half,
            axes,
            half: [length, 0.0, 0.0],
            radius: radius.widened().unwrap_or(f64::NAN),
        }
    }
    /// Returns the bounds of a box of any orientation, inflated by a radius.
    #[must_use]
    pub fn around_box<S: Scalar<Mask = bool>>(inner: Obb3<S>, radius: S) -> Self {
        let size = plain(inner.size);
        SolidBounds {
            center: plain(inner.center),
            axes: inner.rotation.axes().map(plain),
            half: [0.5 * size.x, 0.5 * size.y, 0.5 * size.z],
            radius: radius.widened().unwrap_or(f64::NAN),
        }
    }
    /// Returns `true` for a triangle that has points in common with the box, clearly: no plane across a face of either, or
    /// along an edge of both, comes near to parting them. `false` says nothing.
    #[must_use]
    fn clearly_meet(&self, face: Triangle3<f64>) -> bool {
        let half = self.half;
        let [a, b, c] = face.corners().map(|corner| {
            let arm = corner - self.center;
            self.axes.map(|axis| axis.dot(arm))
        });
        let reach = |v: [f64; 3]| v[0].abs().max(v[1].abs()).max(v[2].abs());
        let size = reach(a).max(reach(b)).max(reach(c)) + half[0] + half[1] + half[2];
        let margin = CLEAR * size;
        // The gap along an axis across both bodies, less the margin.
        let parts = |axis: Vec3<f64>, length: f64| {
            let heights = [a, b, c].map(|v| axis.dot(Vec3::new(v[0], v[1], v[2])));
            let low = heights[0].min(heights[1]).min(heights[2]);
            let high = heights[0].max(heights[1]).max(heights[2]);
            let [x, y, z] = [axis.x, axis.y, axis.z].map(f64::abs);
            let reach = x * half[0] + y * half[1] + z * half[2] - margin * length;
            low.max(-high) >= reach
        };
        if UPRIGHT.iter().any(|&axis| parts(axis, 1.0)) {
            return false;
        }
        let [a, b, c] = [a, b, c].map(|v| Vec3::new(v[0], v[1], v[2]));
        let edges = [b - a, c - b, a - c];
        let normal = edges[0].cross(edges[1]);
        let across = edges
            .iter()
            .flat_map(|edge| UPRIGHT.map(|axis| axis.cross(*edge)));
        let least = SHORT * size;
        let long = edges
            .iter()
            .fold(0.0, |most: f64, edge| most.max(edge.length()));
        let mut axes =
            std::iter::once((normal, least * long)).chain(across.map(|axis| (axis, least)));
        // An axis with few digits may part them.
        axes.all(|(axis, least)| {
            let length = axis.length();
            length > least && !parts(axis, length)
        })
    }
    /// Returns `true` if all numbers are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let half = self.half.iter().all(|x| x.is_finite());
        half && self.center.is_finite()
            && self.axes.iter().all(|axis| axis.is_finite())
            && self.radius.is_finite()
    }
}

/// A solid that a mesh has distances from: shapes of the library, and those of users.
///
/// The search reads bounds and measures faces in double precision; the replay computes in any numbers.
#[diagnostic::on_unimplemented(
    message = "meshes have no distances from `{Self}`",
    label = "no solid of a mesh",
    note = "balls, capsules, boxes, round boxes, segments, triangles, tetrahedra and hulls are; others implement `MeshSolid`"
)]
pub trait MeshSolid<S: Scalar<Mask = bool>>: Copy + Send + Sync {
    /// Returns bounds of the solid. Bounds that are too small make results wrong without an error.
    #[must_use]
    fn bounds(&self) -> SolidBounds;
    /// Returns a function of the distance of a triangle from the solid, in double precision.
    #[must_use]
    fn measure(&self) -> impl Fn(Triangle3<f64>) -> f64 + '_;
    /// Returns a function of two numbers between which that distance is, the lower one first: both zero only where it is
    /// zero. It may return any larger numbers where the distance is above its second argument. Searches measure few triangles
    /// by it. By default it measures each.
    #[must_use]
    fn bracket(&self) -> impl Fn(Triangle3<f64>, f64) -> [f64; 2] + '_ {
        let measure = self.measure();
        move |face, _| [measure(face); 2]
    }
    /// Returns the distance of a face from the solid, 0 where they meet.
    #[must_use]
    fn distance_from(&self, face: Triangle3<S>) -> S;
    /// Returns the nearest points of a face and the solid.
    #[must_use]
    fn closest_from(&self, face: Triangle3<S>) -> PointPair3<S>;
}

/// Returns a shape as plain numbers, exactly.
fn plainly<S: Scalar<Mask = bool>, B: Pack<Scalar = S>>(shape: &B) -> B::With<f64> {
    shape.remake(&mut |&x: &S| x.widened().unwrap_or(f64::NAN))
}

macro_rules! solids {
    ($(
        $Shape:ident [$($generic:tt)*] [$($own:tt)*] $(box $is_box:ident)? |$own_name:ident| $bounds:expr
        $(, corners |$body:ident| $corners:expr)? $(, hull $bracket:ident)?;
    )*) => { $(
        impl<S: Scalar<Mask = bool>, $($generic)*> MeshSolid<S> for $Shape<S, $($own)*> {
            fn bounds(&self) -> SolidBounds {
                let $own_name = *self;
                $bounds
            }
            fn measure(&self) -> impl Fn(Triangle3<f64>) -> f64 + '_ {
                let own: $Shape<f64, $($own)*> = plainly(self);
                $(let $is_box = MeshSolid::<f64>::bounds(&own);)?
                move |face| {
                    $(if $is_box.clearly_meet(face) {
                        return 0.0;
                    })?
                    distance(face, own)
                }
            }
            $(fn bracket(&self) -> impl Fn(Triangle3<f64>, f64) -> [f64; 2] + '_ {
                let $body = plainly(self);
                let (corners, measure) = (FaceBracket::new(&$corners), self.measure());
                move |face, most| match corners.bracket(face, most) {
                    Bracket::Beyond => [f64::INFINITY; 2],
                    Bracket::Meets => [0.0; 2],
                    Bracket::Between(low, high) => [low, high],
                    Bracket::Unclear => [measure(face); 2],
                }
            })?
            fn distance_from(&self, face: Triangle3<S>) -> S {
                // The search of the distance takes some ten times as long to see that they meet.
                $(let $bracket = MeshSolid::<S>::bracket(self);
                if $bracket(plainly(&face), 0.0)[1] == 0.0 {
                    return S::zero();
                })?
                distance(face, *self)
            }
            fn closest_from(&self, face: Triangle3<S>) -> PointPair3<S> {
                closest_points(face, *self)
            }
        }
    )* };
}
solids! {
    Sphere [] [] |own| SolidBounds::around_segment(
        Segment3 { start: own.center, end: own.center }, own.radius);
    Segment3 [] [] |own| SolidBounds::around_segment(own, S::zero());
    Capsule3 [] [] |own| SolidBounds::around_segment(own.segment(), own.radius);
    Triangle3 [] [] |own| SolidBounds::upright(own.bounding()), corners |own| own.corners();
    Tetrahedron [] [] |own| SolidBounds::upright(own.bounding()), corners |own| [own.a, own.b, own.c, own.d];
    Aabb3 [] [] box bounds |own| SolidBounds::upright(own), corners |own| own.corners();
    Obb3 [] [] box bounds |own| SolidBounds::around_box(own, S::zero()), corners |own| own.corners();
    RoundBox3 [] [] box bounds |own| SolidBounds::around_box(own.inner, own.radius);
    Hull3 [const N: usize] [N] |own| SolidBounds::upright(own.bounding()), corners |own| own.as_slice(), hull bracket;
}

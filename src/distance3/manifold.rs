//! Contact manifolds: where two shapes of space lie on each other, in several points.
use super::apart::Apart;
use super::contact_points::Contacts3;
use super::manifold_record::ContactRecord;
use crate::Scalar;

/// Returns where two shapes of space touch, or come within a distance of each other.
///
/// The direction is that of the shortest way between the shapes, or out of each other. Along it the faces that face each
/// other most are compared: the points are the corners of their overlap, each with its own gap, those whose gap is at
/// most `within`. Two boxes that lie on each other have four points or more, a capsule along a face two, a ball one. The
/// least gap is the signed distance. Shapes that are farther apart have no points.
///
/// Faces of segments and capsules are their axes, those of points and balls their centres, each moved by the radius along
/// the direction: points of a face that is tilted by φ lie up to r(1 − cos φ) inside.
/// Flat ends of cylinders and cones, and discs, count as regular octagons on their rims, their sides as the straight line
/// that faces the other shape most. Ellipsoids and own shapes have one point, the nearest one. Of faces of hulls with more
/// than sixteen corners sixteen count. Of more than eight points those are left out that take the least area along, but
/// never the deepest one.
///
/// Derivatives are those of points that are fixed on their features: corners, and crossings of edges seen along the
/// direction. Kinks: another face, corner or edge takes part, or a gap becomes `within`. Points closer than some
/// roundings are one, with the derivative of the first.
///
/// ```
/// use geograd::distance3::contacts;
/// use geograd::{Capsule3, Obb3, Rotation3, Sphere, Vec3};
/// let table = Obb3::new(Vec3::zero(), Vec3::new(4.0, 4.0, 1.0), Rotation3::identity());
/// let book = Obb3::new(Vec3::new(2.0, 0.0, 0.75), Vec3::new(2.0, 1.0, 0.5), Rotation3::identity());
/// let found = contacts(table, book, 0.01); // half of the book is over the edge
/// assert_eq!((found.normal, found.count), (Vec3::new(0.0, 0.0, 1.0), 4.0));
/// assert!(found.points().iter().all(|p| p.on_a.x >= 1.0 && p.on_a.x <= 2.0 && p.gap == 0.0));
/// let pen = Capsule3::new(Vec3::new(-1.0, 0.0, 0.6), Vec3::new(1.0, 0.0, 0.6), 0.1);
/// assert_eq!(contacts(table, pen, 0.01).count, 2.0);
/// assert_eq!(contacts(table, Sphere::new(Vec3::new(0.0, 0.0, 2.0), 1.0), 0.01).count, 0.0);
/// ```
#[must_use]
pub fn contacts<S: Scalar<Mask = bool>, A: Apart<B, Scalar = S>, B: Copy>(
    a: A,
    b: B,
    within: S,
) -> Contacts3<S> {
    let guard = a.guarded_with(&b).and_number(within);
    let relation = a.relation(b);
    let (names, find) = (a.facing(&b, relation.normal), |names| {
        a.patches(&b, names, relation.normal)
    });
    let record = ContactRecord::search(&relation, names, find, within);
    guard.result(record.replay(&relation, find(record.faces)))
}

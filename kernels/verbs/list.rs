//! The verbs.
use crate::verb;
use std::marker::PhantomData;

verb! {
    /// Length that two intervals share, in the unit of length; 0 where they are apart.
    pub IntersectionLength: (a, b)
    /// Area that two shapes share, in the square of the unit of length; 0 where they are apart.
    pub IntersectionArea: (a, b)
    /// Volume that two shapes share, in the cube of the unit of length; 0 where they are apart.
    pub IntersectionVolume: (a, b)
    /// Intersection over union, 0 to 1: the measure of the intersection of two shapes over that of their union.
    pub Iou: (a, b)
    /// Intersection over foreground, 0 to 1: the part of `a` that lies in `b`.
    pub Iof: (a, b)
    /// Intersection over union of two boxes seen from above (bird's eye view), 0 to 1.
    pub IouBev: (a, b)
    /// Intersection over union with a joint separation term, -1 to 1: boxes that are apart have a gradient, too.
    pub SeparationAware: (a, b)
    /// Area of the convex hull of two shapes, in the square of the unit of length.
    pub HullArea: (a, b)
    /// Generalised IoU, -1 to 1 (Rezatofighi et al. 2019); the table of [`iou`](mod@crate::iou) says by which enclosing
    /// shape.
    pub Giou: (a, b)
    /// Generalised IoU by the convex hull, -1 to 1.
    pub GiouHull: (a, b)
    /// Generalised IoU by the enclosing axis-aligned box, -1 to 1.
    pub GiouAabb: (a, b)
    /// Generalised IoU by the smaller enclosing rectangle along either box's axes, -1 to 1.
    pub GiouRectangle: (a, b)
    /// Distance IoU, -1 to 1 (Zheng et al. 2020); the table of [`iou`](mod@crate::iou) says by which enclosing shape.
    pub Diou: (a, b)
    /// Distance IoU by the diameter of the convex hull, -1 to 1.
    pub DiouHull: (a, b)
    /// Distance IoU by the diagonal of the enclosing axis-aligned box, -1 to 1.
    pub DiouAabb: (a, b)
    /// Distance IoU by the smaller enclosing rectangle along either box's axes, -1 to 1.
    pub DiouRectangle: (a, b)
    /// Complete IoU, -3/2 to 1 (Zheng et al. 2020): distance IoU less a term for the ratio of the sides.
    pub Ciou: (a, b)
    /// Complete IoU by the diameter of the convex hull, -3/2 to 1.
    pub CiouHull: (a, b)
    /// Complete IoU by the diagonal of the enclosing axis-aligned box, -3/2 to 1.
    pub CiouAabb: (a, b)
    /// Complete IoU by the smaller enclosing rectangle along either box's axes, -3/2 to 1.
    pub CiouRectangle: (a, b)
    /// Complete IoU whose weight counts as a constant in the gradient, as implementations of its loss detach it.
    pub CiouFixedWeight: (a, b)
    /// Efficient IoU (Zhang et al. 2021): distance IoU less terms for width and height; at most 1.
    pub Eiou: (a, b)
    /// Efficient IoU by the convex hull, -5/2 to 1.
    pub EiouHull: (a, b)
    /// Efficient IoU by the enclosing axis-aligned box, -9/4 to 1.
    pub EiouAabb: (a, b)
    /// Efficient IoU by the smaller enclosing rectangle along either box's axes; at most 1.
    pub EiouRectangle: (a, b)
    /// Wasserstein distance of two boxes as Gaussians, in the unit of length (Yang et al. 2021).
    pub Wasserstein: (a, b)
    /// Squared Wasserstein distance of two boxes as Gaussians, in the square of the unit of length.
    pub SquaredWasserstein: (a, b)
    /// Kullback-Leibler divergence of two boxes as Gaussians, at least 0.
    pub KullbackLeibler: (a, b)
    /// Jeffreys divergence of two boxes as Gaussians, at least 0.
    pub Jeffreys: (a, b)
    /// Bhattacharyya distance of two boxes as Gaussians, at least 0.
    pub Bhattacharyya: (a, b)
    /// Probabilistic IoU of two boxes as Gaussians, 0 to 1 (Llerena et al. 2021).
    pub Probiou: (a, b)
    /// IoU of two boxes as Gaussians by a Kalman filter, 0 to 1 at most (Yang et al. 2022).
    pub Kfiou: (a, b)
    /// Distance of two shapes, in the unit of length; 0 where they touch or overlap.
    pub Distance: (a, b)
    /// Squared distance of two shapes, in the square of the unit of length; 0 where they touch or overlap.
    pub SquaredDistance: (a, b)
    /// Distance of two shapes, or minus the depth of their overlap, in the unit of length.
    pub SignedDistance: (a, b)
    /// Depth of a point in a shape, positive inside and negative outside, in the unit of length: minus the signed
    /// distance. The free way to an obstacle is [`Distance`].
    pub Depth: (a, b)
    /// Closest points: one of each shape, with the smallest distance from each other.
    pub ClosestPoints: (a, b)
    /// Longest distance of a point of one shape from a point of the other, in the unit of length.
    pub FarthestDistance: (a, b)
    /// Depth of the overlap of two shapes and the direction, of length one, in which `b` leaves `a`.
    pub Penetration: (a, b)
    /// Contact of two shapes of space: a direction, and up to eight pairs of points that are at most `within` apart.
    pub Contacts: (a, b, within)
    /// First touch of two moving bodies of space: time, from 0 to 1, place and direction.
    pub TimeOfImpact: (a, motion_of_a, b, motion_of_b)
    /// Least signed distance of two moving bodies of space over the times from 0 to 1, in the unit of length.
    pub Clearance: (a, motion_of_a, b, motion_of_b)
    /// Point in which two lines cross, line in which two planes do, or point of three planes.
    pub Crossing: (a, b)
    /// Part that two segments share: nothing, a point, or a segment.
    pub Meeting: (a, b)
    /// First point of a shape that a ray hits.
    pub FirstHit: (ray, shape)
    /// Parameters at which a line enters and leaves a shape.
    pub Span: (line, shape)
    /// Length of the part of a segment that lies in a shape, in the unit of length.
    pub LengthInside: (segment, shape)
    /// Area, in the square of the unit of length.
    pub Area: (shape)
    /// Area of a shape, positive where its corners are counter-clockwise, in the square of the unit of length.
    pub SignedArea: (shape)
    /// Length of the border, in the unit of length.
    pub Perimeter: (shape)
    /// Volume, in the cube of the unit of length.
    pub Volume: (shape)
    /// Area of a solid's surface, in the square of the unit of length.
    pub Surface: (shape)
    /// Inertia of a solid about its centroid by unit density, in the fifth power of the unit of length.
    pub Inertia: (shape)
    /// Centre of the area, of a solid's volume, or of points.
    pub Centroid: (shape)
    /// Corners of a box, counter-clockwise.
    pub Corners: (shape)
    /// Longest distance of two corners, in the unit of length.
    pub Diameter: (shape)
    /// Smallest distance of two parallel lines that enclose the shape, in the unit of length.
    pub Width: (shape)
    /// Enclosing rectangle of the smallest area.
    pub MinimumRectangle: (shape)
    /// Smallest enclosing circle.
    pub MinimumCircle: (shape)
    /// Circle through three points.
    pub Circumcircle: (a, b, c)
    /// Largest circle inside a shape.
    pub Incircle: (shape)
    /// Shape moved by a pose, rigidly: the pose's rotation counts by its direction, whatever its length.
    pub Move: (pose, shape)
    /// Angle in radians between two rotations or two vectors of space, 0 to π.
    pub Angle: (a, b)
    /// Image of a point of a camera's frame, in pixels.
    pub Project: (point, camera)
    /// Box of an image, whose y axis points down, as a box whose y axis points up; takes the height of the image in
    /// pixels.
    pub FlipY: (shape, image_height)
    /// IoU to a power (He et al. 2021), 0 to 1; of boxes in space the power is three.
    pub AlphaIou: (a, b, power)
}
crate::__verb!([runs [] AlphaIou] (a, b));
crate::__verb!([runs [] Crossing] (a, b, c));

/// A shape in another encoding `To`; see [`convert`].
#[derive(Debug)]
pub struct Convert<To>(PhantomData<fn() -> To>);

/// Returns the verb that converts a box to another [convention](mod@crate::convention), `To`.
///
/// ```
/// use geograd::convention::{KittiBox, Le90, ImageBox};
/// use geograd::kernels::convert;
/// use geograd::prelude::*;
/// let boxes = [ImageBox::from_mirrored(Obb2::new(10.0, 20.0, 4.0, 2.0, 0.1))];
/// let found = Cpu::new().aligned(convert::<Le90<f64>>(), &boxes[..])?;
/// assert_eq!(found[0], Le90::from(boxes[0]));
/// # Ok::<(), geograd::Error>(())
/// ```
#[must_use]
pub const fn convert<To>() -> Convert<To> {
    Convert(PhantomData)
}

impl<To> Clone for Convert<To> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<To> Copy for Convert<To> {}
impl<To> Convert<To> {
    /// Returns the adjoint: batches take the shape and a cotangent of the result, and return the cotangent of the
    /// shape.
    #[must_use]
    pub const fn vjp(self) -> crate::kernels::row::op::Vjp<Self> {
        crate::kernels::row::op::Vjp::of(self)
    }
}
crate::__verb!([runs [To,] Convert<To>] (shape));

verb! {
    /// Length of a path, in the unit of length.
    pub Length: (path)
    /// Second moments about a centroid: of an area, in the fourth power of the unit of length; of points, their
    /// covariance.
    pub SecondMoments: (shape)
    /// Winding number of a ring about a point.
    pub Winding: (point, ring)
}

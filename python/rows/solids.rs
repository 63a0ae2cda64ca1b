//! What one shape has: bounds, corners, planes, heights, and the farthest point in a direction.
use crate::unsigned;
use geograd::{
    Aabb2, Aabb3, Capsule2, Capsule3, Circle, Cone, Cylinder, Disc, Ellipsoid, Obb2, Obb3, Plane3,
    RoundBox3, Segment2, Segment3, Sphere, Tetrahedron, Triangle2, Triangle3, Vec3, YawBox3,
    operation,
};

/// Declares the rows of the bounds of shapes.
macro_rules! bounds {
    ($($Row:ident = $name:literal: $Shape:ident, $Box:ident;)*) => {
        $(operation! {
            /// The smallest axis-aligned box around the shape.
            pub $Row = $name: (shape: $Shape<S>) -> $Box<S> { unsigned(shape.bounding()) }
            invariances [] jumps Never derivative Reverse
        })*
    };
}
bounds! {
    OfCapsule2 = "bounding_capsule2": Capsule2, Aabb2;
    OfCapsule3 = "bounding_capsule3": Capsule3, Aabb3;
    OfCircle = "bounding_circle": Circle, Aabb2;
    OfCone = "bounding_cone": Cone, Aabb3;
    OfCylinder = "bounding_cylinder": Cylinder, Aabb3;
    OfDisc = "bounding_disc": Disc, Aabb3;
    OfEllipsoid = "bounding_ellipsoid": Ellipsoid, Aabb3;
    OfObb2 = "bounding_obb2": Obb2, Aabb2;
    OfObb3 = "bounding_obb3": Obb3, Aabb3;
    OfRoundBox3 = "bounding_round_box3": RoundBox3, Aabb3;
    OfSegment2 = "bounding_segment2": Segment2, Aabb2;
    OfSegment3 = "bounding_segment3": Segment3, Aabb3;
    OfSphere = "bounding_sphere": Sphere, Aabb3;
    OfTetrahedron = "bounding_tetrahedron": Tetrahedron, Aabb3;
    OfTriangle2 = "bounding_triangle2": Triangle2, Aabb2;
    OfTriangle3 = "bounding_triangle3": Triangle3, Aabb3;
    OfYawBox3 = "bounding_yaw_box3": YawBox3, Aabb3;
}

operation! {
    /// The corners of the box: the first side runs fastest, the third slowest.
    pub CornersOfObb3 = "corners_of_obb3": (shape: Obb3<S>) -> [Vec3<S>; 8] { unsigned(shape.corners()) }
    invariances [] jumps Never derivative Reverse

    /// The corners of the box: the first side runs fastest, the third slowest.
    pub CornersOfYawBox3 = "corners_of_yaw_box3": (shape: YawBox3<S>) -> [Vec3<S>; 8] { unsigned(shape.corners()) }
    invariances [] jumps Never derivative Reverse

    /// The planes of the box's faces with normals outwards, two for each side.
    pub PlanesOfObb3 = "planes_of_obb3": (shape: Obb3<S>) -> [Plane3<S>; 6] { unsigned(shape.planes()) }
    invariances [] jumps Never derivative Reverse

    /// The distance of the apex from the base, in units of length.
    pub HeightOfCone = "height_of_cone": (shape: Cone<S>) -> S { shape.height() }
    invariances [] jumps Never derivative Reverse

    /// The distance of both ends, in units of length.
    pub HeightOfCylinder = "height_of_cylinder": (shape: Cylinder<S>) -> S { shape.height() }
    invariances [] jumps Never derivative Reverse

    /// The distance of the apex from the rim, in units of length.
    pub SlantOfCone = "slant_of_cone": (shape: Cone<S>) -> S { shape.slant() }
    invariances [] jumps Never derivative Reverse

    /// The farthest point of the ellipsoid in a direction of any length.
    pub SupportOfEllipsoid = "support_of_ellipsoid": (shape: Ellipsoid<S>, direction: Vec3<S>) -> Vec3<S> {
        unsigned(shape.support(direction))
    }
    invariances [] jumps Anywhere derivative Reverse
}

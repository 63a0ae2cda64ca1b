//! Measures of solids as operations.
use crate::kernels::ops::tables::table;
use crate::kernels::verbs::{Centroid, Inertia, Surface, Volume};
use crate::{
    Aabb3, Capsule3, Cone, Cylinder, Ellipsoid, Obb3, RoundBox3, Sphere, Symmetric3, Tetrahedron, Vec3,
    YawBox3,
};

/// Returns the error of a rotated inertia tensor, as a number of roundings of its own moments: products by the
/// coordinate axes cancel, to zero where two moments are equal.
fn turned(inertia: Symmetric3<f64>) -> f64 {
    4.0 * inertia.xx.max(inertia.yy).max(inertia.zz)
}

table! {
    /// The volume of {}.
    Volume: (shape) -> S { shape.volume() } [rigid(3)] (range NOT_NEGATIVE jumps Never) derivative Reverse {
        "volume_capsule3": Capsule3;
        "volume_cylinder": Cylinder;
        "volume_cone": Cone;
        "volume_tetrahedron": Tetrahedron;
        "volume_round_box": RoundBox3;
        "volume_ellipsoid": Ellipsoid;
    }
    /// The volume of {}.
    Volume: (shape) -> S { shape.volume().saturated().canonical() } [rigid(3)]
    (range NOT_NEGATIVE jumps Never) derivative Reverse {
        "volume_aabb3": Aabb3;
        "volume_obb3": Obb3;
        "volume_yaw": YawBox3;
        "volume_sphere": Sphere;
    }
    /// The area of the surface of {}.
    Surface: (shape) -> S { shape.surface() } [rigid(2)] (range NOT_NEGATIVE jumps Never) derivative Reverse {
        "surface_capsule3": Capsule3;
        "surface_cylinder": Cylinder;
        "surface_cone": Cone;
        "surface_tetrahedron": Tetrahedron;
        "surface_round_box": RoundBox3;
    }
    /// The area of the surface of {}.
    Surface: (shape) -> S { shape.surface().saturated().canonical() } [rigid(2)]
    (range NOT_NEGATIVE jumps Never) derivative Reverse {
        "surface_aabb3": Aabb3;
        "surface_obb3": Obb3;
        "surface_yaw": YawBox3;
        "surface_sphere": Sphere;
    }
    /// The centre of the volume of {}.
    Centroid: (shape) -> Vec3<S> { shape.center() } [follows] (jumps Never) derivative Reverse {
        "centroid_cone": Cone;
        "centroid_cylinder": Cylinder;
        "centroid_tetrahedron": Tetrahedron;
    }
    // The numbers of a tensor are relative to the coordinate axes. Fifth powers of small lengths underflow in `f32`.
    /// The [inertia](crate::measure::inertia) of {} about its centroid, by unit density.
    Inertia: (shape) -> Symmetric3<S> { shape.inertia() } [rigid(5), along_axes] (jumps Never resolution 1e-36)
    derivative Reverse {
        "inertia_sphere": Sphere;
        "inertia_capsule3": Capsule3;
        "inertia_cylinder": Cylinder;
        "inertia_cone": Cone;
        "inertia_tetrahedron": Tetrahedron;
        "inertia_round_box": RoundBox3 (roundings { turned(shape.inertia()) });
        "inertia_ellipsoid": Ellipsoid (roundings { turned(shape.inertia()) });
        "inertia_obb3": Obb3 (roundings { turned(shape.inertia()) });
    }
}

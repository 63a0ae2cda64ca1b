//! Every row of geograd's list in both formats, and rows of methods that have no verb in the library: a crate of its own,
//! so that a change of the binding compiles none of them.
#![forbid(unsafe_code)]
mod encodings;
mod motions;
mod poses;
mod scores;
mod solids;

use geograd::kernels::dynamic::{self, Name, Operation, straight};
use geograd::{Pack, Scalar};
use std::sync::OnceLock;

/// Returns a shape whose zeros have no sign, as all results require.
#[inline]
fn unsigned<S: Scalar, P: Pack<Scalar = S>>(mut shape: P) -> P {
    shape.each(&mut |x| *x = x.canonical());
    shape
}

/// Lists the rows of this crate, each with the verb that it has in Python.
macro_rules! own {
    ($($verb:literal: $module:ident::$Row:ident;)*) => {
        const OWN: &[(&str, Operation)] = &[$(($verb, straight::<$module::$Row>())),*];
    };
}
own! {
    "convert": encodings::OfXywh;
    "convert": encodings::OfCxcywh;
    "convert": encodings::ToXywh;
    "convert": encodings::ToCxcywh;
    "between": motions::Between;
    "screw": motions::Screw;
    "pose_at": motions::PoseAt;
    "ciou_fixed_weight": scores::OfAabb3;
    "ciou_fixed_weight": scores::OfYawBox3;
    "ciou_fixed_weight": scores::OfObb3;
    "from_rotation_vector": poses::FromRotationVector;
    "rotation_vector": poses::RotationVector;
    "left_jacobian": poses::LeftJacobian;
    "right_jacobian": poses::RightJacobian;
    "left_jacobian_inverse": poses::LeftJacobianInverse;
    "right_jacobian_inverse": poses::RightJacobianInverse;
    "retract": poses::RetractRotation;
    "retract": poses::RetractPose;
    "tangent_to": poses::TangentToRotation;
    "tangent_to": poses::TangentToPose;
    "squared_angle": poses::SquaredAngle;
    "interpolate": poses::InterpolateRotations;
    "interpolate": poses::InterpolatePoses;
    "inverse": poses::InverseRotation;
    "inverse": poses::InversePose;
    "inverse": poses::InversePlane;
    "axes": poses::Axes;
    "nearest_rotation": poses::NearestRotation;
    "to_6d": poses::ToSix;
    "from_6d": poses::FromSix;
    "move": poses::TurnVector;
    "move": poses::TurnRotation;
    "from_twist": poses::FromTwist;
    "twist": poses::Twist;
    "adjoint": poses::Adjoint;
    "adjoint_transposed": poses::AdjointTransposed;
    "bounding": solids::OfCapsule2;
    "bounding": solids::OfCapsule3;
    "bounding": solids::OfCircle;
    "bounding": solids::OfCone;
    "bounding": solids::OfCylinder;
    "bounding": solids::OfDisc;
    "bounding": solids::OfEllipsoid;
    "bounding": solids::OfObb2;
    "bounding": solids::OfObb3;
    "bounding": solids::OfRoundBox3;
    "bounding": solids::OfSegment2;
    "bounding": solids::OfSegment3;
    "bounding": solids::OfSphere;
    "bounding": solids::OfTetrahedron;
    "bounding": solids::OfTriangle2;
    "bounding": solids::OfTriangle3;
    "bounding": solids::OfYawBox3;
    "corners": solids::CornersOfObb3;
    "corners": solids::CornersOfYawBox3;
    "planes": solids::PlanesOfObb3;
    "height": solids::HeightOfCone;
    "height": solids::HeightOfCylinder;
    "slant": solids::SlantOfCone;
    "support": solids::SupportOfEllipsoid;
}

/// Every operation of the list, then those of this crate.
#[must_use]
// Inlined, it would compile every row in the crate that calls it.
#[inline(never)]
pub fn operations() -> &'static [Operation] {
    static ALL: OnceLock<Vec<Operation>> = OnceLock::new();
    ALL.get_or_init(|| {
        let own = OWN.iter().map(|&(_, operation)| operation);
        dynamic::operations().iter().copied().chain(own).collect()
    })
}

/// The names of all operations, in any order.
#[must_use]
pub fn names() -> Vec<Name> {
    let own = OWN.iter().map(|&(verb, operation)| Name {
        row: operation.name,
        verb: verb.to_owned(),
        shapes: Vec::new(),
        spelling: operation.name.to_owned(),
    });
    dynamic::names().into_iter().chain(own).collect()
}

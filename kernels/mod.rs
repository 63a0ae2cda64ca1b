//! Batches: the list of operations, and the machines that run them over many shapes.
//!
//! | batch | what it takes | what it gives |
//! | --- | --- | --- |
//! | [`cpu::aligned`] | row i of a with row i of b | one number per row |
//! | [`cpu::all_pairs`] | every row of a with every row of b | a matrix |
//! | [`cpu::ragged`] | rings as vertices and offsets | one result per ring |
//!
//! Each comes as value, value with gradient (`…_grad`) and adjoint with an upstream gradient
//! (`…_vjp`), and with buffers of the caller's (`…_into`).
pub mod check;
pub mod cpu;
pub mod op;
pub mod overlap;
pub mod real;
pub mod ring;
pub mod simd;

/// Every operation, one per line: a name and a type. Tests, benches and documentation walk this
/// list.
///
/// `for_each_op!(with)` calls the macro `with!` with the whole list, `pairs { … } rings { … }`.
#[macro_export]
macro_rules! for_each_op {
    ($with:ident) => {
        $with! {
            pairs {
                intersection_area_obb2: $crate::kernels::overlap::IntersectionAreaObb2,
                iou_obb2: $crate::kernels::overlap::IouObb2,
                iof_obb2: $crate::kernels::overlap::IofObb2,
                intersection_area_aabb2: $crate::kernels::overlap::IntersectionAreaAabb2,
                iou_aabb2: $crate::kernels::overlap::IouAabb2,
                iof_aabb2: $crate::kernels::overlap::IofAabb2,
            }
            rings {
                signed_area: $crate::kernels::ring::SignedArea,
                perimeter: $crate::kernels::ring::Perimeter,
                centroid: $crate::kernels::ring::Centroid,
            }
        }
    };
}

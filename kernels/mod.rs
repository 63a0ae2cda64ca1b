//! Batches: the list of operations, and the machines that run them over many shapes.
//!
//! | batch | what it takes | what it gives |
//! | --- | --- | --- |
//! | [`cpu::aligned`] | row i of a with row i of b | one number per row |
//! | [`cpu::all_pairs`] | every row of a with every row of b | a matrix |
//! | [`cpu::ragged`] | rings as vertices and offsets | one result per ring |
//!
//! Each comes as value, value with gradient (`…_grad`) and adjoint with an upstream gradient
//! (`…_vjp`), and with buffers of the caller's (`…_into`). [`reduce`] gives maxima, sums and lists
//! of all pairs without the matrix. The same on a GPU is [`gpu`]; [`Backend`] is one front for both,
//! and [`resident`] keeps shapes and results where they are between its calls.
#[forbid(unsafe_code)]
pub mod backend;
#[forbid(unsafe_code)]
pub mod check;
pub mod cpu;
#[forbid(unsafe_code)]
pub mod gpu;
#[forbid(unsafe_code)]
mod on_cpu;
#[forbid(unsafe_code)]
pub mod op;
#[forbid(unsafe_code)]
pub mod overlap;
#[forbid(unsafe_code)]
pub mod real;
#[forbid(unsafe_code)]
pub mod reduce;
#[forbid(unsafe_code)]
pub mod resident;
#[forbid(unsafe_code)]
pub mod ring;
#[forbid(unsafe_code)]
pub mod row;
#[forbid(unsafe_code)]
mod subject;
#[forbid(unsafe_code)]
pub mod witness;

pub use backend::Backend;
pub use cpu::{Cpu, Single, Table};
pub use gpu::error::GpuError;
pub use op::{Op, RingOp, Runs};
pub use overlap::{
    IntersectionAreaAabb2, IntersectionAreaObb2, IofAabb2, IofObb2, IouAabb2, IouObb2,
};
pub use ring::{Centroid, Perimeter, SignedArea};
pub use row::{Column, Columns, One, Row, Skip, Target, Targets};

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

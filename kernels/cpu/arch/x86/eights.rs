//! Vectors of single precision that read numbers by eights, for searches in trees.
use super::{F32x4, F32x8, F32x16, F64x2, F64x4, F64x8, Vector};
use crate::Scalar;
use crate::kernels::cpu::arch::Eights;
use crate::mesh::EightLanes;

macro_rules! eights {
    ($($name:ident of $n:literal: $($beside:ident)*;)*) => { $(
        impl EightLanes for $name {
            const PARTS: usize = 8 / $n;
            #[allow(clippy::modulo_one)] // one vector may be all eight
            #[inline(always)]
            fn part(of: &[f32; 8], part: usize) -> Self {
                Self::from_array(of.as_chunks().0[part % (8 / $n)])
            }
            #[allow(clippy::modulo_one)]
            #[inline(always)]
            fn put(self, to: &mut [f32; 8], part: usize) {
                to.as_chunks_mut().0[part % (8 / $n)] = self.array();
            }
            #[inline(always)]
            fn all(x: f32) -> Self {
                Self::splat(x)
            }
            #[inline(always)]
            fn truths(mask: <Self as Scalar>::Mask) -> u32 {
                Self::bits(mask)
            }
        }
        $(
            impl Eights for $beside {
                type Eight = $name;
            }
        )*
    )* };
}
eights! {
    F32x4 of 4: F32x4 F64x2;
    // AVX-512 too: a node has eight children.
    F32x8 of 8: F32x8 F64x4 F32x16 F64x8;
}

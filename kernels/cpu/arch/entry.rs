//! The list of kernels, each compiled for every level, with the only calls into code whose instructions a processor may
//! lack.
use crate::kernels::cpu::arch::BoundCode;
use crate::kernels::cpu::blocks::{self, SPACE};
use crate::kernels::cpu::boxes3;
use crate::kernels::cpu::lane::{Lane, Planes, ResultTiles, TILE, Tiles};
use crate::kernels::cpu::mesh_searches;
use crate::kernels::cpu::nearest;
use crate::kernels::cpu::overlaps::{self, BOUNDS, View};
use crate::kernels::cpu::program::execute::{self, Memory, Pass};
use crate::kernels::cpu::program::instructions::Instruction;
use crate::kernels::cpu::program::lower::Tape;
use crate::kernels::cpu::program::rowwise::{self, ResultRows, RowRange};
use crate::kernels::cpu::quads;
use crate::kernels::cpu::rings::{self, Measure};
use crate::kernels::cpu::upright_boxes;
use crate::kernels::cpu::winding;
use crate::mesh::{FaceRecord, MeshSurface, MeshTree, SearchRoom, SolidBounds, Wanted};
use crate::overlap::Denominator;
use crate::{Pose3, Ray3, Vec2, Vec3};

/// Lists kernels: a name, arguments, and the generic function, of a format `T` and a vector `V`.
///
/// Each becomes a plain function that chooses the level, and a field of [`Kernels`].
macro_rules! entries {
    ($($(#[$doc:meta])* $name:ident($($arg:ident: $type:ty),* $(,)?) $(-> $out:ty)? = $kernel:expr;)*) => {
        /// Every kernel of one format.
        pub struct Kernels<T: 'static> {
            $($(#[$doc])* pub(crate) $name: fn($($type),*) $(-> $out)?,)*
        }

        entries!(@format of_f32: f32, Lanes<f32, 4>, F32x4, F32x8, F32x16;
            $($name($($arg: $type),*) $(-> $out)? = $kernel;)*);
        entries!(@format of_f64: f64, Lanes<f64, 2>, F64x2, F64x4, F64x8;
            $($name($($arg: $type),*) $(-> $out)? = $kernel;)*);
    };
    (@format $format:ident: $t:ident, $plain:ty, $sse2:ident, $avx2:ident, $v4:ident;
     $($name:ident($($arg:ident: $type:ty),*) $(-> $out:ty)? = $kernel:expr;)*) => {
        pub(super) mod $format {
            use super::*;
            #[cfg(any(not(target_arch = "x86_64"), geograd_portable))]
            use crate::Lanes;
            type T = $t;
            /// The kernels of one format.
            pub static KERNELS: Kernels<$t> = Kernels { $($name,)* };
            $(
                fn $name($($arg: $type),*) $(-> $out)? {
                    #[inline(never)]
                    fn baseline($($arg: $type),*) $(-> $out)? {
                        #[cfg(any(not(target_arch = "x86_64"), geograd_portable))]
                        type V = $plain;
                        // Every x86-64 has SSE2.
                        #[cfg(all(target_arch = "x86_64", not(geograd_portable)))]
                        type V = crate::kernels::cpu::arch::x86::$sse2;
                        $kernel($($arg),*)
                    }
                    #[cfg(all(target_arch = "x86_64", not(geograd_portable)))]
                    {
                        use crate::kernels::cpu::arch::x86;
                        use crate::kernels::cpu::simd::Simd;
                        #[inline(never)]
                        #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
                        fn avx2($($arg: $type),*) $(-> $out)? {
                            type V = x86::$avx2;
                            $kernel($($arg),*)
                        }
                        #[inline(never)]
                        #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt,avx512f,avx512bw,avx512cd,avx512dq,avx512vl")]
                        fn v4($($arg: $type),*) $(-> $out)? {
                            type V = x86::$v4;
                            $kernel($($arg),*)
                        }
                        // Sound: the level in use is one that the processor has.
                        match Simd::in_use() {
                            Simd::Baseline => baseline($($arg),*),
                            Simd::Avx2 => unsafe { avx2($($arg),*) },
                            Simd::V4 => unsafe { v4($($arg),*) },
                        }
                    }
                    #[cfg(any(not(target_arch = "x86_64"), geograd_portable))]
                    baseline($($arg),*)
                }
            )*
        }
    };
}

entries! {
    /// Prepares rotated boxes: computes sines and cosines.
    obb2_frames(shapes: Tiles<'_, T>, view: View, frames: &mut [Lane<T>]) = overlaps::obb2_frames::<T, V>;
    /// Bounds of prepared rotated boxes.
    obb2_bounds(frames: Tiles<'_, T>, bounds: &mut [Lane<T>]) = overlaps::obb2_bounds::<T, V>;
    /// `true` if rotated boxes are valid and of ordinary size.
    all_ordinary_obb2(numbers: &[T]) -> bool = overlaps::all_ordinary_obb2::<T, V>;
    /// Scores of prepared rotated boxes.
    obb2_scores(over: Denominator, a: Tiles<'_, T>, b: Tiles<'_, T>, out: ResultTiles<'_, T>) = overlaps::obb2_scores::<T, V>;
    /// Scores of prepared rotated boxes with ten derivatives each.
    obb2_derivatives(over: Denominator, a: Tiles<'_, T>, b: Tiles<'_, T>, seeds: Option<Tiles<'_, T>>, out: ResultTiles<'_, T>) = overlaps::obb2_derivatives::<T, V>;
    /// `true` if rotated boxes are valid and of common size, or zero size.
    all_common_obb2(numbers: &[T]) -> bool = overlaps::all_common_obb2::<T, V>;
    /// Generalised IoU of prepared rotated boxes.
    giou_scores(a: Tiles<'_, T>, b: Tiles<'_, T>, out: ResultTiles<'_, T>) = overlaps::giou_scores::<T, V>;
    /// Generalised IoU of prepared rotated boxes with ten derivatives each.
    giou_derivatives(a: Tiles<'_, T>, b: Tiles<'_, T>, seeds: Option<Tiles<'_, T>>, out: ResultTiles<'_, T>) = overlaps::giou_derivatives::<T, V>;
    /// Areas that convex quadrilaterals share.
    quad_scores(a: Tiles<'_, T>, b: Tiles<'_, T>, out: ResultTiles<'_, T>) = quads::quad_scores::<T, V>;
    /// Areas that convex quadrilaterals share with sixteen derivatives each.
    quad_derivatives(a: Tiles<'_, T>, b: Tiles<'_, T>, seeds: Option<Tiles<'_, T>>, out: ResultTiles<'_, T>) = quads::quad_derivatives::<T, V>;
    /// `true` if quadrilaterals are convex and of ordinary size.
    all_convex_quads(numbers: &[T]) -> bool = quads::all_convex::<T, V>;
    /// `true` if upright boxes are valid and of common size, or zero size.
    all_common_upright(numbers: &[T]) -> bool = overlaps::all_common_upright::<T, V>;
    /// Scores of upright boxes from what they share seen from above.
    upright_scores(over: Denominator, a: Tiles<'_, T>, b: Tiles<'_, T>, out: ResultTiles<'_, T>) = upright_boxes::scores::<T, V>;
    /// The scores of upright boxes with fourteen derivatives each, from areas seen from above with ten.
    upright_derivatives(over: Denominator, a: Tiles<'_, T>, b: Tiles<'_, T>, seeds: Option<Tiles<'_, T>>, out: ResultTiles<'_, T>) = upright_boxes::derivatives::<T, V>;
    /// `true` if boxes of any orientation in space are valid and of common size, or zero size.
    all_common_obb3(numbers: &[T]) -> bool = boxes3::all_common::<T, V>;
    /// Scores of boxes of any orientation in space.
    obb3_scores(over: Denominator, a: Tiles<'_, T>, b: Tiles<'_, T>, out: ResultTiles<'_, T>) = boxes3::scores::<T, V>;
    /// Scores of boxes of any orientation in space with twenty derivatives each.
    obb3_derivatives(over: Denominator, a: Tiles<'_, T>, b: Tiles<'_, T>, seeds: Option<Tiles<'_, T>>, out: ResultTiles<'_, T>) = boxes3::derivatives::<T, V>;
    /// Scores of axis-aligned boxes.
    aabb2_scores(over: Denominator, a: Tiles<'_, T>, b: Tiles<'_, T>, out: ResultTiles<'_, T>) = overlaps::aabb2_scores::<T, V>;
    /// Scores of axis-aligned boxes with eight derivatives each.
    aabb2_derivatives(over: Denominator, a: Tiles<'_, T>, b: Tiles<'_, T>, seeds: Option<Tiles<'_, T>>, out: ResultTiles<'_, T>) = overlaps::aabb2_derivatives::<T, V>;
    /// `true` if axis-aligned boxes are valid.
    all_aabb2(numbers: &[T]) -> bool = blocks::all_aabb2::<T, V>;
    /// Rows of numbers into tiles.
    bring(rows: &[T], fields: usize, out: &mut [Lane<T>]) = blocks::bring::<T, V>;
    /// Tiles into rows of numbers.
    take(results: Planes<'_, T>, fields: usize, rows: &mut [T], stride: usize) = blocks::take::<T, V>;
    /// Broadcasts one item of a tile to all places of another tile.
    broadcast(from: &[Lane<T>], item: usize, tile: &mut [Lane<T>]) = blocks::broadcast::<T, V>;
    /// Picked rows of numbers into tiles.
    gather(rows: &[T], stride: usize, picked: &[u32], fields: usize, out: &mut [Lane<T>]) = blocks::gather::<T, V>;
    /// The items whose bounds meet those of a row, as indices.
    near(row: &[T; BOUNDS], bounds: Tiles<'_, T>, first: u32, hits: &mut [u32]) -> usize = blocks::near::<T, V>;
    /// The items of a tree whose bounds meet those of a row, as indices.
    search(row: &[T; BOUNDS], levels: &[Vec<Lane<T>>], room: &mut Vec<u32>) -> [usize; 2] = blocks::search::<T, V>;
    /// Boxes of space, widened by the errors of distances.
    widen(boxes: &mut [Lane<T>]) = blocks::widen::<T, V>;
    /// Lower bounds of the distances of boxes from one box, or of their squares.
    gaps(own: &[T; SPACE], boxes: Tiles<'_, T>, out: &mut [Lane<T>]) = blocks::gaps::<T, V>;
    /// Results of picked columns, put into a row per field.
    scatter(results: Planes<'_, T>, columns: &[u32], first: usize, rows: &mut [T], stride: usize) = blocks::scatter::<T, V>;
    /// Derivatives of all columns, added up.
    accumulate(results: Planes<'_, T>, fields: [usize; 2], count: usize, rows: &mut [Lane<T>], columns: &mut [Lane<T>]) = blocks::accumulate::<T, V>;
    /// Derivatives of picked columns, added up.
    accumulate_picked(results: Planes<'_, T>, fields: [usize; 2], columns: &[u32], rows: &mut [Lane<T>], sums: &mut [Lane<T>]) = blocks::accumulate_picked::<T, V>;
    /// The largest number.
    largest(numbers: &[T]) -> T = blocks::largest::<T, V>;
    /// The number of entries above a threshold.
    count_above(numbers: &[T], threshold: T) -> u64 = blocks::count_above::<T, V>;
    /// Numbers added to sixteen sums.
    add_up(numbers: &[T], sums: &mut [f64; TILE]) = blocks::add_up::<T, V>;
    /// `true` if every number is finite.
    all_finite(numbers: &[T]) -> bool = blocks::all_finite::<T, V>;
    /// `true` if every number is finite and none beyond a limit.
    all_up_to(numbers: &[T], limit: f64) -> bool = blocks::all_up_to::<T, V>;
    /// `true` if offsets never decrease nor exceed a number of vertices.
    never_decreases(offsets: &[usize], vertices: usize) -> bool = rings::never_decreases::<T, V>;
    /// A part of a block by a recorded program.
    interpret(tape: &Tape, pass: Pass<'_, T>, out: &mut [Lane<T>]) = execute::interpret::<T, V>;
    /// The instructions of a recorded program on numbers in slots.
    carry_out(code: &[Instruction], memory: Memory<'_, T>, native: Option<&BoundCode<'_, T>>) = execute::carry_out::<T, V>;
    /// The results of some items by a recorded program, from rows to rows.
    over_rows(tape: &Tape, part: RowRange<'_, T>, wanted: &mut [ResultRows<'_, T>]) = rowwise::over_rows::<T, V>;
    /// The edges of a path that can be nearest to a point, and the winding number of the path.
    near_edges(point: Vec2<T>, path: &nearest::Edges<T>, limits: nearest::ReliableLimits<T>, squares: &mut [Lane<T>], picked: &mut [u32]) -> Option<(usize, T)> = nearest::near_edges::<T, V>;
    /// The winding number of a ring around a point by the edges of a slab; `None` where it is unreliable.
    winding_of_slabs(point: Vec2<T>, ring: &winding::SlabLanes<T>, limits: nearest::ReliableLimits<T>) -> Option<T> = winding::of_slabs::<T, V>;
    /// The winding number of a ring around a point by all edges; `None` where it is unreliable.
    winding_of_ring(point: Vec2<T>, ring: &[T], limits: nearest::ReliableLimits<T>) -> Option<T> = winding::of_ring::<T, V>;
    /// The distance of every vertex from the one before.
    edge_lengths(vertices: &[T], out: &mut [T]) = rings::edge_lengths::<T, V>;
    /// The nearest faces of some points, in the order of `order`.
    nearest_faces(surface: &MeshSurface<'_, T>, points: &[Vec3<T>], order: &[u32], found: &mut Vec<FaceRecord>) = mesh_searches::nearest_faces::<T, V>;
    /// The first faces that some rays meet, in the order of `order`.
    first_faces(surface: &MeshSurface<'_, T>, rays: &[Ray3<T>], order: &[u32], found: &mut Vec<Option<u32>>) = mesh_searches::first_faces::<T, V>;
    /// The faces that may be near a solid, one after another.
    visit_faces(tree: &MeshTree, bounds: &SolidBounds, start: f64, room: &mut SearchRoom, visit: &mut dyn FnMut(u32) -> Wanted) = mesh_searches::visit_faces::<T, V>;
    /// The faces of two meshes that may be near each other, pair after pair.
    visit_pairs(trees: [&MeshTree; 2], pose: &Pose3<f64>, start: f64, visit: &mut dyn FnMut(u32, u32) -> Wanted) = mesh_searches::visit_pairs::<T, V>;
    /// Measures of rings; `false` if a vertex is not finite, and the measures are then arbitrary.
    ring_values(measure: Measure, vertices: &[Vec2<T>], offsets: &[usize], out: &mut [T]) -> bool = rings::values::<T, V>;
    /// Adjoints of measures of rings.
    ring_bars(measure: Measure, vertices: &[Vec2<T>], offsets: &[usize], upstream: &[T], bars: &mut [Vec2<T>]) = rings::bars::<T, V>;
}

//! Computational geometry with exact derivatives: overlaps, distances and scores of boxes and polygons.
//!
//! Each formula is written once, generic over a [`Scalar`]: one source runs on `f32`, `f64`, dual numbers and SIMD
//! lanes. Hot paths have adjoints by hand, checked against the duals. Batches run on all cores in a default build. A
//! derivative by a shape is a shape:
//!
//! ```
//! use geograd::{Obb2, Pack, gradient, hessian};
//!
//! let truth = Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0); // centre, size, heading in radians
//! let guess = Obb2::new(0.5, 0.2, 4.2, 1.8, 0.1);
//!
//! let iou: f64 = guess.iou(truth);
//! // `lift` makes the other box a constant of the dual numbers.
//! let (same, by_guess) = gradient(|b: Obb2<_>| b.iou(truth.lift()), guess);
//! let (_, _, curvature) = hessian(|b: Obb2<_>| b.iou(truth.lift()), guess);
//! assert_eq!(iou, same);
//! assert!(by_guess.center.x < 0.0); // the IoU falls as the box moves right
//! assert_eq!(curvature.heading.center.x, curvature.center.x.heading);
//! ```
//!
//! # Contents
//!
//! | to | see |
//! | --- | --- |
//! | measure overlap of boxes | [`overlap`], [`Obb2::iou`], [`Aabb2::iou`] |
//! | measure overlap of boxes in space | [`overlap3`], [`Obb3::iou`], [`YawBox3::iou`] |
//! | measure overlap of hulls, tetrahedra and half-spaces, and sections of them | [`overlap_solid`] |
//! | score boxes in space that may be apart | [`iou3`]: GIoU, DIoU, CIoU, EIoU, separation |
//! | compare boxes as Gaussians | [`gaussian`]: Wasserstein, Kullback-Leibler, ProbIoU, KFIoU |
//! | convert boxes of other libraries and data sets | [`convention`] |
//! | replace a call of another detection library | [`detection`] |
//! | measure distances, closest points and penetration of shapes in space | [`distance3`] |
//! | cast rays in space, cut segments | [`intersection3`] |
//! | measure distances from meshes of triangles, cast rays at them, wind around them | [`mesh`] |
//! | read and write meshes in files of OBJ, STL, PLY | `mesh_files` |
//! | find the nearest points of a cloud | [`cloud`] |
//! | find when moving bodies meet, and how near they come | [`motion`] |
//! | find the boxes that contain points | [`kernels::points`] |
//! | score boxes that may be apart: GIoU, DIoU, CIoU and the like | [`iou`] |
//! | suppress, assign and judge detections | [`suppression`], [`assignment`], [`metric`] |
//! | measure polygons | [`ring`], [`measure`] |
//! | measure the overlap of polygons, with holes or without | [`overlap_polygon`] |
//! | store and measure polygons with holes and several parts | [`polygon`] |
//! | unite, intersect and subtract polygons of any kind | [`boolean`] |
//! | grow, shrink (buffer) polygons and paths by a distance | [`offset`] |
//! | add polygons point by point (Minkowski), find where one touches another | [`minkowski`] |
//! | divide a polygon among sites: Voronoi and power cells | [`cells`] |
//! | measure arcs, Bézier curves and paths of them, find the nearest place | [`curve`] |
//! | triangulate points | [`delaunay`] |
//! | clip, join, add convex polygons | [`clipping`], [`hull`] |
//! | test whether a point is in a polygon, and how deep | [`contain`] |
//! | measure distances, closest points and penetration of shapes | [`distance`](mod@distance) |
//! | align points, find the nearest rotation | [`procrustes`](mod@procrustes), [`Rotation3::nearest_to`] |
//! | project points into cameras | [`camera`] |
//! | cross lines, cast rays, cut segments | [`intersection`] |
//! | check your own derivative | [`check`] |
//! | differentiate any generic function of shapes | [`ad`]: [`ad::gradient`], [`ad::hessian`], … |
//! | use an adjoint by hand | [`ad::adjoint::overlap`], [`ad::adjoint::ring`] |
//! | compute for many shapes at once | [`kernels::verbs`], [`kernels::cpu`] |
//! | make a shape | [`Vec2`], [`Rotation2`], [`Pose2`], [`Aabb2`], [`Obb2`], [`ConvexPolygon`]; in space [`Vec3`], [`Pose3`], [`Aabb3`], [`Obb3`], [`YawBox3`], [`Capsule3`], [`Tetrahedron`], [`Hull3`]; all: [`shape`] |
//! | make a shape of your own | [`derive(Shape)`](macro@Shape) |
//! | write generic geometry | [`Scalar`], [`Mask`], [`Pack`] |
//! | port code from the paper's library (DGAL, d3d) | [`paper`] |
//! | read the rules at kinks | [`scalar`] |
//!
//! # Invariances
//!
//! A test checks each.
//!
//! 1. **One source.** Every operation is one generic function; all derivatives come from it. Every adjoint by hand
//!    agrees with duals and with differences, on ties and near them.
//! 2. **Finite in, finite out.** Any finite valid input, from zero size to the largest number, gives finite values and
//!    derivatives, for cotangents of any size, of these rows:
//!    - boxes in the plane: `intersection_area_obb2`, `iou_obb2`, `iof_obb2`, `giou_obb2`, `intersection_area_aabb2`,
//!      `iou_aabb2`, `iof_aabb2`, `intersection_area_quads`;
//!    - boxes in space: `intersection_volume_aabb3`, `iou_aabb3`, `iof_aabb3`, `intersection_volume_yaw`, `iou_yaw`,
//!      `iof_yaw`, `iou_birds_eye`, `intersection_volume_obb3`, `iou_obb3`, `iof_obb3`, `iou_aabb3_obb3`, `iou_yaw_obb3`;
//!    - rings: `signed_area`, `area_of_ring`, `perimeter`, `centroid`.
//!
//!    All other operations guarantee it where every length, coordinate and plain number is zero or of a magnitude from
//!    2⁻²⁰ to 2²⁰ in `f32` and from 2⁻¹⁵⁰ to 2¹⁵⁰ in `f64`, and every angle is zero or at least 2⁻¹⁰⁰ in `f32` and 2⁻⁹⁰⁰
//!    in `f64`, for cotangents of one; duals guarantee it for all operations. Derivatives of `crossing_of_lines`,
//!    `crossing_of_two_planes` and `crossing_of_three_planes` grow with the square of the reciprocal of the sine between
//!    the lines or planes: their numbers are from 2⁻⁸ to 2⁸ in `f32`. A row says so as data (`Declared::finite`).
//! 3. **Ratios stay in \[0, 1\].** Identical boxes give exactly 1 with derivative 0; boxes that are apart exactly 0
//!    with derivative 0. Boxes without area (in space: volume) cover nothing: they score 0 with derivative 0, identical
//!    ones, too.
//! 4. **No absolute epsilon.** Results far from the origin, tiny, huge and thin are as exact as the inputs. The IoU of
//!    rotated boxes is within 2·10⁻⁶ of the exact one in `f32` and within 10⁻¹² in `f64`, against an independent oracle
//!    of 256 bits; for boxes up to a million times longer than wide within 2·10⁻⁵ and 2·10⁻¹⁰.
//! 5. **Reproducible.** A batch returns exactly the bits of calling the function once per item, at every SIMD level,
//!    batch position and thread count. Pairs that it leaves out, since their bounds are apart, have the same bits, too.
//! 6. **Kinks have one policy:** the derivative of the branch taken; ties share, each kink by itself; a norm at zero has
//!    derivative 0.
//! 7. **Typed errors** name argument, item and field; nothing is written when something is wrong.
//! 8. **Safe.** Two modules have `unsafe` code: `kernels/cpu/arch` calls vector instructions after it has asked the
//!    processor for them, and machine code that it wrote; `kernels/row/item/memory.rs` reads shapes as the numbers that
//!    they are.
//!
//! # Features
//!
//! `parallel` (default): batches on all cores. `native` (default): functions without a compiled kernel run as machine
//! code on x86-64. `gpu`: batches on a GPU. `glam`, `geo-types`, `kurbo`, `mint`, `nalgebra`: conversions of points, vectors
//! and curves; the last one also `num-dual`'s vector duals. `serde`:
//! serialization. `proptest`: strategies. `boolean`: [boolean operations](boolean) of polygons.
//! `mesh-files`: meshes in files of OBJ, STL and PLY. `check`: the
//! [harness](check) that checks derivatives, for `[dev-dependencies]`.
#![warn(missing_docs)]
// clippy.toml lists them: functions of the platform's library.
#![warn(clippy::disallowed_methods)]
// Pages of other modules link to the harness.
#![cfg_attr(not(feature = "check"), allow(rustdoc::broken_intra_doc_links))]
// Items of features say which one they need.
#![cfg_attr(docsrs, feature(doc_cfg))]

// The code of `#[derive(Shape)]` calls the library by its name, inside the library, too.
extern crate self as geograd;

mod arrays;
pub mod assignment;
pub mod boolean;
pub mod camera;
pub mod cells;
pub mod clip;
pub mod clipping;
pub mod cloud;
pub mod contain;
pub mod convention;
pub mod curve;
pub mod delaunay;
#[doc(hidden)]
pub mod derived;
#[doc = include_str!("detection.md")]
pub mod detection {}
pub mod distance;
pub mod distance3;
pub mod error;
pub mod gaussian;
pub mod hull;
pub mod hull3;
mod interop;
pub mod intersection;
pub mod intersection3;
pub mod iou;
pub mod iou3;
pub mod measure;
pub mod mesh;
#[cfg(feature = "mesh-files")]
pub mod mesh_files;
pub mod metric;
pub mod minkowski;
pub mod motion;
pub mod offset;
pub mod overlap;
pub mod overlap3;
pub mod overlap_polygon;
pub mod overlap_solid;
pub mod pack;
#[doc = include_str!("paper.md")]
pub mod paper {}
pub mod polygon;
pub mod predicate;
pub mod procrustes;
pub mod product;
pub mod reference;
pub mod ring;
mod rule;
pub mod scalar;
pub mod shape;
pub mod similarity;
pub mod suppression;
mod twofold;

#[path = "../ad/mod.rs"]
pub mod ad;
#[path = "../kernels/mod.rs"]
pub mod kernels;

/// Checks of derivatives: everything that one check needs, in one module.
///
/// A function of your own, in five lines:
///
/// ```
/// use geograd::check::*;
/// fn area<S: Scalar>([width, height]: [S; 2]) -> S {
///     width * height
/// }
/// assert_gradient!(generic area, |[width, height]| [height, width], at [2.0, 3.0]);
/// ```
///
/// `assert_gradient!(program &program, at …)` checks a recording, `Check::of(operation).assert()` an operation.
/// [`ad::check`] has the other options of a [`Check`](check::Check), and how far its verdict goes.
///
/// It needs the feature `check`, best in `[dev-dependencies]` alone: a build without it compiles nothing that only
/// checks.
#[cfg(feature = "check")]
pub mod check {
    pub use crate::ad::check::subject::Conventions;
    pub use crate::ad::check::verdict::{Reason, Witness};
    pub use crate::ad::check::{Check, Failure, Report, Sampling};
    pub use crate::ad::declared::{Effect, Invariance, Jumps, Kind, Motion};
    pub use crate::ad::sample::{Draw, Sample};
    pub use crate::scalar::Scalar;
    pub use crate::{assert_gradient, generic_check};
}

/// Shapes, [`Scalar`], verbs as values and as methods, and machines: everything of everyday use.
///
/// Traits come without names, for their methods alone.
///
/// ```
/// use geograd::prelude::*;
/// let (car, mast) = (Obb2::new(0.0_f64, 0.0, 4.0, 2.0, 0.0), Circle::new(Vec2::new(5.0, 0.0), 1.0));
/// assert_eq!(car.distance(mast), 2.0);
/// assert_eq!(car.giou(car), 1.0);
/// assert_eq!(Cpu::new().aligned(Distance, (One(car), &[mast]))?, [2.0]);
/// # Ok::<(), geograd::Error>(())
/// ```
pub mod prelude {
    pub use crate::ad::forward::{gradient, jacobian, value};
    pub use crate::distance::Convex as _;
    pub use crate::distance3::Apart as _;
    pub use crate::kernels::verbs::methods::{
        Bhattacharyya as _, Ciou as _, CiouAabb as _, CiouFixedWeight as _, CiouHull as _,
        CiouRectangle as _, Crossing as _, Diameter as _, Diou as _, DiouAabb as _, DiouHull as _,
        DiouRectangle as _, Eiou as _, EiouAabb as _, EiouHull as _, EiouRectangle as _,
        FirstHit as _, FlipY as _, Giou as _, GiouAabb as _, GiouHull as _, GiouRectangle as _,
        HullArea as _, IntersectionArea as _, IntersectionLength as _, IntersectionVolume as _,
        Iof as _, Iou as _, IouBev as _, Jeffreys as _, Kfiou as _, KullbackLeibler as _,
        LengthInside as _, Meeting as _, MinimumCircle as _, MinimumRectangle as _, Probiou as _,
        SeparationAware as _, Span as _, SquaredWasserstein as _, Wasserstein as _, Width as _,
    };
    pub use crate::kernels::verbs::*;
    pub use crate::kernels::{Backend, Cpu, One};
    pub use crate::pack::{Fixed as _, Pack as _};
    pub use crate::scalar::{Mask as _, Scalar};
    pub use crate::shape::{
        Aabb2, Aabb3, Capsule2, Capsule3, Circle, Cone, ConvexPolygon, Cylinder, Disc, Ellipsoid,
        Hull3, Interval, Line2, Line3, Obb2, Obb3, Plane3, Pose2, Pose3, Ray2, Ray3, Rotation2,
        Rotation3, RoundBox3, Segment2, Segment3, Sphere, Symmetric3, Tetrahedron, Triangle2,
        Triangle3, Vec2, Vec3, YawBox3,
    };
}

/// README's examples, run with the documentation's.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;

pub use ad::forward::{gradient, hessian, hvp, jacobian, jvp, value};
pub use ad::program::{Program, Sym};
pub use derived::Shape;
pub use error::{Error, Flaw, GpuFault, Unrecordable, Validate, VertexFault};
#[doc(hidden)]
pub use kernels::__private;
pub use pack::{Fixed, Pack};
pub use polygon::{Polygon, Rings};
pub use product::Code;
pub use rule::Rule;
pub use scalar::{Jet, Lanes, Mask, Real, Scalar};
pub use shape::{
    Aabb2, Aabb3, Capsule2, Capsule3, Circle, Cone, ConvexPolygon, Cylinder, Disc, Ellipsoid,
    EulerOrder, Hull3, Interval, Line2, Line3, Obb2, Obb3, Plane3, Pose2, Pose3, Ray2, Ray3,
    Rotation2, Rotation3, RoundBox3, Segment2, Segment3, Sphere, Symmetric3, Tetrahedron,
    Triangle2, Triangle3, Vec2, Vec3, YawBox3,
};

//! The functions of the paper's library, their equivalents here, and their bugs.
//!
//! DGAL, a header of C++ and CUDA templates, came with the paper that this library was begun for; `d3d` is its Python
//! package. Everything that they do in the plane is here, generic, with derivatives, in batches. Bug numbers are those
//! of the tests: `tests/geometry/paper_bugs.rs` has one per bug.
//!
//! ```
//! // The paper's listing: the IoU of two quadrilaterals, and its gradient.
//! use geograd::ad::adjoint::overlap_polygon::iou_polygons_vjp;
//! use geograd::clipping::clip_search;
//! use geograd::overlap_polygon::iou_polygons;
//! use geograd::{ConvexPolygon, Obb2};
//!
//! let a = ConvexPolygon::from(Obb2::new(0.0, 0.0, 4.0, 2.0, 0.0)); // x, y, width, height, radians
//! let b = ConvexPolygon::from(Obb2::new(1.0, 0.5, 4.0, 2.0, 0.3));
//! let iou: f64 = iou_polygons(&a, &b);
//! // What it calls flags: where every vertex of what both share is from. Derivatives do without them.
//! let flags = clip_search::<_, 4, 4, 8>(&a, &b).unwrap();
//! let (grad_a, grad_b) = iou_polygons_vjp(&a, &b, 1.0);
//!
//! // Against a difference, moving one vertex.
//! let (mut ahead, mut behind) = (a, a);
//! ahead.vertices[2].x += 1e-6;
//! behind.vertices[2].x -= 1e-6;
//! let difference = (iou_polygons(&ahead, &b) - iou_polygons(&behind, &b)) / 2e-6;
//! assert!((grad_a.vertices[2].x - difference).abs() < 1e-9);
//! assert!((0.4..0.6).contains(&iou) && flags.count == 6 && grad_b.count == 4);
//! ```
//!
//! # Types
//!
//! | there | here | what was wrong |
//! | --- | --- | --- |
//! | `Point2` | [`Vec2`] | |
//! | `Line2{a, b, c}` | [`Line2`]: a point and a direction; [`from_coefficients`](Line2::from_coefficients), [`coefficients`](Line2::coefficients) | |
//! | `Line2.intersects` | [`crossing_of_lines`](crate::intersection::crossing_of_lines())`.found` | an absolute tolerance of lines that are not normalised |
//! | `Segment2` | [`Segment2`] | |
//! | `AABox2` | [`Aabb2`] | |
//! | `AABox2.contains`, `.intersects` | [`Aabb2::contains`], [`Aabb2::encloses`], [`Aabb2::touches`]: borders belong to boxes | borders belonged to polygons, but not to boxes |
//! | `Poly2<T, Max>` | [`ConvexPolygon<S, N>`](ConvexPolygon) | B19: neither orientation nor convexity was checked |
//! | `Poly2.contains` | [`ConvexPolygon::contains`] | read beyond its memory for no vertices |
//! | `Poly2.intersects` | [`ConvexPolygon::touches`] | documented, and missing |
//! | `Numeric<T>::eps` | none | B11, B16: the same tolerance for areas, lengths and angles |
//! | `Algorithm` | none: there is one, decided exactly | |
//! | `to_string`, `pprint` | `Display` and `Debug` of every shape | a byte was printed as a letter |
//!
//! # Functions
//!
//! | there | here | what was wrong |
//! | --- | --- | --- |
//! | `line2_from_xyxy`, `line2_from_pp` | [`Line2::through`] | B17: the binding of its gradient called another one |
//! | `segment2_from_pp`, `line2_from_segment2` | [`Segment2::new`], [`Segment2::line`] | |
//! | `point_from_t` | [`Line2::point_at`] | B2: the wrong sign for vertical lines; no gradient |
//! | `t_from_pxy`, `t_from_ppoint` | [`Line2::parameter_of`] | divides by b, which is next to nothing for steep lines; no gradient |
//! | `poly2_from_aabox2`, `poly2_from_xywhr` | `ConvexPolygon::from`, [`Aabb2::corners`], [`Obb2::corners`] | |
//! | `aabox2_from_poly2` | [`ConvexPolygon::bounding`] | ties went to the first vertex; here they share |
//! | `distance(Point2, Point2)` | [`Vec2::distance`] | B7: the gradient of equal points was no number |
//! | `distance(Line2, Point2)` | [`Line2::side`] (signed), [`distance`](crate::distance::distance()) | B1: wrong gradient with respect to the line |
//! | `distance(Segment2, Point2)` | [`distance`](crate::distance::distance()) | B1; B3: a sign without meaning beyond the ends |
//! | `distance(Poly2, Point2)` | [`ConvexPolygon::depth`], [`depth_search`](crate::contain::depth_search) (with the edge); the opposite sign: [`signed_distance_to_ring`](crate::distance::ring::signed_distance_to_ring) | B1; B3: positive on the extension of an edge |
//! | `intersect(Line2, Line2)` | [`crossing_of_lines`](crate::intersection::crossing_of_lines()) | infinite for parallel lines |
//! | `intersect(AABox2, AABox2)` | [`Aabb2::meet`] | |
//! | `intersect(Poly2, Poly2)` and its flags | [`clip`](crate::clipping::clip()), [`clip_search`](crate::clipping::clip_search), [`clip_replay`](crate::clipping::clip_replay), [`clip_vjp`](crate::ad::adjoint::clipping::clip_vjp) | B4, B6: boxes of one heading; B10, B11, B12: single precision, small shapes, long ones |
//! | `area` | [`Aabb2::area`], [`ConvexPolygon::area`], [`ring::signed_area`](crate::ring::signed_area) | B10: not relative to a vertex |
//! | `dimension` | [`Aabb2::diagonal`], [`diameter_search`](crate::measure::extent::diameter_search) | B8: did not end for flat shapes |
//! | `center` | [`Aabb2::center`], [`ConvexPolygon::center`] | |
//! | `centroid` | [`ConvexPolygon::centroid`]; the mean of vertices is [`ConvexPolygon::vertex_mean`] | B9: was that mean |
//! | `merge(AABox2, AABox2)` | [`Aabb2::join`] | |
//! | `merge(Poly2, Poly2)` and its flags | [`merge`](crate::hull::merge()), [`merge_search`](crate::hull::merge_search), [`merge_replay`](crate::hull::merge_replay) | B5: empty for boxes of one heading |
//! | `max_distance` | [`farthest_distance`](crate::distance::farthest_distance) | B13: wrong vertices; B14: wrong for nested boxes; no gradient |
//! | `iou(AABox2, AABox2)` | [`Aabb2::iou`] | B18: derivatives of one and minus one for equal boxes; no number for no area |
//! | `giou(AABox2, AABox2)` | [`giou_aabb2`](crate::iou::giou_aabb2); with the exact hull [`giou_hull_aabb2`](crate::iou::giou_hull_aabb2) | B18 |
//! | `diou(AABox2, AABox2)` | [`diou_aabb2`](crate::iou::diou_aabb2); with the hull's diameter [`diou_hull_aabb2`](crate::iou::diou_hull_aabb2) | B7: no number for equal boxes |
//! | `iou(Poly2, Poly2)` | [`iou_polygons`](crate::overlap_polygon::iou_polygons), [`iou_polygons_vjp`](crate::ad::adjoint::overlap_polygon::iou_polygons_vjp); of boxes [`Obb2::iou`] | as `intersect` |
//! | `giou(Poly2, Poly2)` | [`giou_polygons_search`](crate::iou::giou_polygons_search); of boxes [`Obb2::giou`] | B5: infinite for boxes of one heading |
//! | `diou(Poly2, Poly2)` | [`diou_polygons_search`](crate::iou::diou_polygons_search); of boxes [`diou_obb2`](crate::iou::diou_obb2) | B5, B7; wrote beyond its memory above eight vertices |
//! | `…_grad` | any function with [`ad::gradient`](crate::ad::gradient) or in a batch with [`value_grad`](crate::kernels::Op::value_grad) and [`vjp`](crate::kernels::Op::vjp) | B20: results had to be zeroed by the caller |
//!
//! B15 was a name that means another function in another file.
//!
//! # The Python face
//!
//! | there | here | what was wrong |
//! | --- | --- | --- |
//! | `box2d_iou`, methods `box`, `rbox` | [`all_pairs`](crate::kernels::Cpu::all_pairs) of [`Iou`](crate::kernels::Iou) of `Aabb2`, [`Iou`](crate::kernels::Iou) of `Obb2` | gradients were added from many threads without order |
//! | `grbox`, `drbox` | [`Giou`](crate::kernels::Giou) of `Obb2`, [`Diou`](crate::kernels::Diou) of `Obb2` | B5, B7 |
//! | `gbox`, `dbox` | [`Giou`](crate::kernels::Giou) of `Aabb2`, [`Diou`](crate::kernels::Diou) of `Aabb2` | named, and refused |
//! | `precise` | columns of `f64` | |
//! | `box2d_nms` | [`suppression`](crate::suppression): [`hard`](crate::suppression::hard()), [`soft`](crate::suppression::soft()) with both decays | wrong on GPUs above 64 boxes |
//! | `box2dr_pdist` | [`SignedDistance`](crate::kernels::SignedDistance) of `Vec2` and `Obb2` | read beyond its memory; B1 |
//! | `seg1d_pdist` | [`Interval::signed_distance_to`], [`Distance`](crate::kernels::Distance) of `S` and `Interval` | |
//! | `box2dr_crop` | [`above`](crate::kernels::Cpu::above) of [`Depth`](crate::kernels::Depth) of `Vec2` and `Obb2`, or [`Obb2::contains`] | |
//! | `box3dr_pdist` | [`SignedDistance`](crate::kernels::SignedDistance) of `Vec3` and `YawBox3` | B1 |
//! | `box3dp_crop` | [`YawBox3::contains`](crate::shape::YawBox3::contains) | |
//! | `seg1d_iou` | [`Interval::iou`], [`Iou`](crate::kernels::Iou) of `Interval` | took one interval's length for both |
//!
//! Its matchers are [`assignment`](crate::assignment), its evaluation [`metric`](crate::metric).
#[cfg(doc)]
use crate::{Aabb2, ConvexPolygon, Interval, Line2, Obb2, Segment2, Vec2};

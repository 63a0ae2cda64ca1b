//! Scores of convex polygons as operations.
use crate::clipping::Corner;
use crate::distance::{distance, farthest_distance, signed_distance};
use crate::hull::{MergeTrace, merge_search, merge_replay};
use crate::iou::{
    FarthestCorners, diou_polygons_search, diou_polygons_replay, giou_polygons_replay,
};
use crate::kernels::ops::tables::searches;
use crate::kernels::verbs::{
    Diou, Distance, FarthestDistance, Giou, HullArea, IntersectionArea, Iof, Iou, SignedDistance,
};
use crate::overlap_polygon::{intersection_area_polygons, iof_polygons, iou_polygons};
use crate::{ConvexPolygon, Scalar, Vec2};

/// Returns the vertices of the joint hull of two polygons. A capacity that is too small does not compile.
fn joint_hull<S: Scalar<Mask = bool>, const N: usize, const K: usize>(
    a: &ConvexPolygon<S, N>,
    b: &ConvexPolygon<S, N>,
) -> MergeTrace<K> {
    const {
        assert!(
            K >= 2 * N,
            "the hull of two polygons may have the vertices of both"
        )
    };
    merge_search(a, b).unwrap_or(MergeTrace {
        corners: [Corner::A(0); K],
        twins: [None; K],
        count: 0,
    })
}

// Operations with a joint hull have a capacity for it, at least twice that of the polygons. Values stay when polygons
// are exchanged, but collinear sides share the derivative in an order that depends on the first polygon. So this
// invariance is not declared.
searches! {
    /// The [area](crate::overlap_polygon::intersection_area_polygons) that two convex polygons of up to `N`
    /// vertices share.
    IntersectionArea<N> = "intersection_area_polygons":
        (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by ();
    decide |_| {}
    replay |(a, b), _nothing| { intersection_area_polygons(&a, &b) }
    [rigid(2)]
    range NOT_NEGATIVE
    jumps Never

    /// The [IoU](crate::overlap_polygon::iou_polygons) of two convex polygons of up to `N` vertices.
    Iou<N> = "iou_polygons": (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by ();
    decide |_| {}
    replay |(a, b), _nothing| { iou_polygons(&a, &b) }
    [similar]
    range RATIO
    jumps FromZero

    /// The [share](crate::overlap_polygon::iof_polygons) of the first of two convex polygons of up to `N`
    /// vertices that lies in the second.
    Iof<N> = "iof_polygons": (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by ();
    decide |_| {}
    replay |(a, b), _nothing| { iof_polygons(&a, &b) }
    [similar]
    range RATIO
    jumps FromZero

    /// The [generalised IoU](crate::iou::giou_polygons_search) of two convex polygons of up to `N` vertices.
    /// It takes the convex hull of both.
    Giou<N, K> = "giou_polygons":
        (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by MergeTrace<K>;
    decide |(a, b)| { joint_hull(&a, &b) }
    replay |(a, b), hull| { giou_polygons_replay(&a, &b, &hull) }
    [similar]
    range SIGNED
    jumps FromZero

    /// The [distance IoU](crate::iou::diou_polygons_search) of two convex polygons of up to `N` vertices.
    /// It takes the diameter of both together.
    Diou<N> = "diou_polygons":
        (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by FarthestCorners;
    decide |(a, b)| { diou_polygons_search(&a, &b).1 }
    replay |(a, b), farthest| { diou_polygons_replay(&a, &b, farthest) }
    [similar]
    range SIGNED
    jumps FromZero

    /// The area of the [joint hull](crate::hull::merge) of two convex polygons of up to `N` vertices.
    HullArea<N, K> = "hull_area_polygons":
        (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by MergeTrace<K>;
    decide |(a, b)| { joint_hull(&a, &b) }
    replay |(a, b), hull| { merge_replay(&a, &b, &hull).area() }
    [rigid(2)]
    range NOT_NEGATIVE
    jumps Never

    /// The [distance](crate::distance::distance) of two convex polygons of up to `N` vertices, 0 where they meet.
    Distance<N> = "distance_polygons": (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by ();
    decide |_| {}
    replay |(a, b), _nothing| { distance(a, b) }
    [rigid(1)]
    range NOT_NEGATIVE
    jumps Never

    /// The [signed distance](crate::distance::signed_distance) of two convex polygons of up to `N` vertices: less
    /// than 0 where they overlap, by the least move that parts them.
    SignedDistance<N> = "signed_distance_polygons":
        (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by ();
    decide |_| {}
    replay |(a, b), _nothing| { signed_distance(a, b) }
    [rigid(1)]
    jumps Never

    /// The [farthest distance](crate::distance::farthest_distance) of two convex polygons of up to `N` vertices.
    FarthestDistance<N> = "farthest_distance_polygons":
        (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by ();
    decide |_| {}
    replay |(a, b), _nothing| { farthest_distance(a, b) }
    [rigid(1)]
    range NOT_NEGATIVE
    jumps Never

    /// The [distance](crate::distance::distance) of a point from a convex polygon of up to `N` vertices, 0 inside.
    Distance<N> = "distance_point_polygon": (point, polygon) as (Vec2<S>, ConvexPolygon<S, N>) => S, by ();
    decide |_| {}
    replay |(point, polygon), _nothing| { distance(point, polygon) }
    [rigid(1)]
    range NOT_NEGATIVE
    jumps Never

    /// The [signed distance](crate::distance::signed_distance) of a point from the border of a convex polygon of up to
    /// `N` vertices, less than 0 inside.
    SignedDistance<N> = "signed_distance_point_polygon":
        (point, polygon) as (Vec2<S>, ConvexPolygon<S, N>) => S, by ();
    decide |_| {}
    replay |(point, polygon), _nothing| { signed_distance(point, polygon) }
    [rigid(1)]
    jumps Never
}

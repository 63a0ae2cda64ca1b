//! Measures of polygons of a fixed number of corners, and scores of convex ones, as operations.
use crate::ad::adjoint::overlap_quad::intersection_area_quads_vjp;
use crate::clipping::Corner;
use crate::hull::{MergeTrace, merge_decided, merge_replay};
use crate::iou::{
    FarthestCorners, diou_polygons_decided, diou_polygons_replay, giou_polygons_replay,
};
use crate::kernels::cpu::plan::Compiled;
use crate::kernels::ops::rows::searches;
use crate::operation;
use crate::overlap_polygon::{
    intersection_area_polygons, intersection_area_quads, iof_polygons, iou_polygons,
};
use crate::{ConvexPolygon, Scalar, Triangle2, Vec2, ring};

operation! {
    /// The [signed area](Triangle2::signed_area) of a triangle.
    pub SignedAreaTriangle = "signed_area_triangle": (shape: Triangle2<S>) -> S { shape.signed_area() }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(2)]
    jumps Never
    slopes Reverse

    /// The [area](Triangle2::area) of a triangle.
    pub AreaTriangle = "area_triangle": (shape: Triangle2<S>) -> S { shape.area() }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(2)]
    range NOT_NEGATIVE
    jumps Never
    slopes Reverse

    /// The [perimeter](Triangle2::perimeter) of a triangle.
    pub PerimeterTriangle = "perimeter_triangle": (shape: Triangle2<S>) -> S { shape.perimeter() }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1)]
    range NOT_NEGATIVE
    jumps Never
    slopes Reverse

    /// The [centroid](Triangle2::centroid) of a triangle.
    pub CentroidTriangle = "centroid_triangle": (shape: Triangle2<S>) -> Vec2<S> { shape.centroid() }
    promises [TranslationX Follows, TranslationY Follows, Rotation Follows, Scaling Follows]
    jumps Never
    slopes Reverse

    /// The [signed area](crate::ring::signed_area) of four vertices.
    pub SignedAreaQuad = "signed_area_quad": (ring: [Vec2<S>; 4]) -> S { ring::signed_area(&ring) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(2)]
    jumps Never
    slopes Reverse

    /// The [perimeter](crate::ring::perimeter) of four vertices.
    pub PerimeterQuad = "perimeter_quad": (ring: [Vec2<S>; 4]) -> S { ring::perimeter(&ring) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1)]
    range NOT_NEGATIVE
    jumps Never
    slopes Reverse

    /// The [centroid](crate::ring::centroid) of four vertices. It jumps where the area is zero.
    pub CentroidQuad = "centroid_quad": (ring: [Vec2<S>; 4]) -> Vec2<S> { ring::centroid(&ring) }
    promises [TranslationX Follows, TranslationY Follows, Rotation Follows, Scaling Follows]
    jumps Anywhere
    slopes Reverse

    /// [`intersection_area_quads`].
    pub IntersectionAreaQuads = "intersection_area_quads":
        (a: [Vec2<S>; 4], b: [Vec2<S>; 4]) -> S { intersection_area_quads(a, b) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(2), Exchange Stays]
    finite Always range NOT_NEGATIVE extremes Shared
    jumps Never
    slopes ByHand |(a, b), out_bar| { intersection_area_quads_vjp(a, b, out_bar) }
    => compiled { Compiled::Quads }
}

/// The vertices of the joint hull of two polygons. With too little room it does not compile.
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
    merge_decided(a, b).unwrap_or(MergeTrace {
        corners: [Corner::A(0); K],
        twins: [None; K],
        count: 0,
    })
}

// What depends on a joint hull is given the room for it: at least twice that of the polygons. Values stay when
// polygons are exchanged; which one is seen from the other decides how sides along each other share the
// slope, so that is not promised.
searches! {
    /// The [area](crate::overlap_polygon::intersection_area_polygons) that two convex polygons of up to `N`
    /// vertices share. Nothing is searched for.
    IntersectionAreaPolygons<N> = "intersection_area_polygons":
        (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by ();
    decide |_| {}
    replay |(a, b), _nothing| { intersection_area_polygons(&a, &b) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(2)]
    range NOT_NEGATIVE
    jumps Never

    /// The [IoU](crate::overlap_polygon::iou_polygons) of two convex polygons of up to `N` vertices.
    IouPolygons<N> = "iou_polygons": (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by ();
    decide |_| {}
    replay |(a, b), _nothing| { iou_polygons(&a, &b) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Stays]
    range RATIO
    jumps FromZero

    /// The [share](crate::overlap_polygon::iof_polygons) of the first of two convex polygons of up to `N`
    /// vertices that lies in the second.
    IofPolygons<N> = "iof_polygons": (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by ();
    decide |_| {}
    replay |(a, b), _nothing| { iof_polygons(&a, &b) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Stays]
    range RATIO
    jumps FromZero

    /// The [generalised IoU](crate::iou::giou_polygons_decided) of two convex polygons of up to `N` vertices.
    /// Its record says which of them are on the hull.
    GiouPolygons<N, K> = "giou_polygons":
        (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by MergeTrace<K>;
    decide |(a, b)| { joint_hull(&a, &b) }
    replay |(a, b), hull| { giou_polygons_replay(&a, &b, &hull) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Stays]
    range SIGNED
    jumps FromZero

    /// The [distance IoU](crate::iou::diou_polygons_decided) of two convex polygons of up to `N` vertices.
    /// Its record says which of them are farthest apart.
    DiouPolygons<N> = "diou_polygons":
        (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by FarthestCorners;
    decide |(a, b)| { diou_polygons_decided(&a, &b).1 }
    replay |(a, b), farthest| { diou_polygons_replay(&a, &b, farthest) }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Stays]
    range SIGNED
    jumps FromZero

    /// The area of the [joint hull](crate::hull::merge) of two convex polygons of up to `N` vertices.
    HullAreaPolygons<N, K> = "hull_area_polygons":
        (a, b) as (ConvexPolygon<S, N>, ConvexPolygon<S, N>) => S, by MergeTrace<K>;
    decide |(a, b)| { joint_hull(&a, &b) }
    replay |(a, b), hull| { merge_replay(&a, &b, &hull).area() }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(2)]
    range NOT_NEGATIVE
    jumps Never
}

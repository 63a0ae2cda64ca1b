//! Measures of polygons of a fixed number of corners as operations.
use crate::kernels::cpu::plan::Compiled;
use crate::operation;
use crate::overlap_polygon::intersection_area_quads;
use crate::{Triangle2, Vec2, ring};

operation! {
    /// The [signed area](Triangle2::signed_area) of a triangle.
    pub SignedAreaTriangle = "signed_area_triangle": (shape: Triangle2<S>) -> S { shape.signed_area() }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(2)]
    jumps Never
    slopes Reverse

    /// The [area](Triangle2::area) of a triangle.
    pub AreaTriangle = "area_triangle": (shape: Triangle2<S>) -> S { shape.area() }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(2)]
    jumps Never
    slopes Reverse

    /// The [perimeter](Triangle2::perimeter) of a triangle.
    pub PerimeterTriangle = "perimeter_triangle": (shape: Triangle2<S>) -> S { shape.perimeter() }
    promises [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1)]
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
    jumps Never
    slopes Reverse
    => compiled { Compiled::Quads }
}

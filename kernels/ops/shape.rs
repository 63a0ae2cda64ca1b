//! Measures of shapes, and shapes made from shapes, as operations.
use crate::curve::{Arc2, Cubic2, Quadratic2};
use crate::kernels::ops::noun::Quad;
use crate::kernels::ops::tables::table;
use crate::kernels::verbs::{Area, Centroid, Circumcircle, Incircle, Perimeter, SignedArea};
use crate::shape::circumcircle;
use crate::{Aabb2, Capsule2, Circle, Disc, Obb2, Triangle2, Triangle3, Vec2, ring};

table! {
    /// The [signed area](Triangle2::signed_area) of {}.
    SignedArea: (shape) -> S { shape.signed_area() } [rigid(2)] (jumps Never) derivative Reverse {
        "signed_area_triangle": Triangle2;
    }
    /// The signed area between {} and its chord: positive where it runs counter-clockwise.
    SignedArea: (curve) -> S { curve.signed_area() } [rigid(2)] (jumps Never) derivative Reverse {
        "signed_area_quadratic": Quadratic2;
        "signed_area_cubic": Cubic2;
        "signed_area_arc": Arc2;
    }
    /// The [signed area](crate::ring::signed_area) of {}.
    SignedArea: (ring) -> S { ring::signed_area(&ring) } [rigid(2)] (jumps Never) derivative Reverse {
        "signed_area_quad": Quad;
    }
    /// The [area](Triangle2::area) of {}.
    Area: (shape) -> S { shape.area() } [rigid(2)] (range NOT_NEGATIVE jumps Never) derivative Reverse {
        "area_triangle": Triangle2;
        "area_triangle3": Triangle3;
        "area_disc": Disc;
    }
    /// The area of {}.
    Area: (shape) -> S { shape.area().saturated().canonical() } [rigid(2)] (range NOT_NEGATIVE jumps Never)
    derivative Reverse {
        "area_aabb2": Aabb2;
        "area_obb2": Obb2;
        "area_circle": Circle;
        "area_capsule": Capsule2;
    }
    /// The [perimeter](Triangle2::perimeter) of {}.
    Perimeter: (shape) -> S { shape.perimeter() } [rigid(1)] (range NOT_NEGATIVE jumps Never) derivative Reverse {
        "perimeter_triangle": Triangle2;
    }
    /// The perimeter of {}.
    Perimeter: (shape) -> S { shape.perimeter().saturated().canonical() } [rigid(1)] (range NOT_NEGATIVE jumps Never)
    derivative Reverse {
        "perimeter_circle": Circle;
        "perimeter_capsule": Capsule2;
    }
    /// The [perimeter](crate::ring::perimeter) of {}.
    Perimeter: (ring) -> S { ring::perimeter(&ring) } [rigid(1)] (range NOT_NEGATIVE jumps Never) derivative Reverse {
        "perimeter_quad": Quad;
    }
    /// The [centroid](Triangle2::centroid) of {}.
    Centroid: (shape) -> Vec2<S> { shape.centroid() } [follows] (jumps Never) derivative Reverse {
        "centroid_triangle": Triangle2;
    }
    // It jumps where the area is zero.
    /// The [centroid](crate::ring::centroid) of {}.
    Centroid: (ring) -> Vec2<S> { ring::centroid(&ring) } [follows] (jumps Anywhere) derivative Reverse {
        "centroid_quad": Quad;
    }
    /// The [inscribed circle](Triangle2::incircle) of {}.
    Incircle: (shape) -> Circle<S> { shape.incircle() } [follows] (jumps Never) derivative Reverse {
        "incircle": Triangle2;
    }
    /// The circle through three points ([`circumcircle`]). It jumps where they are on one line.
    Circumcircle: (a, b, c) -> Circle<S> { circumcircle(a, b, c) } [] (jumps Anywhere) derivative Reverse {
        "circumcircle": Vec2, Vec2, Vec2;
    }
}

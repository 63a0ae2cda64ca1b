//! Extents of convex polygons, and the smallest shapes around them, as operations.
use crate::kernels::ops::tables::searches;
use crate::kernels::verbs::{Area, Diameter, MinimumCircle, MinimumRectangle, Perimeter, Width};
use crate::measure::circle::{Support, circle_search, circle_replay};
use crate::measure::extent::{
    Farthest, Narrowest, diameter_search, diameter_replay, width_search, width_replay,
};
use crate::measure::rectangle::{Resting, rectangle_search, rectangle_replay};
use crate::{Circle, ConvexPolygon, Obb2};

// A polygon without vertices is measured as its first place repeated; so is one on a line where that has no extent.
searches! {
    /// The [area](ConvexPolygon::area) of a convex polygon of up to `N` vertices. Nothing is searched for.
    Area<N> = "area_of_polygon": (polygon) as ConvexPolygon<S, N> => S, by ();
    decide |_| {}
    replay |polygon, _nothing| { polygon.area() }
    [rigid(2)]
    jumps Never

    /// The [perimeter](ConvexPolygon::perimeter) of a convex polygon of up to `N` vertices. Nothing is searched for.
    Perimeter<N> = "perimeter_of_polygon": (polygon) as ConvexPolygon<S, N> => S, by ();
    decide |_| {}
    replay |polygon, _nothing| { polygon.perimeter() }
    [rigid(1)]
    jumps Never

    /// The [diameter](crate::measure::extent::diameter_search) of a convex polygon of up to `N` vertices:
    /// the largest distance of two of them, which are its record.
    Diameter<N> = "diameter_of_polygon": (polygon) as ConvexPolygon<S, N> => S, by Farthest;
    decide |polygon| {
        let nothing = Farthest { from: 0, to: 0 };
        diameter_search(polygon.as_slice()).map_or(nothing, |found| found.1)
    }
    replay |polygon, record| { diameter_replay(&polygon.vertices, record) }
    [rigid(1)]
    jumps Never

    /// The [width](crate::measure::extent::width_search) of a convex polygon of up to `N` vertices: the
    /// least distance of two parallel lines around it.
    Width<N> = "width_of_polygon": (polygon) as ConvexPolygon<S, N> => S, by Narrowest;
    decide |polygon| {
        let nothing = Narrowest { start: 0, end: 0, across: 0 };
        width_search(polygon.as_slice()).map_or(nothing, |found| found.1)
    }
    replay |polygon, record| { width_replay(&polygon.vertices, record) }
    [rigid(1)]
    jumps Never

    /// The [rectangle of least area](crate::measure::rectangle::rectangle_search) around a convex polygon
    /// of up to `N` vertices. It jumps where another edge carries a smaller one.
    MinimumRectangle<N> = "rectangle_around_polygon": (polygon) as ConvexPolygon<S, N> => Obb2<S>, by Resting;
    decide |polygon| {
        let nothing = Resting { start: 0, end: 0, right: 0, top: 0, left: 0 };
        rectangle_search(polygon.as_slice()).map_or(nothing, |found| found.1)
    }
    replay |polygon, record| { rectangle_replay(&polygon.vertices, record) }
    []
    jumps Anywhere

    /// The [smallest circle](crate::measure::circle::circle_search) around a convex polygon of up to `N`
    /// vertices.
    MinimumCircle<N> = "circle_around_polygon": (polygon) as ConvexPolygon<S, N> => Circle<S>, by Support;
    decide |polygon| {
        circle_search(polygon.as_slice()).map_or(Support::One(0), |found| found.1)
    }
    replay |polygon, record| {
        let found = circle_replay(&polygon.vertices, record);
        Circle::new(found.center, found.radius)
    }
    []
    jumps Never
}

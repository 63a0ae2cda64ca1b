//! The coordinates and points of geo-types.
use super::by_fields;
use crate::Vec2;
use geo_types::{Coord, CoordNum, Point};

by_fields! {
    [S: CoordNum] Vec2<S> = Coord<S> { x, y };
}

impl<S: CoordNum> From<Point<S>> for Vec2<S> {
    #[inline]
    fn from(point: Point<S>) -> Self {
        point.0.into()
    }
}
impl<S: CoordNum> From<Vec2<S>> for Point<S> {
    #[inline]
    fn from(v: Vec2<S>) -> Self {
        Point(v.into())
    }
}

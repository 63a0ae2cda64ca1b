//! kurbo's points, lines, Bézier curves, arcs and paths.
use super::by_fields;
use crate::Segment2;
use crate::curve::{Arc2, Cubic2, CurveElement, CurvePath, Quadratic2};
use crate::error::{Field, Flaw};
use kurbo::{Arc, BezPath, CubicBez, Line, PathEl, Point, QuadBez};

by_fields! {
    [] Vec2<f64> = Point { x, y };
    [] Vec2<f64> = kurbo::Vec2 { x, y };
}

impl From<Line> for Segment2<f64> {
    fn from(Line { p0, p1 }: Line) -> Self {
        Segment2::new(p0.into(), p1.into())
    }
}
impl From<Segment2<f64>> for Line {
    fn from(Segment2 { from, to }: Segment2<f64>) -> Self {
        Line::new(from, to)
    }
}
impl From<QuadBez> for Quadratic2<f64> {
    fn from(QuadBez { p0, p1, p2 }: QuadBez) -> Self {
        Quadratic2::new(p0.into(), p1.into(), p2.into())
    }
}
impl From<Quadratic2<f64>> for QuadBez {
    fn from(curve: Quadratic2<f64>) -> Self {
        let [a, b, c] = curve.points;
        QuadBez::new(a, b, c)
    }
}
impl From<CubicBez> for Cubic2<f64> {
    fn from(CubicBez { p0, p1, p2, p3 }: CubicBez) -> Self {
        Cubic2::new(p0.into(), p1.into(), p2.into(), p3.into())
    }
}
impl From<Cubic2<f64>> for CubicBez {
    fn from(curve: Cubic2<f64>) -> Self {
        let [a, b, c, d] = curve.points;
        CubicBez::new(a, b, c, d)
    }
}

impl TryFrom<&BezPath> for CurvePath<f64> {
    type Error = Flaw;
    /// Returns the path with the same steps; an error where the first one does not begin a contour.
    fn try_from(path: &BezPath) -> Result<Self, Flaw> {
        let of = |element: &PathEl| match *element {
            PathEl::MoveTo(a) => CurveElement::MoveTo(a.into()),
            PathEl::LineTo(a) => CurveElement::LineTo(a.into()),
            PathEl::QuadTo(a, b) => CurveElement::QuadTo(a.into(), b.into()),
            PathEl::CurveTo(a, b, c) => CurveElement::CurveTo(a.into(), b.into(), c.into()),
            PathEl::ClosePath => CurveElement::Close,
        };
        CurvePath::from_elements(path.elements().iter().map(of).collect())
    }
}
impl TryFrom<&CurvePath<f64>> for BezPath {
    type Error = Flaw;
    /// Returns the path with the same steps; an error where one is an arc, which Bézier curves only approximate.
    fn try_from(path: &CurvePath<f64>) -> Result<Self, Flaw> {
        let of = |(number, element): (usize, &CurveElement<f64>)| match *element {
            CurveElement::MoveTo(a) => Ok(PathEl::MoveTo(a.into())),
            CurveElement::LineTo(a) => Ok(PathEl::LineTo(a.into())),
            CurveElement::QuadTo(a, b) => Ok(PathEl::QuadTo(a.into(), b.into())),
            CurveElement::CurveTo(a, b, c) => Ok(PathEl::CurveTo(a.into(), b.into(), c.into())),
            CurveElement::ArcTo(..) => Err(Flaw::Broken(
                Field::VALUE.within_item(number).within("elements"),
                "is an arc, which kurbo's paths lack",
            )),
            CurveElement::Close => Ok(PathEl::ClosePath),
        };
        path.elements().iter().enumerate().map(of).collect()
    }
}

impl TryFrom<Arc> for CurvePath<f64> {
    type Error = Flaw;
    /// Returns the path of a circular arc; an error for one of an ellipse.
    fn try_from(arc: Arc) -> Result<Self, Flaw> {
        if arc.radii.x != arc.radii.y {
            return Err(Flaw::Broken(Field::new("radii"), "differ"));
        }
        let start = arc.start_angle + arc.x_rotation;
        let (center, radius) = (arc.center.into(), arc.radii.x);
        Ok(CurvePath::arc(center, radius, start, arc.sweep_angle))
    }
}
impl TryFrom<Arc2<f64>> for Arc {
    type Error = Flaw;
    /// Returns the arc about its centre; an error for a straight one, which has none.
    fn try_from(arc: Arc2<f64>) -> Result<Self, Flaw> {
        let center = arc.center();
        if !center.is_finite() {
            return Err(Flaw::Broken(
                Field::new("bulge"),
                "is that of a straight arc",
            ));
        }
        let radius = arc.radius();
        let start = (arc.from - center).angle();
        Ok(Arc::new(center, (radius, radius), start, arc.sweep(), 0.0))
    }
}

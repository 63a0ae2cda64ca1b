//! Pictures: a page of SVG, one element a line. A style is a text of attributes.
use geograd::Vec2;
use std::fmt::{Display, Write as _};

pub const INK: &str = "#212529";
pub const FAINT: &str = "#868e96";
pub const RED: &str = "#c92a2a";
pub const ORANGE: &str = "#e8590c";
pub const BLUE: &str = "#1864ab";

/// Numbers of axes.
pub const SMALL: &str = r##"font-size="11" fill="#868e96""##;
/// Text around its place, and before it.
pub const MIDDLE: &str = r#"text-anchor="middle""#;
pub const END: &str = r#"text-anchor="end""#;

/// A picture that is being drawn.
#[derive(Debug)]
pub struct Page {
    text: String,
    size: Vec2<f64>,
    /// Digits of the coordinates of shapes after the point.
    digits: usize,
}

/// A point of any format.
fn wide(at: Vec2<impl Into<f64>>) -> Vec2<f64> {
    Vec2::new(at.x.into(), at.y.into())
}

impl Page {
    /// A page of a size in pixels, with the style that its elements inherit.
    pub fn new(size: Vec2<impl Into<f64>>, digits: usize, style: impl Display) -> Self {
        let size = wide(size);
        let (w, h) = (size.x, size.y);
        let mut page = Page {
            text: String::new(),
            size,
            digits,
        };
        let area = format_args!(r#"viewBox="0 0 {w:.0} {h:.0}" width="{w:.0}" height="{h:.0}""#);
        page.element(format_args!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" {area} {style}>"#
        ));
        page
    }

    /// A page with a title and round corners.
    pub fn titled(size: Vec2<impl Into<f64>>, title: impl Display) -> Self {
        let font = "Inter, 'Helvetica Neue', Helvetica, Arial, 'DejaVu Sans', sans-serif";
        let style = format_args!(r#"font-family="{font}" font-size="13" fill="{INK}""#);
        let mut page = Self::new(size, 1, style);
        page.element(format_args!("<title>{title}</title>"));
        page.paper(r##"rx="10" fill="#fff""##);
        page
    }

    /// The text of the picture.
    #[must_use]
    pub fn finish(mut self) -> String {
        self.element("</svg>");
        self.text
    }

    /// Any element.
    pub fn element(&mut self, element: impl Display) {
        let _ = writeln!(self.text, "{element}");
    }

    /// A rectangle as large as the page.
    pub fn paper(&mut self, style: &str) {
        let (w, h) = (self.size.x, self.size.y);
        self.element(format_args!(
            r#"<rect width="{w:.0}" height="{h:.0}" {style}/>"#
        ));
    }

    /// The attributes of a rectangle by its corner, width and height.
    fn area(&self, area: [impl Into<f64>; 4]) -> String {
        let ([x, y, w, h], n) = (area.map(Into::into), self.digits);
        format!(r#"x="{x:.n$}" y="{y:.n$}" width="{w:.n$}" height="{h:.n$}""#)
    }

    pub fn rect(&mut self, area: [impl Into<f64>; 4], style: impl Display) {
        let area = self.area(area);
        self.element(format_args!("<rect {area} {style}/>"));
    }

    pub fn circle(
        &mut self,
        center: Vec2<impl Into<f64>>,
        radius: impl Display,
        style: impl Display,
    ) {
        let (Vec2 { x, y }, n) = (wide(center), self.digits);
        self.element(format_args!(
            r#"<circle cx="{x:.n$}" cy="{y:.n$}" r="{radius}" {style}/>"#
        ));
    }

    pub fn line(&mut self, ends: [Vec2<impl Into<f64>>; 2], style: impl Display) {
        let ([a, b], n) = (ends.map(wide), self.digits);
        self.element(format_args!(
            r#"<line x1="{:.n$}" y1="{:.n$}" x2="{:.n$}" y2="{:.n$}" {style}/>"#,
            a.x, a.y, b.x, b.y
        ));
    }

    fn points(
        &self,
        points: impl IntoIterator<Item = Vec2<impl Into<f64>>>,
        between: &str,
    ) -> String {
        let n = self.digits;
        let points = points.into_iter().map(wide);
        let points = points.map(|p| format!("{:.n$},{:.n$}", p.x, p.y));
        points.collect::<Vec<_>>().join(between)
    }

    pub fn polygon(
        &mut self,
        points: impl IntoIterator<Item = Vec2<impl Into<f64>>>,
        style: impl Display,
    ) {
        let points = self.points(points, " ");
        self.element(format_args!(r#"<polygon points="{points}" {style}/>"#));
    }

    pub fn polyline(
        &mut self,
        points: impl IntoIterator<Item = Vec2<impl Into<f64>>>,
        style: impl Display,
    ) {
        let points = self.points(points, " ");
        self.element(format_args!(r#"<polyline points="{points}" {style}/>"#));
    }

    pub fn path(&mut self, way: impl Display, style: impl Display) {
        self.element(format_args!(r#"<path d="{way}" {style}/>"#));
    }

    /// Lines over several points each, as one path.
    pub fn strokes<P: Into<f64>>(
        &mut self,
        strokes: impl IntoIterator<Item = impl IntoIterator<Item = Vec2<P>>>,
        style: impl Display,
    ) {
        let strokes = strokes.into_iter().map(|stroke| self.points(stroke, "L"));
        let way: String = strokes.map(|stroke| format!("M{stroke}")).collect();
        self.path(way, style);
    }

    /// Closed lines as one path.
    pub fn rings<P: Into<f64>>(
        &mut self,
        rings: impl IntoIterator<Item = impl IntoIterator<Item = Vec2<P>>>,
        style: impl Display,
    ) {
        let rings = rings.into_iter().map(|ring| self.points(ring, "L"));
        let way: String = rings.map(|ring| format!("M{ring}Z")).collect();
        self.path(way, style);
    }

    pub fn text(&mut self, at: Vec2<impl Into<f64>>, style: impl Display, words: impl Display) {
        let Vec2 { x, y } = wide(at);
        self.element(format_args!(
            r#"<text x="{x:.1}" y="{y:.1}" {style}>{words}</text>"#
        ));
    }

    /// The number of a tick left of an axis.
    pub fn left_of(
        &mut self,
        tick: Vec2<impl Into<f64>>,
        style: impl Display,
        words: impl Display,
    ) {
        let at = wide(tick) + Vec2::new(-7.0, 4.0);
        self.text(at, format_args!("{style} {END}"), words);
    }

    /// The number of a tick below an axis.
    pub fn below(&mut self, tick: Vec2<impl Into<f64>>, style: impl Display, words: impl Display) {
        let at = wide(tick) + Vec2::new(0.0, 17.0);
        self.text(at, format_args!("{style} {MIDDLE}"), words);
    }

    /// The heading of a titled page, and what its rectangles mean: styles with names.
    pub fn head<'a>(
        &mut self,
        left: impl Into<f64>,
        heading: impl Display,
        legend: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) {
        let mut x = left.into();
        let style = r#"font-size="21" font-weight="600""#;
        self.text(Vec2::new(x, 44.0), style, heading);
        for (style, name) in legend {
            self.element(format_args!(
                r#"<rect x="{x:.1}" y="61" width="24" height="12" {style}/>"#
            ));
            self.text(Vec2::new(x + 32.0, 71.5), "", name);
            // No program knows the width of a text: letters are 7.1 pixels wide on average.
            x += 32.0 + 7.1 * name.len() as f64 + 24.0;
        }
    }

    /// Defines a window, through which [`inside`](Page::inside) is seen.
    pub fn window(&mut self, id: impl Display, area: [impl Into<f64>; 4]) {
        let area = self.area(area);
        self.element(format_args!(
            r#"<clipPath id="{id}"><rect {area}/></clipPath>"#
        ));
    }

    /// A window with a ground: that of a map or a chart.
    pub fn ground(&mut self, id: impl Display, area: [impl Into<f64> + Copy; 4]) {
        self.window(id, area);
        self.rect(area, GROUND);
    }

    /// A group of elements with one style.
    pub fn group(&mut self, style: impl Display, draw: impl FnOnce(&mut Self)) {
        self.element(format_args!("<g {style}>"));
        draw(self);
        self.element("</g>");
    }

    /// Elements that are seen through a window.
    pub fn inside(&mut self, id: impl Display, draw: impl FnOnce(&mut Self)) {
        self.group(format_args!(r#"clip-path="url(#{id})""#), draw);
    }
}

/// The style of a ground.
pub const GROUND: &str = r##"fill="#fcfcfd" stroke="#ced4da""##;

/// Text that begins with a bold name and goes on faint.
pub fn headed(name: &str, rest: impl Display) -> String {
    format!(r#"<tspan font-weight="600">{name}</tspan><tspan fill="{FAINT}">{rest}</tspan>"#)
}

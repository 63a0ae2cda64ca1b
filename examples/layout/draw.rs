//! The picture: the container before and after.
use crate::forms::{CONTAINER, Place, Placed};
use crate::pack::Layout;
use geograd::Vec2;
use std::fmt::Write as _;

const SCALE: f64 = 80.0;
const MARGIN: f64 = 70.0;
const FOOT: f64 = 40.0;

/// Fill and border of discs, sticks, crates and wedges.
const COLOURS: [[&str; 2]; 4] = [
    ["#a5d8ff", "#1864ab"],
    ["#b2f2bb", "#2b8a3e"],
    ["#ffec99", "#e67700"],
    ["#ffc9c9", "#c92a2a"],
];

fn polygon(corners: &[Vec2<f64>], [fill, border]: [&str; 2]) -> String {
    let points = corners.iter().map(|p| format!("{:.2},{:.2}", p.x, p.y));
    let points = points.collect::<Vec<_>>().join(" ");
    format!(
        r#"<polygon points="{points}" fill="{fill}" fill-opacity="0.75" stroke="{border}" stroke-width="1.6"/>"#
    )
}

fn shape(shape: Placed<f64>, at: impl Fn(Vec2<f64>) -> Vec2<f64>) -> String {
    match shape {
        Placed::Disc(disc) => {
            let ([fill, border], center) = (COLOURS[0], at(disc.center));
            format!(
                r#"<circle cx="{:.2}" cy="{:.2}" r="{:.2}" fill="{fill}" fill-opacity="0.75" stroke="{border}" stroke-width="1.6"/>"#,
                center.x,
                center.y,
                disc.radius * SCALE
            )
        }
        Placed::Stick(stick) => {
            let [fill, border] = COLOURS[1];
            let (from, to) = (at(stick.from), at(stick.to));
            let line = |colour, width: f64| {
                format!(
                    r#"<line x1="{:.2}" y1="{:.2}" x2="{:.2}" y2="{:.2}" stroke="{colour}" stroke-width="{width:.2}" stroke-linecap="round"/>"#,
                    from.x, from.y, to.x, to.y
                )
            };
            let width = 2.0 * stick.radius * SCALE;
            line(border, width + 1.6) + &line(fill, width - 1.6)
        }
        Placed::Crate(rectangle) => polygon(&rectangle.corners().map(at), COLOURS[2]),
        Placed::Wedge(wedge) => polygon(&wedge.corners().map(at), COLOURS[3]),
    }
}

fn panel(page: &mut String, layout: &Layout, places: &[Place<f64>], left: f64, words: &str) {
    let [width, height] = CONTAINER.map(|half| 2.0 * half * SCALE);
    let _ = writeln!(
        page,
        r##"<rect x="{left}" y="{MARGIN}" width="{width}" height="{height}" fill="#f8f9fa" stroke="#343a40" stroke-width="3"/>"##
    );
    let at = |p: Vec2<f64>| {
        Vec2::new(
            left + (p.x + CONTAINER[0]) * SCALE,
            MARGIN + (CONTAINER[1] - p.y) * SCALE,
        )
    };
    for (form, &place) in layout.forms.iter().zip(places) {
        let _ = writeln!(page, "{}", shape(form.at(place), at));
    }
    let _ = writeln!(
        page,
        r##"<text x="{left}" y="{:.0}" font-family="sans-serif" font-size="16" fill="#212529">{words}</text>"##,
        2.0 * MARGIN + height + 10.0
    );
}

/// The whole picture.
pub fn page(layout: &Layout) -> String {
    let [width, height] = CONTAINER.map(|half| 2.0 * half * SCALE);
    let (whole, tall) = (2.0 * width + 3.0 * MARGIN, height + 2.0 * MARGIN + FOOT);
    let mut page = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {whole} {tall}\" width=\"{whole}\" height=\"{tall}\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
    );
    let (first, last) = (layout.steps[0], layout.steps[layout.steps.len() - 1]);
    let words = [("before", first), ("after", last)]
        .map(|(when, step)| format!("{when}: deepest penetration {:.3}", step.penetration));
    panel(&mut page, layout, &layout.start, MARGIN, &words[0]);
    panel(
        &mut page,
        layout,
        &layout.found,
        2.0 * MARGIN + width,
        &words[1],
    );
    page.push_str("</svg>\n");
    page
}

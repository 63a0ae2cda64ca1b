//! The picture: the container before and after.
use crate::forms::{CONTAINER, Place, Placed};
use crate::pack::Layout;
use common::svg::{INK, Page};
use geograd::Vec2;

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

fn style([fill, border]: [&str; 2]) -> String {
    format!(r#"fill="{fill}" fill-opacity="0.75" stroke="{border}" stroke-width="1.6""#)
}

fn shape(page: &mut Page, shape: Placed<f64>, at: impl Fn(Vec2<f64>) -> Vec2<f64>) {
    match shape {
        Placed::Disc(disc) => {
            let radius = format_args!("{:.2}", disc.radius * SCALE);
            page.circle(at(disc.center), radius, style(COLOURS[0]));
        }
        Placed::Stick(stick) => {
            let [fill, border] = COLOURS[1];
            let width = 2.0 * stick.radius * SCALE;
            for (colour, width) in [(border, width + 1.6), (fill, width - 1.6)] {
                let style = format_args!(
                    r#"stroke="{colour}" stroke-width="{width:.2}" stroke-linecap="round""#
                );
                page.line([stick.from, stick.to].map(&at), style);
            }
        }
        Placed::Crate(rectangle) => {
            page.polygon(rectangle.corners().map(at), style(COLOURS[2]));
        }
        Placed::Wedge(wedge) => page.polygon(wedge.corners().map(at), style(COLOURS[3])),
    }
}

fn panel(page: &mut Page, layout: &Layout, places: &[Place<f64>], left: f64, words: &str) {
    let [width, height] = CONTAINER.map(|half| 2.0 * half * SCALE);
    let style = r##"fill="#f8f9fa" stroke="#343a40" stroke-width="3""##;
    page.rect([left, MARGIN, width, height], style);
    let at = |p: Vec2<f64>| {
        Vec2::new(
            left + (p.x + CONTAINER[0]) * SCALE,
            MARGIN + (CONTAINER[1] - p.y) * SCALE,
        )
    };
    for (form, &place) in layout.forms.iter().zip(places) {
        shape(page, form.at(place), at);
    }
    let style = format_args!(r#"font-family="sans-serif" font-size="16" fill="{INK}""#);
    let foot = Vec2::new(left, 2.0 * MARGIN + height + 10.0);
    page.text(foot, style, words);
}

/// The whole picture.
pub fn page(layout: &Layout) -> String {
    let [width, height] = CONTAINER.map(|half| 2.0 * half * SCALE);
    let size = Vec2::new(2.0 * width + 3.0 * MARGIN, height + 2.0 * MARGIN + FOOT);
    let mut page = Page::new(size, 2, "");
    page.paper(r##"fill="#ffffff""##);
    let (first, last) = (layout.steps[0], layout.steps[layout.steps.len() - 1]);
    for (k, (when, step, places)) in [
        ("before", first, &layout.start),
        ("after", last, &layout.found),
    ]
    .into_iter()
    .enumerate()
    {
        let words = format!("{when}: deepest penetration {:.3}", step.penetration);
        let left = MARGIN + k as f64 * (width + MARGIN);
        panel(&mut page, layout, places, left, &words);
    }
    page.finish()
}

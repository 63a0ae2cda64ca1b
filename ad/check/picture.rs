//! A picture of one input as SVG: the outlines of the shapes, arrows at every point, and a table of numbers. An arrow is
//! the derivative of one witness with respect to the point.
use crate::ad::check::subject::Subject;
use crate::ad::check::symmetry::Kind;
use crate::ad::check::witness::{StepSequence, dot};
use crate::ad::sample::Sample;
use crate::ad::sample::drawn::Drawn;
use std::fmt::Write;

/// Returns the derivatives of the sum of all outputs in three lists: by hand, by duals, and by differences. A function
/// without an adjoint has an empty list, one without duals a list of zeros. A difference that steps cannot give is NaN.
#[must_use]
pub fn derivatives_of_witnesses(subject: &dyn Subject, x: &[f64]) -> [Vec<f64>; 3] {
    let wide = subject.wide();
    let on = wide.as_deref().unwrap_or(subject);
    let y = on.value(x);
    let weights = vec![1.0; y.len()];
    let adjoint = subject.adjoint(x, &weights).unwrap_or_default();
    let jacobian = subject.jacobian(x).unwrap_or_default();
    let dual = (0..x.len())
        .map(|i| jacobian.iter().map(|row| row[i]).sum())
        .collect();
    let values_at = |there: &Vec<f64>| {
        let inside = on.inside(there);
        inside.then(|| match on.traced(there) {
            Some((values, trace)) => (values, Some(trace)),
            None => (on.value(there), None),
        })
    };
    let probe = |places: &[Vec<f64>]| places.iter().map(values_at).collect();
    let trace = on.traced(x).map(|(_, trace)| trace);
    let scales = on.scales(x);
    let difference = (0..x.len())
        .map(|i| {
            let mut direction = vec![0.0; x.len()];
            direction[i] = scales[i];
            let sequence =
                StepSequence::evaluate(&probe, on.precision(), x, &y, trace, &direction, 0.1);
            let noise = f64::EPSILON * dot(&weights, &y).abs();
            let estimate = sequence
                .central(&weights, noise, true)
                .or_else(|| sequence.central(&weights, noise, false));
            estimate.map_or(f64::NAN, |e| e.value / scales[i])
        })
        .collect();
    [adjoint, dual, difference]
}

/// The name and the colour of each witness, and the width of its arrows. The widest are drawn first, so that equal
/// arrows all show.
const ARROWS: [(&str, &str, f64); 3] = [
    ("adjoint", "#9ecae1", 9.0),
    ("dual", "#e6550d", 4.5),
    ("difference", "#252525", 1.5),
];
/// The side of the square drawing area, in pixels.
const SIZE: f64 = 560.0;
/// The margin around the drawing area and the table.
const MARGIN: f64 = 40.0;
/// The height above the drawing area, for the title.
const TOP: f64 = 70.0;

/// Returns a picture of an input of a function and of the witnesses' derivatives there, as SVG.
#[must_use]
pub fn picture<X: Sample>(title: &str, input: &X, subject: &dyn Subject) -> String {
    drawn(title, input, subject)
}

/// Returns the picture of an input without its type, as SVG.
pub(crate) fn drawn(title: &str, input: &dyn Drawn, subject: &dyn Subject) -> String {
    let x = input.numbers();
    let kinds = input.kinds();
    let derivatives = derivatives_of_witnesses(subject, &x);
    let outlines = input.outlines();
    // Indices of x coordinates; y follows.
    let points = (0..x.len()).filter(|&i| kinds[i] == Kind::X);
    let all: Vec<[f64; 2]> = outlines
        .iter()
        .flatten()
        .copied()
        .chain(points.clone().map(|i| [x[i], x[i + 1]]))
        .collect();
    let bound = |axis: usize, pick: fn(f64, f64) -> f64, from: f64| {
        all.iter().fold(from, |m, p| pick(m, p[axis]))
    };
    let low = [
        bound(0, f64::min, f64::INFINITY),
        bound(1, f64::min, f64::INFINITY),
    ];
    let high = [
        bound(0, f64::max, f64::NEG_INFINITY),
        bound(1, f64::max, f64::NEG_INFINITY),
    ];
    let span = (high[0] - low[0]).max(high[1] - low[1]);
    let zoom = if span > 0.0 { 0.7 * SIZE / span } else { 1.0 };
    let middle = [0, 1].map(|k| low[k] + 0.5 * (high[k] - low[k]));
    let place = |p: [f64; 2]| {
        [
            MARGIN + SIZE / 2.0 + (p[0] - middle[0]) * zoom,
            TOP + SIZE / 2.0 - (p[1] - middle[1]) * zoom,
        ]
    };

    let rows = x.len().min(24);
    let height = (TOP + SIZE + MARGIN).max(TOP + 40.0 + 22.0 * rows as f64 + MARGIN);
    let width = 2.0 * MARGIN + SIZE + 640.0;
    let mut svg = String::new();
    let _ = writeln!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" \
         width=\"{width:.0}\" height=\"{height:.0}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"{MARGIN}\" y=\"32\" font-size=\"20\">{title}</text>\n\
         <rect x=\"{MARGIN}\" y=\"{TOP}\" width=\"{SIZE}\" height=\"{SIZE}\" fill=\"#fafafa\" \
         stroke=\"#cccccc\"/>"
    );
    for (outline, colour) in outlines.iter().zip(["#3182bd", "#31a354"].iter().cycle()) {
        let list: Vec<String> = outline
            .iter()
            .map(|&p| {
                let [x, y] = place(p);
                format!("{x:.2},{y:.2}")
            })
            .collect();
        let _ = writeln!(
            svg,
            "<polygon points=\"{}\" fill=\"{colour}\" fill-opacity=\"0.15\" stroke=\"{colour}\" \
             stroke-width=\"1.5\"/>",
            list.join(" ")
        );
    }
    let longest = derivatives.iter().flat_map(|list| {
        points
            .clone()
            .filter_map(|i| Some(list.get(i)?.hypot(*list.get(i + 1)?)))
    });
    let longest = longest.filter(|l| l.is_finite()).fold(0.0_f64, f64::max);
    for (list, (_, colour, width)) in derivatives.iter().zip(ARROWS) {
        for i in points.clone() {
            let (Some(&gx), Some(&gy)) = (list.get(i), list.get(i + 1)) else {
                continue;
            };
            let length = gx.hypot(gy);
            if !length.is_finite() || length == 0.0 {
                continue;
            }
            let [x0, y0] = place([x[i], x[i + 1]]);
            let reach = 0.2 * SIZE * length / longest;
            let (dx, dy) = (gx / length, -gy / length);
            let [x1, y1] = [x0 + reach * dx, y0 + reach * dy];
            let head = 4.0 + width;
            let _ = writeln!(
                svg,
                "<path d=\"M{x0:.2} {y0:.2}L{x1:.2} {y1:.2}M{:.2} {:.2}L{x1:.2} {y1:.2}L{:.2} {:.2}\" \
                 stroke=\"{colour}\" stroke-width=\"{width}\" fill=\"none\" \
                 stroke-linecap=\"round\" stroke-linejoin=\"round\"/>",
                x1 - head * (dx + 0.6 * dy),
                y1 - head * (dy - 0.6 * dx),
                x1 - head * (dx - 0.6 * dy),
                y1 - head * (dy + 0.6 * dx),
            );
        }
    }
    let left = 2.0 * MARGIN + SIZE;
    let columns = [0.0, 70.0, 210.0, 350.0, 490.0];
    let mut text = |column: usize, row: f64, content: &str, colour: &str| {
        let _ = writeln!(
            svg,
            "<text x=\"{:.0}\" y=\"{:.0}\" fill=\"{colour}\" font-family=\"monospace\">{content}</text>",
            left + columns[column],
            TOP + 14.0 + 22.0 * row
        );
    };
    text(0, 0.0, "number", "#252525");
    text(1, 0.0, "value", "#252525");
    for (k, (name, colour, _)) in ARROWS.iter().enumerate() {
        let colour = if k == 0 { "#3182bd" } else { colour };
        text(2 + k, 0.0, &format!("d/d by {name}"), colour);
    }
    for i in 0..rows {
        let kind = match kinds[i] {
            Kind::X => "x",
            Kind::Y => "y",
            Kind::Z => "z",
            Kind::Length => "length",
            Kind::Angle => "angle",
            Kind::AngleX => "angle about x",
            Kind::AngleY => "angle about y",
            Kind::DirectionX => "x of a direction",
            Kind::DirectionY => "y of a direction",
            Kind::DirectionZ => "z of a direction",
            Kind::Offset => "offset along a direction",
            Kind::QuaternionW => "w of a quaternion",
            Kind::QuaternionX => "x of a quaternion",
            Kind::QuaternionY => "y of a quaternion",
            Kind::QuaternionZ => "z of a quaternion",
            Kind::RotationVectorX => "x of a rotation vector",
            Kind::RotationVectorY => "y of a rotation vector",
            Kind::RotationVectorZ => "z of a rotation vector",
            Kind::Number => "number",
        };
        let row = 1.2 + i as f64;
        text(0, row, kind, "#636363");
        text(1, row, &format!("{:.8e}", x[i]), "#636363");
        for (k, list) in derivatives.iter().enumerate() {
            let number = list.get(i).map_or("-".to_owned(), |g| format!("{g:.8e}"));
            text(2 + k, row, &number, "#252525");
        }
    }
    svg.push_str("</svg>\n");
    svg
}

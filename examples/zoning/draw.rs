//! The picture: districts by the nearest station, districts with their capacities, and the steps that led there.
use crate::balance::Plan;
use crate::city::City;
use common::svg::{BLUE, FAINT, GROUND, INK, MIDDLE, ORANGE, Page, SMALL, headed};
use geograd::cells::PowerDiagram;
use geograd::{Error, Vec2};

const LEFT: f64 = 30.0;
const TOP: f64 = 96.0;
const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 470.0;
const CHART: f64 = 150.0;

/// The colour of a district with so much of its capacity: blue below, white at it, red above.
fn colour(load: f64) -> String {
    let far = load.max(1e-3).log2().clamp(-1.0, 1.0);
    let end = if far < 0.0 {
        [66, 133, 200]
    } else {
        [222, 74, 66]
    };
    let part = end.map(|c| 255.0 + (f64::from(c) - 255.0) * far.abs());
    format!(
        "#{:02x}{:02x}{:02x}",
        part[0] as u8, part[1] as u8, part[2] as u8
    )
}

/// From kilometres to pixels of a panel.
struct Frame {
    low: Vec2<f64>,
    scale: f64,
    left: f64,
}

impl Frame {
    fn new(city: &City, left: f64) -> Self {
        let corners = city.domain.vertices();
        let (mut low, mut high) = (Vec2::new(f64::MAX, f64::MAX), Vec2::new(f64::MIN, f64::MIN));
        for p in corners {
            low = Vec2::new(low.x.min(p.x), low.y.min(p.y));
            high = Vec2::new(high.x.max(p.x), high.y.max(p.y));
        }
        let scale = (WIDTH / (high.x - low.x)).min(HEIGHT / (high.y - low.y));
        let rest = Vec2::new(WIDTH, HEIGHT) * (1.0 / scale) - (high - low);
        Frame {
            low: low - rest * 0.5,
            scale,
            left,
        }
    }

    fn at(&self, p: Vec2<f64>) -> Vec2<f64> {
        let from = (p - self.low) * self.scale;
        Vec2::new(self.left + from.x, TOP + HEIGHT - from.y)
    }
}

/// The districts of stations with weights.
fn districts(
    page: &mut Page,
    city: &City,
    frame: &Frame,
    stations: &[Vec2<f64>],
    weights: &[f64],
) -> Result<(), Error> {
    let diagram = PowerDiagram::new(stations, weights, &city.domain)?;
    let trace = diagram.search();
    let cells = diagram.cells(&trace);
    let loads: Vec<f64> = (cells.areas().iter().zip(&city.capacities))
        .map(|(a, c)| a / c)
        .collect();
    for (i, &load) in loads.iter().enumerate() {
        let polygon = cells.polygon(i);
        let rings = polygon
            .rings()
            .iter()
            .map(|ring| ring.iter().map(|&p| frame.at(p)));
        let fill = colour(load);
        let style = format_args!(
            r##"fill="{fill}" fill-rule="evenodd" stroke="#495057" stroke-width="0.8" stroke-linejoin="round""##
        );
        page.rings(rings, style);
    }
    let shores = city.domain.rings();
    // A district around the lake has borders across it that cancel.
    let water = shores
        .iter()
        .skip(1)
        .map(|ring| ring.iter().map(|&p| frame.at(p)));
    page.rings(water, r##"fill="#c5e3f6""##);
    let rings = shores.iter().map(|ring| ring.iter().map(|&p| frame.at(p)));
    page.rings(
        rings,
        format_args!(r#"fill="none" stroke="{INK}" stroke-width="2""#),
    );
    let is_small = stations.len() <= 80;
    for (i, (&station, center)) in stations.iter().zip(cells.centroids()).enumerate() {
        let radius = if is_small { 2.6 } else { 1.4 };
        page.circle(frame.at(station), radius, format_args!(r#"fill="{INK}""#));
        if is_small {
            let style = format_args!(r#"font-size="10" {MIDDLE} fill="{INK}""#);
            // Beside the station.
            let [dot, middle] = [station, center].map(|p| frame.at(p));
            let is_near = (middle - dot).length() < 16.0;
            let place = if is_near {
                dot + Vec2::new(0.0, -7.0)
            } else {
                middle
            };
            page.text(place, style, format_args!("{:.0} %", 100.0 * loads[i]));
        }
    }
    Ok(())
}

/// Ways of the stations.
fn ways(page: &mut Page, city: &City, plan: &Plan, frame: &Frame) {
    let ways = city.stations.iter().zip(&plan.stations);
    let strokes = ways.map(|(&from, &to)| [frame.at(from), frame.at(to)]);
    let style =
        format_args!(r#"fill="none" stroke="{ORANGE}" stroke-width="1.2" stroke-opacity="0.8""#);
    page.strokes(strokes, style);
}

/// A chart of numbers by places, from `low` to `high`, with ticks.
fn chart(
    page: &mut Page,
    left: f64,
    title: (&str, &str),
    numbers: &[f64],
    ticks: &[(f64, String)],
) {
    let (x, y, w, h) = (left + 60.0, TOP + HEIGHT + 74.0, WIDTH - 80.0, CHART);
    let (low, high) = (ticks[0].0, ticks[ticks.len() - 1].0);
    page.rect([x, y, w, h], GROUND);
    page.text(Vec2::new(left, y - 16.0), "", headed(title.0, title.1));
    let place = |value: f64| y + h * (high - value.clamp(low, high)) / (high - low);
    for (value, words) in ticks {
        let at = place(*value);
        page.line(
            [Vec2::new(x, at), Vec2::new(x + w, at)],
            r##"stroke="#e9ecef""##,
        );
        page.left_of(Vec2::new(x, at), SMALL, words);
    }
    let last = (numbers.len() - 1).max(1) as f64;
    let at = |k: usize| Vec2::new(x + w * k as f64 / last, place(numbers[k]));
    let style = format_args!(r#"fill="none" stroke="{BLUE}" stroke-width="2""#);
    page.polyline((0..numbers.len()).map(at), style);
    for k in 0..numbers.len() {
        page.circle(at(k), 2.5, format_args!(r#"fill="{BLUE}""#));
        if k % numbers.len().div_ceil(14) == 0 {
            page.below(Vec2::new(at(k).x, y + h), SMALL, k);
        }
    }
}

/// The whole picture.
pub fn page(city: &City, plan: &Plan) -> Result<String, Error> {
    let right = 2.0 * LEFT + WIDTH;
    let size = Vec2::new(3.0 * LEFT + 2.0 * WIDTH, TOP + HEIGHT + CHART + 120.0);
    let mut page = Page::titled(size, "Districts with capacities");
    let [few, full, many] =
        [0.5, 1.0, 2.0].map(|load| format!(r##"fill="{}" stroke="{FAINT}""##, colour(load)));
    let legend = [
        (few.as_str(), "half of its capacity or less"),
        (full.as_str(), "its capacity"),
        (many.as_str(), "twice its capacity or more"),
    ];
    page.head(LEFT, "Districts of a city, each with a capacity", legend);
    let frame = Frame::new(city, LEFT);
    districts(&mut page, city, &frame, &city.stations, &[])?;
    let frame = Frame::new(city, right);
    districts(&mut page, city, &frame, &plan.stations, &plan.weights)?;
    ways(&mut page, city, plan, &frame);
    let foot = TOP + HEIGHT + 26.0;
    let error = plan.rounds[plan.rounds.len() - 1].error;
    for (left, name, rest) in [
        (
            LEFT,
            "Nearest station: ",
            "every point goes to the station next to it".to_owned(),
        ),
        (
            right,
            "Balanced: ",
            format!(
                "all areas are their capacities up to {error:.0e}; lines are the ways of stations"
            ),
        ),
    ] {
        page.text(Vec2::new(left, foot), "", headed(name, rest));
    }
    let logarithms: Vec<f64> = plan.errors.iter().map(|e| e.max(1e-16).log10()).collect();
    let ticks: Vec<_> = (-4..=1)
        .map(|k| (f64::from(4 * k), format!("1e{}", 4 * k)))
        .collect();
    let title = (
        "Steps of Newton's method: ",
        "largest error of an area, relative to its capacity",
    );
    chart(&mut page, LEFT, title, &logarithms, &ticks);
    let ways: Vec<f64> = plan.rounds.iter().map(|round| round.way).collect();
    let highest = ways.iter().copied().fold(0.0, f64::max);
    // Four steps of one, two or five tenths, hundredths and so on.
    let unit = 10.0_f64.powf((highest / 4.0).log10().floor());
    let step = [1.0, 2.0, 2.5, 5.0, 10.0]
        .map(|k| k * unit)
        .into_iter()
        .find(|step| 4.0 * step >= highest)
        .unwrap_or(highest);
    let ticks: Vec<_> = (0..=4)
        .map(|k| (f64::from(k) * step, format!("{:.1}", f64::from(k) * step)))
        .collect();
    let title = (
        "Moves of stations: ",
        "root mean square way to a station, km",
    );
    chart(&mut page, right, title, &ways, &ticks);
    Ok(page.finish())
}

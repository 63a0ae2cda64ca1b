//! The city: a border with bays, a lake, stations and capacities.
use common::random::Draw;
use geograd::polygon::{Fill, area};
use geograd::{Polygon, Vec2};
use std::f64::consts::TAU;

/// A city, in kilometres.
pub struct City {
    /// The border, and the shore of the lake.
    pub domain: Polygon<f64>,
    pub stations: Vec<Vec2<f64>>,
    /// The area that each district is to have.
    pub capacities: Vec<f64>,
}

/// A closed line around a centre, which waves come nearer to and farther from.
fn shore(draw: &mut Draw, center: Vec2<f64>, radius: f64, corners: usize) -> Vec<Vec2<f64>> {
    let waves: Vec<_> = (2..7)
        .map(|k| {
            let height = 0.32 * f64::from(draw.uniform()) / f64::from(k).sqrt();
            (f64::from(k), height, TAU * f64::from(draw.uniform()))
        })
        .collect();
    (0..corners)
        .map(|i| {
            let angle = TAU * i as f64 / corners as f64;
            let lift = |(k, height, phase): &(f64, f64, f64)| height * (k * angle + phase).sin();
            let reach = radius * (1.0 + waves.iter().map(lift).sum::<f64>());
            center + Vec2::new(1.25 * angle.cos(), angle.sin()) * reach
        })
        .collect()
}

impl City {
    /// A city of a seed. Capacities are up to four times as large as others.
    pub fn random(seed: u64, districts: usize) -> Self {
        let mut draw = Draw::new(&[seed]);
        let border = shore(&mut draw, Vec2::new(0.0, 0.0), 6.0, 160);
        let lake = shore(&mut draw, Vec2::new(1.4, -0.6), 1.1, 48);
        let domain = Polygon::from_rings([&border[..], &lake]);
        let mut stations = Vec::with_capacity(districts);
        while stations.len() < districts {
            let mut within = |reach: f64| reach * (2.0 * f64::from(draw.uniform()) - 1.0);
            // Denser in the middle, as houses are.
            let at = Vec2::new(within(6.0) + within(5.0), within(5.0) + within(4.0));
            if domain.rings().contains(at, Fill::EvenOdd) {
                stations.push(at);
            }
        }
        let wishes: Vec<f64> = (0..districts)
            .map(|_| 0.5 + 1.5 * f64::from(draw.uniform()))
            .collect();
        let share = area(&domain) / wishes.iter().sum::<f64>();
        let capacities = wishes.into_iter().map(|wish| share * wish).collect();
        City {
            domain,
            stations,
            capacities,
        }
    }

    pub fn area(&self) -> f64 {
        self.capacities.iter().sum()
    }
}

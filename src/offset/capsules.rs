//! The part of a line or an arc that is inside a capsule: all within a radius of an edge.
use crate::{Scalar, Vec2};
use std::f64::consts::TAU;

/// The name of a curve: a side of an edge, or the circle about a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Name {
    Side(u32),
    Circle(u32),
}

/// An interval of a curve inside a capsule, with the curves that bound the capsule at both ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taken {
    pub low: f64,
    pub high: f64,
    pub by: [Name; 2],
}

/// An edge with all within a radius of it.
#[derive(Clone, Copy)]
pub(super) struct Capsule {
    /// The number of the edge.
    pub number: u32,
    pub ends: [Vec2<f64>; 2],
    /// The places of both ends by number.
    pub places: [u32; 2],
    /// From the first end to the second, of length one.
    pub way: Vec2<f64>,
    pub length: f64,
}

/// A straight curve: from a place on in a direction of length one.
#[derive(Clone, Copy)]
pub(super) struct Track {
    pub start: Vec2<f64>,
    pub way: Vec2<f64>,
    pub length: f64,
}

/// An arc about a center from a direction on, counter-clockwise.
#[derive(Clone, Copy)]
pub(super) struct Sector {
    pub center: Vec2<f64>,
    pub from: Vec2<f64>,
    pub sweep: f64,
}

impl Sector {
    /// Returns the direction at an angle from the first one.
    pub fn way(&self, angle: f64) -> Vec2<f64> {
        let (sin, cos) = Scalar::sin_cos(angle);
        let from = self.from;
        Vec2::new(from.x * cos - from.y * sin, from.x * sin + from.y * cos)
    }
    fn angle(&self, way: Vec2<f64>) -> f64 {
        Scalar::atan2(self.from.perp_dot(way), self.from.dot(way))
    }
}

/// A disc around a piece of a curve: tells most capsules at once to take all of it or nothing.
pub(super) struct Around {
    middle: Vec2<f64>,
    beyond: f64,
    inside: f64,
}

impl Around {
    pub fn new(middle: Vec2<f64>, half: f64, r: f64) -> Self {
        let half = half * (1.0 + 1e-9);
        let (far, near) = (r * (1.0 + 1e-12) + half, r * (1.0 - 1e-12) - half);
        Around {
            middle,
            beyond: far * far,
            inside: near.max(0.0) * near.max(0.0),
        }
    }
    /// Returns `true` if a capsule takes all, `false` if it takes nothing, `None` if neither is certain.
    pub fn decides(&self, edge: &Capsule) -> Option<bool> {
        let square = edge.square_to(self.middle);
        if square >= self.beyond {
            Some(false)
        } else if square < self.inside {
            Some(true)
        } else {
            None
        }
    }
}

impl Capsule {
    /// Returns the squared distance from the edge to a point.
    fn square_to(&self, at: Vec2<f64>) -> f64 {
        let seen = at - self.ends[0];
        let along = seen.dot(self.way).clamp(0.0, self.length);
        (seen - self.way * along).length_squared()
    }
    /// Returns the interval of a straight track inside. A disc about the place `except` is left out: the track ends where
    /// it touches that disc.
    pub fn part_of_track(&self, track: &Track, r: f64, except: Option<u32>) -> Option<Taken> {
        let seen = track.start - self.ends[0];
        // To the right of the edge, and along it.
        let (height, rise) = (seen.perp_dot(self.way), track.way.perp_dot(self.way));
        let (along, gain) = (seen.dot(self.way), track.way.dot(self.way));
        let (last, end) = (height + rise * track.length, along + gain * track.length);
        let size = self.length;
        if height.min(last) >= r
            || height.max(last) <= -r
            || along.min(end) >= size + r
            || along.max(end) <= -r
        {
            return None;
        }
        let sides = [0, 1].map(|k| Name::Side(2 * self.number + k));
        let mut taken = Taken {
            low: f64::INFINITY,
            high: f64::NEG_INFINITY,
            by: sides,
        };
        let mut add = |low: f64, high: f64, by: [Name; 2]| {
            if low < taken.low {
                (taken.low, taken.by[0]) = (low, by[0]);
            }
            if high > taken.high {
                (taken.high, taken.by[1]) = (high, by[1]);
            }
        };
        let within = |at: f64, step: f64, low: f64, high: f64| {
            if step == 0.0 {
                return match at > low && at < high {
                    true => [f64::NEG_INFINITY, f64::INFINITY],
                    false => [1.0, -1.0],
                };
            }
            let (a, b) = ((low - at) / step, (high - at) / step);
            [a.min(b), a.max(b)]
        };
        let zone = within(along, gain, 0.0, size);
        let strip = within(height, rise, -r, r);
        let (low, high) = (zone[0].max(strip[0]), zone[1].min(strip[1]));
        if low < high {
            // It comes in over the left side where it runs to the right.
            let by = if rise > 0.0 {
                [sides[1], sides[0]]
            } else {
                sides
            };
            add(low, high, by);
        }
        for (at, place) in self.ends.into_iter().zip(self.places) {
            if except == Some(place) {
                continue;
            }
            let way = track.start - at;
            let (back, high) = (way.dot(track.way), way.perp_dot(track.way));
            let rest = (r - high) * (r + high);
            if rest > 0.0 {
                let root = rest.sqrt();
                add(-back - root, -back + root, [Name::Circle(place); 2]);
            }
        }
        let is_met = taken.low < track.length && taken.high > 0.0 && taken.low < taken.high;
        is_met.then_some(taken)
    }
    /// Adds the intervals of an arc inside; returns `true` if that is all of it.
    pub fn parts_of_sector(&self, arc: &Sector, r: f64, all: &mut Vec<Taken>) -> bool {
        if self.square_to(arc.center) >= 4.0 * r * r {
            return false;
        }
        let none = Name::Side(u32::MAX);
        let mut stops = [(0.0, none); 10];
        stops[1].0 = arc.sweep;
        let mut count = 2;
        let mut add = |angle: f64, by: Name| {
            let angle = angle.rem_euclid(TAU);
            if angle > 0.0 && angle < arc.sweep {
                stops[count] = (angle, by);
                count += 1;
            }
        };
        for (at, place) in self.ends.into_iter().zip(self.places) {
            let way = at - arc.center;
            let far = way.length();
            if far > 0.0 && far < 2.0 * r {
                let (middle, half) = (arc.angle(way), arc_cosine(far / (2.0 * r)));
                add(middle - half, Name::Circle(place));
                add(middle + half, Name::Circle(place));
            }
        }
        let across = super::right(self.way);
        let height = (arc.center - self.ends[0]).perp_dot(self.way);
        for (k, side) in [(0, 1.0), (1, -1.0)] {
            let cosine = side - height / r;
            if cosine.abs() < 1.0 {
                let (middle, half) = (arc.angle(across), arc_cosine(cosine));
                let name = Name::Side(2 * self.number + k);
                add(middle - half, name);
                add(middle + half, name);
            }
        }
        let stops = &mut stops[..count];
        stops.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let mut is_whole = true;
        for pair in stops.windows(2) {
            let [(low, before), (high, after)] = [pair[0], pair[1]];
            let at = arc.center + arc.way(f64::midpoint(low, high)) * r;
            if self.square_to(at) < r * r {
                let by = [before, after];
                all.push(Taken { low, high, by });
            } else {
                is_whole = false;
            }
        }
        is_whole
    }
}

fn arc_cosine(x: f64) -> f64 {
    Scalar::atan2(((1.0 - x) * (1.0 + x)).sqrt(), x)
}

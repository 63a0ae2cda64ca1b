//! Bodies of space in a picture: faces and points, those that are nearer over those behind.
use crate::blend::Faces;
use crate::svg::Page;
use geograd::{Capsule3, Vec2, Vec3};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A colour as red, green, blue from 0 to 255.
pub type Colour = [u8; 3];

/// A parallel view.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// The pixel of the origin.
    pub origin: Vec2<f64>,
    /// Pixels of a metre.
    pub scale: f64,
    /// To the right, up, and towards the viewer.
    pub axes: [Vec3<f64>; 3],
}

impl View {
    /// A view turned about the vertical and tilted down, in radians.
    #[must_use]
    pub fn turned(origin: Vec2<f64>, scale: f64, turn: f64, tilt: f64) -> Self {
        let ((sin, cos), (sink, level)) = (turn.sin_cos(), tilt.sin_cos());
        let right = Vec3::new(cos, sin, 0.0);
        let near = Vec3::new(sin * level, -cos * level, sink);
        View {
            origin,
            scale,
            axes: [right, near.cross(right), near],
        }
    }
    /// The pixel of a point.
    #[must_use]
    pub fn place(&self, point: Vec3<f64>) -> Vec2<f64> {
        let [right, up, _] = self.axes;
        self.origin + Vec2::new(right.dot(point), -up.dot(point)) * self.scale
    }
}

/// A mark at a depth.
enum Mark {
    Face([Vec2<f64>; 3], Colour),
    Dot(Vec2<f64>, f64, Colour),
}

/// The marks of a view, until all of them are drawn.
pub struct Painter {
    view: View,
    marks: Vec<(f64, Mark)>,
}

fn hex([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

impl Painter {
    #[must_use]
    pub fn new(view: View) -> Self {
        let marks = Vec::new();
        Painter { view, marks }
    }
    /// Adds the faces of a closed mesh that are seen from outside, darker the more they turn away from the light.
    pub fn mesh(&mut self, mesh: &Faces, colour: Colour) {
        let [right, up, near] = self.view.axes;
        let light = (near + up * 0.8 - right * 0.6).normalize_or_zero();
        for face in &mesh.faces {
            let [a, b, c] = face.map(|i| mesh.vertices[i as usize]);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            if normal.dot(near) <= 0.0 {
                continue;
            }
            let shade = 0.45 + 0.55 * (0.5 + 0.5 * normal.dot(light));
            let colour = colour.map(|part| (f64::from(part) * shade).min(255.0) as u8);
            let depth = near.dot(a + b + c) / 3.0;
            let corners = [a, b, c].map(|corner| self.view.place(corner));
            self.marks.push((depth, Mark::Face(corners, colour)));
        }
    }
    /// Adds a capsule.
    pub fn capsule(&mut self, capsule: &Capsule3<f64>, colour: Colour) {
        self.mesh(&faces_of(capsule), colour);
    }
    /// Adds a point as a disc of so many pixels; it is drawn over faces that are up to `ahead` metres nearer.
    pub fn dot(&mut self, point: Vec3<f64>, pixels: f64, ahead: f64, colour: Colour) {
        let depth = self.view.axes[2].dot(point) + ahead;
        let mark = Mark::Dot(self.view.place(point), pixels, colour);
        self.marks.push((depth, mark));
    }
    /// Draws all of it.
    pub fn finish(mut self, page: &mut Page) {
        self.marks.sort_by(|a, b| a.0.total_cmp(&b.0));
        // Outlines of a face's own colour close the gaps between neighbours.
        let style = r#"fill="currentColor" stroke="currentColor" stroke-width="0.4" stroke-linejoin="round""#;
        page.group(style, |page| {
            for (_, mark) in self.marks {
                match mark {
                    Mark::Face([a, b, c], colour) => {
                        let (b, c) = (b - a, c - b);
                        let way = format_args!(
                            "M{:.1} {:.1}l{:.1} {:.1} {:.1} {:.1}z",
                            a.x, a.y, b.x, b.y, c.x, c.y
                        );
                        page.path(way, format_args!(r#"color="{}""#, hex(colour)));
                    }
                    Mark::Dot(at, pixels, colour) => {
                        let style = format_args!(r#"stroke="none" color="{}""#, hex(colour));
                        page.circle(at, pixels, style);
                    }
                }
            }
        });
    }
}

/// A capsule as a closed mesh.
fn faces_of(capsule: &Capsule3<f64>) -> Faces {
    const ROUND: usize = 20;
    const CAP: usize = 5;
    const PIECE: f64 = 4e-3;
    let along = (capsule.end - capsule.start).normalize_or_zero();
    let least = match along.x.abs() < 0.6 {
        true => Vec3::new(1.0, 0.0, 0.0),
        false => Vec3::new(0.0, 1.0, 0.0),
    };
    let side = along.cross(least).normalize_or_zero();
    let other = along.cross(side);
    // Short faces, since their middles decide which is drawn first.
    let length = (capsule.end - capsule.start).length();
    let pieces = (length / PIECE).ceil().max(1.0);
    let angle = |k: usize| k as f64 / (CAP - 1) as f64;
    let mut rings: Vec<(f64, f64)> = (0..CAP).map(|k| (0.0, angle(k) - 1.0)).collect();
    rings.extend((1..pieces as usize).map(|k| (k as f64 / pieces, 0.0)));
    rings.extend((0..CAP).map(|k| (1.0, angle(k))));
    let mut vertices = Vec::new();
    for &(part, angle) in &rings {
        let center = capsule.start.lerp(capsule.end, part);
        let (height, width) = (0.999 * angle * FRAC_PI_2).sin_cos();
        for k in 0..ROUND {
            let (sin, cos) = (TAU * k as f64 / ROUND as f64).sin_cos();
            let away = along * height + (side * cos + other * sin) * width;
            vertices.push(center + away * capsule.radius);
        }
    }
    let at = |ring: usize, k: usize| (ring * ROUND + k % ROUND) as u32;
    let quads = (0..rings.len() - 1).flat_map(|ring| (0..ROUND).map(move |k| (ring, k)));
    let faces = quads.flat_map(|(ring, k)| {
        let [a, b] = [at(ring, k), at(ring, k + 1)];
        let [c, d] = [at(ring + 1, k + 1), at(ring + 1, k)];
        [[a, b, c], [a, c, d]]
    });
    let faces = faces.collect();
    Faces { vertices, faces }
}

//! The surface of a hull with a volume as triangles: quickhull (Barber, Dobkin, Huhdanpaa 1996) with exact decisions.
use super::orientation::side;
use crate::Vec3;

/// A triangle of the surface, counter-clockwise seen from outside.
#[derive(Clone, Debug)]
pub(super) struct Triangle {
    /// The numbers of its corners.
    pub corners: [usize; 3],
    /// The triangles across the edges from each corner to the next one.
    pub beside: [usize; 3],
    /// `true` if it belongs to the surface of the hull so far.
    pub kept: bool,
    /// Points above it that no other triangle has in its list.
    above: Vec<usize>,
}

impl Triangle {
    fn new(corners: [usize; 3], beside: [usize; 3]) -> Self {
        Triangle {
            corners,
            beside,
            kept: true,
            above: Vec::new(),
        }
    }
}

/// Triangles that are made one after another.
struct Growing<'a> {
    points: &'a [Vec3<f64>],
    all: Vec<Triangle>,
}

/// Returns the triangles of the hull of points, of which four span a volume. Those that are not kept are none of the
/// surface.
pub(super) fn triangles(points: &[Vec3<f64>], [a, b, c, d]: [usize; 4]) -> Vec<Triangle> {
    let all = vec![
        Triangle::new([a, b, c], [1, 2, 3]),
        Triangle::new([a, d, b], [3, 2, 0]),
        Triangle::new([b, d, c], [1, 3, 0]),
        Triangle::new([c, d, a], [2, 1, 0]),
    ];
    let mut growing = Growing { points, all };
    for k in 0..points.len() {
        growing.place(k, 0);
    }
    let mut next = 0;
    while next < growing.all.len() {
        if growing.all[next].kept && !growing.all[next].above.is_empty() {
            growing.extend(next);
        }
        next += 1;
    }
    growing.all
}

impl Growing<'_> {
    fn corners(&self, triangle: usize) -> [Vec3<f64>; 3] {
        self.all[triangle].corners.map(|k| self.points[k])
    }
    fn is_above(&self, triangle: usize, point: usize) -> bool {
        !self.all[triangle].corners.contains(&point)
            && side(self.corners(triangle), self.points[point]) > 0.0
    }
    /// Adds a point to the list of the first triangle, from a number on, that it is above.
    fn place(&mut self, point: usize, from: usize) {
        if let Some(k) = (from..self.all.len()).find(|&k| self.is_above(k, point)) {
            self.all[k].above.push(point);
        }
    }
    /// Extends the hull to the farthest point above a triangle. All triangles below the point are replaced by new ones
    /// from their joint border to the point.
    fn extend(&mut self, start: usize) {
        let [a, b, c] = self.corners(start);
        let normal = (b - a).cross(c - a);
        let height = |k: usize| normal.dot(self.points[k] - a);
        let above = &self.all[start].above;
        let mut apex = above[0];
        for &k in above {
            if height(k) > height(apex) {
                apex = k;
            }
        }
        // Seen from the point these triangles are connected.
        let (mut seen, mut border) = (vec![start], Vec::new());
        self.all[start].kept = false;
        let mut read = 0;
        while read < seen.len() {
            let Triangle {
                corners, beside, ..
            } = self.all[seen[read]];
            for k in 0..3 {
                let other = beside[k];
                if !self.all[other].kept {
                    continue;
                }
                if self.is_above(other, apex) {
                    self.all[other].kept = false;
                    seen.push(other);
                } else {
                    border.push((corners[k], corners[(k + 1) % 3], other));
                }
            }
            read += 1;
        }
        let first = self.all.len();
        let number = |corner: usize, border: &[(usize, usize, usize)], end: bool| {
            let place = border
                .iter()
                .position(|&(from, to, _)| corner == if end { to } else { from });
            first + place.unwrap_or(0)
        };
        for (k, &(from, to, other)) in border.iter().enumerate() {
            let beside = [
                other,
                number(to, &border, false),
                number(from, &border, true),
            ];
            self.all.push(Triangle::new([from, to, apex], beside));
            let other = &mut self.all[other];
            for (edge, beside) in other.beside.iter_mut().enumerate() {
                if other.corners[edge] == to && other.corners[(edge + 1) % 3] == from {
                    *beside = first + k;
                }
            }
        }
        for gone in seen {
            for point in std::mem::take(&mut self.all[gone].above) {
                if point != apex {
                    self.place(point, first);
                }
            }
        }
    }
}

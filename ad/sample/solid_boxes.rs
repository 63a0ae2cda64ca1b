//! Random boxes of space, and their hard cases.
//!
//! Boxes of any orientation turn about all axes, upright ones about z, axis-aligned ones not at all.
use crate::ad::declared::Kind;
use crate::ad::sample::{Draw, Sample};
use crate::error::Validate;
use crate::shape::{Aabb3, Obb3, Ray3, Rotation3, YawBox3};
use crate::{Obb2, Vec3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// Returns a height of about unit size.
fn tall(draw: &mut Draw) -> f64 {
    draw.within(0.2, 3.0)
}

/// Returns minus one or one.
fn sign(draw: &mut Draw) -> f64 {
    if draw.once_in(2) { -1.0 } else { 1.0 }
}

/// Returns a vector of three numbers.
fn vector([x, y, z]: [f64; 3]) -> Vec3<f64> {
    Vec3::new(x, y, z)
}

/// Returns the scales of a box's centre and sizes. Sizes have their own magnitude as scale, or the largest one for
/// zero. The centre has the geometric mean of the sizes, or a thousandth of the largest.
fn lengths(size: Vec3<f64>) -> [f64; 6] {
    let size = [size.x, size.y, size.z];
    let largest = match size.into_iter().fold(0.0_f64, f64::max) {
        0.0 => 1.0,
        largest => largest,
    };
    let own = size.map(|x| if x > 0.0 { x } else { largest });
    let mean = own[0].cbrt() * own[1].cbrt() * own[2].cbrt();
    let place = mean.max(1e-3 * largest);
    [place, place, place, own[0], own[1], own[2]]
}

/// Returns the largest angle of a turn: it moves the ends of a box by about as much as its centre may move.
fn turn(lengths: &[f64; 6]) -> f64 {
    lengths[0] / lengths[3].max(lengths[4]).max(lengths[5])
}

/// Returns the vector from the centre of one box to that of another of equal axes that touches it: face on face, edge
/// on edge or corner on corner.
fn touching(own: Vec3<f64>, other: Vec3<f64>, draw: &mut Draw) -> [f64; 3] {
    let reach = (own + other) * 0.5;
    let across = draw.below(3);
    let at_corner = draw.once_in(4);
    let mut offset = [reach.x, reach.y, reach.z];
    for (axis, x) in offset.iter_mut().enumerate() {
        *x *= match axis == across || at_corner {
            true => sign(draw),
            false => draw.within(-1.0, 1.0),
        };
    }
    offset
}

/// Returns a rotation about any axis, now and then by an eighth of a turn about one of the world's, by any
/// quaternion of about unit length.
fn rotation(draw: &mut Draw) -> Rotation3<f64> {
    let axis = [0; 3].map(|_| draw.within(-1.0, 1.0));
    let turned = match draw.below(6) {
        0 => {
            let mut axis = [0.0; 3];
            axis[draw.below(3)] = 1.0;
            let angle = FRAC_PI_4 * draw.below(8) as f64;
            Rotation3::from_axis_angle(vector(axis), angle)
        }
        _ => Rotation3::new(draw.within(-1.0, 1.0), axis[0], axis[1], axis[2]),
    };
    let length = [turned.w, turned.x, turned.y, turned.z]
        .iter()
        .fold(0.0_f64, |sum, x| sum.hypot(*x));
    match length > 0.3 {
        true => turned,
        false => Rotation3::identity(),
    }
}

impl Sample for Vec3<f64> {
    fn ordinary(draw: &mut Draw) -> Self {
        vector([0; 3].map(|_| draw.within(-2.0, 2.0)))
    }
    fn hard() -> Vec<Self> {
        // The middle, a face, an edge and a corner of hard boxes, and points off all of them.
        let all = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 0.5, 0.25],
            [1.0, 0.5, 0.75],
            [0.0, -1.0, 0.5],
            [0.5, 0.5, 0.5],
            [0.3, -0.2, 0.4],
            [4.0, 3.0, -2.0],
        ];
        all.map(vector).to_vec()
    }
    fn kinds(&self) -> Vec<Kind> {
        vec![Kind::X, Kind::Y, Kind::Z]
    }
    fn scales(&self) -> Vec<f64> {
        let size = self.x.abs().max(self.y.abs()).max(self.z.abs());
        vec![if size > 0.0 { size } else { 1.0 }; 3]
    }
    fn inside(&self) -> bool {
        self.is_finite()
    }
}

impl Sample for Ray3<f64> {
    fn ordinary(draw: &mut Draw) -> Self {
        // At the middle of where other shapes are: few others would hit them.
        let (point, at) = (Vec3::ordinary(draw), [0; 3].map(|_| draw.within(-0.7, 0.7)));
        let way = vector(at) - point;
        let ray = Ray3::new(point, way * draw.magnitude(0.1, 10.0));
        if ray.inside() {
            ray
        } else {
            Ray3::new(point, Vec3::new(1.0, 0.0, 0.0))
        }
    }
    fn hard() -> Vec<Self> {
        let points = Vec3::hard().into_iter();
        let ways = [
            [1.0, 0.0, 0.0],
            [0.0, -2.0, 0.0],
            [1.0, 0.5, 0.75],
            [4.0, 3.0, -2.0],
        ];
        let rays = points.flat_map(|point| ways.map(|way| Ray3::new(point, vector(way))));
        rays.step_by(3).collect()
    }
    fn kinds(&self) -> Vec<Kind> {
        use Kind::{DirectionX, DirectionY, DirectionZ, X, Y, Z};
        vec![X, Y, Z, DirectionX, DirectionY, DirectionZ]
    }
    fn scales(&self) -> Vec<f64> {
        [self.point.scales(), self.direction.scales()].concat()
    }
    fn inside(&self) -> bool {
        self.validate().is_ok()
    }
}

impl Sample for YawBox3<f64> {
    fn ordinary(draw: &mut Draw) -> Self {
        let ground = Obb2::ordinary(draw);
        let center = [ground.center.x, ground.center.y, draw.within(-1.0, 1.0)];
        let size = [ground.size.x, ground.size.y, tall(draw)];
        YawBox3::new(vector(center), vector(size), ground.heading)
    }
    fn thin(draw: &mut Draw) -> Self {
        let mut size = [0; 3].map(|_| draw.magnitude(1.0, 50.0));
        size[draw.below(3)] = draw.magnitude(1e-3, 0.1);
        YawBox3 {
            size: vector(size),
            ..Self::ordinary(draw)
        }
    }
    fn beside(&self, draw: &mut Draw) -> Self {
        let other = Self::ordinary(draw);
        let offset = touching(self.size, other.size, draw);
        YawBox3 {
            center: self.center + self.rotation() * vector(offset),
            heading: self.heading,
            ..other
        }
    }
    fn hard() -> Vec<Self> {
        let made =
            |at: [f64; 3], size: [f64; 3], heading| YawBox3::new(vector(at), vector(size), heading);
        vec![
            made([0.0, 0.0, 0.0], [2.0, 1.0, 1.5], 0.0),
            made([0.0, 0.0, 0.0], [1.0, 0.5, 0.75], 0.0),
            made([0.5, 0.25, 0.0], [1.0, 0.5, 1.5], 0.0),
            made([2.0, 0.0, 0.0], [2.0, 1.0, 1.5], 0.0),
            made([2.0, 1.0, 1.5], [2.0, 1.0, 1.5], 0.0),
            made([0.5, 0.0, 1.5], [2.0, 1.0, 1.5], 0.0),
            made([0.0, 0.0, 0.0], [2.0, 1.0, 1.5], FRAC_PI_2),
            made([0.25, 0.125, 0.1], [1.5, 1.5, 1.0], FRAC_PI_4),
            made([0.0, 0.0, 0.0], [2.0, 1.0, 1.5], 1e-5),
            made([0.0, 0.0, 0.0], [50.0, 1e-3, 1.0], 0.0),
            made([0.25, 0.0, 0.0], [0.0, 1.0, 1.0], 0.0),
            made([9.0, 9.0, 3.0], [2.0, 1.0, 1.0], 0.5),
            made([0.3, -0.2, 0.4], [1.4, 0.9, 1.2], 0.7),
        ]
    }
    fn kinds(&self) -> Vec<Kind> {
        use Kind::{Angle, Length, X, Y, Z};
        vec![X, Y, Z, Length, Length, Length, Angle]
    }
    fn scales(&self) -> Vec<f64> {
        let lengths = lengths(self.size);
        [&lengths[..], &[turn(&lengths)]].concat()
    }
    fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        self.birds_eye().outlines()
    }
    fn inside(&self) -> bool {
        self.validate().is_ok()
    }
}

impl Sample for Obb3<f64> {
    fn ordinary(draw: &mut Draw) -> Self {
        let upright = YawBox3::ordinary(draw);
        Obb3::new(upright.center, upright.size, rotation(draw))
    }
    fn thin(draw: &mut Draw) -> Self {
        let upright = YawBox3::thin(draw);
        Obb3::new(upright.center, upright.size, rotation(draw))
    }
    fn beside(&self, draw: &mut Draw) -> Self {
        let other = Self::ordinary(draw);
        let offset = touching(self.size, other.size, draw);
        Obb3 {
            center: self.center + self.rotation * vector(offset),
            rotation: self.rotation,
            ..other
        }
    }
    fn hard() -> Vec<Self> {
        let about = |axis: [f64; 3], angle| Rotation3::from_axis_angle(vector(axis), angle);
        let made =
            |at: [f64; 3], size: [f64; 3], rotation| Obb3::new(vector(at), vector(size), rotation);
        let none = Rotation3::identity();
        // Few: every pair of them is a long computation.
        vec![
            made([0.0, 0.0, 0.0], [2.0, 1.0, 1.5], none),
            made([0.0, 0.0, 0.0], [1.0, 0.5, 0.75], none),
            made([2.0, 0.0, 0.0], [2.0, 1.0, 1.5], none),
            made(
                [0.0, 0.0, 0.0],
                [2.0, 1.0, 1.5],
                Rotation3::new(-2.0, 0.0, 0.0, 0.0),
            ),
            made(
                [0.0, 0.0, 0.0],
                [2.0, 1.0, 1.5],
                about([0.0, 0.0, 1.0], FRAC_PI_2),
            ),
            made(
                [0.25, 0.125, 0.1],
                [1.5, 1.5, 1.0],
                about([1.0, 0.0, 0.0], FRAC_PI_4),
            ),
            made([0.0, 0.0, 0.0], [50.0, 1e-3, 1.0], none),
            made([0.25, 0.0, 0.0], [0.0, 1.0, 1.0], none),
            made(
                [0.3, -0.2, 0.4],
                [1.4, 0.9, 1.2],
                about([0.5, -0.3, 0.8], 0.7),
            ),
        ]
    }
    fn kinds(&self) -> Vec<Kind> {
        use Kind::{Length, X, Y, Z};
        let place = vec![X, Y, Z, Length, Length, Length];
        [place, self.rotation.kinds()].concat()
    }
    fn scales(&self) -> Vec<f64> {
        let (lengths, q) = (lengths(self.size), self.rotation);
        let length = q.w.hypot(q.x).hypot(q.y).hypot(q.z);
        [&lengths[..], &[turn(&lengths) * length; 4]].concat()
    }
    fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        let [a, b, c, d, ..] = self.corners().map(|p| [p.x, p.y]);
        vec![vec![a, b, d, c]]
    }
    fn inside(&self) -> bool {
        self.validate().is_ok()
    }
}

/// Returns the axis-aligned box of such a centre and size.
fn upright(center: Vec3<f64>, size: Vec3<f64>) -> Aabb3<f64> {
    Aabb3::new(center - size * 0.5, center + size * 0.5)
}

impl Sample for Aabb3<f64> {
    fn ordinary(draw: &mut Draw) -> Self {
        let drawn = YawBox3::ordinary(draw);
        upright(drawn.center, drawn.size)
    }
    fn thin(draw: &mut Draw) -> Self {
        let drawn = YawBox3::thin(draw);
        upright(drawn.center, drawn.size)
    }
    fn beside(&self, draw: &mut Draw) -> Self {
        let size = YawBox3::ordinary(draw).size;
        let offset = touching(self.size(), size, draw);
        upright(self.center() + vector(offset), size)
    }
    fn hard() -> Vec<Self> {
        let made = |min: [f64; 3], max: [f64; 3]| Aabb3::new(vector(min), vector(max));
        vec![
            made([0.0, 0.0, 0.0], [2.0, 1.0, 1.5]),
            made([0.5, 0.25, 0.5], [1.0, 0.75, 1.0]),
            made([0.0, 0.25, 0.0], [2.0, 0.5, 1.5]),
            made([1.0, 0.0, 0.0], [3.0, 1.0, 1.5]),
            made([2.0, 0.0, 0.0], [4.0, 1.0, 1.5]),
            made([2.0, 1.0, 1.5], [4.0, 2.0, 3.0]),
            made([0.7, 0.3, 0.2], [2.9, 1.7, 1.3]),
            made([1.0, 0.0, 0.0], [1.0, 1.0, 1.0]),
            made([1.0, 0.5, 0.5], [1.0, 0.5, 0.5]),
            made([-25.0, 0.5, 0.25], [25.0, 0.501, 1.25]),
            made([0.0, 0.0, 0.0], [100.0, 100.0, 100.0]),
            made([9.0, 9.0, 9.0], [11.0, 10.0, 10.0]),
        ]
    }
    fn kinds(&self) -> Vec<Kind> {
        [Kind::X, Kind::Y, Kind::Z].repeat(2)
    }
    fn scales(&self) -> Vec<f64> {
        lengths(self.size())[3..].repeat(2)
    }
    fn outlines(&self) -> Vec<Vec<[f64; 2]>> {
        self.birds_eye().outlines()
    }
    fn inside(&self) -> bool {
        self.validate().is_ok()
    }
}

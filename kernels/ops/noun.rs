//! Shapes in rows: their names in sentences, and the motions of the plane that they have.
use crate::convention::{Detectron2Box, ImageBox, KittiBox, LidarBox, NuScenesBox, Xyxyr};
use crate::iou::Exponent;
use crate::{
    Aabb2, Aabb3, Capsule2, Circle, ConvexPolygon, Interval, Line2, Obb2, Obb3, Pose2, Ray2,
    Segment2, Triangle2, Vec2, Vec3, YawBox3,
};

/// A shape in the documentation and the invariances of a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Noun {
    /// The name of an argument.
    pub name: &'static str,
    /// One of it.
    pub one: &'static str,
    /// Two of it.
    pub two: &'static str,
    /// True if all of it moves along x and y like points.
    pub shifts: bool,
    /// True if it turns about the origin of the plane. Axis-aligned boxes cannot; the turn of a box of any orientation is
    /// not an angle of the plane.
    pub turns: bool,
}

/// A type with a [`Noun`].
pub(crate) trait Named {
    const NOUN: Noun;
}

/// A plain number as an argument.
pub(crate) type Number<S> = S;
/// Four vertices.
pub(crate) type Quad<S> = [Vec2<S>; 4];

/// Shapes and their nouns.
macro_rules! nouns {
    ($([$($size:tt)*] $type:ty: $name:literal, $one:literal, $two:literal, $shifts:literal, $turns:literal;)*) => { $(
        impl<$($size)*> Named for $type {
            const NOUN: Noun = Noun {
                name: $name,
                one: $one,
                two: $two,
                shifts: $shifts,
                turns: $turns,
            };
        }
    )* };
}
nouns! {
    //                   name       one                           two                             shifts turns
    [] Vec2<f64>:        "point",    "a point",                    "two points",                    true,  true;
    [] Vec3<f64>:        "point",    "a point",                    "two points",                    true,  true;
    [] Segment2<f64>:    "segment",  "a segment",                  "two segments",                  true,  true;
    [] Triangle2<f64>:   "triangle", "a triangle",                 "two triangles",                 true,  true;
    [] Circle<f64>:      "circle",   "a circle",                   "two circles",                   true,  true;
    [] Capsule2<f64>:    "capsule",  "a capsule",                  "two capsules",                  true,  true;
    [] Quad<f64>:        "ring",     "four vertices",              "two quadrilaterals",            true,  true;
    [const N: usize] ConvexPolygon<f64, N>:
                         "polygon",  "a convex polygon",           "two convex polygons",           true,  true;
    [] Aabb2<f64>:       "shape",    "an axis-aligned box",        "two axis-aligned boxes",        true,  false;
    [] Obb2<f64>:        "shape",    "a rotated box",              "two rotated boxes",             true,  true;
    [] Aabb3<f64>:       "shape",    "an axis-aligned box",        "two axis-aligned boxes",        true,  false;
    [] YawBox3<f64>:     "shape",    "an upright box",             "two upright boxes",             true,  true;
    [] Obb3<f64>:        "shape",    "a box of any orientation",   "two boxes of any orientation",  true,  false;
    [] Exponent<f64>:    "power",    "a power",                    "two powers",                    true,  true;
    // A shift moves directions like points.
    [] Line2<f64>:       "line",     "a line",                     "two lines",                     false, true;
    [] Ray2<f64>:        "ray",      "a ray",                      "two rays",                      false, true;
    [] Pose2<f64>:       "pose",     "a pose",                     "two poses",                     false, true;
    // Their ends are lengths.
    [] Interval<f64>:    "interval", "an interval",                "two intervals",                 false, false;
    [] f64:              "x",        "a number",                   "two numbers",                   false, false;
    // Encodings, which are converted only.
    [] ImageBox<f64>:      "shape",  "an image's box",             "two boxes of an image",         false, false;
    [] Detectron2Box<f64>: "shape",  "detectron2's box",           "two boxes of detectron2",       false, false;
    [] Xyxyr<f64>:         "shape",  "bounds before turning, with the angle", "two bounds with angles", false, false;
    [] KittiBox<f64>:      "shape",  "KITTI's box",                "two boxes of KITTI",            false, false;
    [] LidarBox<f64>:      "shape",  "OpenPCDet's box",            "two boxes of OpenPCDet",        false, false;
    [] NuScenesBox<f64>:   "shape",  "nuScenes' box",              "two boxes of nuScenes",         false, false;
}

/// True for two equal texts.
pub(crate) const fn same(a: &str, b: &str) -> bool {
    let (x, y) = (a.as_bytes(), b.as_bytes());
    let mut alike = x.len() == y.len();
    let mut i = 0;
    while alike && i < x.len() {
        alike = x[i] == y[i];
        i += 1;
    }
    alike
}

/// The names of two arguments: what they are, or `a` and `b` of two of one kind.
pub(crate) const fn named(a: &'static str, b: &'static str) -> [&'static str; 2] {
    match same(a, b) {
        true => ["a", "b"],
        false => [a, b],
    }
}

/// The parts of a documentation: the title, its `{}` the arguments (but for parameters after the first two), and the
/// sentence of the row alone.
pub(crate) const fn sentences(
    title: &'static str,
    own: &'static str,
    arguments: &[Noun],
) -> [&'static str; 6] {
    let title = title.trim_ascii();
    let (bytes, mut at) = (title.as_bytes(), 0);
    while at + 1 < bytes.len() && !(bytes[at] == b'{' && bytes[at + 1] == b'}') {
        at += 1;
    }
    if at + 1 >= bytes.len() {
        return [title, "", "", "", "", own];
    }
    let (before, after) = (title.split_at(at).0, title.split_at(at + 2).1);
    let a = arguments[0];
    if arguments.len() == 1 {
        return [before, a.one, "", "", after, own];
    }
    let b = arguments[1];
    match same(a.one, b.one) {
        true => [before, a.two, "", "", after, own],
        false => [before, a.one, " and ", b.one, after, own],
    }
}

/// The length of all parts.
pub(crate) const fn length(parts: &[&str]) -> usize {
    let (mut sum, mut i) = (0, 0);
    while i < parts.len() {
        sum += parts[i].len();
        i += 1;
    }
    sum
}

/// The bytes of all parts, one after the other.
pub(crate) const fn joined<const N: usize>(parts: &[&str]) -> [u8; N] {
    let (mut bytes, mut at, mut i) = ([0; N], 0, 0);
    while i < parts.len() {
        let (part, mut k) = (parts[i].as_bytes(), 0);
        while k < part.len() {
            bytes[at] = part[k];
            at += 1;
            k += 1;
        }
        i += 1;
    }
    bytes
}

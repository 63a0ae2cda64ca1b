//! Shapes in rows: their names in sentences, and their motions.
use crate::camera::{BrownConrady, Fisheye, Pinhole};
use crate::convention::{
    Detectron2Box, ImageBox, KittiBox, Le90, Le135, LidarBox, NuScenesBox, OpenCvBox, Xyxyr,
};
use crate::curve::{Arc2, Cubic2, Quadratic2};
use crate::iou::Exponent;
use crate::motion::Motion3;
use crate::{
    Aabb2, Aabb3, Capsule2, Capsule3, Circle, Cone, ConvexPolygon, Cylinder, Disc, Ellipsoid,
    Hull3, Interval, Line2, Line3, Obb2, Obb3, Plane3, Pose2, Pose3, Ray2, Ray3, Rotation3,
    RoundBox3, Segment2, Segment3, Sphere, Tetrahedron, Triangle2, Triangle3, Vec2, Vec3, YawBox3,
};

/// A shape in the documentation and the invariances of a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Noun {
    /// The name of the argument.
    pub name: &'static str,
    /// The phrase for one shape.
    pub one: &'static str,
    /// The phrase for two shapes.
    pub two: &'static str,
    /// The motions that move it.
    pub moves: Moves,
}

/// The motions of a frame that a shape follows: its numbers change by their kinds, and its meaning moves along.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moves {
    /// Shifts along x, y and z.
    pub shifts: [bool; 3],
    /// Rotations about x, y and z; in the plane about the origin, which is z.
    pub turns: [bool; 3],
}

impl Moves {
    const fn new(shifts: [bool; 3], turns: [bool; 3]) -> Self {
        Moves { shifts, turns }
    }
    /// Encodings, which are only converted, and numbers of a line.
    const NONE: Moves = Moves::new([false; 3], [false; 3]);
    /// A number that no motion changes, which fits all shapes.
    pub const WITH_ALL: Moves = Moves::new([true; 3], [true; 3]);
    /// Shapes of the plane.
    const PLANE: Moves = Moves::new([true, true, false], [false, false, true]);
    /// Axis-aligned shapes of the plane.
    const PLANE_ALIGNED: Moves = Moves::new([true, true, false], [false; 3]);
    /// Shapes of the plane with a direction among their points, which a shift would wrongly move.
    const PLANE_DIRECTED: Moves = Moves::new([false; 3], [false, false, true]);
    /// Shapes of space.
    const SPACE: Moves = Moves::new([true; 3], [true; 3]);
    /// Shapes of space with an angle about z.
    const UPRIGHT: Moves = Moves::new([true; 3], [false, false, true]);
    /// Shapes of space with an angle about y, as a camera sees upright ones.
    const OF_CAMERA: Moves = Moves::new([true; 3], [false, true, false]);
    /// Axis-aligned shapes of space.
    const SPACE_ALIGNED: Moves = Moves::new([true; 3], [false; 3]);

    /// Returns the motions that both have.
    pub const fn and(self, other: Moves) -> Self {
        let (mut both, mut i) = (self, 0);
        while i < 3 {
            both.shifts[i] = self.shifts[i] && other.shifts[i];
            both.turns[i] = self.turns[i] && other.turns[i];
            i += 1;
        }
        both
    }
}

/// A type with a [`Noun`].
pub(crate) trait Named {
    const NOUN: Noun;
}

/// A plain number as an argument.
pub(crate) type Number<S> = S;
/// Four vertices.
pub(crate) type Quad<S> = [Vec2<S>; 4];

/// Implements [`Named`] for shapes, from their nouns.
macro_rules! nouns {
    ($([$($size:tt)*] $type:ty: $name:literal, $one:literal, $two:literal, $moves:ident;)*) => { $(
        impl<$($size)*> Named for $type {
            const NOUN: Noun = Noun {
                name: $name,
                one: $one,
                two: $two,
                moves: Moves::$moves,
            };
        }
    )* };
}
nouns! {
    //                   name       one                           two                               moves
    [] Vec2<f64>:        "point",    "a point",                    "two points",                    PLANE;
    [] Vec3<f64>:        "point",    "a point",                    "two points",                    SPACE;
    [] Segment2<f64>:    "segment",  "a segment",                  "two segments",                  PLANE;
    [] Quadratic2<f64>:  "curve",    "a quadratic Bézier curve",   "two quadratic Bézier curves",   PLANE;
    [] Cubic2<f64>:      "curve",    "a cubic Bézier curve",       "two cubic Bézier curves",       PLANE;
    [] Arc2<f64>:        "curve",    "a circular arc",             "two circular arcs",             PLANE;
    [] Triangle2<f64>:   "triangle", "a triangle",                 "two triangles",                 PLANE;
    [] Circle<f64>:      "circle",   "a circle",                   "two circles",                   PLANE;
    [] Capsule2<f64>:    "capsule",  "a capsule",                  "two capsules",                  PLANE;
    [] Quad<f64>:        "ring",     "four vertices",              "two quadrilaterals",            PLANE;
    [const N: usize] ConvexPolygon<f64, N>:
                         "polygon",  "a convex polygon",           "two convex polygons",           PLANE;
    [] Aabb2<f64>:       "shape",    "an axis-aligned box",        "two axis-aligned boxes",        PLANE_ALIGNED;
    [] Obb2<f64>:        "shape",    "a rotated box",              "two rotated boxes",             PLANE;
    [] Aabb3<f64>:       "shape",    "an axis-aligned box",        "two axis-aligned boxes",        SPACE_ALIGNED;
    [] YawBox3<f64>:     "shape",    "an upright box",             "two upright boxes",             UPRIGHT;
    [] Obb3<f64>:        "shape",    "a box of any orientation",   "two boxes of any orientation",  SPACE;
    [] RoundBox3<f64>:   "shape",    "a box with round edges",     "two boxes with round edges",    SPACE;
    [] Segment3<f64>:    "segment",  "a segment of space",         "two segments of space",         SPACE;
    [] Triangle3<f64>:   "triangle", "a triangle of space",        "two triangles of space",        SPACE;
    [] Tetrahedron<f64>: "solid",    "a tetrahedron",              "two tetrahedra",                SPACE;
    [const N: usize] Hull3<f64, N>:
                         "hull",     "a convex hull",              "two convex hulls",              SPACE;
    [] Sphere<f64>:      "ball",     "a ball",                     "two balls",                     SPACE;
    [] Capsule3<f64>:    "capsule",  "a capsule of space",         "two capsules of space",         SPACE;
    [] Cylinder<f64>:    "cylinder", "a cylinder",                 "two cylinders",                 SPACE;
    [] Cone<f64>:        "cone",     "a cone",                     "two cones",                     SPACE;
    [] Ellipsoid<f64>:   "ellipsoid", "an ellipsoid",              "two ellipsoids",                SPACE;
    [] Disc<f64>:        "disc",     "a disc",                     "two discs",                     SPACE;
    [] Plane3<f64>:      "plane",    "a half-space",               "two half-spaces",               SPACE;
    [] Line3<f64>:       "line",     "a line of space",            "two lines of space",            SPACE;
    [] Ray3<f64>:        "ray",      "a ray of space",             "two rays of space",             SPACE;
    [] Rotation3<f64>:   "rotation", "a rotation",                 "two rotations",                SPACE;
    [] Pinhole<f64>:     "camera",   "a pinhole camera",           "two pinhole cameras",          NONE;
    [] BrownConrady<f64>: "camera",  "a camera with distortion",   "two cameras with distortion",  NONE;
    [] Fisheye<f64>:     "camera",   "a fisheye camera",           "two fisheye cameras",          NONE;
    [] Exponent<f64>:    "power",    "a power",                    "two powers",                    WITH_ALL;
    // A shift would move directions like points.
    [] Line2<f64>:       "line",     "a line",                     "two lines",                     PLANE_DIRECTED;
    [] Ray2<f64>:        "ray",      "a ray",                      "two rays",                      PLANE_DIRECTED;
    [] Pose2<f64>:       "pose",     "a pose",                     "two poses",                     PLANE;
    [] Motion3<f64>:     "motion",   "a motion",                   "two motions",                   NONE;
    [] Pose3<f64>:       "pose",     "a pose of space",            "two poses of space",            SPACE;
    // Its ends are lengths.
    [] Interval<f64>:    "interval", "an interval",                "two intervals",                 NONE;
    [] f64:              "x",        "a number",                   "two numbers",                   NONE;
    // Encodings.
    [] ImageBox<f64>:      "shape",  "an image's box",             "two boxes of an image",         NONE;
    [] Detectron2Box<f64>: "shape",  "detectron2's box",           "two boxes of detectron2",       NONE;
    [] Le90<f64>:          "shape",  "mmrotate's box (le90)",      "two boxes of mmrotate",         NONE;
    [] Le135<f64>:         "shape",  "mmrotate's box (le135)",     "two boxes of mmrotate",         NONE;
    [] OpenCvBox<f64>:     "shape",  "OpenCV's box",               "two boxes of OpenCV",           NONE;
    [] Xyxyr<f64>:         "shape",  "bounds before turning, with the angle", "two bounds with angles", NONE;
    [] KittiBox<f64>:      "shape",  "KITTI's box",                "two boxes of KITTI",            OF_CAMERA;
    [] LidarBox<f64>:      "shape",  "OpenPCDet's box",            "two boxes of OpenPCDet",        UPRIGHT;
    [] NuScenesBox<f64>:   "shape",  "nuScenes' box",              "two boxes of nuScenes",         SPACE;
}

/// Returns `true` for two equal texts.
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

/// Returns the names of two arguments: those of their kinds, or `a` and `b` for two of one kind.
pub(crate) const fn named(a: &'static str, b: &'static str) -> [&'static str; 2] {
    match same(a, b) {
        true => ["a", "b"],
        false => [a, b],
    }
}

/// Returns the parts of a documentation: the title, with the arguments in place of `{}` (without parameters after the
/// first two), and the row's own sentence.
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

/// Returns the length of all parts.
pub(crate) const fn length(parts: &[&str]) -> usize {
    let (mut sum, mut i) = (0, 0);
    while i < parts.len() {
        sum += parts[i].len();
        i += 1;
    }
    sum
}

/// Returns the bytes of all parts, one after another.
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

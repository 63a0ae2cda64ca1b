"""What shapes are: a sentence or two for each, and of numbers whose name does not say it."""

import textwrap

_POLYGON = (
    "A convex polygon of up to {n} vertices, in counter-clockwise order. The last number is how many vertices count; those "
    "after them are not read."
)
_IMAGE = (
    "in an image, where y points down. The angle turns from x towards y, clockwise to the viewer; the width lies along it."
)

SHAPES = {
    "Obb2": "A rotated box in the plane. The heading turns from x towards y: counter-clockwise where y points up, clockwise in "
    "an image, where y points down. The width lies along the heading, the height across it. detectron2's and torchvision's "
    "(cxcywhr) angle is -heading in degrees.",
    "Aabb2": "An axis-aligned box in the plane, by two corners: torchvision's xyxy.",
    "Vec2x4": "A quadrilateral: its corners one after another, either way round.",
    "Exponent": "The power of alpha_iou, above 0.",
    "Interval": "An interval of numbers.",
    "Vec2": "A point of the plane, or a vector.",
    "Segment2": "A segment of the plane, from one end to the other.",
    "Circle": "A disc of the plane.",
    "Quadratic2": "A quadratic Bezier curve of the plane, by its control points.",
    "Cubic2": "A cubic Bezier curve of the plane, by its control points.",
    "Arc2": "A circular arc of the plane from one point to another. The bulge is the tangent of a quarter of the angle that it sweeps "
    "counter-clockwise, as in DXF files: 0 is straight, 1 half a circle.",
    "Triangle2": "A triangle of the plane, by its corners in any order.",
    "Capsule2": "All points at most a radius from a segment of the plane.",
    "Contact": "How deep two shapes are in each other, and the direction of the shortest shift of the second one that parts them.",
    "PointPair": "A point of each of two shapes.",
    "ClosestOnSegments": "The nearest points of two segments, and where they are: 0 at the start, 1 at the end.",
    "Line2": "A line of the plane: a point of it, and a direction of any length.",
    "CommonPoint": "The point in which two lines cross, and its parameters on both.",
    "CommonPart": "The part that two segments share.",
    "Ray2": "Half a line of the plane: its start, and a direction of any length.",
    "Hit": "The first point of a ray on the border of a shape, and the normal there, out of the shape.",
    "Chord": "The part of a line in a shape, by parameters of the line.",
    "Pose2": "A turn about the origin, by its cosine and sine, and then a shift.",
    "Obb3": "A box in space of any orientation: centre, sizes along its own axes, and the quaternion (w, x, y, z), of any length, "
    "that turns the axes of space to its own.",
    "ImageBox": f"A rotated box {_IMAGE} As Obb2 it is the box in a frame with y upwards; read with y downwards both have the "
    "same numbers.",
    "Le90": f"mmrotate's le90, a rotated box {_IMAGE} The width is the longer side, the angle in [-pi/2, pi/2).",
    "Le135": f"mmrotate's le135, a rotated box {_IMAGE} The width is the longer side, the angle in [-pi/4, 3 pi/4).",
    "OpenCvBox": f"The box of OpenCV's minAreaRect since 4.5.1, but in radians: a rotated box {_IMAGE} Either side may be the "
    "longer one; the angle is in (0, pi/2].",
    "Detectron2Box": "detectron2's RotatedBoxes: a rotated box in an image, where y points down, with an angle in degrees that "
    "grows counter-clockwise to the viewer.",
    "Xyxyr": "The bounds of a box before it is turned about its centre, and the angle, from x towards y.",
    "KittiBox": "A box of KITTI's labels, in the frame of a camera: x to the right, y down, z ahead. The location is the middle of "
    "the bottom face; rotation_y turns about the y axis and is 0 for travel to the right.",
    "YawBox3": "An upright box in space: centre, sizes along its own axes (length, width, height), and the heading about the z axis, "
    "which points up: counter-clockwise seen from above.",
    "LidarBox": "A box of OpenPCDet: the centre, length, width, height, and the heading about the z axis, which points up: "
    "counter-clockwise seen from above, 0 for travel along x.",
    "NuScenesBox": "A box of nuScenes: the centre, width, length, height, and the rotation as a quaternion (w, x, y, z) of any "
    "length; the direction of travel is its own x axis.",
    "Aabb3": "An axis-aligned box in space, by two corners.",
    "Vec3": "A point of space, or a vector.",
    "Segment3": "A segment of space, from one end to the other.",
    "Triangle3": "A triangle of space.",
    "Tetrahedron": "A tetrahedron.",
    "Hull3_8": "The convex hull of up to 8 vertices of space, in any order. The last number is how many vertices count; those "
    "after them are not read.",
    "Capsule3": "All points at most a radius from a segment of space.",
    "Cylinder": "A cylinder around the segment from the middle of one end to that of the other, which differ.",
    "Cone": "A cone: its apex and the middle of its base, which differ, and the base's radius.",
    "Ellipsoid": "An ellipsoid: the centre, half of the extents along its own axes, and the rotation of these as a quaternion "
    "(w, x, y, z) of any length.",
    "Disc": "A flat disc: the centre, a vector of any length orthogonal to it, and the radius.",
    "Sphere": "A ball.",
    "Line3": "A line of space: a point of it, and a direction of any length.",
    "Ray3": "Half a line of space: its start, and a direction of any length.",
    "RoundBox3": "All points at most a radius from a box of any orientation; see Obb3.",
    "Plane3": "The plane of all points p with normal . p = offset, and the half-space behind it; the normal has any length.",
    "Contact3": "How deep two shapes are in each other, and the direction of the shortest shift of the second one that parts them.",
    "PointPair3": "A point of each of two shapes of space.",
    "Hit3": "The first point of a ray on the border of a shape of space, and the normal there, out of the shape.",
    "Motion3": "A motion of a body from time 0 to time 1: the centre of its turn at time 0, the way of that centre, and the "
    "turn as a rotation vector in radians.",
    "Impact3": "The first touch of two moving bodies: its time, the place on the first body, and the direction in which the second "
    "one is in the way.",
    "Contacts3": "The contact of two shapes: the direction from a to b in which they must part, and up to eight pairs of points.",
    "CommonLine3": "The line that two planes share.",
    "CommonPoint3": "The point that three planes share.",
    "Rotation3": "A rotation of space: a quaternion of any length.",
    "Pinhole": "A camera without distortion: focal lengths and the principal point, in pixels.",
    "BrownConrady": "A camera with the distortion of Brown and Conrady: k1, k2, k3 and p1, p2 of OpenCV, whose vector has k3 last.",
    "Fisheye": "A fisheye camera of Kannala and Brandt, with k1 to k4 of OpenCV's fisheye model.",
    "ConvexPolygon5": _POLYGON.format(n=5),
    "ConvexPolygon6": _POLYGON.format(n=6),
    "AreaMoments": "The second moments of an area: integrals of x * x, y * y and x * y.",
    "Symmetric3": "A symmetric matrix of three rows.",
}

_FLAG = "1 where there is one, else 0"
_MISS = "the largest finite number for a miss"

NUMBERS = {
    ("Detectron2Box", "heading.value"): "angle in degrees",
    ("Exponent", "alpha"): "power",
    ("Hit", "parameter"): f"distance in lengths of the direction; {_MISS}",
    ("Hit", "kind"): "0 for a miss, 1 for a hit from outside, 2 from inside, where the ray leaves",
    ("Hit3", "parameter"): f"distance in lengths of the direction; {_MISS}",
    ("Hit3", "kind"): "0 for a miss, 1 for a hit from outside, 2 from inside, where the ray leaves",
    ("Impact3", "time"): f"time from 0 to 1; {_MISS}",
    ("Impact3", "kind"): "0 for a miss, 1 for an impact, 2 where the bodies touch at time 0",
    ("Contacts3", "count"): "how many pairs of points there are; the others are zero",
    ("CommonPart", "kind"): "0 for nothing, 1 for a point, 2 for a segment",
    ("CommonPoint", "along_a"): "distance from a's point in lengths of its direction; 0 for parallel lines",
    ("CommonPoint", "along_b"): "distance from b's point in lengths of its direction; 0 for parallel lines",
    ("CommonPoint", "found"): "1 where the lines cross, 0 where they are parallel",
    ("CommonLine3", "found"): _FLAG,
    ("CommonPoint3", "found"): _FLAG,
    ("Chord", "enter"): "least parameter in lengths of the direction; 0 for a miss",
    ("Chord", "exit"): "greatest parameter in lengths of the direction; 0 for a miss",
    ("Chord", "found"): "1 where the line meets the shape, else 0",
    ("ClosestOnSegments", "along_a"): "share of the way along a",
    ("ClosestOnSegments", "along_b"): "share of the way along b",
    ("Contact", "depth"): "length, 0 where the shapes are apart",
    ("Contact3", "depth"): "length, 0 where the shapes are apart",
    ("ConvexPolygon5", "codes[0]"): "how many vertices count, a whole number",
    ("ConvexPolygon6", "codes[0]"): "how many vertices count, a whole number",
    ("Hull3_8", "codes[0]"): "how many vertices count, a whole number",
}


def described(name, fields):
    """The documentation of a shape: what it is, and its numbers with their units and limits."""
    lines = [*textwrap.wrap(SHAPES.get(name, f"{name}."), 100), "", "An array whose last axis has its numbers, in this order:", ""]
    for field, unit, limit in fields:
        lines.append(f"    {field}: {NUMBERS.get((name, field), unit)}{', ' + limit if limit else ''}")
    return "\n".join(lines)

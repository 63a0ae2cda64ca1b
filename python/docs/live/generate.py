"""Writes the modules that the page calls: programs of geograd as JavaScript, with gradients, and as WGSL.

    python python/docs/live/generate.py            # writes python/docs/live/generated/
    python python/docs/live/generate.py FOLDER     # writes them elsewhere

The files belong to the tree, so that the page needs no build. A test compares them with what this script writes.
"""

import inspect
import json
import pathlib
import re
import sys
import textwrap

import numpy as np

import geograd

HERE = pathlib.Path(__file__).parent


@geograd.function
def blend(point: geograd.Vec2, softness: float):
    shapes = [
        geograd.Circle(-1.5, 0.5, 0.9),
        geograd.Circle(1.6, 0.9, 0.6),
        geograd.Obb2(0.4, -0.4, 2.8, 0.7, 0.45),
    ]
    parts = [geograd.signed_distance(point, shape) for shape in shapes]
    least = geograd.minimum(geograd.minimum(parts[0], parts[1]), parts[2])
    total = sum(geograd.exp((least - part) / softness) for part in parts)
    return least - softness * geograd.log(total)


def polygon(point, corners):
    """The signed distance of a point and a polygon: less than 0 inside."""
    nearest, sign = None, 1.0
    for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1]):
        distance = geograd.distance(point, geograd.Segment2(ax, ay, bx, by))
        nearest = distance if nearest is None else geograd.minimum(nearest, distance)
        if ay != by:
            # A ray to the right enters or leaves the polygon at this edge.
            is_between = (point.y >= min(ay, by)) & (point.y < max(ay, by))
            is_right = ax + (point.y - ay) * ((bx - ax) / (by - ay)) > point.x
            sign = geograd.where(is_between & is_right, -sign, sign)
    return nearest * sign


@geograd.function
def car(point: geograd.Vec2, heading: float):
    cos, sin = geograd.cos(heading), geograd.sin(heading)
    local = geograd.Vec2(cos * point.x + sin * point.y, cos * point.y - sin * point.x)
    cabin = [(-1.5, 0.2), (-0.9, 1.0), (0.5, 1.0), (1.2, 0.2)]
    parts = [
        geograd.signed_distance(local, geograd.Obb2(0.0, 0.0, 4.2, 0.6, 0.0)) - 0.12,
        polygon(local, cabin) - 0.1,
        geograd.signed_distance(local, geograd.Circle(-1.3, -0.42, 0.42)),
        geograd.signed_distance(local, geograd.Circle(1.35, -0.42, 0.42)),
    ]
    while len(parts) > 1:
        parts.append(geograd.minimum(parts.pop(0), parts.pop(0)))
    return parts[0]


@geograd.function
def star(point: geograd.Vec2, rounding: float):
    corners = [
        (0.0, 1.8), (-0.45, 0.62), (-1.71, 0.56), (-0.73, -0.24), (-1.06, -1.46),
        (0.0, -0.76), (1.06, -1.46), (0.73, -0.24), (1.71, 0.56), (0.45, 0.62),
    ]
    return polygon(point, corners) - rounding


@geograd.function
def crescent(point: geograd.Vec2, bite: float):
    disc = geograd.signed_distance(point, geograd.Circle(-0.2, 0.0, 1.7))
    other = geograd.signed_distance(point, geograd.Circle(2.6 - bite, 0.3, 1.5))
    return geograd.maximum(disc, -other)


# The fields: what they show, and the name, the range and the first value of their number.
FIELDS = [
    (blend, "Blend", "Two circles and a box, blended.", "softness", [0.05, 0.8], 0.25),
    (car, "Car", "A body, a cabin and two wheels; all of them turn.", "heading", [-3.1, 3.1], 0.25),
    (star, "Star", "A polygon of ten edges, edge by edge, with round corners.", "rounding", [0.0, 0.6], 0.12),
    (crescent, "Crescent", "A disc less another one.", "bite", [0.0, 2.4], 1.4),
]

# The rows of two rotated boxes, each in the form that the page calls.
ROWS = [
    (geograd.iou, "value_grad"),
    (geograd.giou, "value_grad"),
    (geograd.signed_distance, "value_grad"),
    (geograd.closest_points, "value"),
]


def source(function):
    """The Python of a field, with that of `polygon` if it calls it."""
    own = inspect.getsource(function.__wrapped__)
    parts = [inspect.getsource(polygon), own] if "polygon(" in own else [own]
    return "\n\n".join(textwrap.dedent(part).strip() for part in parts)


def modules():
    """The text of every file by its name."""
    files = {}
    for verb, form in ROWS:
        files[f"{verb.__name__}.js"] = verb.javascript(kind=("Obb2", "Obb2"), form=form)
    described = []
    for function, title, about, number, limits, first in FIELDS:
        name = function.__name__
        files[f"{name}.js"] = function.javascript(form="value_grad")
        described.append({
            "name": name,
            "title": title,
            "about": about,
            "number": number,
            "limits": limits,
            "first": first,
            "operations": function.program.cost,
            "python": source(function),
            "wgsl": function.program_of("value_grad", np.float32).wgsl("field"),
        })
    lines = ["// Written by generate.py."]
    for name in [field["name"] for field in described]:
        lines.append(f'import {{ {name} }} from "./{name}.js";')
    lines.append("\n/** What fields call in WGSL. */")
    lines.append(f"export const WGSL = {literal(geograd.WGSL)};")
    lines.append("\n/** Every field: what it is, and its value with the gradient in JavaScript and WGSL. */")
    lines.append("export const FIELDS = [")
    for field in described:
        lines.append("    {")
        lines += [f"        {key}: {literal(value)}," for key, value in field.items()]
        lines.append(f"        of: {field['name']},\n    }},")
    lines.append("];\n")
    files = shared(files)
    files["fields.js"] = "\n".join(lines)
    return files


def shared(files):
    """Modules that import the functions that programs call, and one module with all of these."""
    known, modules = {}, {}
    for file, text in files.items():
        head, *blocks, own = text.split("\n\n")
        # The names that blocks declare, and those that each of them and the module's own function call.
        for block in blocks:
            for name in re.findall(r"^(?:function|const) (program_\w+)", block, re.M):
                assert known.setdefault(name, block) == block, name
        called = sorted(set(re.findall(r"program_\w+", own)))
        imported = [f'import {{ {", ".join(called)} }} from "./program.js";'] if called else []
        modules[file] = "\n\n".join([head, *imported, own])
    blocks = [re.sub(r"^(function|const) program_", r"export \1 program_", block, flags=re.M) for block in dict.fromkeys(known.values())]
    modules["program.js"] = "\n\n".join(["// Written by geograd: what programs in 64-bit floats call.", *blocks]) + "\n"
    return modules


def literal(value):
    """A value in JavaScript; text of several lines as it is."""
    if isinstance(value, str) and "\n" in value:
        escaped = value.replace("\\", "\\\\").replace("`", "\\`").replace("${", "\\${")
        return f"`{escaped}`"
    return json.dumps(value, ensure_ascii=False)


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    files = modules()
    for old in folder.glob("*.js"):
        if old.name not in files:
            old.unlink()
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "generated")

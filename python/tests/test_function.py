"""Functions of one's own: recorded, differentiated, and what is refused while they are."""

import dataclasses
import inspect
import math
from typing import Annotated

import numpy as np
import pytest

import geograd

RNG = np.random.default_rng(11)


@geograd.function
def loss(a: geograd.Obb2, b: geograd.Obb2):
    return 1 - geograd.iou(a, b) + 0.1 * abs(a.heading - b.heading)


@geograd.function
def arm(q: 2, target: geograd.Vec2):
    x = np.cos(q[0]) + 0.7 * np.cos(q[0] + q[1])
    y = np.sin(q[0]) + 0.7 * np.sin(q[0] + q[1])
    return x - target.x, y - target.y


def test_values_and_gradients(boxes):
    a, b = boxes
    expected = 1 - geograd.iou(a, b, kind="Obb2") + 0.1 * np.abs(a[:, 4] - b[:, 4])
    value, (by_a, by_b) = loss.value_grad(a, b)
    np.testing.assert_allclose(value, expected, rtol=1e-14)
    np.testing.assert_array_equal(loss(geograd.Obb2(a), b), value)
    derivatives = geograd.iou.value_grad(a, b, kind="Obb2")[1]
    sign = np.zeros_like(a)
    sign[:, 4] = 0.1 * np.sign(a[:, 4] - b[:, 4])
    np.testing.assert_allclose(by_a, sign - derivatives[0], atol=1e-12)
    np.testing.assert_allclose(by_b, -sign - derivatives[1], atol=1e-12)
    assert loss(a.astype(np.float32), b.astype(np.float32)).dtype == np.float32
    np.testing.assert_allclose(loss.vjp(a, b, np.full(40, 3.0))[0], 3 * by_a, rtol=1e-12)
    with pytest.raises(ValueError, match=r"`a` item 3: width is negative"):
        loss(np.where(np.arange(40)[:, None] == 3, -a, a), b)
    with pytest.raises(TypeError, match="`b` is Obb2, not ImageBox"):
        loss(a, geograd.ImageBox(b))


def test_pairs(boxes):
    a, b = boxes
    matrix = loss.all_pairs(a, b)
    np.testing.assert_allclose(np.diag(matrix), loss(a, b), rtol=1e-13)
    np.testing.assert_array_equal(loss.row_max(a, b)[1], matrix.argmax(1))
    np.testing.assert_array_equal(loss.column_max(a, b)[0], matrix.max(0))
    np.testing.assert_allclose(loss.sum(a, b), matrix.sum())
    np.testing.assert_allclose(loss.mean(a, b), matrix.mean())
    assert loss.count_above(a, b, 0.9) == (matrix > 0.9).sum() == len(loss.above(a, b, 0.9)[0])
    total, (by_a, by_b) = loss.sum_grad(a, b)
    ones = loss.all_pairs_vjp(a, b, np.ones((40, 40)))
    np.testing.assert_allclose(by_a, ones[0], rtol=1e-9)
    np.testing.assert_allclose(loss.mean_grad(a, b)[1][1] * 1600, by_b, rtol=1e-9, atol=1e-12)


def test_derivatives():
    q, target = RNG.normal(size=(30, 2)), RNG.normal(size=(30, 2))
    x, y = arm(q, target)
    np.testing.assert_allclose(x, np.cos(q[:, 0]) + 0.7 * np.cos(q.sum(1)) - target[:, 0], atol=1e-14)
    jacobian = arm.jacobian(q, target)
    assert jacobian.shape == (30, 2, 4)
    np.testing.assert_allclose(jacobian[:, 0, 0], -np.sin(q[:, 0]) - 0.7 * np.sin(q.sum(1)), atol=1e-14)
    np.testing.assert_allclose(jacobian[:, :, 2:], np.broadcast_to(-np.eye(2), (30, 2, 2)))
    dq, dt = RNG.normal(size=(2, 30, 2))
    _, along = arm.jvp(q, target, dq, dt)
    expected = np.einsum("nij,nj->ni", jacobian, np.concatenate([dq, dt], 1))
    np.testing.assert_allclose(np.stack(along, 1), expected, atol=1e-13)
    bars = arm.vjp(q, target, np.ones(30), np.full(30, 2.0))
    np.testing.assert_allclose(np.concatenate(bars, 1), np.einsum("nij,i->nj", jacobian, [1.0, 2.0]), atol=1e-13)

    @geograd.function
    def square(q: 2, target: geograd.Vec2):
        x, y = arm(q, target)
        return 0.5 * (x * x + y**2)

    value, (by_q, _) = square.value_grad(q, target)
    np.testing.assert_allclose(by_q, np.einsum("nij,ni->nj", jacobian[:, :, :2], np.stack([x, y], 1)), atol=1e-13)
    hessian = square.hessian(q, target)
    product = square.hvp(q, target, dq, dt)
    np.testing.assert_allclose(
        np.concatenate(product, 1), np.einsum("nij,nj->ni", hessian, np.concatenate([dq, dt], 1)), atol=1e-12
    )
    with pytest.raises(TypeError, match="2 numbers"):
        arm.value_grad(q, target)


def test_numpys_functions():
    @geograd.function
    def many(x: float, y: float):
        c = np.where(x < y, np.sqrt(x), np.minimum(x, y))
        d = np.clip(x * y, 0.5, 2.0) + np.hypot(x, y) + np.arctan2(y, x) + np.exp(-x) + np.log(y) + np.tan(x)
        e = geograd.where((x > 1) & ~(y >= 2) | (y < 0.1), abs(x - y), np.square(y)) + np.maximum(x, 0.3)
        g = np.float64(2) * x + np.array(0.5) * y + x**3 - x**-1 + y**0.5 + np.add(x, 1) + np.power(x, 2) - (-y) / 3 + 1 / y
        h = np.array([1.0, 2.0]) * x
        return c + d + e + g + h[1] + sum([x, y])

    x, y = RNG.uniform(0.1, 3, (2, 200))
    c = np.where(x < y, np.sqrt(x), np.minimum(x, y))
    d = np.clip(x * y, 0.5, 2.0) + np.hypot(x, y) + np.arctan2(y, x) + np.exp(-x) + np.log(y) + np.tan(x)
    e = np.where((x > 1) & ~(y >= 2) | (y < 0.1), abs(x - y), np.square(y)) + np.maximum(x, 0.3)
    g = 2 * x + 0.5 * y + x**3 - 1 / x + y**0.5 + x + 1 + x**2 + y / 3 + 1 / y
    np.testing.assert_allclose(many(x, y), c + d + e + g + 2 * x + x + y, rtol=1e-11)


def test_nan_passes_minimum_maximum_and_clip():
    bounds = [
        lambda y: np.minimum(y, 1.0),
        lambda y: np.minimum(1.0, y),
        lambda y: np.maximum(y, -1.0),
        lambda y: np.maximum(-1.0, y),
        lambda y: np.clip(y, -1.0, 1.0),
        lambda y: np.clip(y, None, 1.0),
    ]
    x = np.array([-1.0, 0.5, 2.0, 9.0])
    for bound in bounds:

        @geograd.function
        def bounded(x: float):
            return bound(np.log(x))

        with np.errstate(invalid="ignore"):
            np.testing.assert_allclose(bounded(x), bound(np.log(x)), rtol=1e-12)


@dataclasses.dataclass
class Arm:
    base: geograd.Vec2
    lengths: Annotated[list[float], 2]
    turn: float


def test_arguments_of_parts():
    @geograd.function
    def reach(arm: Arm, target: tuple[geograd.Vec2, float]):
        at, radius = target
        return (arm.base - at).length() - radius + arm.lengths[0] * arm.lengths[1] + arm.turn

    numbers, at, radius = RNG.normal(size=(20, 5)), RNG.normal(size=(20, 2)), RNG.normal(size=20)
    expected = np.hypot(*(numbers[:, :2] - at).T) - radius + numbers[:, 2] * numbers[:, 3] + numbers[:, 4]
    whole = np.column_stack([at, radius])
    np.testing.assert_allclose(reach(numbers, whole), expected, rtol=1e-13)
    parts = Arm(geograd.Vec2(numbers[:, :2]), [numbers[:, 2], numbers[:, 3]], numbers[:, 4])
    np.testing.assert_allclose(reach(parts, (at, radius)), expected, rtol=1e-13)
    value, (by_arm, by_target) = reach.value_grad(numbers, (at, radius))
    assert by_arm.shape == (20, 5) and by_target.shape == (20, 3)
    np.testing.assert_allclose(by_arm[:, 2], numbers[:, 3])
    np.testing.assert_allclose(by_target[:, 2], -1)
    with pytest.raises(ValueError, match="`arm`.*5"):
        reach(numbers[:, :3], whole)
    with pytest.raises(ValueError, match=r"arm\.base.*item 1"):
        wrong = numbers.copy()
        wrong[1, 0] = np.nan
        reach(wrong, whole)


def test_shapes_as_results():
    @geograd.function
    def moved(pose: geograd.Pose2, segment: geograd.Segment2):
        return geograd.move(pose, segment)

    pose = np.array([[0.0, 1.0, 2.0, 3.0]])
    segment = np.array([[1.0, 0.0, 2.0, 0.0]])
    got = moved(pose, segment)
    assert isinstance(got, geograd.Segment2)
    np.testing.assert_allclose(got.array, geograd.move(geograd.Pose2(pose), geograd.Segment2(segment)).array)
    np.testing.assert_allclose(got.array, [[2, 4, 2, 5]])


def test_paths_of_symbols():
    @geograd.function
    def area(a: geograd.Vec2, b: geograd.Vec2, c: geograd.Vec2):
        return geograd.signed_area([a, b, c], kind="ring")

    x = RNG.normal(size=(3, 10, 2))
    u, v = x[1] - x[0], x[2] - x[0]
    expected = 0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
    np.testing.assert_allclose(area(*x), expected, atol=1e-14)


KEPT = []


@pytest.mark.parametrize(
    ("body", "says"),
    [
        (lambda x, y: x if x < y else y, "geograd.where"),
        (lambda x, y: min(x, y), "numpy.minimum"),
        (lambda x, y: 1.0 if 0 < x < 1 else 2.0, "(a < x) & (x < b)"),
        (lambda x, y: x < 1 and y, "&"),
        (lambda x, y: math.sqrt(x), "geograd.sqrt"),
        (lambda x, y: float(x), "geograd.sqrt"),
        (lambda x, y: int(x), "float()"),
        (lambda x, y: round(x), "round"),
        (lambda x, y: x == y, "numpy.equal"),
        (lambda x, y: x in [y], "=="),
        (lambda x, y: x**np.inf, "a power is a number"),
        (lambda x, y: x**"2", "unsupported operand"),
        (lambda x, y: round(x), "numpy.rint"),
        (lambda x, y: int(x), "numpy.trunc"),
        (lambda x, y: np.nextafter(x, y), "numpy.nextafter cannot be recorded"),
        (lambda x, y: np.linalg.norm(x), "cannot be recorded"),
        (lambda x, y: "text", "text"),
        (lambda x, y: None, "None"),
        (lambda x, y: np.inf * x, "inf cannot be recorded"),
        (lambda x, y: [a for a in x], "not a list"),
        (lambda x, y: geograd.iou(x, y), "Obb2"),
        (lambda x, y: geograd.iou.all_pairs(geograd.Obb2(x, y, 1, 1, 0), geograd.Obb2(x, y, 1, 1, 0)), "symbols"),
        (lambda x, y: geograd.intersection_area(geograd.Vec2(x, y), geograd.Vec2(x, y)), "no row"),
        (lambda x, y: KEPT[0] + x, "another one"),
    ],
)
def test_what_cannot_be_recorded(body, says):
    if not KEPT:
        geograd.function(lambda x: (KEPT.append(x), x)[1])(1.0)
    with pytest.raises(TypeError) as error:
        geograd.function(body)(np.ones(3), np.ones(3))
    assert any(part in str(error.value) for part in says.split("|")), str(error.value)
    # The line that is wrong is the last of this file that the traceback names, unless it is the result.
    names = [entry.name for entry in error.traceback]
    assert "<lambda>" in names or says in ("text", "None")


def test_a_symbol_has_no_other_attributes():
    with pytest.raises(AttributeError, match="a symbol is one number, without spherical"):
        geograd.function(lambda x: x.spherical)(1.0)


def test_a_recording_ends_with_its_error():
    with pytest.raises(TypeError):
        geograd.function(lambda x: math.sqrt(x))(1.0)
    assert geograd.function(lambda x: x + 1)(2.0) == 3.0
    with pytest.raises(TypeError, match="annotate"):
        geograd.function(annotated_wrongly)


def annotated_wrongly(x: str):
    return x


def test_searches_cannot_be_recorded():
    from geograd import _core

    rows = [(verb, row) for verb in _core.verbs() for row in _core.rows(verb)]
    verb, row = next((verb, row) for verb, row in rows if row["sort"] == "search")
    kinds = [getattr(geograd, kind) for kind in row["kinds"]]

    def both(*arguments):
        return getattr(geograd, verb)(*arguments)

    parameters = [inspect.Parameter(f"x{i}", 1, annotation=kind) for i, kind in enumerate(kinds)]
    both.__signature__ = inspect.Signature(parameters)
    with pytest.raises(TypeError, match="search|whole numbers"):
        geograd.function(both)(*[np.ones(len(kind._fields)) for kind in kinds])


def test_programs():
    text = str(loss.program)
    assert "a.width" in text and "result 0" in text
    assert loss.program.cost > 100 and loss.program.dtype == "float64"
    assert "fn loss(" in loss.wgsl()
    nodes, results = loss.program.nodes()
    assert len(results) == 1 and {"input", "add", "mul"} <= {name for name, _, _ in nodes}
    numbers = [0.0, 0, 2, 2, 0, 1, 0, 2, 2, 0]
    assert loss.program.eval(numbers) == [pytest.approx(1 - 1 / 3)]
    assert loss.program_of("value_grad").cost > loss.program.cost

"""Arguments of functions: defaults, names, annotations, methods; forms and paths in a recording; messages."""

import functools
import inspect
from typing import NamedTuple

import numpy as np
import pytest

import geograd

X = np.array([1.0, 2.0, 5.0])


def scaled(x: float, k: float = 2.0, *, shift: float = 1.0):
    return k * x + shift


def test_defaults_and_names():
    f = geograd.function(scaled)
    np.testing.assert_array_equal(f(X), 2 * X + 1)
    np.testing.assert_array_equal(f(X, 3.0), 3 * X + 1)
    np.testing.assert_array_equal(f(X, shift=4.0), 2 * X + 4)
    np.testing.assert_array_equal(f(shift=X, x=1.0, k=0.5), 0.5 + X)
    value, (by_x, by_k, by_shift) = f.value_grad(X, shift=0.0)
    np.testing.assert_array_equal(value, 2 * X)
    np.testing.assert_array_equal(by_k, X)
    np.testing.assert_array_equal(np.broadcast_to(by_shift, 3), np.ones(3))
    assert f.jacobian(X, k=1.0).shape == (3, 3) and f.hessian(X).shape == (3, 3, 3)
    np.testing.assert_array_equal(f.vjp(X, np.full(3, 2.0), np.zeros(3), np.ones(3))[0], 2)
    for wrong, says in (
        (lambda: f(), "x is missing"),
        (lambda: f(X, y=1.0), "not y"),
        (lambda: f(X, x=1.0), "given twice"),
    ):
        with pytest.raises(TypeError, match=says):
            wrong()


def test_arguments_that_are_no_numbers_stay_as_they_are():
    def chosen(x: float, squares=True, name: str = "cost", scale=None, k: float = 3.0):
        assert name == "cost" and scale is None
        return k * x * x if squares else k * x

    f = geograd.function(chosen)
    np.testing.assert_array_equal(f(X), 3 * X * X)
    np.testing.assert_array_equal(f.value_grad(X, 2.0)[1][1], X * X)
    plain = geograd.function(functools.partial(chosen, squares=False))
    np.testing.assert_array_equal(plain(X), 3 * X)
    with pytest.raises(TypeError, match="not squares"):
        f(X, squares=False)


def test_partials_lambdas_and_callables():
    f = geograd.function(functools.partial(scaled, k=5.0))
    np.testing.assert_array_equal(f(X), 5 * X + 1)
    assert f.__name__ == "scaled" and "scaled" in repr(f)

    class Cost:
        def __call__(self, x: float, p: geograd.Vec2):
            return x * p.x

    np.testing.assert_array_equal(geograd.function(Cost())(X, [2.0, 0.0]), 2 * X)
    np.testing.assert_array_equal(geograd.function(lambda x, n: x * n)(X, 2), 2 * X)


class Joint(NamedTuple):
    at: geograd.Vec2
    angle: float
    gain: int = 1


def test_named_tuples_and_whole_numbers():
    @geograd.function
    def reach(joint: Joint, n: int):
        assert isinstance(joint, Joint)
        return joint.at.x + np.cos(joint.angle) * joint.gain * n

    whole = np.array([[1.0, 0.0, 0.0, 2.0], [3.0, 0.0, np.pi, 1.0]])
    np.testing.assert_allclose(reach(whole, 3), [7.0, 0.0])
    parts = Joint(geograd.Vec2(whole[:, :2]), whole[:, 2], whole[:, 3])
    value, (by_joint, by_n) = reach.value_grad(parts, 3)
    np.testing.assert_allclose(value, [7.0, 0.0])
    assert by_joint.shape == (2, 4) and by_n.shape == (2,)


class Robot:
    """Its numbers are constants of its methods."""

    def __init__(self, length):
        self.length = length

    @geograd.function
    def reach(self, angle: float, gain: float = 1.0):
        return gain * self.length * np.cos(angle)


class Slotted:
    __slots__ = ("length",)

    def __init__(self, length):
        self.length = length

    @geograd.function
    def reach(self, angle: float):
        return self.length * np.cos(angle)


def test_methods():
    robot, other = Robot(2.0), Robot(3.0)
    assert robot.reach(0.0) == 2.0 and other.reach(0.0, gain=2.0) == 6.0
    np.testing.assert_allclose(robot.reach.value_grad(X)[1][0], -2 * np.sin(X))
    # Recorded once, and anew after an attribute was set.
    assert robot.reach._core is robot.reach._core
    robot.length = 5.0
    assert robot.reach(0.0) == 5.0 and other.reach(0.0) == 3.0
    assert Robot(7.0).reach(0.0) == 7.0
    assert Slotted(4.0).reach(0.0) == 4.0
    assert isinstance(Robot.reach, geograd.Function) and Robot.reach.__name__ == "reach"
    bound = geograd.function(functools.partial(Robot.reach.__wrapped__, other))
    assert bound(0.0) == 3.0


def test_objects_end_with_their_methods():
    import gc
    import weakref

    robot = Robot(2.0)
    robot.reach.value_grad(X)
    there = weakref.ref(robot)
    del robot
    gc.collect()
    assert there() is None and not Robot.reach._methods


def test_forms_of_functions_in_a_recording():
    @geograd.function
    def energy(p: geograd.Vec2, k: float):
        return k * p.x * p.x * p.y

    @geograd.function
    def of_forms(q: 2, k: float):
        value, (by_p, by_k) = energy.value_grad(geograd.Vec2(q[0], q[1]), k)
        hessian = energy.hessian(geograd.Vec2(q[0], q[1]), k)
        along = energy.jvp(geograd.Vec2(q[0], q[1]), k, geograd.Vec2(1.0, 0.0), 0.0)[1]
        pulled = energy.vjp(geograd.Vec2(q[0], q[1]), k, 2.0)[0]
        product = energy.hvp(geograd.Vec2(q[0], q[1]), k, geograd.Vec2(0.0, 1.0), 0.0)[0]
        jacobian = energy.jacobian(geograd.Vec2(q[0], q[1]), k)
        return value, by_p[0], by_p[1], by_k, hessian[0, 0], hessian[0, 1], along, pulled[1], product[0], jacobian[2]

    x, y, k = 2.0, 3.0, 5.0
    found = of_forms([x, y], k)
    expected = (k * x * x * y, 2 * k * x * y, k * x * x, x * x * y, 2 * k * y, 2 * k * x, 2 * k * x * y, 2 * k * x * x, 2 * k * x, x * x * y)
    np.testing.assert_allclose(found, expected)
    with pytest.raises(TypeError, match="out is for arrays"):
        geograd.function(lambda x: energy.value_grad(geograd.Vec2(x, x), x, out=X)[0])(1.0)


def test_gradients_of_verbs_in_a_recording_are_arrays():
    @geograd.function
    def push(p: geograd.Vec2, q: geograd.Vec2):
        value, (by_p, by_q) = geograd.distance.value_grad(p, q)
        return (2.0 * by_p - by_q)[0] * value + geograd.distance.hessian(p, q)[0, 2]

    p, q = np.array([[3.0, 4.0]]), np.zeros((1, 2))
    np.testing.assert_allclose(push(p, q), 3 * 0.6 * 5 - 16 / 125)


def test_a_constant_path_in_a_recording():
    square = [(0, 0), (4, 0), (4, 4), (0, 4)]
    rings = geograd.Rings.of([square])

    @geograd.function
    def near(p: geograd.Vec2):
        return geograd.signed_distance(p, rings)

    points = np.array([[1.0, 2.0], [6.0, 1.0], [7.0, 8.0]])
    value, slope = near.value_grad(points)
    expected, (by_points, *_) = geograd.signed_distance.value_grad(geograd.Vec2(points), rings)
    np.testing.assert_allclose(value, expected)
    np.testing.assert_allclose(slope, by_points)
    assert near.hessian(points).shape == (3, 2, 2)
    with pytest.raises(TypeError, match="takes one path"):
        geograd.function(lambda x: geograd.signed_distance(geograd.Vec2(x, x), geograd.Rings.of([square, square])))(1.0)


def test_all_pairs_of_points_and_paths():
    rings = geograd.Rings.of([[(0, 0), (4, 0), (4, 4)], [(9, 9), (10, 9), (10, 10), (9, 10)]])
    points = np.random.default_rng(1).uniform(0, 10, (7, 2))
    matrix = geograd.distance.all_pairs(geograd.Vec2(points), rings)
    assert matrix.shape == (7, 2)
    for i in range(2):
        np.testing.assert_array_equal(matrix[:, i], geograd.distance(geograd.Vec2(points), rings[i : i + 1]))
    assert geograd.distance.all_pairs(geograd.Vec2(points), rings[:0]).shape == (7, 0)
    out = np.empty((7, 2))
    assert geograd.distance.all_pairs(geograd.Vec2(points), rings, out=out) is out
    np.testing.assert_array_equal(out, matrix)
    with pytest.raises(TypeError, match="it has value_grad and vjp"):
        geograd.distance.jvp(geograd.Vec2(points), rings, points, points)


A, B = np.tile([0.0, 0.0, 2.0, 1.0, 0.1], (3, 1)), np.tile([0.5, 0.0, 2.0, 1.0, 0.1], (2, 1))


@pytest.mark.parametrize(
    ("call", "error", "says"),
    [
        (lambda: geograd.iou(A, A, kind="obb2"), ValueError, r'no shape is called "obb2"; is it Obb2\?'),
        (lambda: geograd.iou(A, A, kind="Ob2"), ValueError, "is it Obb2"),
        (lambda: geograd.iou(A, A, kind="zzzzz"), ValueError, "shapes are number, ring"),
        (lambda: geograd.iou.suppress(A, X, 0.5, most=-1, kind="Obb2"), ValueError, "most: a whole number from 0 on is needed, not -1"),
        (lambda: geograd.iou.suppress(A, X, 0.5, most=1.5, kind="Obb2"), TypeError, "most: a whole number is needed, not 1.5"),
        (lambda: geograd.iou.suppress(A, X, 0.5, classes=[0.5, 1, 2], kind="Obb2"), TypeError, "classes: .*float64"),
        (lambda: geograd.iou.suppress(A, X, 0.5, classes=[-1, 1, 2], kind="Obb2"), ValueError, "classes: .*-1 to 2"),
        (lambda: geograd.iou.suppress(A, X, None, kind="Obb2"), TypeError, "overlap: a number is needed, not None"),
        (lambda: geograd.iou.suppress(A, X, 0.5, score="0.1", kind="Obb2"), TypeError, "score: a number is needed, not '0.1'"),
        (lambda: geograd.iou.above(A, A, None, kind="Obb2"), TypeError, "threshold: a number is needed, not None"),
        (lambda: geograd.iou.value_grad(A, b=A, kind="Obb2"), TypeError, "takes its shapes without names, not b="),
        (lambda: geograd.minimum_circle.jacobian(np.ones(13), kind="ConvexPolygon6"), TypeError, "first derivatives only"),
        (lambda: geograd.function(geograd.function(lambda x: x)), TypeError, "a geograd.function already"),
    ],
)
def test_messages_name_what_is_wrong(call, error, says):
    with pytest.raises(error, match=says):
        call()


def test_numbers_of_suppression_may_be_of_numpy():
    kept = geograd.iou.suppress(A, X, np.float32(0.5), classes=np.array([0, 0, 1], np.uint8), most=np.int64(5), kind="Obb2")
    np.testing.assert_array_equal(kept, [2, 1])
    assert geograd.iou.suppress(A[:0], X[:0], 0.5, classes=[], kind="Obb2").shape == (0,)


def test_the_best_of_none():
    for form, own, other in (("row_max", A, B[:0]), ("column_max", B[:0], A)):
        for dtype in ("f4", "f8"):
            values, places = getattr(geograd.iou, form)(own.astype(dtype), other.astype(dtype), kind="Obb2")
            assert values.shape == places.shape == (3,) and values.dtype == dtype
            assert (values == -np.inf).all() and (places == -1).all()
    values, places = geograd.iou.row_max(np.stack([A, A]), B[:0], kind="Obb2")
    assert values.shape == places.shape == (2, 3)


def test_tensors_that_require_a_gradient_are_refused():
    torch = pytest.importorskip("torch")
    with pytest.raises(TypeError, match="`a`: the tensor requires a gradient.*geograd.torch"):
        geograd.giou(torch.tensor(A, requires_grad=True), A, kind="Obb2")
    np.testing.assert_array_equal(geograd.giou(torch.tensor(A), A, kind="Obb2"), 1)


def test_signatures():
    assert "kind" in str(inspect.signature(geograd.iou))
    assert list(inspect.signature(geograd.iou.above).parameters) == ["a", "b", "threshold", "groups", "kind", "backend"]


def test_shapes_say_what_they_are():
    from geograd import _core, _meaning

    kinds = {name: [field for field, _, _ in fields] for name, fields, _ in _core.shapes() if fields}
    assert set(_meaning.SHAPES) <= set(kinds) and all(field in kinds[name] for name, field in _meaning.NUMBERS)
    texts = {name: getattr(geograd, name).__doc__ for name in kinds}
    assert "from x towards y" in texts["Obb2"] and "-heading in degrees" in " ".join(texts["Obb2"].split())
    assert "heading.value: angle in degrees" in texts["Detectron2Box"] and "counter-clockwise order" in texts["ConvexPolygon5"]
    assert "codes[0]: how many vertices count" in texts["ConvexPolygon5"] and "kind: 0 for a miss, 1 for a hit" in texts["Hit"]
    for verb in ("wasserstein", "kullback_leibler", "kfiou"):
        assert "standard deviations are half the sizes" in " ".join(getattr(geograd, verb).__doc__.split())
    assert "size²/12" in geograd.probiou.__doc__


def test_the_angle_of_torchvision_is_what_the_text_says():
    torch = pytest.importorskip("torch")
    ops = pytest.importorskip("torchvision.ops")
    if "fmt" not in inspect.signature(ops.box_iou).parameters:
        pytest.skip("this torchvision has no rotated boxes")
    a = np.random.default_rng(1).uniform(1, 3, (20, 5))
    b = a + 0.2
    turned = lambda x: torch.tensor(np.column_stack([x[:, :4], -np.degrees(x[:, 4])]))
    np.testing.assert_allclose(ops.box_iou(turned(a), turned(b), fmt="cxcywhr").diagonal(), geograd.iou(a, b, kind="Obb2"), atol=1e-6)

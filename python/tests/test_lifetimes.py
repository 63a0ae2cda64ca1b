"""What is kept, and how long: traced functions, and what PyTorch and JAX have of them."""

import gc
import weakref

import numpy as np
import pytest

import geograd
from geograd import _nodes
from pairs import A, B


class Scene:
    """Something large that a function captures."""

    def __init__(self):
        self.numbers = np.zeros(1000)


def captured(scene):
    def cost(x: float, y: float):
        return x * y + len(scene.numbers)

    return cost


def recorded():
    """A traced function after use, and a weak reference to what it captured."""
    scene = Scene()
    function = geograd.function(captured(scene))
    function.value_grad(np.ones(3), np.ones(3))
    function.hessian(1.0, 2.0)
    return function, weakref.ref(scene)


def test_a_traced_function_ends_with_its_last_use():
    function, scene = recorded()
    assert scene() is not None
    del function
    assert scene() is None, "without a collection of cycles"


def test_a_function_that_holds_itself_is_collected():
    scene = Scene()

    @geograd.function
    def own(x: float):
        assert own is not None
        return x + len(scene.numbers)

    own.value_grad(1.0)
    there = weakref.ref(scene)
    del own, scene
    gc.collect()
    assert there() is None


def test_a_function_that_failed_ends_too():
    scene = Scene()
    function = geograd.function(lambda x: float(x) + len(scene.numbers))
    with pytest.raises(TypeError):
        function(1.0)
    there = weakref.ref(scene)
    del function, scene
    gc.collect()
    assert there() is None


def test_many_functions_leave_nothing():
    resource = pytest.importorskip("resource")

    def make(count):
        for _ in range(count):
            geograd.function(lambda x: x * 2.0 + 1.0).value_grad(1.0)
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    before = make(300)
    # In KiB; kept, they had 11 each.
    assert make(2000) - before < 5000


def test_functions_of_torch_end_with_their_last_use():
    torch = pytest.importorskip("torch")
    import geograd.torch

    def once():
        function, scene = recorded()
        own = geograd.torch.function(function)
        x = torch.tensor([1.0, 2.0], requires_grad=True)
        result = own(x, x).sum()
        del function, own
        gc.collect()
        # The gradient needs the recording.
        assert scene() is not None
        result.backward()
        torch.testing.assert_close(x.grad, torch.tensor([2.0, 4.0]))
        del result
        return scene

    before = len(_nodes._OWN)
    scenes = [once() for _ in range(5)]
    gc.collect()
    assert not any(scene() for scene in scenes) and len(_nodes._OWN) == before


def test_second_derivatives_of_torch_end_too():
    torch = pytest.importorskip("torch")
    import geograd.torch

    function, scene = recorded()
    own = geograd.torch.function(function)
    x = torch.tensor([1.0, 2.0], dtype=torch.float64, requires_grad=True)
    (slope,) = torch.autograd.grad((own(x, x) ** 2).sum(), x, create_graph=True)
    slope.sum().backward()
    del function, own, slope, x
    gc.collect()
    assert scene() is None


def test_functions_of_jax_end_with_what_jax_keeps():
    jax = pytest.importorskip("jax")
    import geograd.jax

    function, scene = recorded()
    own = geograd.jax.function(function)
    jax.grad(lambda x: own(x, x).sum())(np.ones(3, "f4"))
    jax.jit(own)(np.ones(3, "f4"), np.ones(3, "f4"))
    del function, own
    jax.clear_caches()
    gc.collect()
    assert scene() is None


def test_an_eager_call_of_jax_compiles_once():
    jax = pytest.importorskip("jax")
    import geograd.jax

    compiled = []
    jax.monitoring.register_event_duration_secs_listener(
        lambda event, _, **more: compiled.append(event) if "backend_compile" in event else None
    )
    try:
        a, b = A.astype("f4"), B.astype("f4")
        for x in (a, a + 1):
            geograd.jax.giou(x, b, kind="Obb2")
            jax.grad(lambda a: geograd.jax.giou(a, b, kind="Obb2").sum())(x)
        first = len(compiled)
        for k in range(5):
            geograd.jax.giou(a + k, b, kind="Obb2")
            jax.grad(lambda a: geograd.jax.giou(a, b, kind="Obb2").sum())(a + k)
        assert first > 0 and len(compiled) == first
    finally:
        jax.monitoring.clear_event_listeners()

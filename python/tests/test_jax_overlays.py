"""Boolean operations of polygons on JAX's arrays: values and gradients of the library's, under jit in a buffer."""

import numpy as np
import pytest

import geograd

jax = pytest.importorskip("jax")
pytest.importorskip("shapely")
import jax.numpy as jnp
from test_polygons import blobs

import geograd.jax as ours

jax.config.update("jax_enable_x64", True)
NAMES = ("union", "intersection", "difference", "symmetric_difference")


def columns(count=6, seed=3):
    return [geograd.Polygons.of(own) for own in blobs(seed, count)]


def weights(shape):
    return np.random.default_rng(5).normal(size=shape)


def areas(buffer):
    """The areas of a buffer by its edges."""
    start, end, of = buffer.edges()
    cross = start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0]
    return jax.ops.segment_sum(cross / 2, of, num_segments=len(buffer))


@pytest.mark.parametrize("name", NAMES)
def test_results_are_polygons_with_the_gradients_of_the_library(name):
    a, b = columns()
    own, expected = getattr(ours, name), getattr(geograd, name)(a, b)
    x, y = ours.Polygons.of(a), ours.Polygons.of(b)
    made = own(x, y)
    assert isinstance(made, ours.Polygons) and np.array_equal(made.vertices, expected.vertices)
    assert all(np.array_equal(p, q) for p, q in zip(made.offsets, expected.offsets))
    assert np.allclose(ours.area(made), geograd.area(expected))
    factor = weights(expected.vertices.shape)
    loss = lambda x, y: (own(x, y).vertices * factor).sum()
    found = jax.grad(loss, (0, 1))(x, y)
    wanted = getattr(geograd, name).vjp(a, b, factor)
    for p, q in zip(found, wanted):
        assert np.any(q) and np.array_equal(p.vertices, q)


def test_a_verb_of_the_result_has_derivatives_by_both():
    a, b = columns()
    shared = lambda x, y: ours.area(ours.intersection(ours.Polygons(x, a), ours.Polygons(y, b))).sum()
    found = jax.grad(shared, (0, 1))(a.vertices, b.vertices)
    wanted = geograd.intersection_area.vjp(a, b, 1.0)
    assert all(np.allclose(p, q, atol=1e-9) for p, q in zip(found, wanted))
    rows = jax.jacrev(lambda x: ours.intersection(ours.Polygons(x, a), b).vertices[:3])(a.vertices)
    bar = np.zeros_like(geograd.intersection(a, b).vertices)
    bar[2, 1] = 1
    assert np.array_equal(rows[2, 1], geograd.intersection.vjp(a, b, bar)[0]) and np.any(rows)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_buffers_under_jit(name):
    a, b = columns()
    own, expected = getattr(ours, name), getattr(geograd, name)(a, b)
    capacity = len(expected.vertices) + 7
    x, y = ours.Polygons.of(a), ours.Polygons.of(b)
    call = jax.jit(lambda x, y: own(x, y, capacity=capacity))
    made = call(x, y)
    assert isinstance(made, ours.PolygonBuffer) and len(made) == len(a)
    assert made.vertices.shape == (capacity, 2) and not np.any(made.vertices[-7:])
    trimmed = made.trimmed()
    assert np.array_equal(trimmed.vertices, expected.vertices)
    assert all(np.array_equal(p, q) for p, q in zip(trimmed.offsets, expected.offsets))
    assert np.allclose(areas(made), geograd.area(expected), atol=1e-12)
    by_area = jax.jit(jax.grad(lambda x, y: areas(own(x, y, capacity=capacity)).sum(), (0, 1)))(x, y)
    wanted = jax.grad(lambda x, y: ours.area(own(x, y)).sum(), (0, 1))(x, y)
    for p, q in zip(by_area, wanted):
        assert np.any(q.vertices) and np.allclose(p.vertices, q.vertices, atol=1e-9)


def test_buffers_under_vmap_and_in_single_precision():
    a, b = columns(2)
    x = jnp.stack([jnp.asarray(a.vertices), jnp.asarray(a.vertices) * 1.01])
    call = lambda x: areas(ours.union(ours.Polygons(x, a), b, capacity=90))
    found = jax.jit(jax.vmap(call))(x)
    for row, own in zip(found, x):
        assert np.allclose(row, geograd.area(geograd.union(geograd.Polygons(np.asarray(own), a.offsets), b)))
    single = [ours.Polygons(jnp.asarray(own.vertices, jnp.float32), own) for own in (a, b)]
    assert ours.union(*single).vertices.dtype == jnp.float32
    assert ours.union(*single, capacity=90).vertices.dtype == jnp.float32


def test_one_polygon_stands_for_all_and_none_gives_none():
    a, b = columns()
    one = ours.union(a[0], b)
    assert np.array_equal(one.vertices, geograd.union(a[0], b).vertices) and len(one) == len(b)
    assert len(ours.union(a[0], b, capacity=400)) == len(b)
    none = ours.intersection(geograd.Polygons.of([]), geograd.Polygons.of([]), capacity=4)
    assert len(none) == 0 and len(none.trimmed()) == 0 and areas(none).shape == (0,)


def test_refusals():
    a, b = (ours.Polygons.of(own) for own in columns())
    with pytest.raises(TypeError, match="pass capacity="):
        jax.jit(lambda x, y: ours.union(x, y).vertices)(a, b)
    with pytest.raises(ValueError, match="capacity: a number of vertices from 0 on"):
        ours.union(a, b, capacity=-1)
    with pytest.raises(Exception, match="has [0-9]+ vertices, and capacity is 5"):
        jax.block_until_ready(jax.jit(lambda x, y: ours.union(x, y, capacity=5))(a, b))

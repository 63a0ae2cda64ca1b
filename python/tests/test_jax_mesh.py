"""Queries of meshes on JAX's arrays."""

import numpy as np
import pytest

import geograd

jax = pytest.importorskip("jax")
jnp = pytest.importorskip("jax.numpy")
geograd_jax = pytest.importorskip("geograd.jax")


@pytest.fixture(autouse=True)
def doubles():
    with jax.enable_x64(True) if hasattr(jax, "enable_x64") else jax.experimental.enable_x64():
        yield


def ball(count=2):
    """An octahedron whose faces were divided, with vertices off the ball so that no two places are alike."""
    vertices = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
    faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    vertices = [np.array(v, float) for v in vertices]
    for _ in range(count):
        middles, divided = {}, []

        def middle(i, j):
            key = min(i, j), max(i, j)
            if key not in middles:
                middles[key] = len(vertices)
                place = vertices[i] + vertices[j]
                vertices.append(place / np.linalg.norm(place))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            divided += [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        faces = divided
    draw = np.random.default_rng(5)
    return np.array(vertices) * draw.uniform(0.9, 1.1, (len(vertices), 1)), np.array(faces)


VERTICES, FACES = ball()
DRAW = np.random.default_rng(11)
POINTS = DRAW.uniform(-1.6, 1.6, (40, 3))
SOLIDS = {
    "Sphere": np.c_[POINTS[:6] * 2, np.full(6, 0.1)],
    "Capsule3": np.c_[POINTS[:6] * 2, POINTS[:6] * 2.5, np.full(6, 0.1)],
    "Segment3": np.c_[POINTS[:6] * 2, POINTS[:6] * 2.5],
    "Triangle3": np.c_[POINTS[:6] * 2, POINTS[:6] * 2.5, POINTS[:6] * 2 + 0.3],
}


def slopes(f, x, v, tries=3):
    """Compares the derivatives of f by two arrays with differences along directions."""
    by = jax.grad(f, (0, 1))(x, v)
    for _ in range(tries):
        dx, dv = DRAW.normal(0, 1, x.shape), DRAW.normal(0, 1, v.shape)
        h = 1e-6
        difference = (f(x + h * dx, v + h * dv) - f(x - h * dx, v - h * dv)) / (2 * h)
        derivative = (by[0] * dx).sum() + (by[1] * dv).sum()
        assert abs(difference - derivative) < 1e-6 * (1 + abs(derivative)), (difference, derivative)
    return by


WEIGHTS = DRAW.normal(0, 1, 40)


@pytest.mark.parametrize("verb", ["distance", "squared_distance", "signed_distance"])
def test_distances_are_those_of_numpy_with_the_slopes_of_differences(verb):
    own = geograd.Mesh(VERTICES, FACES)
    mesh = geograd_jax.Mesh(VERTICES, FACES)
    assert (np.asarray(getattr(mesh, verb)(POINTS)) == getattr(own, verb)(POINTS)).all()
    f = lambda x, v: (getattr(geograd_jax.Mesh(v, like=mesh), verb)(x) * WEIGHTS).sum()
    slopes(f, jnp.asarray(POINTS), jnp.asarray(VERTICES))


def test_other_queries_have_the_slopes_of_differences():
    own = geograd.Mesh(VERTICES, FACES)
    mesh = geograd_jax.Mesh(own)
    x, v = jnp.asarray(POINTS), jnp.asarray(VERTICES)
    assert (np.asarray(mesh.closest(POINTS)) == own.closest(POINTS)[0]).all()
    slopes(lambda x, v: (geograd_jax.Mesh(v, like=mesh).closest(x)[:, 1] * WEIGHTS).sum(), x, v)
    # An open mesh, whose border moves.
    part = geograd_jax.Mesh(VERTICES, FACES[:60])
    assert (np.asarray(part.winding_number(POINTS)) == geograd.Mesh(VERTICES, FACES[:60]).winding_number(POINTS)).all()
    slopes(lambda x, v: (geograd_jax.Mesh(v, like=part).winding_number(x) * WEIGHTS).sum(), x, v)
    starts = np.full((40, 3), 0.05)
    values, faces = mesh.rays(starts, POINTS)
    expected = own.rays(starts, POINTS)
    assert (np.asarray(values) == expected[0]).all() and (np.asarray(faces) == expected[1]).all() and (faces >= 0).all()
    slopes(lambda x, v: (geograd_jax.Mesh(v, like=mesh).rays(starts, x)[0] * WEIGHTS).sum(), x, v)


def test_a_ray_that_misses_has_no_slope():
    mesh = geograd_jax.Mesh(VERTICES, FACES)
    value, face = mesh.rays(jnp.array([3.0, 0, 0]), jnp.array([1.0, 0, 0]))
    assert value == jnp.inf and face == -1
    f = lambda v: 1 / geograd_jax.Mesh(v, like=mesh).rays(jnp.array([3.0, 0, 0]), jnp.array([1.0, 0, 0]))[0]
    assert (jax.grad(f)(mesh.vertices) == 0).all()


@pytest.mark.parametrize("kind", list(SOLIDS))
def test_distances_of_solids_have_the_slopes_of_differences(kind):
    mesh = geograd_jax.Mesh(VERTICES, FACES)
    expected = geograd.Mesh(VERTICES, FACES).distance_to(getattr(geograd, kind)(SOLIDS[kind]))
    assert (np.asarray(mesh.distance_to(kind, SOLIDS[kind])) == expected).all() and (expected > 0).any()
    apart = jnp.asarray(SOLIDS[kind][expected > 1e-3])
    slopes(lambda x, v: geograd_jax.Mesh(v, like=mesh).distance_to(kind, x).sum(), apart, jnp.asarray(VERTICES))


def test_distances_of_two_meshes_have_the_slopes_of_differences():
    mesh = geograd_jax.Mesh(VERTICES, FACES)
    other = geograd_jax.Mesh(VERTICES * 0.5, FACES)
    poses = np.array(geograd.Pose3([[1, 0.1, 0.2, 0.3, 3.0, 0.2, 0.1], [0.2, 1, 0.1, 0.3, 0.3, -2.7, 0.5]]))
    own = geograd.Mesh(VERTICES, FACES).distance_between(geograd.Mesh(VERTICES * 0.5, FACES), poses)
    assert (np.asarray(mesh.distance_between(other, poses)) == own).all() and (own > 0.5).all()
    f = lambda x, v: mesh.distance_between(geograd_jax.Mesh(v, like=other), x).sum()
    slopes(f, jnp.asarray(poses), jnp.asarray(VERTICES * 0.5))
    f = lambda x, v: geograd_jax.Mesh(v, like=mesh).distance_between(other, x).sum()
    slopes(f, jnp.asarray(poses), jnp.asarray(VERTICES))


def test_energies_have_second_derivatives():
    mesh = geograd_jax.Mesh(VERTICES, FACES)
    own = geograd.Mesh(VERTICES, FACES)
    direction = jnp.asarray(DRAW.normal(0, 1, VERTICES.shape))
    for kind, constants in [("area", None), ("volume", None), ("springs", 0.3), ("bending", 0.1), ("dirichlet", VERTICES[:, 0] ** 2)]:
        f = lambda v: geograd_jax.Mesh(v, like=mesh).energy(kind, constants)
        v = jnp.asarray(VERTICES)
        assert f(v) == own.energy(kind, constants)
        assert (np.asarray(jax.grad(f)(v)) == own.slopes(kind, constants)).all()
        along = lambda v: (jax.grad(f)(v) * direction).sum()
        rows, columns, values = own.hessian(kind, constants)
        product = np.bincount(rows, weights=values * np.asarray(direction).reshape(-1)[columns], minlength=VERTICES.size)
        np.testing.assert_allclose(np.asarray(jax.grad(along)(v)).reshape(-1), product, rtol=1e-9, atol=1e-9)
    assert (np.asarray(mesh.centroid()) == own.centroid()).all() and mesh.area() == own.area() and mesh.volume() == own.volume()
    slopes(lambda _, v: geograd_jax.Mesh(v, like=mesh).centroid()[0], jnp.zeros(1), jnp.asarray(VERTICES))


def test_transforms_of_jax():
    mesh = geograd_jax.Mesh(VERTICES, FACES)
    f = lambda mesh, x: mesh.distance(x).sum()
    bars = jax.jit(jax.grad(f))(mesh, POINTS)
    assert isinstance(bars, geograd_jax.Mesh) and (bars.vertices == jax.grad(f)(mesh, POINTS).vertices).all()
    assert (bars.faces == FACES).all()
    mapped = jax.vmap(mesh.distance)(jnp.asarray(POINTS).reshape(8, 5, 3))
    assert (mapped.reshape(-1) == mesh.distance(POINTS)).all()
    # A mesh that is made under jit.
    made = jax.jit(lambda v, x: geograd_jax.Mesh(v, FACES).distance(x))
    assert (made(VERTICES, POINTS) == mesh.distance(POINTS)).all()
    moved = made(VERTICES * 1.1, POINTS)
    assert (moved == geograd.Mesh(VERTICES * 1.1, FACES).distance(POINTS)).all()


def test_single_precision_and_single_points():
    mesh = geograd_jax.Mesh(VERTICES.astype(np.float32), FACES)
    found = mesh.distance(jnp.asarray(POINTS[0], jnp.float32))
    assert found.dtype == jnp.float32 and found.shape == ()
    assert mesh.distance(jnp.zeros((0, 3), jnp.float32)).shape == (0,)
    assert mesh.distance([[1, 2, 3]]).shape == (1,)


def test_bad_input_is_named():
    mesh = geograd_jax.Mesh(VERTICES, FACES)
    with pytest.raises(ValueError, match="points"):
        mesh.distance(np.zeros((4, 2)))
    with pytest.raises(ValueError, match="kind"):
        mesh.distance_to("Plane3", np.zeros((4, 4)))
    with pytest.raises(TypeError, match="faces"):
        geograd_jax.Mesh(VERTICES)
    with pytest.raises(TypeError, match="other"):
        mesh.distance_between(geograd.Mesh(VERTICES, FACES), np.zeros((1, 7)))
    with pytest.raises(Exception, match="vert|face"):
        geograd_jax.Mesh(VERTICES, [[0, 1, 200]])


def second(f, x, v):
    """Compares second derivatives of f by two arrays with differences of first ones."""
    ways = DRAW.normal(0, 1, x.shape), DRAW.normal(0, 1, v.shape)

    def along(x, v):
        by = jax.grad(f, (0, 1))(x, v)
        return sum((own * way).sum() for own, way in zip(by, ways))

    slopes(along, x, v)
    # Callbacks of compiled functions run outside of the fixture's setting: lowering alone needs none.
    jax.jit(jax.grad(along)).lower(x, v)


@pytest.mark.parametrize("verb", ["distance", "squared_distance", "signed_distance", "closest"])
def test_distances_have_second_derivatives(verb):
    mesh = geograd_jax.Mesh(VERTICES, FACES)
    points = jnp.asarray(POINTS)
    w = jnp.asarray(DRAW.normal(0, 1, (40, 3)) if verb == "closest" else WEIGHTS)
    second(lambda x, v: (getattr(geograd_jax.Mesh(v, like=mesh), verb)(x) ** 2 * w).sum(), points, jnp.asarray(VERTICES))
    f = lambda x: (getattr(mesh, verb)(x) ** 2).sum()
    blocks = jax.vmap(jax.jacrev(jax.grad(f)))(points[:4, None])
    assert np.isfinite(np.asarray(blocks)).all()


def test_hits_have_second_derivatives_and_misses_none():
    mesh = geograd_jax.Mesh(VERTICES, FACES)
    starts = jnp.asarray(POINTS[:20] * 3)
    targets = jnp.asarray(DRAW.uniform(-0.4, 0.4, (20, 3)))
    ways = (targets - starts).at[::5].multiply(-1.0)
    values, faces = mesh.rays(starts, ways)
    assert (faces < 0).any() and (faces >= 0).any()

    def f(x, v):
        found, faces = geograd_jax.Mesh(v, like=mesh).rays(x, ways)
        return jnp.where(faces < 0, 0.0, jnp.where(faces < 0, 1.0, found) ** 2).sum()

    second(f, starts, jnp.asarray(VERTICES))


@pytest.mark.parametrize("kind", [*SOLIDS, "Aabb3"])
def test_distances_of_solids_have_second_derivatives(kind):
    mesh = geograd_jax.Mesh(VERTICES, FACES)
    rows = SOLIDS.get(kind, np.c_[POINTS[:6] * 2 - 0.1, POINTS[:6] * 2 + 0.2])
    apart = jnp.asarray(rows[geograd.Mesh(VERTICES, FACES).distance_to(getattr(geograd, kind)(rows)) > 1e-3])
    assert len(apart) > 2
    second(lambda x, v: (geograd_jax.Mesh(v, like=mesh).distance_to(kind, x) ** 2).sum(), apart, jnp.asarray(VERTICES))


def test_meshes_centroids_and_winding_numbers_have_second_derivatives():
    mesh, v = geograd_jax.Mesh(VERTICES, FACES), jnp.asarray(VERTICES)
    other = geograd_jax.Mesh(VERTICES * 0.5, FACES)
    poses = jnp.asarray([[1, 0.1, 0.2, 0.3, 3.0, 0.2, 0.1], [0.2, 1, 0.1, 0.3, 0.3, -2.7, 0.5]])
    second(lambda x, v: (geograd_jax.Mesh(v, like=mesh).distance_between(other, x) ** 2).sum(), poses, v)
    second(lambda x, v: (mesh.distance_between(geograd_jax.Mesh(v, like=other), x) ** 2).sum(), poses, v * 0.5)
    second(lambda x, v: (geograd_jax.Mesh(v, like=mesh).centroid() ** 3 * x).sum(), jnp.ones(3), v)
    holed = geograd_jax.Mesh(VERTICES, FACES[::3])
    second(lambda x, v: (geograd_jax.Mesh(v, like=holed).winding_number(x) ** 2).sum(), jnp.asarray(POINTS), v)

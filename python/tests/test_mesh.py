"""Meshes: closest points, distances and hits against every face one by one and against trimesh, gradients against differences."""

import pickle

import numpy as np
import pytest

import geograd


def bumpy(cuts=2, seed=1):
    """A closed mesh: an octahedron whose faces are cut in four, with vertices moved at random."""
    vertices = [np.eye(3)[k] * sign for k in range(3) for sign in (1.0, -1.0)]
    faces = [(x, y, z) if (x + y + z) % 2 == 0 else (x, z, y) for x in (0, 1) for y in (2, 3) for z in (4, 5)]
    for _ in range(cuts):
        middles = {}

        def middle(i, j):
            key = min(i, j), max(i, j)
            if key not in middles:
                middles[key] = len(vertices)
                vertices.append((vertices[i] + vertices[j]) / np.linalg.norm(vertices[i] + vertices[j]))
            return middles[key]

        cut = []
        for a, b, c in faces:
            x, y, z = middle(a, b), middle(b, c), middle(c, a)
            cut += [(a, x, z), (b, y, x), (c, z, y), (x, y, z)]
        faces = cut
    random = np.random.default_rng(seed)
    vertices = np.array(vertices)
    return vertices * random.uniform(0.9, 1.1, (len(vertices), 1)), np.array(faces)


VERTICES, FACES = bumpy()
MESH = geograd.Mesh(VERTICES, FACES)
POINTS = np.random.default_rng(2).uniform(-1.5, 1.5, (400, 3))


def nearest(point, vertices=VERTICES, faces=FACES):
    """The distance of a point, by the plane and the edges of every face."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    best = np.full(len(faces), np.inf)
    for p, q in ((a, b), (b, c), (c, a)):
        t = np.clip(((point - p) * (q - p)).sum(1) / ((q - p) ** 2).sum(1), 0, 1)[:, None]
        best = np.minimum(best, np.linalg.norm(p + t * (q - p) - point, axis=1))
    n = np.cross(b - a, c - a)
    inside = np.all([(np.cross(q - p, point - p) * n).sum(1) > 0 for p, q in ((a, b), (b, c), (c, a))], axis=0)
    height = np.abs(((point - a) * n).sum(1)) / np.linalg.norm(n, axis=1)
    return np.where(inside, height, best).min()


def test_distances_are_the_least_of_all_faces():
    expected = np.array([nearest(point) for point in POINTS])
    np.testing.assert_allclose(MESH.distance(POINTS), expected, rtol=1e-12, atol=1e-14)
    np.testing.assert_allclose(MESH.squared_distance(POINTS), expected**2, rtol=1e-12, atol=1e-14)
    closest, faces = MESH.closest(POINTS.reshape(20, 20, 3))
    assert closest.shape == (20, 20, 3) and faces.shape == (20, 20) and faces.dtype == np.int64
    np.testing.assert_allclose(np.linalg.norm(closest.reshape(-1, 3) - POINTS, axis=1), expected, rtol=1e-12, atol=1e-14)
    signed = MESH.signed_distance(POINTS)
    np.testing.assert_allclose(np.abs(signed), expected, rtol=1e-12, atol=1e-14)
    assert (signed[np.linalg.norm(POINTS, axis=1) < 0.8] < 0).all() and (signed[np.linalg.norm(POINTS, axis=1) > 1.15] > 0).all()


def test_rays_meet_what_they_are_aimed_at():
    centres = VERTICES[FACES].mean(1)
    starts = 3 * centres
    parameters, faces = MESH.rays(starts, centres - starts)
    np.testing.assert_allclose(parameters, 1, rtol=1e-12)
    assert faces.tolist() == list(range(len(FACES)))
    parameters, faces = MESH.rays(starts, starts)
    assert (parameters == np.inf).all() and (faces == -1).all()
    # From within, whatever the direction.
    parameters, faces = MESH.rays([0, 0, 0], POINTS)
    assert (faces >= 0).all()
    np.testing.assert_allclose(MESH.distance(parameters[:, None] * POINTS), 0, atol=1e-14)


def test_a_mesh_of_trimesh_gives_what_trimesh_gives():
    trimesh = pytest.importorskip("trimesh")
    pytest.importorskip("rtree")
    other = trimesh.Trimesh(VERTICES, FACES, process=False)
    mesh = geograd.Mesh(other)
    assert len(mesh) == len(FACES) and (mesh.faces == FACES).all()
    _, distance, _ = trimesh.proximity.closest_point(other, POINTS)
    np.testing.assert_allclose(mesh.distance(POINTS), distance, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(-trimesh.proximity.signed_distance(other, POINTS), mesh.signed_distance(POINTS), rtol=1e-9, atol=1e-9)
    directions = np.random.default_rng(4).normal(size=POINTS.shape)
    hits, rays, faces = other.ray.intersects_location(POINTS, directions, multiple_hits=False)
    parameters, found = mesh.rays(POINTS, directions)
    assert sorted(rays) == np.flatnonzero(found >= 0).tolist()
    np.testing.assert_allclose((POINTS + parameters[:, None] * directions)[rays], hits, rtol=1e-7, atol=1e-7)
    _, theirs, met = other.ray.intersects_location(POINTS, directions, multiple_hits=True)
    every, rays, faces = mesh.all_hits(POINTS, directions)
    assert sorted(zip(rays, faces)) == sorted(zip(theirs, met)) and len(rays) > len(hits)
    assert (np.diff(rays) >= 0).all() and (np.diff(every)[np.diff(rays) == 0] >= 0).all()
    # The first of a ray is its first hit.
    first = np.flatnonzero(np.diff(rays, prepend=-1))
    assert (every[first] == parameters[rays[first]]).all()


def test_moved_vertices_take_the_tree_along():
    other = VERTICES * [1.0, 0.5, 2.0] + [3, 0, 0]
    moved = MESH.moved(other)
    assert (moved.vertices == other).all() and (MESH.vertices == VERTICES).all()
    assert (moved.distance(POINTS) == geograd.Mesh(other, FACES).distance(POINTS)).all()
    assert (pickle.loads(pickle.dumps(moved)).distance(POINTS) == moved.distance(POINTS)).all()


def test_any_number_of_threads_gives_the_same_bits():
    points, threads = np.random.default_rng(5).normal(size=(20_000, 3)), geograd.get_num_threads()
    try:
        geograd.set_num_threads(1)
        one = MESH.closest(points)[0]
        geograd.set_num_threads(2)
        assert (MESH.closest(points)[0] == one).all()
    finally:
        geograd.set_num_threads(threads)


def test_faults_name_what_is_wrong():
    with pytest.raises(ValueError, match="corner 1 of face 2 is vertex 9, which"):
        geograd.Mesh(VERTICES[:4], [[0, 1, 2], [0, 1, 2], [0, 9, 1]])
    with pytest.raises(ValueError, match="corner 0 of face 0 is vertex -1, which"):
        geograd.Mesh(VERTICES, [[-1, 1, 2]])
    with pytest.raises(ValueError, match="vertex 1 has a coordinate that is not a finite number"):
        geograd.Mesh([[0, 0, 0], [np.nan, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    with pytest.raises(ValueError, match="the mesh has no faces"):
        geograd.Mesh(VERTICES, np.zeros((0, 3), int))
    with pytest.raises(TypeError, match="faces: whole numbers are needed"):
        geograd.Mesh(VERTICES, [[0.0, 1.0, 2.0]])
    with pytest.raises(TypeError, match="one object with vertices and faces"):
        geograd.Mesh(VERTICES)
    with pytest.raises(ValueError, match="face 0 has no neighbour at its edge"):
        geograd.Mesh(VERTICES, FACES[:3]).signed_distance(POINTS)
    with pytest.raises(ValueError, match="`points` item 1: "):
        MESH.distance([[0, 0, 0], [0, np.inf, 0]])
    with pytest.raises(ValueError, match=r"points: an array of shape \(..., 3\) is needed, not \(2,\)"):
        MESH.distance([0, 1])
    with pytest.raises(ValueError, match="the tree is of 66 vertices"):
        MESH.moved(np.vstack([VERTICES, VERTICES[:1]]))
    assert MESH.distance(np.zeros((0, 3))).shape == (0,)


@pytest.mark.parametrize("kind", ["distance", "squared_distance", "signed_distance", "closest"])
def test_gradients_of_tensors_are_those_of_differences(kind):
    torch = pytest.importorskip("torch")
    pytest.importorskip("geograd.torch")
    vertices, faces = bumpy(1)
    vertices = torch.tensor(vertices, requires_grad=True)
    points = torch.tensor(POINTS[:40].reshape(2, 20, 3), requires_grad=True)

    def query(points, vertices):
        return getattr(geograd.torch.Mesh(vertices, faces), kind)(points)

    assert torch.autograd.gradcheck(query, (points, vertices), eps=1e-7, atol=1e-5)
    assert query(points, vertices).shape == points.shape if kind == "closest" else points.shape[:-1]


def checked_twice(torch, query, leaves):
    """Second derivatives by differences, and first ones of both ways."""
    assert torch.autograd.gradgradcheck(query, leaves, eps=1e-6, atol=1e-4, rtol=1e-4)
    value = query(*leaves)
    upstream = torch.tensor(np.random.default_rng(3).normal(size=value.shape))
    first = torch.autograd.grad(value, leaves, upstream, retain_graph=True)
    again = torch.autograd.grad(value, leaves, upstream, create_graph=True)
    for one, other in zip(first, again):
        np.testing.assert_allclose(other.detach(), one, atol=1e-11)


@pytest.mark.parametrize("kind", ["distance", "squared_distance", "signed_distance", "wound_distance", "closest", "winding_number"])
def test_queries_have_second_derivatives(kind):
    torch = pytest.importorskip("torch")
    pytest.importorskip("geograd.torch")
    vertices, faces = bumpy(0)
    open_faces = faces[1:] if kind in ("winding_number", "wound_distance") else faces
    # Faces, edges and corners are the nearest ones.
    points = POINTS[:200][np.abs(geograd.Mesh(vertices, faces).distance(POINTS[:200])) > 0.1][:30]
    codes = geograd.Mesh(vertices, faces)._core.search(np.ascontiguousarray(points))[:, 1]
    assert min((codes == 0).sum(), ((codes > 0) & (codes < 4)).sum(), (codes > 3).sum()) > 0
    leaves = torch.tensor(points.reshape(2, 15, 3), requires_grad=True), torch.tensor(vertices, requires_grad=True)

    def query(points, vertices):
        mesh = geograd.torch.Mesh(vertices, open_faces)
        return mesh.signed_distance(points, winding=True) if kind == "wound_distance" else getattr(mesh, kind)(points)

    checked_twice(torch, query, leaves)


def test_rays_have_second_derivatives():
    torch = pytest.importorskip("torch")
    pytest.importorskip("geograd.torch")
    vertices, faces = bumpy(0)
    random = np.random.default_rng(7)
    starts = random.normal(size=(12, 3)) * 2
    directions = random.normal(size=(12, 3)) * 0.2 - starts
    directions[0] = starts[0]
    leaves = tuple(torch.tensor(own, requires_grad=True) for own in (starts, directions, vertices))
    values, hits = geograd.torch.Mesh(leaves[2], faces).rays(*leaves[:2])
    assert hits[0] == -1 and (hits >= 0).sum() > 5

    def query(starts, directions, vertices):
        return geograd.torch.Mesh(vertices, faces).rays(starts, directions)[0][hits >= 0]

    checked_twice(torch, query, leaves)


def test_second_derivatives_on_a_mesh_are_finite():
    torch = pytest.importorskip("torch")
    pytest.importorskip("geograd.torch")
    vertices, faces = bumpy(0)
    vertices = torch.tensor(vertices, requires_grad=True)
    on = vertices.detach()[faces[0]]
    points = torch.stack([on.mean(0), on[:2].mean(0), on[0]]).requires_grad_()
    for kind in ["distance", "squared_distance", "signed_distance", "closest"]:
        value = getattr(geograd.torch.Mesh(vertices, faces), kind)(points)
        (first,) = torch.autograd.grad(value.sum(), points, create_graph=True)
        second = torch.autograd.grad((first * points).sum(), (points, vertices))
        assert all(own.isfinite().all() for own in (first, *second)), kind
    single = points.detach().float().requires_grad_()
    value = geograd.torch.Mesh(vertices.detach().float(), faces).distance(single + 1.0)
    (first,) = torch.autograd.grad(value.sum(), single, create_graph=True)
    (second,) = torch.autograd.grad(first.square().sum(), single)
    assert first.dtype == second.dtype == torch.float32 and second.isfinite().all()


def test_gradients_of_rays_are_those_of_differences():
    torch = pytest.importorskip("torch")
    pytest.importorskip("geograd.torch")
    vertices, faces = bumpy(1)
    vertices = torch.tensor(vertices, requires_grad=True)
    random = np.random.default_rng(7)
    starts = torch.tensor(random.normal(size=(30, 3)) * 2, requires_grad=True)
    directions = torch.tensor(random.normal(size=(30, 3)) * 0.2 - starts.detach().numpy(), requires_grad=True)
    hit = geograd.torch.Mesh(vertices, faces).rays(starts, directions)[1] >= 0
    assert 5 < hit.sum()

    def query(starts, directions, vertices):
        return geograd.torch.Mesh(vertices, faces).rays(starts, directions)[0][hit]

    assert torch.autograd.gradcheck(query, (starts, directions, vertices), eps=1e-7, atol=1e-5)

    def last(starts, directions, vertices):
        return geograd.torch.Mesh(vertices, faces).all_hits(starts, directions)[0]

    assert last(starts, directions, vertices).numel() > hit.sum()
    assert torch.autograd.gradcheck(last, (starts, directions, vertices), eps=1e-7, atol=1e-5)
    # Misses have no part in derivatives, in single precision neither.
    away = torch.tensor([[3.0, 0.0, 0.0]], requires_grad=True)
    values, indices = geograd.torch.Mesh(vertices, faces).rays(away, away)
    assert values.dtype == torch.float32 and values.item() == np.inf and indices.item() == -1
    values.sum().backward()
    assert (away.grad == 0).all()


def test_a_mesh_descends_to_points():
    torch = pytest.importorskip("torch")
    pytest.importorskip("geograd.torch")
    vertices = torch.tensor(VERTICES, requires_grad=True)
    mesh = geograd.torch.Mesh(vertices, FACES)
    targets = torch.tensor(POINTS / np.linalg.norm(POINTS, axis=1, keepdims=True))
    optimiser = torch.optim.Adam([vertices], lr=0.01)
    losses = []
    for _ in range(60):
        optimiser.zero_grad()
        mesh = geograd.torch.Mesh(vertices, like=mesh)
        loss = mesh.squared_distance(targets).mean()
        loss.backward()
        optimiser.step()
        losses.append(loss.item())
    assert losses[-1] < 0.05 * losses[0], losses
    with pytest.raises(TypeError, match="faces are needed, or like"):
        geograd.torch.Mesh(vertices)


def angles(points, vertices, faces):
    """The winding numbers: solid angles of all faces, by van Oosterom and Strackee."""
    a, b, c = (vertices[faces[:, k]][None] - points[:, None] for k in range(3))
    x, y, z = (np.linalg.norm(v, axis=-1) for v in (a, b, c))
    dot = lambda p, q: (p * q).sum(-1)
    below = x * y * z + dot(a, b) * z + dot(b, c) * x + dot(c, a) * y
    return 2 * np.arctan2(dot(a, np.cross(b, c)), below).sum(1) / (4 * np.pi)


def test_winding_numbers_are_the_sums_of_solid_angles():
    inside = np.linalg.norm(POINTS, axis=1) < 0.8
    assert (MESH.winding_number(POINTS)[inside] == 1).all() and inside.sum() > 10
    np.testing.assert_allclose(MESH.winding_number(POINTS), angles(POINTS, VERTICES, FACES), atol=1e-12)
    holed = geograd.Mesh(VERTICES, FACES[::3])
    found = holed.winding_number(POINTS.reshape(20, 20, 3))
    np.testing.assert_allclose(found.ravel(), angles(POINTS, VERTICES, FACES[::3]), atol=1e-12)
    np.testing.assert_array_equal(np.sign(MESH.signed_distance(POINTS, winding=True)), np.sign(MESH.signed_distance(POINTS)))
    signed = geograd.Mesh(VERTICES, FACES[1:]).signed_distance(POINTS, winding=True)
    assert (signed[np.linalg.norm(POINTS, axis=1) < 0.5] < 0).all()


def test_measures_are_those_of_sums():
    a, b, c = (VERTICES[FACES[:, k]] for k in range(3))
    np.testing.assert_allclose(MESH.area(), np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
    sixths = (a * np.cross(b, c)).sum(1) / 6
    np.testing.assert_allclose(MESH.volume(), sixths.sum())
    np.testing.assert_allclose(MESH.centroid(), ((a + b + c) * sixths[:, None] / 4).sum(0) / sixths.sum(), atol=1e-14)
    i, j = MESH.edges.T
    lengths = np.linalg.norm(VERTICES[i] - VERTICES[j], axis=1)
    np.testing.assert_allclose(MESH.energy("springs", 0.25), ((lengths - 0.25) ** 2).sum() / 2)
    assert len(MESH.hinges) == len(MESH.edges) == 3 * len(FACES) // 2
    values = VERTICES @ [1.0, -2.0, 0.5]
    rows, columns, entries = MESH.laplacian()
    np.testing.assert_allclose(MESH.energy("dirichlet", values), (values[rows] * entries * values[columns]).sum() / 2)


def test_slopes_and_hessians_are_those_of_differences():
    constants = {"area": None, "volume": None, "dirichlet": VERTICES[:, 0] ** 2, "springs": 0.3, "bending": 0.1}
    way = np.random.default_rng(8).normal(size=VERTICES.shape)
    for kind, own in constants.items():
        up, down = (MESH.moved(VERTICES + step * way) for step in (1e-6, -1e-6))
        slopes = MESH.slopes(kind, own)
        np.testing.assert_allclose((slopes * way).sum(), (up.energy(kind, own) - down.energy(kind, own)) / 2e-6, rtol=1e-6, atol=1e-6)
        rows, columns, values = MESH.hessian(kind, own)
        product = np.bincount(rows, values * way.ravel()[columns], minlength=way.size).reshape(way.shape)
        np.testing.assert_allclose(product, (up.slopes(kind, own) - down.slopes(kind, own)) / 2e-6, rtol=1e-5, atol=1e-4)


def test_faults_of_energies_name_what_is_wrong():
    with pytest.raises(ValueError, match="kind: one of area, volume"):
        MESH.energy("mass")
    with pytest.raises(TypeError, match="constants: springs has a number per"):
        MESH.energy("springs")
    with pytest.raises(TypeError, match="elements: area has none"):
        MESH.energy("area", elements=MESH.edges)
    with pytest.raises(ValueError, match="`edges` item 1: value is not a pair of vertices"):
        MESH.slopes("springs", 1.0, [[0, 1], [0, -1]])
    with pytest.raises(ValueError, match="`values` has 3 items where 66 are needed"):
        MESH.hessian("dirichlet", [1.0, 2.0, 3.0])
    with pytest.raises(ValueError, match="whole numbers of shape"):
        MESH.energy("bending", 0.0, [[0, 1, 2]])


@pytest.mark.parametrize("kind", ["winding_number", "wound_distance"])
def test_gradients_of_windings_are_those_of_differences(kind):
    torch = pytest.importorskip("torch")
    pytest.importorskip("geograd.torch")
    vertices, faces = bumpy(1)
    points = POINTS[:200][np.abs(geograd.Mesh(vertices, faces[::2]).distance(POINTS[:200])) > 0.1][:30]
    vertices = torch.tensor(vertices, requires_grad=True)
    points = torch.tensor(points, requires_grad=True)

    def query(points, vertices):
        mesh = geograd.torch.Mesh(vertices, faces[::2])
        return mesh.winding_number(points) if kind == "winding_number" else mesh.signed_distance(points, winding=True)

    assert torch.autograd.gradcheck(query, (points, vertices), eps=1e-7, atol=1e-5)


def test_energies_have_first_and_second_derivatives():
    torch = pytest.importorskip("torch")
    pytest.importorskip("geograd.torch")
    vertices, faces = bumpy(0)
    vertices = torch.tensor(vertices, requires_grad=True)
    constants = {"area": None, "volume": None, "dirichlet": np.arange(6.0), "springs": 0.3, "bending": torch.tensor(0.1)}
    for kind, own in constants.items():

        def energy(vertices, kind=kind, own=own):
            return geograd.torch.Mesh(vertices, faces).energy(kind, own)

        assert torch.autograd.gradcheck(energy, (vertices,), eps=1e-6, atol=1e-5)
        assert torch.autograd.gradgradcheck(energy, (vertices,), eps=1e-6, atol=1e-4)
    assert torch.autograd.gradcheck(lambda v: geograd.torch.Mesh(v, faces).centroid(), (vertices,), eps=1e-6, atol=1e-6)
    with pytest.raises(TypeError, match="constants: they have no derivatives"):
        geograd.torch.Mesh(vertices, faces).energy("springs", torch.ones(12, dtype=torch.float64, requires_grad=True))
    assert geograd.torch.Mesh(vertices.detach().float(), faces).area().dtype == torch.float32


def turned(random, count):
    quaternions = random.normal(size=(count, 4))
    return quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)


def solids(random, count):
    """Solids of every kind around the mesh, as rows."""
    at, size = random.uniform(-2, 2, (count, 3)), random.uniform(0.05, 0.4, (count, 3))
    corners = at[:, None] + random.uniform(-0.3, 0.3, (count, 8, 3))
    quaternions = turned(random, count)
    box = np.hstack([at, size, quaternions])
    return {
        "Sphere": np.hstack([at, size[:, :1]]),
        "Capsule3": np.hstack([corners[:, :2].reshape(count, 6), size[:, :1]]),
        "Segment3": corners[:, :2].reshape(count, 6),
        "Triangle3": corners[:, :3].reshape(count, 9),
        "Tetrahedron": corners[:, :4].reshape(count, 12),
        "Aabb3": np.hstack([at - size, at + size]),
        "Obb3": box,
        "RoundBox3": np.hstack([box, size[:, :1]]),
        "Hull3_8": np.hstack([corners.reshape(count, 24), np.full((count, 1), 8.0)]),
    }


@pytest.mark.parametrize("kind", sorted(solids(np.random.default_rng(0), 1)))
def test_distances_of_solids_are_the_least_of_all_faces(kind):
    rows = solids(np.random.default_rng(11), 12)[kind]
    own = getattr(geograd, kind)(rows)
    vertices, faces = bumpy(1)
    mesh = geograd.Mesh(vertices, faces)
    triangles = vertices[faces].reshape(-1, 9)
    one_face = [geograd.Mesh(triangle.reshape(3, 3), [[0, 1, 2]]) for triangle in triangles]
    every = np.stack([face.distance_to(own) for face in one_face], 1)
    found = mesh.distance_to(own)
    assert found.shape == (12,) and (found == every.min(1)).all() and (found > 0).any()
    on_mesh, on_solid, nearest = mesh.closest_to(own)
    assert (nearest == every.argmin(1)).all()
    apart = found > 0
    np.testing.assert_allclose(np.linalg.norm(on_mesh - on_solid, axis=1)[apart], found[apart], rtol=1e-9)
    np.testing.assert_allclose(mesh.distance(on_mesh[apart]), 0, atol=1e-14)
    assert (mesh.touches(own) == ~apart).all()
    items, within = mesh.faces_within(own, 0.7)
    expected = np.argwhere(every <= 0.7)
    assert (items == expected[:, 0]).all() and (within == expected[:, 1]).all() and len(items) > 5
    # Solids in an array of two dimensions.
    assert (mesh.distance_to(getattr(geograd, kind)(rows.reshape(3, 4, -1))) == found.reshape(3, 4)).all()


def test_distances_of_meshes_are_the_least_of_all_pairs():
    first, second = bumpy(1), bumpy(0, seed=3)
    own, other = geograd.Mesh(*first), geograd.Mesh(second[0] * 0.5, second[1])
    random = np.random.default_rng(12)
    shifts = random.normal(size=(20, 3))
    shifts *= (np.arange(20) % 5 / 2 / np.linalg.norm(shifts, axis=1))[:, None]
    rows = np.hstack([turned(random, 20), shifts])
    poses = geograd.Pose3(rows)
    found = own.distance_between(other, poses)
    every = []
    for row in rows:
        x, y, z, w = np.asarray(row)[[list(geograd.Pose3._fields).index(f"rotation.{k}") for k in "xyzw"]]
        shift = np.asarray(row)[[list(geograd.Pose3._fields).index(f"translation.{k}") for k in "xyz"]]
        axis = np.array([x, y, z])
        vertices = other.vertices
        placed = vertices + 2 * np.cross(axis, np.cross(axis, vertices) + w * vertices) + shift
        triangles = geograd.Triangle3(placed[other.faces].reshape(-1, 9))
        every.append(own.distance_to(triangles).min())
    np.testing.assert_allclose(found, every, rtol=1e-11, atol=1e-12)
    assert (own.meets(other, poses) == (found == 0)).all() and 3 < (found == 0).sum() < 17
    on_own, on_other, faces = own.closest_between(other, rows)
    apart = found > 0
    np.testing.assert_allclose(np.linalg.norm(on_own - on_other, axis=1)[apart], found[apart], rtol=1e-9)
    of, pairs = own.pairs_within(other, poses, 0.3)
    assert set(of) == set(np.flatnonzero(found <= 0.3)) and pairs.shape == (len(of), 2) and faces.shape == (20, 2)
    for pose in set(of):
        assert (found[pose] == 0 and pairs[of == pose][0].tolist() <= faces[pose].tolist()) or faces[pose].tolist() in pairs[of == pose].tolist()
    assert own.distance_between(other, rows[0]).shape == ()


def test_distances_of_meshes_are_those_of_coal():
    coal = pytest.importorskip("coal")

    def model(mesh):
        made = coal.BVHModelOBBRSS()
        made.beginModel(len(mesh.faces), len(mesh.vertices))
        points, faces = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
        for vertex in mesh.vertices:
            points.append(vertex)
        for face in mesh.faces:
            faces.append(coal.Triangle(*map(int, face)))
        made.addSubModel(points, faces)
        made.endModel()
        return made

    other = geograd.Mesh(VERTICES * 0.5, FACES)
    ours, theirs = model(MESH), model(other)
    random = np.random.default_rng(13)
    for _ in range(20):
        row = np.hstack([turned(random, 1)[0], random.uniform(-2.5, 2.5, 3)])
        pose = dict(zip(geograd.Pose3._fields, row))
        quaternion = coal.Quaternion(*[pose[f"rotation.{k}"] for k in "wxyz"]) if hasattr(coal, "Quaternion") else None
        if quaternion is None:
            pytest.skip("coal without quaternions")
        place = coal.Transform3s(quaternion, np.array([pose[f"translation.{k}"] for k in "xyz"]))
        result = coal.DistanceResult()
        apart = coal.distance(ours, coal.Transform3s(), theirs, place, coal.DistanceRequest(), result)
        np.testing.assert_allclose(MESH.distance_between(other, row), max(apart, 0), rtol=1e-7, atol=1e-7)


@pytest.mark.parametrize("kind", sorted(solids(np.random.default_rng(0), 1)))
def test_gradients_of_solids_are_those_of_differences(kind):
    torch = pytest.importorskip("torch")
    pytest.importorskip("geograd.torch")
    vertices, faces = bumpy(1)
    rows = solids(np.random.default_rng(14), 12)[kind]
    rows = rows[geograd.Mesh(vertices, faces).distance_to(getattr(geograd, kind)(rows)) > 0.05]
    assert len(rows) > 4
    numbers = torch.tensor(rows[:, :24], requires_grad=True)
    count = torch.tensor(rows[:, 24:])
    vertices = torch.tensor(vertices, requires_grad=True)

    def query(numbers, vertices):
        return geograd.torch.Mesh(vertices, faces).distance_to(kind, torch.cat([numbers, count], 1))

    assert torch.autograd.gradcheck(query, (numbers, vertices), eps=1e-7, atol=1e-5)


@pytest.mark.parametrize("kind", sorted(solids(np.random.default_rng(0), 1)))
def test_distances_of_solids_have_second_derivatives(kind):
    torch = pytest.importorskip("torch")
    pytest.importorskip("geograd.torch")
    vertices, faces = bumpy(0)
    rows = solids(np.random.default_rng(16), 12)[kind]
    found = geograd.Mesh(vertices, faces).distance_to(getattr(geograd, kind)(rows))
    # One touches the mesh: it has no derivative.
    rows = np.vstack([rows[found > 0.05][:4], rows[found == 0][:1]])
    leaves = torch.tensor(rows, requires_grad=True), torch.tensor(vertices, requires_grad=True)

    def query(solids, vertices):
        return geograd.torch.Mesh(vertices, faces).distance_to(kind, solids)

    if kind != "Hull3_8":
        checked_twice(torch, query, leaves)
        return
    # The first ones are there, and nobody takes them for constants.
    first = torch.autograd.grad(query(*leaves).sum(), leaves, create_graph=True)
    assert first[1].abs().sum() > 0
    with pytest.raises(RuntimeError, match="Hull3_8: derivatives of this order are not there"):
        (leaves[1].sum() + first[1].square().sum()).backward()


def test_meshes_and_centroids_have_second_derivatives():
    torch = pytest.importorskip("torch")
    pytest.importorskip("geograd.torch")
    random = np.random.default_rng(17)
    shifts = random.normal(size=(4, 3))
    shifts *= 2.3 / np.linalg.norm(shifts, axis=1)[:, None]
    own, other = bumpy(0), bumpy(0, seed=5)
    given = np.hstack([turned(random, 4), shifts]), own[0], other[0] * 0.5
    leaves = tuple(torch.tensor(part, requires_grad=True) for part in given)

    def query(poses, vertices, others):
        mesh = geograd.torch.Mesh(vertices, own[1])
        return mesh.distance_between(geograd.torch.Mesh(others, other[1]), poses)

    assert (query(*leaves) > 0.05).all()
    checked_twice(torch, query, leaves)
    checked_twice(torch, lambda vertices: geograd.torch.Mesh(vertices + 5.0, own[1]).centroid(), leaves[1:2])


def test_gradients_of_poses_and_both_meshes_are_those_of_differences():
    torch = pytest.importorskip("torch")
    pytest.importorskip("geograd.torch")
    random = np.random.default_rng(15)
    shifts = random.normal(size=(6, 3))
    shifts *= 2 / np.linalg.norm(shifts, axis=1)[:, None]
    poses = torch.tensor(np.hstack([turned(random, 6), shifts]), requires_grad=True)
    own, other = bumpy(1), bumpy(0, seed=5)
    vertices = torch.tensor(own[0], requires_grad=True)
    others = torch.tensor(other[0] * 0.5, requires_grad=True)

    def query(poses, vertices, others):
        mesh = geograd.torch.Mesh(vertices, own[1])
        return mesh.distance_between(geograd.torch.Mesh(others, other[1]), poses)

    assert (query(poses, vertices, others) > 0.05).all()
    assert torch.autograd.gradcheck(query, (poses, vertices, others), eps=1e-7, atol=1e-5)
    single = query(poses.float(), vertices.float(), others.float())
    assert single.dtype == torch.float32 and single.shape == (6,)


def test_faults_of_solids_name_what_is_wrong():
    ball = geograd.Sphere([[0.0, 0.0, 3.0, 1.0], [0.0, 0.0, 3.0, -1.0]])
    with pytest.raises(ValueError, match="`solids` item 1: radius is negative"):
        MESH.distance_to(ball)
    with pytest.raises(TypeError, match="solids: one of Sphere, .* is needed, not ndarray"):
        MESH.distance_to(np.zeros((3, 4)))
    with pytest.raises(TypeError, match="solids: one of Sphere, .* is needed, not Circle"):
        MESH.touches(geograd.Circle([0, 0, 1]))
    with pytest.raises(ValueError, match="`most` item 0: value is negative"):
        MESH.faces_within(geograd.Sphere([0, 0, 3, 1]), -1)
    with pytest.raises(TypeError, match="other: a Mesh is needed"):
        MESH.distance_between(VERTICES, np.zeros(7))
    assert MESH.distance_to(geograd.Sphere(np.zeros((0, 4)))).shape == (0,)

# %% [markdown]
# # Two maps of one city
#
# Two surveys of a city are shifted and turned against each other. GeoPandas has the footprints; geograd finds
# pairs of buildings, their shared areas, and the motion between the maps, by the gradient of the shared area.

# %%
import matplotlib.pyplot as plt
import numpy as np

import geograd

try:
    import geopandas
    import shapely
except ImportError as error:
    raise SystemExit(f"{error}: pip install geopandas") from None

# %% [markdown]
# ## A city
#
# Blocks of rectangles, pentagons and corner houses along turned streets. The second survey has errors of its
# own, lacks some buildings, and is shifted by (1.8, -1.1) m and turned by 0.2 degrees.


# %%
def city(count=400, seed=None):
    town = np.random.default_rng(7)
    w, h = town.uniform(8, 17, (2, count)) / 2
    sort, turn = town.choice(3, count, p=[0.6, 0.25, 0.15]), town.normal(0.2, 0.12, count)
    side = int(np.sqrt(count))
    place = 22.0 * np.stack([np.arange(count) % side, np.arange(count) // side], -1) + town.normal(
        0, 1.0, (count, 2)
    )
    zero = np.zeros(count)
    forms = [
        [(-w, -h), (w, -h), (w, h), (-w, h)],
        [(-w, -h), (w, -h), (w, h / 2), (zero, h), (-w, h / 2)],
        [(-w, -h), (w, -h), (w, h)],
    ]
    if seed is not None:
        errors = np.random.default_rng(seed)
        place, turn = (
            place + errors.normal(0, 0.25, place.shape),
            turn + errors.normal(0, 0.01, count),
        )
    made = np.empty(count, object)
    for kind, form in enumerate(forms):
        own = sort == kind
        xy = np.stack([np.stack([x[own], y[own]], -1) for x, y in form], 1)
        sine, cosine = np.sin(turn[own])[:, None], np.cos(turn[own])[:, None]
        xy = np.stack(
            [cosine * xy[..., 0] - sine * xy[..., 1], sine * xy[..., 0] + cosine * xy[..., 1]], -1
        )
        made[own] = shapely.polygons(xy + place[own, None])
    return geopandas.GeoDataFrame({"building": np.arange(count)}, geometry=made, crs="EPSG:32632")


old = city()
new = city(seed=1)
new = new[np.random.default_rng(2).random(len(new)) < 0.94].reset_index(drop=True)
middle = shapely.Point(210, 210)
new.geometry = new.geometry.rotate(0.2, origin=middle).translate(1.8, -1.1)
print(len(old), len(new))

# %% [markdown]
# ## Pairs and shared areas
#
# Bounds find the candidates; convex polygons of up to five vertices have the exact area.


# %%
def polygons(frame):
    """Convex polygons of up to five vertices: their coordinates, and how many count."""
    rows = np.zeros((len(frame), 11))
    for row, geometry in zip(rows, shapely.orient_polygons(frame.geometry.to_numpy())):
        xy = shapely.get_coordinates(geometry)[:-1]
        row[: 2 * len(xy)], row[10] = xy.ravel(), len(xy)
    return rows


a, b = polygons(old), polygons(new)
i, j, _ = geograd.intersection_area.above(
    geograd.Aabb2(old.bounds.to_numpy()), geograd.Aabb2(new.bounds.to_numpy()), 0.0
)
shared = geograd.intersection_area(geograd.ConvexPolygon5(a[i]), geograd.ConvexPolygon5(b[j]))
theirs = shapely.area(shapely.intersection(old.geometry.to_numpy()[i], new.geometry.to_numpy()[j]))
print(f"{len(i)} candidates, {(shared > 0.01).sum()} pairs share {shared.sum():.0f} m²")
print(f"largest difference from shapely: {np.abs(shared - theirs).max():.0e} m²")

# %% [markdown]
# ## The motion between the maps
#
# The gradient of the shared area by the vertices of the new map is a force on each vertex. Their sum is the
# derivative by a shift, and their moment is the derivative by a turn. Ascent finds the motion, which has to
# be the opposite of that of the survey.

# %%
corners = np.arange(5) < b[:, 10:]
center = np.array([middle.x + 1.8, middle.y - 1.1])


def moved(motion):
    """The new map, turned about its centre and shifted: metres, radians."""
    x, y, turn = motion
    xy = b[:, :10].reshape(-1, 5, 2) - center
    sine, cosine = np.sin(turn), np.cos(turn)
    xy = (
        np.stack(
            [cosine * xy[..., 0] - sine * xy[..., 1], sine * xy[..., 0] + cosine * xy[..., 1]], -1
        )
        + center
        + [x, y]
    )
    return np.concatenate(
        [np.where(corners[..., None], xy, 0).reshape(len(b), 10), b[:, 10:]], 1
    ), xy - center


motion, seen = np.zeros(3), []
for step in range(20):
    now, arm = moved(motion)
    area, (_, force) = geograd.intersection_area.value_grad(
        geograd.ConvexPolygon5(a[i]), geograd.ConvexPolygon5(now[j])
    )
    force = np.where(corners[j][..., None], force[:, :10].reshape(-1, 5, 2), 0)
    moment = (arm[j, :, 0] * force[..., 1] - arm[j, :, 1] * force[..., 0]).sum()
    seen.append(area.sum())
    # Steps in metres; a radian moves the border of the map by about 150 of them.
    motion += 0.6 * 0.85**step * np.array([*force.sum((0, 1)), moment / 150**2]) / len(i) / 8
print(f"shift {motion[0]:.2f} m, {motion[1]:.2f} m, turn {np.degrees(motion[2]):.3f} degrees")
print(f"shared area {seen[0]:.0f} m² before, {seen[-1]:.0f} m² after")

# %%
figure, panels = plt.subplots(1, 2, figsize=(10, 4.6))
after, _ = moved(motion)
for axes, layer, text in ((panels[0], b, "As surveyed"), (panels[1], after, "After the ascent")):
    for rows, color in ((a, "#d8612c"), (layer, "#2166ac")):
        for row in rows:
            xy = row[:10].reshape(5, 2)[: int(row[10])]
            if 240 < xy[0, 0] < 360 and 240 < xy[0, 1] < 360:
                axes.fill(*xy.T, facecolor=color, edgecolor=color, alpha=0.35)
    axes.set_title(text)
    axes.set_aspect("equal")
    axes.axis("off")
plt.show()

# %% [markdown]
# Orange is the old map, blue the new one.
#
# ## Buildings that changed
#
# IoU after the motion says which buildings agree, and which are only in one of the maps.

# %%
iou = geograd.iou(geograd.ConvexPolygon5(a[i]), geograd.ConvexPolygon5(after[j]))
first, second, overlap = geograd.assignment.largest((i, j, iou))
gone = len(old) - len(first)
print(
    f"{len(first)} pairs, mean IoU {overlap.mean():.2f}; {gone} buildings are in the old map only"
)

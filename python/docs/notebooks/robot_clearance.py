# %% [markdown]
# # A robot keeps its distance
#
# A vehicle with a rectangular outline drives through a yard. Its path is a list of poses; the gradient of the
# clearance moves all poses away from obstacles at once.

# %%
import matplotlib.pyplot as plt
import numpy as np

import geograd

LENGTH, WIDTH, MARGIN = 1.6, 0.8, 0.35
boxes = np.array(
    [[3.2, 0.9, 1.6, 1.6, 0.5], [6.4, -1.3, 2.4, 1.2, -0.3], [8.8, 1.6, 1.2, 2.2, 0.2]]
)
posts = np.array([[4.9, 2.6, 0.35], [5.0, -2.6, 0.3], [10.4, -0.9, 0.4]])

# %% [markdown]
# ## The clearance of a pose
#
# A pose is a place and a heading. The clearance of a vehicle from an obstacle is the signed distance of two
# shapes: negative where they overlap, so that it has a gradient there, too.


# %%
@geograd.function
def from_box(pose: 3, box: geograd.Obb2):
    x, y, heading = pose
    return geograd.signed_distance(geograd.Obb2(x, y, LENGTH, WIDTH, heading), box)


@geograd.function
def from_post(pose: 3, post: geograd.Circle):
    x, y, heading = pose
    return geograd.signed_distance(geograd.Obb2(x, y, LENGTH, WIDTH, heading), post)


def clearances(poses):
    """The signed distance of each pose from each obstacle, and its gradient by the pose."""
    found = [from_box.value_grad(poses, box) for box in boxes] + [
        from_post.value_grad(poses, post) for post in posts
    ]
    return np.stack([value for value, _ in found]), np.stack([grads[0] for _, grads in found])


# %% [markdown]
# ## The descent
#
# Each step pulls neighbours together, turns the vehicle along its way, and pushes poses out of the margin
# around obstacles.

# %%
COUNT = 60
start = np.stack([np.linspace(0, 12, COUNT), np.zeros(COUNT), np.zeros(COUNT)], -1)
poses = start.copy()
for step in range(1500):
    value, by_pose = clearances(poses)
    push = (np.maximum(MARGIN - value, 0)[..., None] * by_pose).sum(0)
    pull = np.zeros_like(poses)
    pull[1:-1] = poses[2:] + poses[:-2] - 2 * poses[1:-1]
    # The heading follows the chord between the neighbours.
    chord = np.zeros_like(poses)
    ahead = poses[2:, :2] - poses[:-2, :2]
    chord[1:-1, 2] = np.arctan2(ahead[:, 1], ahead[:, 0]) - poses[1:-1, 2]
    change = 0.5 * push + 0.05 * pull + 0.01 * chord
    poses[1:-1] += change[1:-1]

least = [clearances(path)[0].min() for path in (start, poses)]
print(f"least clearance: {least[0]:.2f} on the straight way, {least[1]:.2f} after the descent")

# %%
figure, axes = plt.subplots(figsize=(9, 4.6))
for box in boxes:
    corners = geograd.corners(box, kind="Obb2").array.reshape(4, 2)
    axes.fill(*corners.T, facecolor="#5b6975", edgecolor="#22303c")
for x, y, radius in posts:
    axes.add_patch(plt.Circle((x, y), radius, facecolor="#5b6975", edgecolor="#22303c"))
for path, color in ((start, "#d8612c"), (poses, "#2166ac")):
    for pose in path[::3]:
        corners = geograd.corners(
            [pose[0], pose[1], LENGTH, WIDTH, pose[2]], kind="Obb2"
        ).array.reshape(4, 2)
        axes.fill(*corners.T, fill=False, edgecolor=color, linewidth=1.0, alpha=0.7)
    axes.plot(*path[:, :2].T, color=color)
axes.set(
    xlabel="x (m)", ylabel="y (m)", title="Straight way (orange) and path after the descent (blue)"
)
axes.set_aspect("equal")
plt.show()

# %% [markdown]
# ## Between the poses
#
# A path is safe where the vehicle is, not only where a pose was put. Poses between two neighbours show it.

# %%
at = np.linspace(0, COUNT - 1, 12 * (COUNT - 1) + 1)
dense = np.stack([np.interp(at, np.arange(COUNT), column) for column in poses.T], -1)
value, _ = clearances(dense)
print(f"least clearance of {len(dense)} poses along the path: {value.min():.3f}")

figure, axes = plt.subplots(figsize=(9, 2.8))
axes.plot(dense[:, 0], value.min(0))
axes.axhline(0, color="#22303c", linewidth=1)
axes.axhline(MARGIN, color="#66788a", linewidth=1, linestyle="--")
axes.set(xlabel="x (m)", title="Clearance from the nearest obstacle (m)", xlim=(0, 12))
plt.show()

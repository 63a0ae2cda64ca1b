# %% [markdown]
# # A function of your own, and its gradient checked
#
# A cost of two cars is written once, recorded, differentiated and run on a batch. Then the harness looks for
# a fault in a gradient that was written by hand.

# %%
import numpy as np

import geograd

# %% [markdown]
# ## Record it
#
# Annotations say which shapes the arguments are. Calls of other verbs are part of the recording;
# `geograd.where` and `geograd.maximum` stand where plain code would have an `if`.


# %%
@geograd.function
def cost(car: geograd.Obb2, other: geograd.Obb2, margin: float):
    gap = geograd.distance(car, other)
    shortfall = geograd.maximum(margin - gap, 0.0)
    turned = geograd.sin(car.heading - other.heading)
    return shortfall * shortfall + 0.1 * turned * turned


draw = np.random.default_rng(3)
cars = draw.uniform([-6, -6, 3, 1.5, -3], [6, 6, 5, 2.2, 3], (100_000, 5))
other = np.array([0.0, 0.0, 4.5, 1.9, 0.2])
value, (by_car, by_other, by_margin) = cost.value_grad(cars, other, 2.0)
print(value[:4].round(3))
print(by_car[:4].round(3))

# %% [markdown]
# Second derivatives come from the same recording.

# %%
print(cost.hessian(cars[:4], other, 2.0).shape)
print(*str(cost.program).splitlines()[:8], "…", sep="\n")

# %% [markdown]
# ## Check it
#
# The harness draws random inputs, and those that are hard for the shapes: boxes that touch, parallel sides,
# sizes near zero. It compares derivatives with differences at falling steps, and knows kinks from faults.

# %%
report = geograd.check(cost, samples=100)

# %% [markdown]
# ## A gradient by hand
#
# The distance of a point from a segment is a few lines, and so is its gradient. This one forgets that the
# foot of the point stops at the second end.


# %%
def away(point, segment):
    (px, py), (ax, ay, bx, by) = point.array.tolist(), segment.array.tolist()
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    place = min(max(((px - ax) * dx + (py - ay) * dy) / square, 0.0), 1.0) if square else 0.0
    return place, np.array([px - ax - place * dx, py - ay - place * dy]), np.array([dx, dy])


def distance(point: geograd.Vec2, segment: geograd.Segment2):
    return np.hypot(*away(point, segment)[1])


def gradient(point, segment):
    place, offset, along = away(point, segment)
    size = np.hypot(*offset)
    normal = offset / size if size else np.zeros(2)
    if place == 1.0 and np.hypot(*along):
        normal = np.array([-along[1], along[0]]) / np.hypot(*along)  # as if the segment went on
    return np.concatenate([normal, -(1 - place) * normal, -place * normal])


report = geograd.check(distance, gradient, samples=50, resolution=1e-10)

# %% [markdown]
# The report names the argument at fault, a small input, and what the witnesses say there. With the two lines
# of the fault left out the same check passes:


# %%
def mended(point, segment):
    place, offset, _ = away(point, segment)
    size = np.hypot(*offset)
    normal = offset / size if size else np.zeros(2)
    return np.concatenate([normal, -(1 - place) * normal, -place * normal])


print(geograd.check(distance, mended, samples=50, resolution=1e-10, quiet=True).passed)

# %% [markdown]
# `geograd.torch.check(f, *inputs)` does the same for whatever autograd returns of a function of tensors.

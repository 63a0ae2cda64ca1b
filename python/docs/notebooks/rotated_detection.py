# %% [markdown]
# # Rotated boxes, learnt in PyTorch
#
# A small network sees an image of one rotated box and answers five numbers. Three losses train it: the smooth
# L1 loss of the numbers, the GIoU loss of `geograd.torch`, which is that of the box itself, and their sum.

# %%
import matplotlib.pyplot as plt
import numpy as np
import torch

import geograd
import geograd.torch

torch.manual_seed(1)
torch.set_num_threads(1)
SIDE, COUNT = 24, 1500

# %% [markdown]
# ## Images
#
# The signed distance of a pixel from a box draws the box: 1 inside, 0 outside, and a soft border one pixel
# wide.

# %%
draw = np.random.default_rng(1)
boxes = np.stack(
    [
        draw.uniform(8, 16, COUNT),
        draw.uniform(8, 16, COUNT),
        draw.uniform(8, 13, COUNT),
        draw.uniform(3, 6, COUNT),
        draw.uniform(-np.pi / 2, np.pi / 2, COUNT),
    ],
    -1,
)
pixels = geograd.Vec2(
    np.stack(np.meshgrid(np.arange(SIDE), np.arange(SIDE)), -1).reshape(-1, 2).astype(float)
)
away = geograd.signed_distance.all_pairs(pixels, geograd.Obb2(boxes)).T.reshape(COUNT, SIDE, SIDE)
images = np.clip(0.5 - away, 0, 1) + draw.normal(0, 0.15, away.shape)
print(images.shape)

# %% [markdown]
# ## A network and its losses
#
# The heading of a box has a period of π, so the network answers the sine and cosine of twice the heading.


# %%
def network():
    torch.manual_seed(2)
    return torch.nn.Sequential(
        torch.nn.Conv2d(1, 16, 3, stride=2, padding=1),
        torch.nn.ReLU(),
        torch.nn.Conv2d(16, 32, 3, stride=2, padding=1),
        torch.nn.ReLU(),
        torch.nn.Flatten(),
        torch.nn.Linear(32 * 36, 64),
        torch.nn.ReLU(),
        torch.nn.Linear(64, 6),
    )


def decoded(raw):
    """Boxes of what the network answers: sizes above zero, headings of two numbers."""
    center = SIDE / 2 + 6 * raw[:, :2]
    size = 2 + 6 * torch.nn.functional.softplus(raw[:, 2:4])
    heading = 0.5 * torch.atan2(raw[:, 5], raw[:, 4])
    return torch.cat([center, size, heading[:, None]], -1)


def smooth_l1(found, truth):
    # An angle counts modulo π; its error is in units of pixels at the end of a box.
    turn = found[:, 4] - truth[:, 4]
    turn = turn - torch.pi * torch.round(turn / torch.pi)
    errors = torch.cat([found[:, :4] - truth[:, :4], 6 * turn[:, None]], -1)
    return torch.nn.functional.smooth_l1_loss(errors, torch.zeros_like(errors))


x = torch.tensor(images, dtype=torch.float32)[:, None]
y = torch.tensor(boxes, dtype=torch.float32)
train, test = slice(0, 1250), slice(1250, COUNT)


def trained(loss, steps=400):
    model, scores = network(), []
    adam = torch.optim.Adam(model.parameters(), 2e-3)
    for step in range(steps):
        rows = torch.randint(0, 1250, (64,))
        adam.zero_grad()
        loss(decoded(model(x[rows])), y[rows]).backward()
        adam.step()
        if step % 10 == 9:
            with torch.no_grad():
                scores.append(
                    geograd.torch.iou(decoded(model(x[test])), y[test], kind="Obb2").mean().item()
                )
    return model, scores


giou = geograd.torch.GIoULoss()
losses = {
    "smooth L1": smooth_l1,
    "GIoU": giou,
    "sum of both": lambda found, truth: smooth_l1(found, truth) + giou(found, truth),
}
runs = {name: trained(loss) for name, loss in losses.items()}
for name, (_, scores) in runs.items():
    print(f"{name}: mean IoU {scores[-1]:.2f} on {COUNT - 1250} images that were not trained on")

# %%
figure, axes = plt.subplots(figsize=(7, 3.4))
for name, (_, scores) in runs.items():
    axes.plot(10 * np.arange(1, len(scores) + 1), scores, label=name)
axes.set(xlabel="step", title="Mean IoU of the test images", ylim=(0, 1))
axes.grid(axis="y", color="#d5dde4")
axes.legend()
plt.show()

# %% [markdown]
# The loss of numbers was weighed by hand for these images: six pixels to a radian. GIoU needs no weight;
# alone it starts more slowly, and the sum is best here.
#
# ## Some answers

# %%
with torch.no_grad():
    found = decoded(runs["sum of both"][0](x[test])).double().numpy()
figure, panels = plt.subplots(1, 5, figsize=(10, 2.2))
for k, axes in enumerate(panels):
    axes.imshow(images[1250 + k], cmap="Greys", vmin=-0.4, vmax=2.2)
    for numbers, color in ((boxes[1250 + k], "#d8612c"), (found[k], "#2166ac")):
        corners = geograd.corners(numbers, kind="Obb2").array.reshape(4, 2)
        axes.fill(*corners.T, fill=False, edgecolor=color, linewidth=2)
    score = geograd.iou(boxes[1250 + k], found[k], kind="Obb2")
    axes.set_title(f"IoU {score:.2f}", fontsize=10)
    axes.axis("off")
plt.show()

# %% [markdown]
# Orange is the truth, blue the answer. Other losses have the same form: `DIoULoss`, `CIoULoss`, `KFIoULoss`,
# and `geograd.torch.Loss("probiou")` for any score of two boxes.

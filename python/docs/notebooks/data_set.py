# %% [markdown]
# # A data set under Ray
#
# Rows of a data set have boxes in columns of Arrow. Ray spreads blocks of them over processes, and geograd
# reads the columns without a copy.

# %%
import importlib.util

import numpy as np

missing = [name for name in ("ray", "pyarrow") if importlib.util.find_spec(name) is None]
if missing:
    print("This notebook computes nothing here: pip install", " ".join(missing))

# %% [markdown]
# ## Detections and truths of many frames

# %%
if not missing:
    import pyarrow as pa
    import ray

    import geograd
    import geograd.arrow
    import geograd.ray

    ray.init(num_cpus=2, include_dashboard=False, logging_level="error", log_to_driver=False)
    ray.data.DataContext.get_current().enable_progress_bars = False

    draw = np.random.default_rng(5)
    frames = np.repeat(np.arange(400), 25)
    truths = np.concatenate(
        [
            draw.uniform(0, 80, (len(frames), 2)),
            draw.uniform(2, 5, (len(frames), 2)),
            draw.uniform(-3, 3, (len(frames), 1)),
        ],
        1,
    )
    found = truths + draw.normal(0, [0.3, 0.3, 0.2, 0.2, 0.08], truths.shape)
    table = pa.table(
        {
            "frame": frames,
            "found": geograd.arrow.column(found),
            "truth": geograd.arrow.column(truths),
        }
    )
    print(table.schema)

# %% [markdown]
# ## A verb over the columns
#
# `geograd.ray.map` appends the result of a verb to every row.

# %%
if not missing:
    data = ray.data.from_arrow(table).repartition(4)
    scored = geograd.ray.map(data, "iou", ["found", "truth"], "Obb2", out="iou")
    print(f"mean IoU {scored.mean('iou'):.3f} of {scored.count()} rows")

# %% [markdown]
# ## Average precision of all frames
#
# Pairs are formed within frames: `groups` has where each frame begins. One call finds them, and another one
# judges them.

# %%
if not missing:
    scores = draw.random(len(found))
    offsets = np.arange(0, len(found) + 1, 25)
    pairs = geograd.iou.above(found, truths, 0.3, groups=(offsets, offsets), kind="Obb2")
    for threshold in (0.5, 0.7, 0.8):
        outcomes = geograd.metric.outcomes(
            scores, len(truths), pairs, threshold, groups=(offsets, offsets)
        )
        curve = geograd.metric.curve(scores, outcomes, len(truths))
        print(f"IoU {threshold}: average precision {geograd.metric.average_precision(curve):.3f}")

# %% [markdown]
# Files are the unit of larger jobs: `geograd.ray.Files(function).run(paths)` runs a function once per file.

# %%
if not missing:
    ray.shutdown()

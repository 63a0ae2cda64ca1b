"""Mistakes of a user, a line each, every one of which type checkers find."""

import numpy as np
import torch

import geograd
import geograd.arrow
import geograd.cuda
import geograd.datafusion
import geograd.jax
import geograd.torch
from geograd import assignment, metric

boxes = geograd.Obb2(np.ones((2, 5)))
tensor = torch.ones(2, 5)
geograd.iuo(boxes, boxes)  # mistake
geograd.iou(boxes, geograd.Vec2(1.0, 2.0))  # mistake
boxes.widht  # mistake
geograd.iou(boxes, boxes).heading  # mistake
geograd.set_num_threads("4")  # mistake
geograd.iou.above(boxes, boxes, "0.5")  # mistake
geograd.iou.row_mx(boxes, boxes)  # mistake
geograd.convert(geograd.ImageBox(np.ones(5)), to="Le90").points  # mistake
geograd.Rings.of([[(0, 0), (1, 0), (1, 1)]]).vertexes  # mistake
geograd.torch.iuo(tensor, tensor, kind="Obb2")  # mistake
geograd.torch.iou(tensor, tensor, kind=5)  # mistake
geograd.torch.GIoULoss(reduction="median")  # mistake
geograd.torch.KLDLoss(invalid="skip")  # mistake
geograd.torch.iou.suppress(tensor)  # mistake
geograd.jax.giou_loss(boxes.array, boxes.array, reduction="median")  # mistake
geograd.jax.iou.all_pair(boxes.array, boxes.array)  # mistake
geograd.cuda.iuo  # mistake
geograd.cuda.iou([0.0, 0.0, 4.0, 2.0, 0.1], tensor, kind="Obb2")  # mistake
geograd.cuda.iou.row_max(tensor, tensor, 0.5, kind="Obb2")  # mistake
geograd.arrow.Apply("iou", ["a", "b"])  # mistake
geograd.datafusion.register(None, "iou", "Obb2", precision="f16")  # mistake
metric.average_precision((1, 2, 3), "ten")  # mistake
assignment.largest(boxes.array, offsets=[0])  # mistake

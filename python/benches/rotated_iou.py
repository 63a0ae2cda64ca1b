"""IoU of rotated boxes in plain PyTorch, after the recipe of lilanxiao/Rotated_IoU: corners, crossings of edges, corners
inside of the other box, order by angle around their mean, and the shoelace formula. Its sort is `argsort` here."""

import torch

EPS = 1e-8


def corners(box):
    """Four corners, counterclockwise: (..., 5) to (..., 4, 2)."""
    x, y, width, height, angle = box.unbind(-1)
    signs = box.new_tensor([[1, 1], [-1, 1], [-1, -1], [1, -1]]) / 2
    local = signs * torch.stack([width, height], -1).unsqueeze(-2)
    cosine, sine = angle.cos().unsqueeze(-1), angle.sin().unsqueeze(-1)
    u, v = local.unbind(-1)
    return torch.stack([u * cosine - v * sine + x.unsqueeze(-1), u * sine + v * cosine + y.unsqueeze(-1)], -1)


def crossings(a, b):
    """Crossings of all edges of a with all edges of b, and which of them exist: (..., 16, 2), (..., 16)."""
    start, end = a.unsqueeze(-2), a.roll(-1, -2).unsqueeze(-2)
    other, further = b.unsqueeze(-3), b.roll(-1, -2).unsqueeze(-3)
    d, e = end - start, further - other
    cross = d[..., 0] * e[..., 1] - d[..., 1] * e[..., 0]
    w = other - start
    t = (w[..., 0] * e[..., 1] - w[..., 1] * e[..., 0]) / (cross + EPS)
    u = (w[..., 0] * d[..., 1] - w[..., 1] * d[..., 0]) / (cross + EPS)
    is_there = (t > 0) & (t < 1) & (u > 0) & (u < 1)
    points = start + t.unsqueeze(-1) * d
    points = points * is_there.unsqueeze(-1)
    return points.flatten(-3, -2), is_there.flatten(-2)


def inside(points, box):
    """Which corners lie in a box given by its corners."""
    origin, u, v = box[..., 0:1, :], box[..., 1:2, :] - box[..., 0:1, :], box[..., 3:4, :] - box[..., 0:1, :]
    p = points - origin
    along_u, along_v = (p * u).sum(-1) / (u * u).sum(-1), (p * v).sum(-1) / (v * v).sum(-1)
    return (along_u > -1e-6) & (along_u < 1 + 1e-6) & (along_v > -1e-6) & (along_v < 1 + 1e-6)


def iou(a, b):
    """IoU of aligned boxes (x, y, width, height, angle)."""
    ca, cb = corners(a), corners(b)
    between, is_between = crossings(ca, cb)
    vertices = torch.cat([ca, cb, between], -2)
    mask = torch.cat([inside(ca, cb), inside(cb, ca), is_between], -1)
    count = mask.sum(-1, keepdim=True)
    mean = (vertices * mask.unsqueeze(-1)).sum(-2) / count.clamp(min=1)
    centred = (vertices - mean.unsqueeze(-2)) * mask.unsqueeze(-1)
    with torch.no_grad():
        angle = torch.atan2(centred[..., 1], centred[..., 0]).masked_fill(~mask, 1e6)
        order = angle.argsort(-1)[..., :8]
        last = torch.arange(8, device=a.device) >= count
        order = torch.where(last, order[..., :1], order)
    polygon = centred.gather(-2, order.unsqueeze(-1).expand(*order.shape, 2))
    following = polygon.roll(-1, -2)
    area = 0.5 * (polygon[..., 0] * following[..., 1] - polygon[..., 1] * following[..., 0]).sum(-1)
    shared = torch.where(count.squeeze(-1) > 2, area.abs(), area.abs() * 0)
    union = a[..., 2] * a[..., 3] + b[..., 2] * b[..., 3] - shared
    return shared / union

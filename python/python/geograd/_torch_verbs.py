"""The verbs on tensors, with their forms of two lists."""

from __future__ import annotations

import numpy as np
import torch

import geograd
from geograd import _columns, _cuda, _nodes, _torch, _torch_polygons

#: The list whose rows have a result, and the comparison that a better one passes.
_EXTREMES = {"row_max": (0, ">"), "column_max": (1, ">")}
_COLUMNS = _torch_polygons.ANY


class _Pairs(torch.autograd.Function):
    """A form of all pairs whose gradient the library has: the matrix, its sum or its mean."""

    @staticmethod
    def forward(ctx, node, form, a, b):
        ctx.node, ctx.form = node, form
        ctx.save_for_backward(a, b)
        if _cuda.is_there(a):
            if form == "all_pairs":
                return _torch.computed(node, _crossed(node, a, b))[0]
            factor = 1 / max(a.shape[0] * b.shape[0], 1) if form == "mean" else 1.0
            total, ctx.grads = _cuda.total(node, a, b, factor, any(ctx.needs_input_grad))
            return total
        verb, kinds = node.base.verb, node.base.kinds
        arrays = a.detach().numpy(), b.detach().numpy()
        if form == "all_pairs":
            return torch.from_numpy(verb.all_pairs(*arrays, kind=kinds))
        total, grads = getattr(verb, f"{form}_grad")(*arrays, kind=kinds)
        ctx.grads = [torch.from_numpy(grad) for grad in grads]
        return a.new_tensor(total)

    @staticmethod
    def backward(ctx, bar):
        a, b = ctx.saved_tensors
        if torch.is_grad_enabled():
            # Derivatives of higher order: those of every pair.
            count = a.shape[0] * b.shape[0]
            bar = bar / count if ctx.form == "mean" and count else bar
            inputs = [*_crossed(ctx.node, a, b), bar.expand(a.shape[0], b.shape[0])]
            grads = _torch.applied(ctx.node.vjp(), inputs)
            return None, None, grads[0].sum(1), grads[1].sum(0)
        if ctx.form == "all_pairs" and _cuda.is_there(a):
            return None, None, *_cuda.pulled_back(ctx.node, a, b, bar)
        if ctx.form == "all_pairs":
            arrays = a.numpy(), b.numpy(), bar.contiguous().numpy()
            grads = ctx.node.base.verb.all_pairs_vjp(*arrays, kind=ctx.node.base.kinds)
            return None, None, *map(torch.from_numpy, grads)
        return None, None, ctx.grads[0] * bar, ctx.grads[1] * bar


def _crossed(node, a, b):
    """Both lists with an axis for each other's."""
    (_, _, width_a), (_, _, width_b) = node.takes
    return a.unsqueeze(-2 if width_a else -1), b.unsqueeze(-3 if width_b else -2)


class Verb:
    """A verb on tensors: ``geograd.torch.iou(a, b, kind="Obb2")``.

    ``kind`` names the shape of the arguments, or one for each; ``to`` that of the result where there are several.
    """

    def __init__(self, name):
        self.__name__ = self.__qualname__ = name

    # The table has it, which a compiler of graphs must not ask.
    @property
    def __doc__(self):
        return getattr(geograd, self.__name__).__doc__

    def __repr__(self):
        return f"<geograd.torch.{self.__name__}>"

    def __reduce__(self):
        return (_verb, (self.__name__,))

    def __call__(self, *arguments, kind=None, to=None):
        if any(isinstance(x, _COLUMNS) for x in arguments):
            return _torch_polygons.run(self.__name__, arguments, kind)
        return _torch.of_verb(self.__name__, arguments, kind, to)

    def _two(self, form, a, b, kind):
        """The node and both lists of a form of pairs."""
        node = _nodes.of_verb(self.__name__, kind, 2)
        if len(node.takes) != 2:
            raise TypeError(f"{node.name} takes {len(node.takes)} arguments, and {form} is of two")
        return node, _torch.tensors(self.__name__, (a, b))

    def all_pairs(self, a, b, *, kind=None):
        """Every row of ``a`` with every row of ``b``: a matrix, with derivatives of any order.

        ``a`` has the shape ``(..., N, k)``, ``b`` ``(..., M, k)``, the result ``(..., N, M)``. Either may be a column of
        polygons or paths.
        """
        if isinstance(a, _torch_polygons.ANY) or isinstance(b, _torch_polygons.ANY):
            return _torch_polygons.run(self.__name__, (a, b), kind, _columns.Pairs)
        if torch.compiler.is_compiling():
            return self(a.unsqueeze(-2), b.unsqueeze(-3), kind=kind)
        node, (a, b) = self._two("all_pairs", a, b, kind)
        if self._is_special(node, a, b):
            return self(*_crossed(node, a, b), kind=kind)
        return _Pairs.apply(node, "all_pairs", a, b)

    @staticmethod
    def _is_special(node, a, b):
        """Whether pairs are taken one by one: in transforms, in batches, of results of several numbers."""
        has_axes = any(x.dim() - bool(width) != 1 for x, (_, _, width) in zip((a, b), node.takes))
        return has_axes or node.gives != [0] or _torch.is_transformed() or _torch.has_tangents()

    def _total(self, form, a, b, kind):
        if torch.compiler.is_compiling():
            return getattr(self.all_pairs(a, b, kind=kind), form)()
        node, (a, b) = self._two(form, a, b, kind)
        if self._is_special(node, a, b):
            return getattr(self.all_pairs(a, b, kind=kind), form)()
        return _Pairs.apply(node, form, a, b)

    def sum(self, a, b, *, kind=None):
        """The sum of the results of all pairs, without their matrix."""
        return self._total("sum", a, b, kind)

    def mean(self, a, b, *, kind=None):
        """The mean of the results of all pairs, without their matrix; zero where there are none."""
        return self._total("mean", a, b, kind)

    @torch.compiler.disable
    def row_max(self, a, b, *, groups=None, kind=None):
        """The largest result of every row of ``a``, with derivatives, and its row of ``b``.

        They are -inf and -1 where ``b`` has no rows. ``groups`` are the offsets of both lists.
        """
        return self._most("row_max", a, b, groups, kind)

    @torch.compiler.disable
    def column_max(self, a, b, *, groups=None, kind=None):
        """The same of every row of ``b``."""
        return self._most("column_max", a, b, groups, kind)

    def _most(self, form, a, b, groups, kind):
        node, (a, b) = self._two(form, a, b, kind)
        groups = None if groups is None else tuple(map(_offsets, groups))
        if _cuda.is_there(a):
            values, places = _cuda.most(node, a, b, *_EXTREMES[form], groups)
        else:
            arrays = a.detach().numpy(), b.detach().numpy()
            found = getattr(node.base.verb, form)(*arrays, groups=groups, kind=node.base.kinds)
            values, places = map(torch.from_numpy, found)
        if torch.is_grad_enabled() and (a.requires_grad or b.requires_grad):
            found = torch.nonzero(places >= 0).squeeze(-1)
            own, other = found, places[found]
            pairs = (a[own], b[other]) if form == "row_max" else (a[other], b[own])
            values = values.index_copy(0, found, self(*pairs, kind=kind))
        return values, places

    @torch.compiler.disable
    def row_min(self, a, b, *, within=None, groups=None, lower=None, kind=None):
        """The least result of every row of ``a``, with derivatives, and its row of ``b``.

        They are inf and -1 where no result is at most ``within``. Of equal results the first has the derivative.
        """
        return self._least("row_min", a, b, within, groups, lower, kind)

    @torch.compiler.disable
    def column_min(self, a, b, *, within=None, groups=None, lower=None, kind=None):
        """The same of every row of ``b``."""
        return self._least("column_min", a, b, within, groups, lower, kind)

    @torch.compiler.disable
    def nearest(self, a, b, *, within=None, groups=None, lower=None, kind=None):
        """The least result of all pairs, or of every group, with derivatives, and its rows of ``a`` and of ``b``."""
        return self._least("nearest", a, b, within, groups, lower, kind)

    def _least(self, form, a, b, within, groups, lower, kind):
        node, (a, b) = self._two(form, a, b, kind)
        _torch.lacks(f"{self.__name__}.{form}", a, a.is_cuda)
        groups = None if groups is None else tuple(map(_offsets, groups))
        arrays = a.detach().numpy(), b.detach().numpy()
        found = getattr(node.base.verb, form)(*arrays, within=within, groups=groups, lower=lower, kind=node.base.kinds)
        values, *places = (torch.from_numpy(np.asarray(x)) for x in found)
        if torch.is_grad_enabled() and (a.requires_grad or b.requires_grad):
            own = torch.nonzero(places[0].reshape(-1) >= 0).squeeze(-1)
            rows = [place.reshape(-1)[own] for place in places]
            if form == "row_min":
                rows.insert(0, own)
            elif form == "column_min":
                rows.append(own)
            exact = self(a[rows[0]], b[rows[1]], kind=kind)
            values = values.reshape(-1).index_copy(0, own, exact).reshape(values.shape)
        return values, *places

    @torch.compiler.disable
    def below(self, a, b, limit, *, groups=None, lower=None, kind=None):
        """Every pair, with groups every pair of a group, whose result is below a limit: rows of ``a``, rows of ``b``,
        results with derivatives."""
        node, (a, b) = self._two("below", a, b, kind)
        _torch.lacks(f"{self.__name__}.below", a, a.is_cuda)
        groups = None if groups is None else tuple(map(_offsets, groups))
        arrays = a.detach().numpy(), b.detach().numpy()
        found = node.base.verb.below(*arrays, float(limit), groups=groups, lower=lower, kind=node.base.kinds)
        rows, columns, values = map(torch.from_numpy, found)
        if torch.is_grad_enabled() and (a.requires_grad or b.requires_grad):
            values = self(a[rows], b[columns], kind=kind)
        return rows, columns, values

    def count_below(self, a, b, limit, *, kind=None):
        """How many pairs have a result below a limit."""
        node, (a, b) = self._two("count_below", a, b, kind)
        if a.is_cuda:
            return int((self.all_pairs(a, b, kind=kind) < limit).sum())
        arrays = a.detach().numpy(), b.detach().numpy()
        return node.base.verb.count_below(*arrays, float(limit), kind=node.base.kinds)

    @torch.compiler.disable
    def above(self, a, b, threshold, *, groups=None, kind=None):
        """Every pair, with groups every pair of a group, whose result is above a threshold: rows of ``a``, rows of ``b``,
        results with derivatives."""
        node, (a, b) = self._two("above", a, b, kind)
        groups = None if groups is None else tuple(map(_offsets, groups))
        if _cuda.is_there(a):
            rows, columns, values = _cuda.above(node, a, b, ">", float(threshold), groups)
        else:
            arrays = a.detach().numpy(), b.detach().numpy()
            found = node.base.verb.above(*arrays, float(threshold), groups=groups, kind=node.base.kinds)
            rows, columns, values = map(torch.from_numpy, found)
        if torch.is_grad_enabled() and (a.requires_grad or b.requires_grad):
            values = self(a[rows], b[columns], kind=kind)
        return rows, columns, values

    def count_above(self, a, b, threshold, *, kind=None):
        """How many pairs have a result above a threshold."""
        node, (a, b) = self._two("count_above", a, b, kind)
        if _cuda.is_there(a):
            return _cuda.count_above(node, a, b, ">", float(threshold))
        arrays = a.detach().numpy(), b.detach().numpy()
        return node.base.verb.count_above(*arrays, float(threshold), kind=node.base.kinds)

    @torch.compiler.disable
    def suppress(self, shapes, scores, overlap, *, classes=None, score=None, most=None, groups=None, kind=None):
        """The places of the shapes that no better one, kept itself, overlaps by more than a threshold, the best first; with
        ``classes`` within a class, with ``groups``, offsets of the list, group by group."""
        node = _nodes.of_verb(self.__name__, kind, 2)
        (shapes,) = _torch.tensors(self.__name__, (shapes,), casts=True)
        (scores,) = _torch.tensors(self.__name__, (scores,), casts=True)
        _torch.lacks(f"{self.__name__}.suppress", shapes, True)
        kept = node.base.verb.suppress(
            shapes.detach().numpy(), scores.detach().numpy(), overlap, classes=_offsets(classes), score=score, most=most,
            groups=_offsets(groups), kind=node.base.kinds
        )
        return torch.from_numpy(kept)


def _offsets(x):
    """Whole numbers of a tensor as an array."""
    return x.detach().cpu().numpy() if isinstance(x, torch.Tensor) else x


_VERBS = {name: Verb(name) for name in geograd._VERBS}


def _verb(name):
    return _VERBS[name]


__all__ = sorted(_VERBS)
globals().update(_VERBS)

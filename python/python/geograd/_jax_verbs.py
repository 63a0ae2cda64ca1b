"""The verbs on JAX's arrays."""

from __future__ import annotations

import geograd
from geograd import _columns, _jax, _jax_columns, _nodes


class Verb:
    """A verb on JAX's arrays: ``geograd.jax.iou(a, b, kind="Obb2")``.

    ``kind`` names the shape of the arguments, or one for each; ``to`` that of the result where there are several.
    """

    def __init__(self, name):
        self.__name__ = self.__qualname__ = name

    @property
    def __doc__(self):
        return getattr(geograd, self.__name__).__doc__

    def __repr__(self):
        return f"<geograd.jax.{self.__name__}>"

    def __reduce__(self):
        return (_verb, (self.__name__,))

    def __call__(self, *arguments, kind=None, to=None):
        if any(isinstance(x, _jax_columns.ANY) for x in arguments):
            return _jax_columns.run(self.__name__, arguments, kind)
        return _jax.applied(_nodes.of_verb(self.__name__, kind, len(arguments), to), arguments)

    def all_pairs(self, a, b, *, kind=None):
        """Every row of ``a`` with every row of ``b``: a matrix of shape ``(..., N, M)``, with derivatives of any order.

        Either may be a column of polygons or paths.
        """
        if isinstance(a, _jax_columns.ANY) or isinstance(b, _jax_columns.ANY):
            return _jax_columns.run(self.__name__, (a, b), kind, _columns.Pairs)
        node = _nodes.of_verb(self.__name__, kind, 2)
        if len(node.takes) != 2:
            raise TypeError(f"{node.name} takes {len(node.takes)} arguments, and all_pairs are of two")
        (_, _, width_a), (_, _, width_b) = node.takes
        a = _jax.jnp.expand_dims(a, -2 if width_a else -1)
        b = _jax.jnp.expand_dims(b, -3 if width_b else -2)
        return self(a, b, kind=kind)


_VERBS = {name: Verb(name) for name in geograd._VERBS}


def _verb(name):
    return _VERBS[name]


__all__ = sorted(_VERBS)
globals().update(_VERBS)

"""The verbs on arrays of a card."""

from __future__ import annotations

import geograd

from . import _nodes
from ._cuda_calls import Calls


class Verb(Calls):
    """A verb on arrays of a card: ``geograd.cuda.iou(a, b, kind="Obb2")``.

    ``kind`` names the shape of the arguments, or one for each; ``to`` that of the result where there are several.
    """

    def __init__(self, name):
        self.__name__ = self.__qualname__ = name

    def _node(self, count, kind, to):
        return _nodes.of_verb(self.__name__, kind, count, to)

    def __repr__(self):
        return f"<geograd.cuda.{self.__name__}>"

    def __reduce__(self):
        return _verb, (self.__name__,)


_VERBS = {name: Verb(name) for name in geograd._VERBS}


def _verb(name):
    return _VERBS[name]


__all__ = sorted(_VERBS)
globals().update(_VERBS)

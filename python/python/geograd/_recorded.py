"""Recorded functions of lists of numbers, for formulas whose boxes a shape would refuse."""

from __future__ import annotations

import inspect
from typing import Any, Callable

import geograd


def numbers(**widths: int) -> Callable[[Callable[..., Any]], geograd.Function]:
    """Records a function whose arguments are lists of so many numbers, by the names that errors give them.

    0 stands for a lone number. Infinite numbers and NaN raise a ValueError.
    """

    def recorded(f: Callable[..., Any]) -> geograd.Function:
        kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
        f.__annotations__ = {name: width or float for name, width in widths.items()}
        setattr(f, "__signature__", inspect.Signature([inspect.Parameter(name, kind) for name in widths]))
        return geograd.Function(f)

    return recorded

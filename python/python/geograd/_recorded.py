"""Recorded functions of lists of numbers, for formulas whose boxes a shape would refuse."""

from __future__ import annotations

from typing import Any, Callable

import geograd


def numbers(*widths: int) -> Callable[[Callable[..., Any]], geograd.Function]:
    """Records a function whose arguments are lists of so many numbers; 0 stands for a lone number."""

    def recorded(f: Callable[..., Any]) -> geograd.Function:
        names = [name for name in f.__code__.co_varnames[: f.__code__.co_argcount]]
        f.__annotations__ = {name: width or float for name, width in zip(names, widths)}
        return geograd.Function(f)

    return recorded

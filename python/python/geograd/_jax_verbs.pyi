# Written by stubs.py, from the table of the library.
from typing import Any, Generic, Sequence, Type, TypeVar, Union

import jax
from jax.typing import ArrayLike

from geograd import Shape

Kind = Union[str, Type[Shape], None, Sequence[Union[str, Type[Shape], None]]]
_Result = TypeVar("_Result", covariant=True)

class Verb(Generic[_Result]):
    """A verb on JAX's arrays, with derivatives of any order."""
    __name__: str
    def __init__(self, name: str) -> None: ...
    def __call__(self, *arguments: ArrayLike, kind: Kind = ..., to: Kind = ...) -> _Result: ...
    def all_pairs(self, a: ArrayLike, b: ArrayLike, *, kind: Kind = ...) -> jax.Array: ...

__all__ = ["alpha_iou", "angle", "area", "bhattacharyya", "centroid", "ciou", "ciou_aabb", "ciou_fixed_weight", "ciou_hull", "ciou_rectangle", "circumcircle", "closest_points", "convert", "corners", "crossing", "depth", "diameter", "diou", "diou_aabb", "diou_hull", "diou_rectangle", "distance", "eiou", "eiou_aabb", "eiou_hull", "eiou_rectangle", "farthest_distance", "first_hit", "flip_y", "giou", "giou_aabb", "giou_hull", "giou_rectangle", "hull_area", "incircle", "inertia", "intersection_area", "intersection_length", "intersection_volume", "iof", "iou", "iou_bev", "jeffreys", "kfiou", "kullback_leibler", "length", "length_inside", "meeting", "minimum_circle", "minimum_rectangle", "move", "penetration", "perimeter", "probiou", "project", "second_moments", "separation_aware", "signed_area", "signed_distance", "span", "squared_distance", "squared_wasserstein", "surface", "volume", "wasserstein", "width", "winding"]

alpha_iou: Verb[jax.Array]
angle: Verb[jax.Array]
area: Verb[jax.Array]
bhattacharyya: Verb[jax.Array]
centroid: Verb[jax.Array]
ciou: Verb[jax.Array]
ciou_aabb: Verb[jax.Array]
ciou_fixed_weight: Verb[jax.Array]
ciou_hull: Verb[jax.Array]
ciou_rectangle: Verb[jax.Array]
circumcircle: Verb[jax.Array]
closest_points: Verb[jax.Array]
convert: Verb[jax.Array]
corners: Verb[jax.Array]
crossing: Verb[jax.Array]
depth: Verb[jax.Array]
diameter: Verb[jax.Array]
diou: Verb[jax.Array]
diou_aabb: Verb[jax.Array]
diou_hull: Verb[jax.Array]
diou_rectangle: Verb[jax.Array]
distance: Verb[jax.Array]
eiou: Verb[jax.Array]
eiou_aabb: Verb[jax.Array]
eiou_hull: Verb[jax.Array]
eiou_rectangle: Verb[jax.Array]
farthest_distance: Verb[jax.Array]
first_hit: Verb[jax.Array]
flip_y: Verb[jax.Array]
giou: Verb[jax.Array]
giou_aabb: Verb[jax.Array]
giou_hull: Verb[jax.Array]
giou_rectangle: Verb[jax.Array]
hull_area: Verb[jax.Array]
incircle: Verb[jax.Array]
inertia: Verb[jax.Array]
intersection_area: Verb[jax.Array]
intersection_length: Verb[jax.Array]
intersection_volume: Verb[jax.Array]
iof: Verb[jax.Array]
iou: Verb[jax.Array]
iou_bev: Verb[jax.Array]
jeffreys: Verb[jax.Array]
kfiou: Verb[jax.Array]
kullback_leibler: Verb[jax.Array]
length: Verb[jax.Array]
length_inside: Verb[jax.Array]
meeting: Verb[jax.Array]
minimum_circle: Verb[jax.Array]
minimum_rectangle: Verb[jax.Array]
move: Verb[jax.Array]
penetration: Verb[jax.Array]
perimeter: Verb[jax.Array]
probiou: Verb[jax.Array]
project: Verb[jax.Array]
second_moments: Verb[jax.Array]
separation_aware: Verb[jax.Array]
signed_area: Verb[jax.Array]
signed_distance: Verb[jax.Array]
span: Verb[jax.Array]
squared_distance: Verb[jax.Array]
squared_wasserstein: Verb[jax.Array]
surface: Verb[jax.Array]
volume: Verb[jax.Array]
wasserstein: Verb[jax.Array]
width: Verb[jax.Array]
winding: Verb[jax.Array]

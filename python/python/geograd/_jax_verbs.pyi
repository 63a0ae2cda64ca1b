# Written by stubs.py, from the table of the library.
from typing import Any, Generic, Sequence, Type, TypeVar, Union, overload

import jax
from jax.typing import ArrayLike

from geograd import Paths as _Paths, Polygons as _Polygons, Shape
from geograd._jax_columns import Column

Kind = Union[str, Type[Shape], None, Sequence[Union[str, Type[Shape], None]]]
_Column = Union[Column, _Polygons, _Paths]
_Result = TypeVar("_Result", covariant=True)

class Verb(Generic[_Result]):
    """A verb on JAX's arrays, with derivatives of any order."""
    __name__: str
    def __init__(self, name: str) -> None: ...
    @overload
    def __call__(self, *arguments: ArrayLike, kind: Kind = ..., to: Kind = ...) -> _Result: ...
    @overload
    def __call__(self, *arguments: Union[ArrayLike, _Column], kind: Kind = ...) -> jax.Array:
        """The verb of polygons, rings or other paths, one of which an argument is at least."""
    def all_pairs(self, a: ArrayLike, b: ArrayLike, *, kind: Kind = ...) -> jax.Array: ...

__all__ = ["adjoint", "adjoint_transposed", "alpha_iou", "angle", "area", "axes", "bhattacharyya", "centroid", "ciou", "ciou_aabb", "ciou_fixed_weight", "ciou_hull", "ciou_rectangle", "circumcircle", "closest_points", "convert", "corners", "crossing", "depth", "diameter", "diou", "diou_aabb", "diou_hull", "diou_rectangle", "distance", "eiou", "eiou_aabb", "eiou_hull", "eiou_rectangle", "farthest_distance", "first_hit", "flip_y", "from_6d", "from_rotation_vector", "from_twist", "giou", "giou_aabb", "giou_hull", "giou_rectangle", "hull_area", "incircle", "inertia", "interpolate", "intersection_area", "intersection_length", "intersection_volume", "inverse", "iof", "iou", "iou_bev", "jeffreys", "kfiou", "kullback_leibler", "left_jacobian", "left_jacobian_inverse", "length", "length_inside", "meeting", "minimum_circle", "minimum_rectangle", "move", "nearest_rotation", "penetration", "perimeter", "probiou", "project", "retract", "right_jacobian", "right_jacobian_inverse", "rotation_vector", "second_moments", "separation_aware", "signed_area", "signed_distance", "span", "squared_angle", "squared_distance", "squared_wasserstein", "surface", "tangent_to", "to_6d", "twist", "volume", "wasserstein", "width", "winding"]

adjoint: Verb[Any]
adjoint_transposed: Verb[Any]
alpha_iou: Verb[jax.Array]
angle: Verb[jax.Array]
area: Verb[jax.Array]
axes: Verb[jax.Array]
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
from_6d: Verb[jax.Array]
from_rotation_vector: Verb[jax.Array]
from_twist: Verb[jax.Array]
giou: Verb[jax.Array]
giou_aabb: Verb[jax.Array]
giou_hull: Verb[jax.Array]
giou_rectangle: Verb[jax.Array]
hull_area: Verb[jax.Array]
incircle: Verb[jax.Array]
inertia: Verb[jax.Array]
interpolate: Verb[jax.Array]
intersection_area: Verb[jax.Array]
intersection_length: Verb[jax.Array]
intersection_volume: Verb[jax.Array]
inverse: Verb[jax.Array]
iof: Verb[jax.Array]
iou: Verb[jax.Array]
iou_bev: Verb[jax.Array]
jeffreys: Verb[jax.Array]
kfiou: Verb[jax.Array]
kullback_leibler: Verb[jax.Array]
left_jacobian: Verb[jax.Array]
left_jacobian_inverse: Verb[jax.Array]
length: Verb[jax.Array]
length_inside: Verb[jax.Array]
meeting: Verb[jax.Array]
minimum_circle: Verb[jax.Array]
minimum_rectangle: Verb[jax.Array]
move: Verb[jax.Array]
nearest_rotation: Verb[jax.Array]
penetration: Verb[jax.Array]
perimeter: Verb[jax.Array]
probiou: Verb[jax.Array]
project: Verb[jax.Array]
retract: Verb[jax.Array]
right_jacobian: Verb[jax.Array]
right_jacobian_inverse: Verb[jax.Array]
rotation_vector: Verb[jax.Array]
second_moments: Verb[jax.Array]
separation_aware: Verb[jax.Array]
signed_area: Verb[jax.Array]
signed_distance: Verb[jax.Array]
span: Verb[jax.Array]
squared_angle: Verb[jax.Array]
squared_distance: Verb[jax.Array]
squared_wasserstein: Verb[jax.Array]
surface: Verb[jax.Array]
tangent_to: Verb[Any]
to_6d: Verb[jax.Array]
twist: Verb[Any]
volume: Verb[jax.Array]
wasserstein: Verb[jax.Array]
width: Verb[jax.Array]
winding: Verb[jax.Array]

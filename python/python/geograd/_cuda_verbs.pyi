# Written by stubs.py, from the table of the library.
from typing import Any, Generic, Optional, Sequence, Type, TypeVar, Union, overload

from numpy.typing import ArrayLike

from geograd import Shape
from geograd._cuda_arrays import Array, OnCard

Kind = Union[str, Type[Shape], None, Sequence[Union[str, Type[Shape], None]]]
Groups = Optional[Sequence[Union[ArrayLike, OnCard]]]
_Result = TypeVar("_Result", covariant=True)
_Out = TypeVar("_Out", bound=OnCard)

class Verb(Generic[_Result]):
    """A verb on arrays of a card."""
    __name__: str
    def __init__(self, name: str) -> None: ...
    @overload
    def __call__(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: None = ...) -> _Result: ...
    @overload
    def __call__(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: _Out) -> _Out: ...
    @overload
    def __call__(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: Sequence[Optional[OnCard]]) -> Any: ...
    @overload
    def value_grad(self, *arguments: OnCard, kind: Kind = ..., out: None = ...) -> tuple[Array, tuple[Array, ...]]: ...
    @overload
    def value_grad(self, *arguments: OnCard, kind: Kind = ..., out: Sequence[Any]) -> tuple[Any, tuple[Any, ...]]: ...
    @overload
    def vjp(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: None = ...) -> tuple[Array, ...]: ...
    @overload
    def vjp(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: Union[OnCard, Sequence[Any]]) -> tuple[Any, ...]: ...
    @overload
    def jvp(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: None = ...) -> tuple[Array, ...]: ...
    @overload
    def jvp(self, *arguments: OnCard, kind: Kind = ..., to: Kind = ..., out: Sequence[Any]) -> tuple[Any, ...]: ...
    @overload
    def all_pairs(self, a: OnCard, b: OnCard, *, kind: Kind = ..., out: None = ...) -> Array: ...
    @overload
    def all_pairs(self, a: OnCard, b: OnCard, *, kind: Kind = ..., out: _Out) -> _Out: ...
    def row_max(
        self, a: OnCard, b: OnCard, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, Array]: ...
    def row_min(
        self, a: OnCard, b: OnCard, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, Array]: ...
    def column_max(
        self, a: OnCard, b: OnCard, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, Array]: ...
    def column_min(
        self, a: OnCard, b: OnCard, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, Array]: ...
    def above(
        self, a: OnCard, b: OnCard, threshold: float, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, Array, Array]: ...
    def below(
        self, a: OnCard, b: OnCard, limit: float, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, Array, Array]: ...
    def count_above(
        self, a: OnCard, b: OnCard, threshold: float, *, groups: Groups = ..., kind: Kind = ...
    ) -> int: ...
    def count_below(
        self, a: OnCard, b: OnCard, limit: float, *, groups: Groups = ..., kind: Kind = ...
    ) -> int: ...
    def sum(
        self, a: OnCard, b: OnCard, *, groups: Groups = ..., kind: Kind = ...
    ) -> Array: ...
    def sum_grad(
        self, a: OnCard, b: OnCard, *, groups: Groups = ..., kind: Kind = ...
    ) -> tuple[Array, tuple[Array, Array]]: ...

__all__ = ["adjoint", "adjoint_transposed", "alpha_iou", "angle", "area", "axes", "between", "bhattacharyya", "bounding", "centroid", "ciou", "ciou_aabb", "ciou_fixed_weight", "ciou_hull", "ciou_rectangle", "circumcircle", "clearance", "closest_points", "contacts", "convert", "corners", "crossing", "depth", "diameter", "diou", "diou_aabb", "diou_hull", "diou_rectangle", "distance", "eiou", "eiou_aabb", "eiou_hull", "eiou_rectangle", "farthest_distance", "first_hit", "flip_y", "from_6d", "from_rotation_vector", "from_twist", "giou", "giou_aabb", "giou_hull", "giou_rectangle", "height", "hull_area", "incircle", "inertia", "interpolate", "intersection_area", "intersection_length", "intersection_volume", "inverse", "iof", "iou", "iou_bev", "jeffreys", "kfiou", "kullback_leibler", "left_jacobian", "left_jacobian_inverse", "length", "length_inside", "meeting", "minimum_circle", "minimum_rectangle", "move", "nearest_rotation", "penetration", "perimeter", "planes", "pose_at", "probiou", "project", "retract", "right_jacobian", "right_jacobian_inverse", "rotation_vector", "screw", "second_moments", "separation_aware", "signed_area", "signed_distance", "slant", "span", "squared_angle", "squared_distance", "squared_wasserstein", "support", "surface", "tangent_to", "time_of_impact", "to_6d", "twist", "volume", "wasserstein", "width", "winding"]

adjoint: Verb[Any]
adjoint_transposed: Verb[Any]
alpha_iou: Verb[Array]
angle: Verb[Array]
area: Verb[Array]
axes: Verb[Array]
between: Verb[Array]
bhattacharyya: Verb[Array]
bounding: Verb[Array]
centroid: Verb[Array]
ciou: Verb[Array]
ciou_aabb: Verb[Array]
ciou_fixed_weight: Verb[Array]
ciou_hull: Verb[Array]
ciou_rectangle: Verb[Array]
circumcircle: Verb[Array]
clearance: Verb[Array]
closest_points: Verb[Array]
contacts: Verb[Array]
convert: Verb[Array]
corners: Verb[Array]
crossing: Verb[Array]
depth: Verb[Array]
diameter: Verb[Array]
diou: Verb[Array]
diou_aabb: Verb[Array]
diou_hull: Verb[Array]
diou_rectangle: Verb[Array]
distance: Verb[Array]
eiou: Verb[Array]
eiou_aabb: Verb[Array]
eiou_hull: Verb[Array]
eiou_rectangle: Verb[Array]
farthest_distance: Verb[Array]
first_hit: Verb[Array]
flip_y: Verb[Array]
from_6d: Verb[Array]
from_rotation_vector: Verb[Array]
from_twist: Verb[Array]
giou: Verb[Array]
giou_aabb: Verb[Array]
giou_hull: Verb[Array]
giou_rectangle: Verb[Array]
height: Verb[Array]
hull_area: Verb[Array]
incircle: Verb[Array]
inertia: Verb[Array]
interpolate: Verb[Array]
intersection_area: Verb[Array]
intersection_length: Verb[Array]
intersection_volume: Verb[Array]
inverse: Verb[Array]
iof: Verb[Array]
iou: Verb[Array]
iou_bev: Verb[Array]
jeffreys: Verb[Array]
kfiou: Verb[Array]
kullback_leibler: Verb[Array]
left_jacobian: Verb[Array]
left_jacobian_inverse: Verb[Array]
length: Verb[Array]
length_inside: Verb[Array]
meeting: Verb[Array]
minimum_circle: Verb[Array]
minimum_rectangle: Verb[Array]
move: Verb[Array]
nearest_rotation: Verb[Array]
penetration: Verb[Array]
perimeter: Verb[Array]
planes: Verb[Array]
pose_at: Verb[Array]
probiou: Verb[Array]
project: Verb[Array]
retract: Verb[Array]
right_jacobian: Verb[Array]
right_jacobian_inverse: Verb[Array]
rotation_vector: Verb[Array]
screw: Verb[Array]
second_moments: Verb[Array]
separation_aware: Verb[Array]
signed_area: Verb[Array]
signed_distance: Verb[Array]
slant: Verb[Array]
span: Verb[Array]
squared_angle: Verb[Array]
squared_distance: Verb[Array]
squared_wasserstein: Verb[Array]
support: Verb[Array]
surface: Verb[Array]
tangent_to: Verb[Any]
time_of_impact: Verb[Array]
to_6d: Verb[Array]
twist: Verb[Any]
volume: Verb[Array]
wasserstein: Verb[Array]
width: Verb[Array]
winding: Verb[Array]

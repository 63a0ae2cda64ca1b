# Written by stubs.py, from the table of the library.
from typing import Any, Generic, Optional, Sequence, Type, TypeVar, Union

import torch

from geograd import Paths as _Paths, Polygons as _Polygons, Shape
from geograd._torch_polygons import Column

Kind = Union[str, Type[Shape], None, Sequence[Union[str, Type[Shape], None]]]
Argument = Union[torch.Tensor, float]
Offsets = Union[torch.Tensor, Sequence[int], Any]
_Column = Union[Column, _Polygons, _Paths]
_Result = TypeVar("_Result", covariant=True)

class Verb(Generic[_Result]):
    """A verb on tensors, with derivatives of any order."""
    __name__: str
    def __init__(self, name: str) -> None: ...
    def __call__(self, *arguments: Union[Argument, _Column], kind: Kind = ..., to: Kind = ...) -> _Result: ...
    def all_pairs(self, a: Union[torch.Tensor, _Column], b: Union[torch.Tensor, _Column], *, kind: Kind = ...) -> torch.Tensor: ...
    def sum(self, a: torch.Tensor, b: torch.Tensor, *, kind: Kind = ...) -> torch.Tensor: ...
    def mean(self, a: torch.Tensor, b: torch.Tensor, *, kind: Kind = ...) -> torch.Tensor: ...
    def row_max(
        self, a: torch.Tensor, b: torch.Tensor, *, groups: Optional[Sequence[Offsets]] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor]: ...
    def column_max(
        self, a: torch.Tensor, b: torch.Tensor, *, groups: Optional[Sequence[Offsets]] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor]: ...
    def above(
        self, a: torch.Tensor, b: torch.Tensor, threshold: float, *, groups: Optional[Sequence[Offsets]] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]: ...
    def count_above(self, a: torch.Tensor, b: torch.Tensor, threshold: float, *, kind: Kind = ...) -> int: ...
    def row_min(
        self, a: torch.Tensor, b: torch.Tensor, *, within: Optional[float] = ...,
        groups: Optional[Sequence[Offsets]] = ..., lower: Optional[str] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor]: ...
    def column_min(
        self, a: torch.Tensor, b: torch.Tensor, *, within: Optional[float] = ...,
        groups: Optional[Sequence[Offsets]] = ..., lower: Optional[str] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor]: ...
    def nearest(
        self, a: torch.Tensor, b: torch.Tensor, *, within: Optional[float] = ...,
        groups: Optional[Sequence[Offsets]] = ..., lower: Optional[str] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]: ...
    def below(
        self, a: torch.Tensor, b: torch.Tensor, limit: float, *, groups: Optional[Sequence[Offsets]] = ..., lower: Optional[str] = ..., kind: Kind = ...
    ) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]: ...
    def count_below(self, a: torch.Tensor, b: torch.Tensor, limit: float, *, kind: Kind = ...) -> int: ...
    def suppress(
        self, shapes: torch.Tensor, scores: torch.Tensor, overlap: float, *, classes: Optional[Offsets] = ...,
        score: Optional[float] = ..., most: Optional[int] = ..., groups: Optional[Offsets] = ..., kind: Kind = ...
    ) -> torch.Tensor: ...

__all__ = ["adjoint", "adjoint_transposed", "alpha_iou", "angle", "area", "axes", "between", "bhattacharyya", "bounding", "centroid", "ciou", "ciou_aabb", "ciou_fixed_weight", "ciou_hull", "ciou_rectangle", "circumcircle", "clearance", "closest_points", "contacts", "convert", "corners", "crossing", "depth", "diameter", "diou", "diou_aabb", "diou_hull", "diou_rectangle", "distance", "eiou", "eiou_aabb", "eiou_hull", "eiou_rectangle", "farthest_distance", "first_hit", "flip_y", "from_6d", "from_rotation_vector", "from_twist", "giou", "giou_aabb", "giou_hull", "giou_rectangle", "height", "hull_area", "incircle", "inertia", "interpolate", "intersection_area", "intersection_length", "intersection_volume", "inverse", "iof", "iou", "iou_bev", "jeffreys", "kfiou", "kullback_leibler", "left_jacobian", "left_jacobian_inverse", "length", "length_inside", "meeting", "minimum_circle", "minimum_rectangle", "move", "nearest_rotation", "penetration", "perimeter", "planes", "pose_at", "probiou", "project", "retract", "right_jacobian", "right_jacobian_inverse", "rotation_vector", "screw", "second_moments", "separation_aware", "signed_area", "signed_distance", "slant", "span", "squared_angle", "squared_distance", "squared_wasserstein", "support", "surface", "tangent_to", "time_of_impact", "to_6d", "twist", "volume", "wasserstein", "width", "winding"]

adjoint: Verb[Any]
adjoint_transposed: Verb[Any]
alpha_iou: Verb[torch.Tensor]
angle: Verb[torch.Tensor]
area: Verb[torch.Tensor]
axes: Verb[torch.Tensor]
between: Verb[torch.Tensor]
bhattacharyya: Verb[torch.Tensor]
bounding: Verb[torch.Tensor]
centroid: Verb[torch.Tensor]
ciou: Verb[torch.Tensor]
ciou_aabb: Verb[torch.Tensor]
ciou_fixed_weight: Verb[torch.Tensor]
ciou_hull: Verb[torch.Tensor]
ciou_rectangle: Verb[torch.Tensor]
circumcircle: Verb[torch.Tensor]
clearance: Verb[torch.Tensor]
closest_points: Verb[torch.Tensor]
contacts: Verb[torch.Tensor]
convert: Verb[torch.Tensor]
corners: Verb[torch.Tensor]
crossing: Verb[torch.Tensor]
depth: Verb[torch.Tensor]
diameter: Verb[torch.Tensor]
diou: Verb[torch.Tensor]
diou_aabb: Verb[torch.Tensor]
diou_hull: Verb[torch.Tensor]
diou_rectangle: Verb[torch.Tensor]
distance: Verb[torch.Tensor]
eiou: Verb[torch.Tensor]
eiou_aabb: Verb[torch.Tensor]
eiou_hull: Verb[torch.Tensor]
eiou_rectangle: Verb[torch.Tensor]
farthest_distance: Verb[torch.Tensor]
first_hit: Verb[torch.Tensor]
flip_y: Verb[torch.Tensor]
from_6d: Verb[torch.Tensor]
from_rotation_vector: Verb[torch.Tensor]
from_twist: Verb[torch.Tensor]
giou: Verb[torch.Tensor]
giou_aabb: Verb[torch.Tensor]
giou_hull: Verb[torch.Tensor]
giou_rectangle: Verb[torch.Tensor]
height: Verb[torch.Tensor]
hull_area: Verb[torch.Tensor]
incircle: Verb[torch.Tensor]
inertia: Verb[torch.Tensor]
interpolate: Verb[torch.Tensor]
intersection_area: Verb[torch.Tensor]
intersection_length: Verb[torch.Tensor]
intersection_volume: Verb[torch.Tensor]
inverse: Verb[torch.Tensor]
iof: Verb[torch.Tensor]
iou: Verb[torch.Tensor]
iou_bev: Verb[torch.Tensor]
jeffreys: Verb[torch.Tensor]
kfiou: Verb[torch.Tensor]
kullback_leibler: Verb[torch.Tensor]
left_jacobian: Verb[torch.Tensor]
left_jacobian_inverse: Verb[torch.Tensor]
length: Verb[torch.Tensor]
length_inside: Verb[torch.Tensor]
meeting: Verb[torch.Tensor]
minimum_circle: Verb[torch.Tensor]
minimum_rectangle: Verb[torch.Tensor]
move: Verb[torch.Tensor]
nearest_rotation: Verb[torch.Tensor]
penetration: Verb[torch.Tensor]
perimeter: Verb[torch.Tensor]
planes: Verb[torch.Tensor]
pose_at: Verb[torch.Tensor]
probiou: Verb[torch.Tensor]
project: Verb[torch.Tensor]
retract: Verb[torch.Tensor]
right_jacobian: Verb[torch.Tensor]
right_jacobian_inverse: Verb[torch.Tensor]
rotation_vector: Verb[torch.Tensor]
screw: Verb[torch.Tensor]
second_moments: Verb[torch.Tensor]
separation_aware: Verb[torch.Tensor]
signed_area: Verb[torch.Tensor]
signed_distance: Verb[torch.Tensor]
slant: Verb[torch.Tensor]
span: Verb[torch.Tensor]
squared_angle: Verb[torch.Tensor]
squared_distance: Verb[torch.Tensor]
squared_wasserstein: Verb[torch.Tensor]
support: Verb[torch.Tensor]
surface: Verb[torch.Tensor]
tangent_to: Verb[Any]
time_of_impact: Verb[torch.Tensor]
to_6d: Verb[torch.Tensor]
twist: Verb[Any]
volume: Verb[torch.Tensor]
wasserstein: Verb[torch.Tensor]
width: Verb[torch.Tensor]
winding: Verb[torch.Tensor]

//! Places on solids in the solids' own terms.
use super::by_normal::TURNED;
use super::piece::Place;
use super::smooth_solid::{EDGES, FACES, Solid};
use crate::arrays::Each;
use crate::{Scalar, Vec3};

/// A place on a solid in the solid's own terms.
#[derive(Clone, Copy, Debug)]
pub enum Grip<S> {
    /// Coordinates along the axes of an ellipsoid, over half the extents.
    Ball([S; 3]),
    /// A share of the axis, and a vector across it, over the radius there and times it.
    Round { share: S, arm: Vec3<S>, size: S },
    /// Coordinates along the axes of a box, over half the sides.
    Box([S; 3]),
    /// Corners with their shares.
    Corners([(usize, S); 3]),
}

/// Returns corners with the shares of a place on an edge or a face.
pub fn between<S: Scalar>(corners: &[usize], place: &Place<S>) -> Grip<S> {
    let (zero, one) = (S::zero(), S::one());
    let [x, y, _] = place.y;
    Grip::Corners(match *corners {
        [i, j] => [(i, one - place.s), (j, place.s), (i, zero)],
        [i, j, k] => [(i, one - x - y), (j, x), (k, y)],
        _ => [(corners[0], one), (corners[0], zero), (corners[0], zero)],
    })
}

impl<S: Scalar> Solid<S> {
    /// Returns the place on a piece in the solid's terms, given its number and the outer normal.
    pub fn held(&self, k: usize, place: &Place<S>, normal: Vec3<S>) -> Grip<S> {
        let (zero, one) = (S::zero(), S::one());
        let turned = k >= TURNED;
        let k = if turned { k - TURNED } else { k };
        let round = |ways: &[Vec3<S>; 2], share: S, size: S| {
            let [x, y] = match turned {
                true => {
                    let [x, y] = ways.each_as(|way| way.dot(normal));
                    let over = one.over((x * x + y * y).root());
                    [x * over, y * over]
                }
                false => [place.y[0], place.y[1]],
            };
            Grip::Round {
                share,
                arm: ways[0] * x + ways[1] * y,
                size,
            }
        };
        match self {
            Solid::Ball { ways, half, .. } => Grip::Ball(match turned {
                true => {
                    let y = [0, 1, 2].each_as(|k: usize| half[k] * ways[k].dot(normal));
                    let over = one.over((y[0] * y[0] + y[1] * y[1] + y[2] * y[2]).root());
                    y.each_as(|y| y * over)
                }
                false => place.y,
            }),
            Solid::Disc { ways, .. } => round(ways, zero, one),
            Solid::Cylinder { ways, .. } => {
                let share = match k {
                    0 | 2 => zero,
                    1 | 3 => one,
                    _ => place.s,
                };
                round(ways, share, one)
            }
            Solid::Cone { ways, .. } => match k {
                0 | 1 => round(ways, one, one),
                2 => round(ways, place.s, place.s),
                _ => Grip::Round {
                    share: zero,
                    arm: Vec3::zero(),
                    size: zero,
                },
            },
            Solid::Box { .. } => {
                let side = |plus: usize| if plus == 0 { -one } else { one };
                let mut along = [zero; 3];
                if k < 8 {
                    along = [side(k & 1), side(k & 2), side(k & 4)];
                } else if k < 20 {
                    let (j, sides) = ((k - 8) / 4, (k - 8) % 4);
                    along[j] = place.s + place.s - one;
                    along[(j + 1) % 3] = side(sides & 1);
                    along[(j + 2) % 3] = side(sides & 2);
                } else {
                    let j = (k - 20) / 2;
                    along[j] = side((k - 20) % 2);
                    along[(j + 1) % 3] = place.y[0];
                    along[(j + 2) % 3] = place.y[1];
                }
                Grip::Box(along)
            }
            Solid::Simplex { count, .. } => {
                let edges = [0, 0, 1, 3, 6][*count];
                match k {
                    k if k < *count => between(&[k], place),
                    k if k < count + edges => between(&EDGES[k - count], place),
                    _ => between(&FACES[k - count - edges], place),
                }
            }
        }
    }
}

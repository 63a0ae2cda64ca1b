//! The edges of an input by places, and what stands between the moved sides of two edges.
use super::capsules::Capsule;
use crate::Vec2;
use crate::polygon::Rings;
use crate::predicate::{Turn, turn_between};

/// The joint of an end of a side with its neighbour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Joint {
    /// Nothing: another side cuts it off.
    Inner,
    /// The arc about the place.
    Arc,
    /// The next side, which is in line with it.
    Straight(u32),
}

/// An arc about a place, between two sides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct OpenCorner {
    pub place: u32,
    pub sides: [u32; 2],
}

/// The number of no arc.
const NONE: u32 = u32::MAX;

/// Edges between distinct places, with their sides that move.
#[derive(Default)]
pub(super) struct Corners {
    pub edges: Vec<Capsule>,
    /// The vertices at both ends of each edge.
    pub vertices: Vec<[u32; 2]>,
    /// How each side starts and ends: by number.
    pub joints: Vec<[Joint; 2]>,
    pub arcs: Vec<OpenCorner>,
    /// The number of the arc about each place; [`NONE`] where there is none.
    pub arc_of: Vec<u32>,
    /// The place of each vertex.
    pub places: Vec<u32>,
    pub is_path: bool,
}

/// Returns the number of the place of each point, and how many there are.
fn places(points: &[Vec2<f64>]) -> (Vec<u32>, usize) {
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    let key = |k: u32| {
        let at = points[k as usize];
        (at.x, at.y)
    };
    order.sort_unstable_by(|&a, &b| {
        let ((ax, ay), (bx, by)) = (key(a), key(b));
        ax.total_cmp(&bx).then(ay.total_cmp(&by))
    });
    let (mut made, mut count) = (vec![0; points.len()], 0);
    for (k, &vertex) in order.iter().enumerate() {
        if k > 0 && key(order[k - 1]) != key(vertex) {
            count += 1;
        }
        made[vertex as usize] = count;
    }
    (made, count as usize + usize::from(!points.is_empty()))
}

impl Corners {
    /// Returns the edges of rings or open paths in local coordinates, backwards if all outside of the rings is to grow.
    /// `None` where two arcs would stand at one place, which no polygon has.
    pub fn new(rings: Rings<'_, f64>, is_path: bool, is_inward: bool) -> Option<Self> {
        let mut first = 0_u32;
        let points: Vec<_> = rings.iter().flatten().map(|v| *v + Vec2::zero()).collect();
        let (places, count) = places(&points);
        let mut made = Corners {
            is_path,
            ..Corners::default()
        };
        for ring in rings.iter() {
            let n = ring.len() as u32;
            let steps = if is_path { n.saturating_sub(1) } else { n };
            for k in 0..steps {
                let (from, to) = (first + k, first + (k + 1) % n);
                if places[from as usize] != places[to as usize] {
                    made.vertices
                        .push(if is_inward { [to, from] } else { [from, to] });
                }
            }
            first += n;
        }
        made.places = places;
        if is_path {
            made.drop_repeated();
        }
        for (number, ends) in (0..).zip(&made.vertices) {
            let [p, q] = ends.map(|v| points[v as usize]);
            let length = (q - p).length();
            made.edges.push(Capsule {
                number,
                ends: [p, q],
                places: ends.map(|v| made.places[v as usize]),
                way: (q - p) * (1.0 / length),
                length,
            });
        }
        made.join(count).then_some(made)
    }
    /// Removes edges of paths between places that another edge joins.
    fn drop_repeated(&mut self) {
        let places = &self.places;
        let pair = |ends: &[u32; 2]| {
            let [a, b] = ends.map(|v| places[v as usize]);
            (a.min(b), a.max(b))
        };
        let mut order: Vec<usize> = (0..self.vertices.len()).collect();
        order.sort_by_key(|&k| pair(&self.vertices[k]));
        let mut is_kept = vec![true; order.len()];
        for two in order.windows(2) {
            is_kept[two[1]] = pair(&self.vertices[two[0]]) != pair(&self.vertices[two[1]]);
        }
        let mut kept = is_kept.into_iter();
        self.vertices.retain(|_| kept.next().unwrap_or(true));
    }
    /// Returns the sides that move.
    pub fn sides(&self) -> impl Iterator<Item = u32> + use<> {
        let step = if self.is_path { 1 } else { 2 };
        (0..2 * self.edges.len() as u32).step_by(step)
    }
    /// Returns the places at the start and the end of a side.
    pub fn side_places(&self, side: u32) -> [u32; 2] {
        self.ordered(side, self.edges[side as usize / 2].places)
    }
    /// Returns the vertices at the start and the end of a side.
    pub fn side_vertices(&self, side: u32) -> [u32; 2] {
        self.ordered(side, self.vertices[side as usize / 2])
    }
    /// Returns the start and the end of a side before it moves.
    pub fn side_ends(&self, side: u32) -> [Vec2<f64>; 2] {
        self.ordered(side, self.edges[side as usize / 2].ends)
    }
    /// Returns the direction of a side, of length one.
    pub fn side_way(&self, side: u32) -> Vec2<f64> {
        let way = self.edges[side as usize / 2].way;
        if side.is_multiple_of(2) { way } else { -way }
    }
    fn ordered<T>(&self, side: u32, [a, b]: [T; 2]) -> [T; 2] {
        if side.is_multiple_of(2) {
            [a, b]
        } else {
            [b, a]
        }
    }
    /// Finds how sides are joined; `false` if two arcs stand at one place.
    fn join(&mut self, count: usize) -> bool {
        self.joints = vec![[Joint::Inner; 2]; 2 * self.edges.len()];
        // Sides that end at each place.
        let mut starts = vec![0_u32; count + 1];
        for side in self.sides() {
            starts[self.side_places(side)[1] as usize + 1] += 1;
        }
        for k in 0..count {
            starts[k + 1] += starts[k];
        }
        let mut next = starts.clone();
        let mut ending = vec![0_u32; starts[count] as usize];
        for side in self.sides() {
            let at = &mut next[self.side_places(side)[1] as usize];
            ending[*at as usize] = side;
            *at += 1;
        }
        self.arc_of = vec![NONE; count];
        for side in self.sides() {
            let place = self.side_places(side)[0] as usize;
            let here = &ending[starts[place] as usize..starts[place + 1] as usize];
            let way = self.side_ends(side);
            // The first edge clockwise from the side, seen from the place.
            let before = |&a: &u32, &b: &u32| {
                let [p, q] = [a, b].map(|k| self.back(k));
                let [x, y] = [p, q].map(|back| gap(way, back));
                let near = x.cmp(&y);
                near.then_with(|| match turn_between(p, q) {
                    Turn::Right => std::cmp::Ordering::Less,
                    Turn::Straight => std::cmp::Ordering::Equal,
                    Turn::Left => std::cmp::Ordering::Greater,
                })
            };
            let Some(&other) = here.iter().min_by(|a, b| before(a, b)) else {
                continue;
            };
            let joint = match gap(way, self.back(other)) {
                Gap::Less => continue,
                Gap::Half => [Joint::Straight(other), Joint::Straight(side)],
                Gap::More | Gap::Whole => {
                    let number = self.arcs.len() as u32;
                    if std::mem::replace(&mut self.arc_of[place], number) != NONE {
                        return false;
                    }
                    self.arcs.push(OpenCorner {
                        place: place as u32,
                        sides: [other, side],
                    });
                    [Joint::Arc; 2]
                }
            };
            self.joints[side as usize][0] = joint[0];
            self.joints[other as usize][1] = joint[1];
        }
        true
    }
    /// Returns the number of the arc about a place.
    pub fn arc(&self, place: u32) -> Option<u32> {
        let number = self.arc_of[place as usize];
        (number != NONE).then_some(number)
    }
    /// Returns the vertices of a corner from the end of one side to the start of the next one, all at one place.
    pub fn between(&self, first: u32, last: u32) -> Vec<u32> {
        let (low, high) = (first.min(last), first.max(last));
        let is_here = |k: u32| self.places[k as usize] == self.places[low as usize];
        if (low..=high).all(is_here) {
            (low..=high).collect()
        } else {
            vec![first, last]
        }
    }
    /// Returns the end and the start of a side.
    fn back(&self, side: u32) -> [Vec2<f64>; 2] {
        let [start, end] = self.side_ends(side);
        [end, start]
    }
}

/// The angle from one direction to another one clockwise, beside half a turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Gap {
    Less,
    Half,
    More,
    Whole,
}

fn gap(from: [Vec2<f64>; 2], to: [Vec2<f64>; 2]) -> Gap {
    match turn_between(from, to) {
        Turn::Right => Gap::Less,
        Turn::Left => Gap::More,
        Turn::Straight if (from[1] - from[0]).dot(to[1] - to[0]) < 0.0 => Gap::Half,
        Turn::Straight => Gap::Whole,
    }
}

//! Point-in-box queries of many points and many boxes.
//!
//! A tree of the boxes' bounds excludes boxes far from a point; [`contains`](crate::Obb2::contains) decides for the
//! others. So results equal the results of a loop over all points and boxes, for any number of threads.
use crate::error::{Argument, Error, Validate};
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::work::Interruption;
use crate::shape::{Aabb3, Obb3, YawBox3};
use crate::{Aabb2, Obb2, Real, Vec2, Vec3};

/// The largest number of boxes of a leaf, and of children of a node.
const FEW: usize = 8;
/// The number of points in a piece of work.
const PIECE: usize = 1024;

/// A kind of box that can contain points.
pub trait Container: Copy + Validate + Sync {
    /// A point of its space.
    type Point: Copy + Validate + Sync;
    /// Returns the coordinates of a point; in the plane the third one is zero.
    #[doc(hidden)]
    fn place(point: Self::Point) -> [f64; 3];
    /// Returns `true` if the point is in the box or on its border.
    #[must_use]
    fn holds(self, point: Self::Point) -> bool;
    /// Returns the lower and upper corner of bounds that contain every point of the box, with a margin for rounding.
    #[doc(hidden)]
    fn ends(self) -> [[f64; 3]; 2];
}

/// Adds a margin to bounds, for the rounding of the bounds and of the box's own frame.
fn with_room(low: [f64; 3], high: [f64; 3], epsilon: f64) -> [[f64; 3]; 2] {
    let of = |k: usize| low[k].abs() + high[k].abs() + (high[k] - low[k]);
    let room = 8.0 * epsilon * (of(0) + of(1) + of(2));
    [low.map(|x| x - room), high.map(|x| x + room)]
}

#[inline]
fn in_plane<T: Real>(point: Vec2<T>) -> [f64; 3] {
    [point.x.widen(), point.y.widen(), 0.0]
}
#[inline]
fn in_space<T: Real>(point: Vec3<T>) -> [f64; 3] {
    [point.x.widen(), point.y.widen(), point.z.widen()]
}

macro_rules! containers {
    ($($shape:ident of $point:ident at $place:ident: $own:ident => $bounds:expr;)*) => { $(
        impl<T: Real> Container for $shape<T> {
            type Point = $point<T>;
            #[inline]
            fn place(point: $point<T>) -> [f64; 3] {
                $place(point)
            }
            #[inline]
            fn holds(self, point: $point<T>) -> bool {
                self.contains(point)
            }
            fn ends(self) -> [[f64; 3]; 2] {
                let $own = self;
                let bounds = $bounds;
                with_room($place(bounds.min), $place(bounds.max), T::format().epsilon())
            }
        }
    )* };
}
containers! {
    Aabb2 of Vec2 at in_plane: own => own;
    Obb2 of Vec2 at in_plane: own => own.bounding();
    Aabb3 of Vec3 at in_space: own => own;
    YawBox3 of Vec3 at in_space: own => own.bounding();
    Obb3 of Vec3 at in_space: own => own.bounding();
}

/// A node of the tree: bounds around some neighbouring boxes.
struct Node {
    ends: [[f64; 3]; 2],
    /// The smallest index of a box in it.
    first: usize,
    /// The range of its children among the nodes, or of a leaf's boxes in the tree's order.
    from: usize,
    to: usize,
    is_leaf: bool,
}

/// A tree over bounds: the root is the last node.
struct BoxTree {
    nodes: Vec<Node>,
    order: Vec<usize>,
}

/// Returns the smallest bounds around all given ones.
fn around(all: impl Iterator<Item = [[f64; 3]; 2]>) -> [[f64; 3]; 2] {
    let none = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    all.fold(none, |[low, high], [l, h]| {
        [
            std::array::from_fn(|k| low[k].min(l[k])),
            std::array::from_fn(|k| high[k].max(h[k])),
        ]
    })
}

impl BoxTree {
    fn new(ends: &[[[f64; 3]; 2]]) -> Self {
        let mut order: Vec<usize> = (0..ends.len()).collect();
        halve(ends, &mut order);
        let mut nodes: Vec<Node> = order
            .chunks(FEW)
            .enumerate()
            .map(|(n, items)| Node {
                ends: around(items.iter().map(|&i| ends[i])),
                first: items.iter().copied().min().unwrap_or(0),
                from: n * FEW,
                to: n * FEW + items.len(),
                is_leaf: true,
            })
            .collect();
        let mut level = 0..nodes.len();
        while level.len() > 1 {
            let next = nodes.len();
            for from in level.clone().step_by(FEW) {
                let to = level.end.min(from + FEW);
                let children = &nodes[from..to];
                let node = Node {
                    ends: around(children.iter().map(|node| node.ends)),
                    first: children.iter().map(|node| node.first).min().unwrap_or(0),
                    from,
                    to,
                    is_leaf: false,
                };
                nodes.push(node);
            }
            level = next..nodes.len();
        }
        BoxTree { nodes, order }
    }

    /// Calls `found` with every box that contains the point, in the order of the tree. The answer is an upper limit:
    /// boxes with larger indices are skipped from then on.
    fn visit<B: Container>(
        &self,
        boxes: &[B],
        point: B::Point,
        stack: &mut Vec<usize>,
        mut found: impl FnMut(usize) -> usize,
    ) {
        let at = B::place(point);
        let mut below = usize::MAX;
        stack.clear();
        stack.extend(self.nodes.len().checked_sub(1));
        while let Some(n) = stack.pop() {
            let node = &self.nodes[n];
            let [low, high] = &node.ends;
            let is_near = (0..3).all(|k| low[k] <= at[k] && at[k] <= high[k]);
            if !is_near || node.first >= below {
                continue;
            }
            if !node.is_leaf {
                stack.extend(node.from..node.to);
                continue;
            }
            for &i in &self.order[node.from..node.to] {
                if i < below && boxes[i].holds(point) {
                    below = found(i);
                }
            }
        }
    }
}

/// Sorts items so that neighbours in space are neighbours in the list, by repeated halving along the longest side of
/// their bounds.
fn halve(ends: &[[[f64; 3]; 2]], items: &mut [usize]) {
    if items.len() <= FEW {
        return;
    }
    // Halving before adding avoids overflow.
    let middle = |i: usize, k: usize| ends[i][0][k] * 0.5 + ends[i][1][k] * 0.5;
    let width = |k: usize| {
        let all = items.iter().map(|&i| middle(i, k));
        let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(x), high.max(x))
        });
        high * 0.5 - low * 0.5
    };
    let (x, y, z) = (width(0), width(1), width(2));
    let k = if x >= y && x >= z {
        0
    } else {
        usize::from(z > y) + 1
    };
    // The left side has a whole number of leaves.
    let half = (items.len() / 2).next_multiple_of(FEW);
    items.select_nth_unstable_by(half, |&i, &j| {
        middle(i, k).total_cmp(&middle(j, k)).then(i.cmp(&j))
    });
    let (left, right) = items.split_at_mut(half);
    halve(ends, left);
    halve(ends, right);
}

fn check<P: Validate>(name: &'static str, shapes: &[P]) -> Result<(), Error> {
    for (row, shape) in shapes.iter().enumerate() {
        shape.validate().map_err(|flaw| Error::Invalid {
            argument: Argument::Named(name),
            item: row,
            flaw,
        })?;
    }
    Ok(())
}

/// Returns the results of `of` for every piece of the points, in order.
fn pieces<B: Container, R: Send>(
    points: &[B::Point],
    boxes: &[B],
    of: impl Fn(&BoxTree, usize, &[B::Point]) -> R + Sync,
) -> Result<Vec<R>, Error> {
    check("points", points)?;
    check("boxes", boxes)?;
    let ends: Vec<_> = boxes.iter().map(|one| one.ends()).collect();
    let tree = BoxTree::new(&ends);
    let interruption = Interruption::current();
    let run = |(piece, points)| (!interruption.is_due()).then(|| of(&tree, piece * PIECE, points));
    #[cfg(feature = "parallel")]
    if crate::kernels::cpu::work::is_parallel() {
        use rayon::prelude::*;
        return Ok(points
            .par_chunks(PIECE)
            .enumerate()
            .filter_map(run)
            .collect());
    }
    Ok(points.chunks(PIECE).enumerate().filter_map(run).collect())
}

impl Cpu {
    /// Returns the index of the first box that contains each point, or `None`.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a point or box that is not valid, with its row.
    ///
    /// ```
    /// use geograd::{Vec3, YawBox3, kernels::Cpu};
    /// let size = Vec3::new(4.0_f32, 2.0, 1.5);
    /// let cars = [0.0, 3.0, 9.0].map(|x| YawBox3::new(Vec3::new(x, 0.0, 0.0), size, 0.0));
    /// let points = [1.5, 4.5, 6.5].map(|x| Vec3::new(x, 0.5, 0.5));
    /// let cpu = Cpu::new();
    /// assert_eq!(cpu.first_box(&points, &cars)?, [Some(0), Some(1), None]);
    /// assert_eq!(cpu.boxes_of_points(&points, &cars)?, [(0, 0), (0, 1), (1, 1)]);
    /// assert_eq!(cpu.points_per_box(&points, &cars)?, [1, 2, 0]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn first_box<B: Container>(
        &self,
        points: &[B::Point],
        boxes: &[B],
    ) -> Result<Vec<Option<usize>>, Error> {
        let all = pieces(points, boxes, |tree, _, points| {
            let mut stack = Vec::new();
            let first = |&point: &B::Point| {
                let mut first = None;
                tree.visit(boxes, point, &mut stack, |i| *first.insert(i));
                first
            };
            points.iter().map(first).collect::<Vec<_>>()
        })?;
        Ok(all.concat())
    }

    /// Returns every point with every box that contains it, as indices, ordered by point and then by box.
    ///
    /// # Errors
    ///
    /// As [`first_box`](Cpu::first_box).
    pub fn boxes_of_points<B: Container>(
        &self,
        points: &[B::Point],
        boxes: &[B],
    ) -> Result<Vec<(usize, usize)>, Error> {
        let all = pieces(points, boxes, |tree, start, points| {
            let (mut stack, mut pairs) = (Vec::new(), Vec::new());
            for (n, &point) in points.iter().enumerate() {
                let from = pairs.len();
                tree.visit(boxes, point, &mut stack, |i| {
                    pairs.push((start + n, i));
                    usize::MAX
                });
                pairs[from..].sort_unstable();
            }
            pairs
        })?;
        Ok(all.concat())
    }

    /// Returns the number of points in every box.
    ///
    /// # Errors
    ///
    /// As [`first_box`](Cpu::first_box).
    pub fn points_per_box<B: Container>(
        &self,
        points: &[B::Point],
        boxes: &[B],
    ) -> Result<Vec<usize>, Error> {
        let mut counts = vec![0; boxes.len()];
        for (_, i) in self.boxes_of_points(points, boxes)? {
            counts[i] += 1;
        }
        Ok(counts)
    }
}

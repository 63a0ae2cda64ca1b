//! Inputs on a grid of whole numbers, edge by edge.
use super::cut::Numbered;
use super::snap::Squares;
use super::{EdgeId, Owner, VertexId};
use crate::error::{Argument, Error, Flaw, VertexFault};
use crate::polygon::Rings;
use crate::predicate::wide;
use crate::{Scalar, Vec2};
use i_overlay::i_float::int::point::IntPoint;

/// The extent of both inputs together in grid units. Whole numbers may have up to 62 bits; coordinates
/// down to a fraction of 2⁻⁷ of the extent, which have 53, lie on the grid exactly.
const EXTENT: f64 = (1_u64 << 59) as f64;

/// An edge of an input.
pub(super) struct Edge {
    pub id: EdgeId,
    /// The vertex at which it ends.
    pub end: usize,
    /// Both ends on the grid.
    pub ends: [IntPoint<i64>; 2],
    /// From start to end.
    pub along: Vec2<f64>,
}

impl Edge {
    /// Returns the vertex that one of its ends is.
    pub fn vertex(&self, at_end: bool) -> VertexId {
        VertexId {
            owner: self.id.owner,
            ring: self.id.ring,
            vertex: if at_end { self.end } else { self.id.edge },
        }
    }
    /// Returns the fraction of the edge at which a point on it lies: 0 at its start, 1 at its end.
    pub fn share(&self, at: IntPoint<i64>) -> f64 {
        let start = self.ends[0];
        let way = Vec2::new((at.x - start.x) as f64, (at.y - start.y) as f64);
        way.dot(self.along) / self.along.length_squared()
    }
    /// Returns the vertex of this edge at a point, or `None` if neither end is there.
    pub fn vertex_at(&self, at: IntPoint<i64>) -> Option<VertexId> {
        [false, true]
            .into_iter()
            .find(|&end| self.ends[usize::from(end)] == at)
            .map(|end| self.vertex(end))
    }
}

/// The origin of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Steps {
    /// From near both inputs, so that far away it is no coarser.
    Fine,
    /// The origin of coordinates, so that points of a coarser grid are numbers of the format.
    Exact,
}

/// The steps of a grid for both inputs.
pub(super) struct Scale {
    axes: [Axis; 2],
    /// Half a coordinate times this is from two to four where it is largest.
    unit: f64,
}

/// The edges of both inputs on the grid, without those of length zero.
pub(super) struct Grid {
    pub edges: Vec<Edge>,
    scale: Scale,
    /// Every ring's vertices on the grid, of both inputs.
    places: [Vec<Vec<IntPoint<i64>>>; 2],
}

impl Scale {
    pub fn new<S: Scalar<Mask = bool>>(inputs: [Rings<'_, S>; 2], steps: Steps) -> Self {
        let vertices = inputs.iter().flat_map(|rings| rings.iter()).flatten();
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for &vertex in vertices {
            let at = wide(vertex).unwrap_or([0.0; 2]);
            for k in 0..2 {
                low[k] = low[k].min(at[k]);
                high[k] = high[k].max(at[k]);
            }
        }
        let axes = [0, 1].map(|k| match steps {
            Steps::Fine => Axis::new(low[k], high[k]),
            Steps::Exact => Axis::from_zero(low[k], high[k]),
        });
        let reach = axes[0].reach.max(axes[1].reach);
        // Half of it near one; both factors are powers of two.
        let unit = if reach > 0.0 {
            Scalar::binade(reach)
        } else {
            1.0
        };
        Scale { axes, unit }
    }
    /// Returns the nearest point of the grid.
    pub fn place<S: Scalar<Mask = bool>>(&self, vertex: Vec2<S>) -> IntPoint<i64> {
        let whole = |x: f64, axis: &Axis| {
            let half = (x * 0.5 - axis.from * 0.5) * self.unit;
            // Below four in size: at most 2⁶¹.
            (half * EXTENT).round() as i64
        };
        let [x, y] = wide(vertex).unwrap_or([0.0; 2]);
        IntPoint::new(whole(x, &self.axes[0]), whole(y, &self.axes[1]))
    }
    /// Returns the coordinates of a point of the grid of [`squares`].
    pub fn coordinates<S: Scalar>(&self, at: IntPoint<i64>) -> [f64; 2] {
        let steps = EXTENT / (1_u64 << squares::<S>().bits) as f64;
        [at.x, at.y].map(|x| x as f64 / steps / self.unit * 2.0)
    }
}

impl Grid {
    pub fn new<S: Scalar<Mask = bool>>(
        inputs: [Rings<'_, S>; 2],
        steps: Steps,
    ) -> Result<Self, Error> {
        let scale = Scale::new(inputs, steps);
        let places = inputs.map(|rings| {
            let ring = |ring: &[Vec2<S>]| ring.iter().map(|&v| scale.place(v)).collect();
            rings.iter().map(ring).collect::<Vec<_>>()
        });
        let mut grid = Grid {
            edges: Vec::new(),
            scale,
            places,
        };
        for (owner, rings) in [Owner::A, Owner::B].into_iter().zip(inputs) {
            for (ring, vertices) in rings.iter().enumerate() {
                grid.add(
                    EdgeId {
                        owner,
                        ring,
                        edge: 0,
                    },
                    vertices,
                )?;
            }
        }
        Ok(grid)
    }
    fn add<S: Scalar<Mask = bool>>(&mut self, id: EdgeId, ring: &[Vec2<S>]) -> Result<(), Error> {
        let places = &self.places[id.owner as usize][id.ring];
        for edge in 0..ring.len() {
            let end = if edge + 1 < ring.len() { edge + 1 } else { 0 };
            let ends = [places[edge], places[end]];
            if ends[0] == ends[1] {
                continue;
            }
            if self.edges.len() >= Tag::MOST {
                let fault = VertexFault::Surplus;
                return Err(invalid(
                    id.owner,
                    Flaw::Ring {
                        ring: id.ring,
                        index: edge,
                        fault,
                    },
                ));
            }
            let along = [0, 1].map(|k| {
                let [from, to] = ends.map(|p| if k == 0 { p.x } else { p.y });
                // Differences of whole numbers below 2⁶¹.
                (to - from) as f64
            });
            self.edges.push(Edge {
                id: EdgeId { edge, ..id },
                end,
                ends,
                along: Vec2::new(along[0], along[1]),
            });
        }
        Ok(())
    }
    /// Returns the edges in pieces that meet at their ends only, on a coarser grid: each piece with the number of its
    /// edge. Ends of edges and vertices are on that grid from now on.
    pub fn snap(&mut self, squares: Squares) -> Numbered {
        let ends: Vec<_> = self.edges.iter().map(|edge| edge.ends).collect();
        let mut pieces = Vec::new();
        for (k, path) in squares.along(&ends).into_iter().enumerate() {
            pieces.extend(path.windows(2).map(|pair| (k, [pair[0], pair[1]])));
        }
        for edge in &mut self.edges {
            edge.ends = edge.ends.map(|at| squares.of(at));
            let along = [0, 1].map(|k| {
                let [from, to] = edge.ends.map(|p| if k == 0 { p.x } else { p.y });
                (to - from) as f64
            });
            edge.along = Vec2::new(along[0], along[1]);
        }
        for at in self.places.iter_mut().flatten().flatten() {
            *at = squares.of(*at);
        }
        pieces
    }
    /// Returns the coordinates of a point of the grid of [`squares`].
    pub fn coordinates<S: Scalar>(&self, at: IntPoint<i64>) -> [f64; 2] {
        self.scale.coordinates::<S>(at)
    }
    /// Returns `true` if two vertices are one, or are successive ones of a ring that coincide.
    pub fn is_joined(&self, a: VertexId, b: VertexId) -> bool {
        if (a.owner, a.ring) != (b.owner, b.ring) {
            return false;
        }
        let ring = &self.places[a.owner as usize][a.ring];
        let (n, here) = (ring.len(), ring[a.vertex]);
        let way = (b.vertex + n - a.vertex) % n;
        let alike =
            |mut steps: std::ops::Range<usize>| steps.all(|k| ring[(a.vertex + k) % n] == here);
        alike(0..way + 1) || alike(way..n)
    }
}

/// Returns the squares of an exact grid whose centres are numbers of the format: steps of the largest coordinate.
pub(super) fn squares<S: Scalar>() -> Squares {
    // The exponent of a power of two.
    let bits = (EXTENT * 2.0 * S::format().epsilon()).to_bits() >> 52;
    Squares {
        bits: bits as u32 - 1023,
    }
}

/// The range of a coordinate: its origin, and its extent from there.
struct Axis {
    from: f64,
    reach: f64,
}

impl Axis {
    fn new(low: f64, high: f64) -> Self {
        let half = high * 0.5 - low * 0.5;
        // Far away all differences are exact; near zero there is no need for any.
        let nearest = if low > 0.0 { low } else { (-high).max(0.0) };
        let from = match nearest * 0.5 > 2.0 * half {
            true => low,
            false => 0.0,
        };
        let reach = (low * 0.5 - from * 0.5)
            .abs()
            .max((high * 0.5 - from * 0.5).abs());
        Axis { from, reach }
    }
    /// Creates an axis whose coordinates are relative to zero.
    fn from_zero(low: f64, high: f64) -> Self {
        let reach = (low * 0.5).abs().max((high * 0.5).abs());
        Axis { from: 0.0, reach }
    }
}

/// Returns a flaw of one of the inputs.
pub(super) fn invalid(owner: Owner, flaw: Flaw) -> Error {
    let argument = match owner {
        Owner::A => Argument::A,
        Owner::B => Argument::B,
    };
    Error::Invalid {
        argument,
        item: 0,
        flaw,
    }
}

/// A set of edges that lie along each other: the number of one, or that of two sets joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tag(u32);

impl Tag {
    /// The largest number of edges.
    const MOST: usize = 1 << 31;

    pub fn edge(k: usize) -> Self {
        Tag(k as u32)
    }
    pub fn joined(a: Tag, b: Tag, sets: &mut Vec<[Tag; 2]>) -> Self {
        if a == b {
            return a;
        }
        sets.push([a, b]);
        Tag((Self::MOST + sets.len() - 1) as u32)
    }
    /// Adds the numbers of all edges of the set to a list, each once.
    pub fn edges(self, sets: &[[Tag; 2]], to: &mut Vec<usize>) {
        match (self.0 as usize).checked_sub(Self::MOST) {
            Some(k) => sets[k].iter().for_each(|part| part.edges(sets, to)),
            None if !to.contains(&(self.0 as usize)) => to.push(self.0 as usize),
            None => {}
        }
    }
}

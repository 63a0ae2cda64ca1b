//! Edges of a plane graph, each in both directions, with their order around vertices.

/// The edges: number `e` runs back as `e ^ 1`.
pub(super) struct HalfEdges {
    all: Vec<HalfEdge>,
    /// Removed ones, whose places are used again.
    removed: Vec<u32>,
}

/// One direction of an edge.
#[derive(Clone, Copy)]
struct HalfEdge {
    /// The vertex at which it begins.
    origin: u32,
    /// The next one around its origin, counter-clockwise.
    next: u32,
    /// The next one around its origin, clockwise.
    previous: u32,
}

/// The origin of a removed edge.
const NOWHERE: u32 = u32::MAX;

/// Returns the same edge in the other direction.
#[inline(always)]
pub(super) fn back(e: u32) -> u32 {
    e ^ 1
}

impl HalfEdges {
    /// Creates the edges of a graph of so many vertices, without edges, with room for a triangulation.
    pub fn with_room(vertices: usize) -> Self {
        HalfEdges {
            all: Vec::with_capacity(6 * vertices),
            removed: Vec::new(),
        }
    }
    /// Returns the number of directed edges, removed ones included.
    pub fn len(&self) -> usize {
        self.all.len()
    }
    /// Returns `true` for an edge that is part of the graph.
    pub fn is_present(&self, e: u32) -> bool {
        self.from(e) != NOWHERE
    }
    /// Returns the vertex at which an edge begins.
    #[inline(always)]
    pub fn from(&self, e: u32) -> u32 {
        self.all[e as usize].origin
    }
    /// Returns the vertex at which an edge ends.
    #[inline(always)]
    pub fn to(&self, e: u32) -> u32 {
        self.from(back(e))
    }
    /// Returns the next edge around the origin, counter-clockwise.
    #[inline(always)]
    pub fn left_of(&self, e: u32) -> u32 {
        self.all[e as usize].next
    }
    /// Returns the next edge around the origin, clockwise.
    #[inline(always)]
    pub fn right_of(&self, e: u32) -> u32 {
        self.all[e as usize].previous
    }
    /// Returns the edge after this one around the face on its left.
    #[inline(always)]
    pub fn after(&self, e: u32) -> u32 {
        self.right_of(back(e))
    }
    /// Adds an edge between two vertices, without neighbours at either.
    pub fn add(&mut self, from: u32, to: u32) -> u32 {
        let e = self.removed.pop().unwrap_or(self.all.len() as u32);
        for (e, origin) in [(e, from), (back(e), to)] {
            let alone = HalfEdge {
                origin,
                next: e,
                previous: e,
            };
            match self.all.get_mut(e as usize) {
                Some(place) => *place = alone,
                None => self.all.push(alone),
            }
        }
        e
    }
    /// Exchanges what follows two edges around their origins: joins two rings of edges to one, or parts one into two.
    pub fn splice(&mut self, a: u32, b: u32) {
        let (after_a, after_b) = (self.left_of(a), self.left_of(b));
        self.all[a as usize].next = after_b;
        self.all[after_b as usize].previous = a;
        self.all[b as usize].next = after_a;
        self.all[after_a as usize].previous = b;
    }
    /// Adds an edge from the end of one edge to the start of another one, which share their left face.
    pub fn connect(&mut self, a: u32, b: u32) -> u32 {
        let e = self.add(self.to(a), self.from(b));
        let after = self.after(a);
        self.splice(e, after);
        self.splice(back(e), b);
        e
    }
    /// Removes an edge.
    pub fn remove(&mut self, e: u32) {
        for e in [e, back(e)] {
            let beside = self.right_of(e);
            self.splice(e, beside);
            self.all[e as usize].origin = NOWHERE;
        }
        self.removed.push(e & !1);
    }
}

//! Borrowed rings, and owned rings.
use crate::error::{Flaw, Validate, VertexFault};
use crate::predicate::same;
use crate::reference::bounds_of;
use crate::shape::edges;
use crate::{Aabb2, Pack, Scalar, Vec2};

/// The rings of a polygon, as a view of someone else's vertices. The last vertex of a ring is joined to
/// its first one.
///
/// ```
/// use geograd::{Aabb2, Rings};
/// let (outer, hole) = (Aabb2::new(0.0, 0.0, 4.0, 4.0).corners(), Aabb2::new(1.0, 1.0, 2.0, 2.0).corners());
/// let both = [outer.as_slice(), &hole];
/// assert_eq!(Rings::from(&both[..]).vertex_count(), 8);
/// assert_eq!(Rings::from(&outer[..]).count(), 1);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Rings<'a, S> {
    source: RingSource<'a, S>,
}

#[derive(Clone, Copy, Debug)]
enum RingSource<'a, S> {
    One(&'a [Vec2<S>]),
    Slices(&'a [&'a [Vec2<S>]]),
    Lists(&'a [Vec<Vec2<S>>]),
    Flat(&'a [Vec2<S>], &'a [usize]),
}

impl<'a, S> Rings<'a, S> {
    /// Creates rings from the vertices of all rings one after the other, and the number of vertices up to the end of
    /// each ring. Ends beyond the vertices, or below the previous end, are clamped.
    #[must_use]
    pub fn flat(vertices: &'a [Vec2<S>], ends: &'a [usize]) -> Self {
        let source = RingSource::Flat(vertices, ends);
        Rings { source }
    }
    /// Returns the number of rings.
    #[must_use]
    #[inline]
    pub fn count(&self) -> usize {
        match self.source {
            RingSource::One(_) => 1,
            RingSource::Slices(all) => all.len(),
            RingSource::Lists(all) => all.len(),
            RingSource::Flat(_, ends) => ends.len(),
        }
    }
    /// Returns the vertices of a ring; none for an index beyond the last one.
    #[must_use]
    #[inline]
    pub fn ring(&self, k: usize) -> &'a [Vec2<S>] {
        let found = match self.source {
            RingSource::One(ring) => (k == 0).then_some(ring),
            RingSource::Slices(all) => all.get(k).copied(),
            RingSource::Lists(all) => all.get(k).map(Vec::as_slice),
            RingSource::Flat(vertices, ends) => ends.get(k).and_then(|&end| {
                let start = k.checked_sub(1).map_or(0, |before| ends[before]);
                vertices.get(start..end.min(vertices.len()))
            }),
        };
        found.unwrap_or(&[])
    }
    /// Returns all rings.
    #[inline]
    pub fn iter(&self) -> impl Iterator<Item = &'a [Vec2<S>]> + 'a
    where
        S: Copy,
    {
        let all = *self;
        (0..all.count()).map(move |k| all.ring(k))
    }
    /// Returns the number of vertices of all rings together.
    #[must_use]
    #[inline]
    pub fn vertex_count(&self) -> usize
    where
        S: Copy,
    {
        self.iter().map(<[_]>::len).sum()
    }
}

impl<S: Scalar> Rings<'_, S> {
    /// Returns the smallest axis-aligned box around all rings, without derivatives; `None` without vertices.
    #[must_use]
    #[inline]
    pub(crate) fn bounds(&self) -> Option<Aabb2<S>> {
        self.iter().filter_map(bounds_of).reduce(|a, b| a.join(b))
    }
    /// Returns the smallest axis-aligned box around all rings; ties share the derivative. `None` without vertices.
    ///
    /// ```
    /// use geograd::{Aabb2, Rings, Vec2};
    /// let triangle = [(1.0, 1.0), (4.0, 2.0), (2.0, 5.0)].map(|(x, y)| Vec2::new(x, y));
    /// assert_eq!(Rings::from(&triangle[..]).bounding(), Some(Aabb2::new(1.0, 1.0, 4.0, 5.0)));
    /// ```
    #[must_use]
    #[inline]
    pub fn bounding(&self) -> Option<Aabb2<S>> {
        let all = self.iter().filter_map(Aabb2::around);
        all.reduce(|a, b| Aabb2 {
            min: a.min.least(b.min),
            max: a.max.most(b.max),
        })
    }
    /// Returns `Ok` when every coordinate is finite and every ring has three distinct vertices.
    ///
    /// # Errors
    ///
    /// [`Flaw::Ring`] with the ring and its first vertex at fault: of fewer than three vertices the number of them, of
    /// more at fewer than three points the first one that coincides with an earlier one.
    pub fn validate(&self) -> Result<(), Flaw>
    where
        S: Scalar<Mask = bool>,
    {
        for (ring, vertices) in self.iter().enumerate() {
            let flaw = |index, fault| Err(Flaw::Ring { ring, index, fault });
            if let Some(index) = vertices.iter().position(|vertex| !vertex.is_finite()) {
                return flaw(index, VertexFault::NotFinite);
            }
            let mut others = vertices.iter().filter(|v| !same(**v, vertices[0]));
            let second = others.next();
            if second.is_some_and(|second| others.any(|third| !same(*second, *third))) {
                continue;
            }
            if vertices.len() < 3 {
                return flaw(vertices.len(), VertexFault::Missing);
            }
            let is_known = |&i: &usize| vertices[..i].iter().any(|v| same(*v, vertices[i]));
            // If three vertices are at two points, two of them coincide.
            let index = (1..3).find(is_known).unwrap_or(2);
            return flaw(index, VertexFault::Coincident);
        }
        Ok(())
    }
    /// Returns a polygon that owns copies of the rings' vertices.
    #[must_use]
    pub fn to_polygon(&self) -> Polygon<S> {
        Polygon::from_rings(self.iter())
    }
}

impl<'a, S> From<&'a [Vec2<S>]> for Rings<'a, S> {
    /// Creates rings of one ring.
    fn from(ring: &'a [Vec2<S>]) -> Self {
        let source = RingSource::One(ring);
        Rings { source }
    }
}
impl<'a, S> From<&'a Vec<Vec2<S>>> for Rings<'a, S> {
    /// Creates rings of one ring.
    fn from(ring: &'a Vec<Vec2<S>>) -> Self {
        ring.as_slice().into()
    }
}
impl<'a, S, const N: usize> From<&'a [Vec2<S>; N]> for Rings<'a, S> {
    /// Creates rings of one ring.
    fn from(ring: &'a [Vec2<S>; N]) -> Self {
        ring.as_slice().into()
    }
}
impl<'a, S> From<&'a [&'a [Vec2<S>]]> for Rings<'a, S> {
    /// Creates rings from a list of them.
    fn from(all: &'a [&'a [Vec2<S>]]) -> Self {
        let source = RingSource::Slices(all);
        Rings { source }
    }
}
impl<'a, S> From<&'a [Vec<Vec2<S>>]> for Rings<'a, S> {
    /// Creates rings from a list of them.
    fn from(all: &'a [Vec<Vec2<S>>]) -> Self {
        let source = RingSource::Lists(all);
        Rings { source }
    }
}
impl<'a, S> From<&'a Polygon<S>> for Rings<'a, S> {
    /// Returns the rings of the polygon.
    fn from(polygon: &'a Polygon<S>) -> Self {
        Rings::flat(&polygon.vertices, &polygon.ends)
    }
}

/// A polygon with holes and of many parts: rings of either orientation. See the [module](super).
///
/// It is a [`Pack`], so that functions of polygons are differentiated like those of other shapes.
///
/// ```
/// use geograd::{Aabb2, Polygon, polygon};
/// let frame = Polygon::try_from_rings([
///     &Aabb2::new(0.0, 0.0, 4.0, 3.0).corners()[..],
///     &Aabb2::new(1.0, 1.0, 3.0, 2.0).corners(),
/// ])?;
/// assert_eq!(polygon::area(&frame), 10.0);
/// let (area, derivatives) = geograd::gradient(|p: Polygon<_>| polygon::area(&p), frame);
/// assert_eq!((area, derivatives.ring(1)[0].x), (10.0, 0.5)); // a smaller hole, a larger area
/// # Ok::<(), geograd::Flaw>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polygon<S> {
    vertices: Vec<Vec2<S>>,
    ends: Vec<usize>,
}

impl<S> Polygon<S> {
    /// Creates a polygon without rings.
    #[must_use]
    pub const fn new() -> Self {
        Polygon {
            vertices: Vec::new(),
            ends: Vec::new(),
        }
    }
    /// Creates a polygon from rings of either orientation, unchecked.
    #[must_use]
    pub fn from_rings<'r>(rings: impl IntoIterator<Item = &'r [Vec2<S>]>) -> Self
    where
        S: Copy + 'r,
    {
        let mut made = Self::new();
        for ring in rings {
            made.push(ring.iter().copied());
        }
        made
    }
    /// Creates a polygon from rings of either orientation.
    ///
    /// # Errors
    ///
    /// See [`Rings::validate`].
    pub fn try_from_rings<'r>(rings: impl IntoIterator<Item = &'r [Vec2<S>]>) -> Result<Self, Flaw>
    where
        S: Scalar<Mask = bool> + 'r,
    {
        let made = Self::from_rings(rings);
        made.rings().validate()?;
        Ok(made)
    }
    /// Adds a ring.
    pub fn push(&mut self, ring: impl IntoIterator<Item = Vec2<S>>) {
        self.vertices.extend(ring);
        self.ends.push(self.vertices.len());
    }
    /// Returns the rings.
    #[must_use]
    pub fn rings(&self) -> Rings<'_, S> {
        self.into()
    }
    /// Returns the vertices of a ring; none for an index beyond the last one.
    #[must_use]
    pub fn ring(&self, k: usize) -> &[Vec2<S>] {
        self.rings().ring(k)
    }
    /// Returns the vertices of all rings, one ring after the other.
    #[must_use]
    pub fn vertices(&self) -> &[Vec2<S>] {
        &self.vertices
    }
    /// Returns the vertices of all rings, one ring after the other, for change.
    #[must_use]
    pub fn vertices_mut(&mut self) -> &mut [Vec2<S>] {
        &mut self.vertices
    }
    /// Returns the number of vertices up to the end of each ring.
    #[must_use]
    pub fn ends(&self) -> &[usize] {
        &self.ends
    }
}

impl<S: Clone> Pack for Polygon<S> {
    type Scalar = S;
    type With<T: Clone> = Polygon<T>;
    fn remake<T: Clone>(&self, f: &mut impl FnMut(&S) -> T) -> Polygon<T> {
        let mut each = |v: &Vec2<S>| Vec2::new(f(&v.x), f(&v.y));
        Polygon {
            vertices: self.vertices.iter().map(&mut each).collect(),
            ends: self.ends.clone(),
        }
    }
    fn each(&mut self, f: &mut impl FnMut(&mut S)) {
        for vertex in &mut self.vertices {
            f(&mut vertex.x);
            f(&mut vertex.y);
        }
    }
}

impl<S: Scalar<Mask = bool>> Validate for Polygon<S> {
    fn validate(&self) -> Result<(), Flaw> {
        self.rings().validate()
    }
}

impl<S: Scalar> Rings<'_, S> {
    /// Calls something for every edge: its ring, the numbers of its ends among all vertices, and both
    /// ends.
    #[inline(always)]
    pub(crate) fn each_edge(&self, mut f: impl FnMut(usize, [usize; 2], [Vec2<S>; 2])) {
        let mut first = 0;
        for (ring, vertices) in self.iter().enumerate() {
            for (k, ends) in edges(vertices).enumerate() {
                let next = if k + 1 < vertices.len() { k + 1 } else { 0 };
                f(ring, [first + k, first + next], ends);
            }
            first += vertices.len();
        }
    }
}

//! A polytope that is expanded from inside towards the difference of two solids (van den Bergen 2001): its faces with
//! their neighbours, and what a new corner takes away.
use super::gjk::Difference;
use crate::Vec3;
use crate::arrays::Each;
use smallvec::SmallVec;

/// A face of the polytope.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    /// Its corners, counter-clockwise seen from outside.
    pub corners: [u16; 3],
    /// The sides of other faces across the edges from each corner to the next one.
    beside: [Side; 3],
    /// Its normal, of length one; zero of a sliver.
    pub normal: Vec3<f64>,
    /// The height of its plane over the origin; infinite of a sliver.
    pub height: f64,
    /// `true` if it is no face any more.
    pub gone: bool,
}

/// A side of a face: the edge from a corner to the next one.
#[derive(Clone, Copy, Debug)]
struct Side(u16);

impl Side {
    /// Returns the side of a face that begins at one of its corners.
    fn new(face: usize, corner: usize) -> Self {
        debug_assert!(face < 1 << 14, "a polytope of few corners");
        Side((4 * face + corner) as u16)
    }
    /// Returns the numbers of the face and of the corner in it.
    fn parts(self) -> (usize, usize) {
        (usize::from(self.0 / 4), usize::from(self.0 % 4))
    }
}

/// An edge around faces below a point: its ends, and the side of the face beyond.
#[derive(Clone, Copy, Debug)]
struct Border {
    from: u16,
    to: u16,
    beyond: Side,
}

/// The numbers of corners and of faces, also those that are gone, up to which the polytope needs no heap.
const CORNERS: usize = 24;
const FACES: usize = 96;

/// The polytope so far.
#[derive(Debug)]
pub(super) struct Polytope<D> {
    /// The corners, at most 150: with all that are gone, faces are fewer than 2¹⁴.
    pub corners: SmallVec<[D; CORNERS]>,
    /// All faces, also those that are gone.
    pub faces: SmallVec<[Face; FACES]>,
    /// The heights of faces above which there may be something; infinite for all others.
    pub open: SmallVec<[f64; FACES]>,
    /// `true` if a face has been a sliver.
    pub has_slivers: bool,
    /// The edges around the faces below a point, counter-clockwise.
    border: SmallVec<[Border; CORNERS]>,
    /// The faces below a point.
    below: SmallVec<[usize; CORNERS]>,
    /// The height over a face's plane that is none.
    none: f64,
    /// The sine of the least angle of faces whose normals have digits enough.
    sliver: f64,
}

impl<D: Difference> Polytope<D> {
    /// Creates a polytope without corners, given the height over a plane that is none, and the sine of the least angle of
    /// a face that is no sliver.
    pub fn new(none: f64, sliver: f64) -> Self {
        Polytope {
            corners: SmallVec::new(),
            faces: SmallVec::new(),
            open: SmallVec::new(),
            has_slivers: false,
            border: SmallVec::new(),
            below: SmallVec::new(),
            none,
            sliver,
        }
    }
    /// Begins with a tetrahedron, given a number with the sign of the height of the last corner over the others,
    /// counter-clockwise seen from above.
    pub fn begin(&mut self, corners: [D; 4], height: f64) {
        self.corners.clear();
        self.faces.clear();
        self.open.clear();
        self.has_slivers = false;
        self.corners.extend(corners);
        // The last corner is behind the first face.
        let [b, c] = if height < 0.0 { [1, 2] } else { [2, 1] };
        let side = Side::new;
        self.add([0, b, c], [side(1, 2), side(2, 2), side(3, 2)]);
        self.add([0, 3, b], [side(3, 1), side(2, 0), side(0, 0)]);
        self.add([b, 3, c], [side(1, 1), side(3, 0), side(0, 1)]);
        self.add([c, 3, 0], [side(2, 1), side(1, 0), side(0, 2)]);
    }
    fn add(&mut self, corners: [usize; 3], beside: [Side; 3]) {
        let [p, q, r] = corners.each_as(|k| self.corners[k].way());
        let (u, v, w) = (q - p, r - p, r - q);
        let product = u.cross(v);
        let more = |x: f64, y: f64| if x > y { x } else { y };
        let squares = [u, v, w].each_as(|side| side.length_squared());
        let longest = more(more(squares[0], squares[1]), squares[2]);
        let square = product.length_squared();
        let is_sliver = square <= self.sliver * self.sliver * (longest * longest);
        let (normal, height) = match is_sliver {
            true => (Vec3::zero(), f64::INFINITY),
            false => {
                let normal = product * (1.0 / square.sqrt());
                let heights = [normal.dot(p), normal.dot(q), normal.dot(r)];
                (normal, more(more(heights[0], heights[1]), heights[2]))
            }
        };
        self.has_slivers |= is_sliver;
        self.open.push(height);
        self.faces.push(Face {
            corners: corners.each_as(|k| k as u16),
            beside,
            normal,
            height,
            gone: false,
        });
    }
    /// Returns the lowest of the faces above which there may be something, and its height.
    pub fn lowest(&self) -> Option<(usize, f64)> {
        let (mut first, mut least) = (0, f64::INFINITY);
        for (face, &height) in self.open.iter().enumerate() {
            // Selections, since no branch predictor knows which face is the lowest.
            let is_lower = height < least;
            first = if is_lower { face } else { first };
            least = if is_lower { height } else { least };
        }
        (least < f64::INFINITY).then_some((first, least))
    }
    /// Returns the corners of a face.
    pub fn corners_of(&self, face: &Face) -> [D; 3] {
        face.corners.each_as(|k| self.corners[usize::from(k)])
    }
    /// Takes a face away, with all around it that are below a point, and keeps the sides around these, in order
    /// counter-clockwise, beginning with a side of the face.
    fn take(&mut self, number: usize, first: usize, count: usize, apex: Vec3<f64>) {
        self.faces[number].gone = true;
        self.below.push(number);
        for k in first..first + count {
            let face = &self.faces[number];
            let k = if k < 3 { k } else { k - 3 };
            let beyond = face.beside[k];
            let (other, side) = beyond.parts();
            let beside = &self.faces[other];
            if beside.gone {
                continue;
            }
            if beside.normal.dot(apex) - beside.height > self.none {
                self.take(other, side + 1, 2, apex);
            } else {
                let next = if k == 2 { 0 } else { k + 1 };
                self.border.push(Border {
                    from: face.corners[k],
                    to: face.corners[next],
                    beyond,
                });
            }
        }
    }
    /// Extends the polytope to a point above a face. Returns `false`, and leaves it as it is, if the faces below the point
    /// are not in one piece by rounding.
    pub fn extend(&mut self, start: usize, apex: D) -> bool {
        self.border.clear();
        self.below.clear();
        self.take(start, 0, 3, apex.way());
        let count = self.border.len();
        let next = |k: usize| if k + 1 < count { k + 1 } else { 0 };
        if count < 3 || !(0..count).all(|k| self.border[k].to == self.border[next(k)].from) {
            for &face in &self.below {
                self.faces[face].gone = false;
            }
            return false;
        }
        for &face in &self.below {
            self.open[face] = f64::INFINITY;
        }
        let (number, first) = (self.corners.len(), self.faces.len());
        self.corners.push(apex);
        for k in 0..count {
            let Border { from, to, beyond } = self.border[k];
            let before = if k > 0 { k - 1 } else { count - 1 };
            let corners = [usize::from(from), usize::from(to), number];
            let after = Side::new(first + next(k), 2);
            self.add(corners, [beyond, after, Side::new(first + before, 1)]);
            let (other, side) = beyond.parts();
            self.faces[other].beside[side] = Side::new(first + k, 0);
        }
        true
    }
}

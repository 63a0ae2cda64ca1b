//! A tree of eight over the faces of a mesh.
use super::mesh_column::{Mesh, plain};
use super::mesh_fault::MeshFault;
use super::packet::{NO_CHILD, PACKET, Packet, TreeNode};
use super::tree_split::{Bounds, parts};
use crate::{Scalar, Vec3};

/// The frame of a tree: coordinates relative to the mesh's middle, in units of a power of two in which they are at most
/// one. Differences of large coordinates keep their digits in single precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TreeFrame {
    /// The middle of the mesh's bounds.
    pub middle: Vec3<f64>,
    /// The power of two.
    pub scale: f64,
}

impl TreeFrame {
    fn of<S: Scalar<Mask = bool>>(mesh: &Mesh<'_, S>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for &vertex in mesh.vertices() {
            let Vec3 { x, y, z } = plain(vertex);
            for (k, x) in [x, y, z].into_iter().enumerate() {
                low[k] = if x < low[k] { x } else { low[k] };
                high[k] = if x > high[k] { x } else { high[k] };
            }
        }
        // Halves do not overflow.
        let [x, y, z] = [0, 1, 2].map(|k| 0.5 * low[k] + 0.5 * high[k]);
        let half = (0..3).fold(0.0, |most: f64, k| {
            Scalar::most(most, 0.5 * high[k] - 0.5 * low[k])
        });
        let scale = if half > 0.0 {
            0.25 * half.binade()
        } else {
            1.0
        };
        TreeFrame {
            middle: Vec3::new(x, y, z),
            scale,
        }
    }
    /// Returns a point in the frame.
    #[inline]
    #[must_use]
    pub fn local(&self, point: Vec3<f64>) -> Vec3<f64> {
        // Half of both first, so that the difference does not overflow.
        let half = point * 0.5 - self.middle * 0.5;
        half * self.scale * 2.0
    }
}

/// A tree over the faces of a [`Mesh`]: bounds of eight children a node, packets of eight triangles, in single
/// precision.
///
/// It keeps no reference, so threads and calls share it. [`refit`](MeshTree::refit) follows vertices that move.
#[derive(Clone, Debug)]
pub struct MeshTree {
    frame: TreeFrame,
    nodes: Vec<TreeNode>,
    packets: Vec<Packet>,
    /// The lowest face below each node.
    lowest: Vec<u32>,
    /// The faces of each packet, in order; a missing one repeats the last.
    faces: Vec<[u32; 8]>,
    /// The number of vertices and of faces that it was built over.
    counts: [usize; 2],
}

impl MeshTree {
    /// Builds a tree over a mesh, with a binned surface-area heuristic. Takes `O(n log n)` steps.
    #[must_use]
    pub fn new<S: Scalar<Mask = bool>>(mesh: &Mesh<'_, S>) -> Self {
        let frame = TreeFrame::of(mesh);
        let corners = frame.corners(mesh);
        let bounds: Vec<Bounds> = mesh
            .faces()
            .iter()
            .map(|face| Bounds::of(face.map(|i| corners[i as usize])))
            .collect();
        let mut tree = MeshTree {
            frame,
            nodes: Vec::new(),
            packets: Vec::new(),
            lowest: Vec::new(),
            faces: Vec::new(),
            counts: [mesh.vertices().len(), mesh.faces().len()],
        };
        let mut order: Vec<u32> = (0..bounds.len() as u32).collect();
        tree.grow(&mut order, &bounds, 0);
        tree.fill(mesh, &corners);
        tree
    }

    /// Adds a node over some faces and all below it; returns its number.
    fn grow(&mut self, order: &mut [u32], bounds: &[Bounds], depth: usize) -> u32 {
        let own = self.nodes.len();
        self.lowest.push(u32::MAX);
        self.nodes.push(TreeNode {
            bounds: [[[f32::INFINITY; 8]; 3], [[f32::NEG_INFINITY; 8]; 3]],
            children: [NO_CHILD; 8],
        });
        for (k, (start, end)) in parts(order, bounds, depth).into_iter().enumerate() {
            let items = &mut order[start..end];
            self.nodes[own].children[k] = if items.len() <= 8 {
                let last = items.len() - 1;
                items.sort_unstable();
                self.faces.push(std::array::from_fn(|l| items[l.min(last)]));
                PACKET | (self.faces.len() - 1) as u32
            } else {
                self.grow(items, bounds, depth + 1)
            };
            self.lowest[own] = self.lowest[own].min(self.lowest(self.nodes[own].children[k]));
        }
        own as u32
    }

    /// Writes the corners of all packets and the bounds of all nodes, children before their parents.
    fn fill<S: Copy>(&mut self, mesh: &Mesh<'_, S>, corners: &[[f32; 3]]) {
        self.packets.clear();
        let mut bounds_of_packets = Vec::with_capacity(self.faces.len());
        for faces in &self.faces {
            let mut packet = Packet {
                corners: [[[f32::NAN; 8]; 3]; 3],
            };
            let mut all = Bounds::none();
            for (lane, &face) in faces.iter().enumerate() {
                if lane > 0 && faces[lane - 1] == face {
                    break;
                }
                let triangle = mesh.faces()[face as usize].map(|i| corners[i as usize]);
                all = all.with(&Bounds::of(triangle));
                for (corner, place) in triangle.into_iter().enumerate() {
                    for (axis, x) in place.into_iter().enumerate() {
                        packet.corners[corner][axis][lane] = x;
                    }
                }
            }
            self.packets.push(packet);
            bounds_of_packets.push(all);
        }
        let mut bounds_of_nodes = vec![Bounds::none(); self.nodes.len()];
        for (number, node) in self.nodes.iter_mut().enumerate().rev() {
            for (k, &child) in node.children.iter().enumerate() {
                if child == NO_CHILD {
                    continue;
                }
                let bounds = match child & PACKET {
                    0 => bounds_of_nodes[child as usize],
                    _ => bounds_of_packets[(child ^ PACKET) as usize],
                };
                bounds_of_nodes[number] = bounds_of_nodes[number].with(&bounds);
                for axis in 0..3 {
                    node.bounds[0][axis][k] = bounds.low[axis];
                    node.bounds[1][axis][k] = bounds.high[axis];
                }
            }
        }
    }

    /// Follows a mesh whose vertices have moved and whose faces are as they were; queries stay right, and become slower
    /// as far as neighbours move apart. Takes `O(n)` steps.
    ///
    /// # Errors
    ///
    /// [`MeshFault::OtherTree`] for another number of vertices or faces; the tree is then as it was.
    pub fn refit<S: Scalar<Mask = bool>>(&mut self, mesh: &Mesh<'_, S>) -> Result<(), MeshFault> {
        self.check(mesh)?;
        self.frame = TreeFrame::of(mesh);
        let corners = self.frame.corners(mesh);
        self.fill(mesh, &corners);
        Ok(())
    }

    /// Returns `Ok` for a mesh of as many vertices and faces as the tree was built over.
    pub(super) fn check<S: Copy>(&self, mesh: &Mesh<'_, S>) -> Result<(), MeshFault> {
        let expected = [mesh.vertices().len(), mesh.faces().len()];
        if expected == self.counts {
            return Ok(());
        }
        Err(MeshFault::OtherTree {
            expected,
            found: self.counts,
        })
    }

    /// Returns the frame of its coordinates.
    #[inline]
    pub(crate) fn frame(&self) -> &TreeFrame {
        &self.frame
    }
    /// Returns the number of faces.
    #[inline]
    pub(super) fn face_count(&self) -> usize {
        self.counts[1]
    }
    /// Returns the nodes, the root first.
    #[inline]
    pub(crate) fn nodes(&self) -> &[TreeNode] {
        &self.nodes
    }
    /// Returns the lowest face below a child.
    #[inline(always)]
    pub(super) fn lowest(&self, child: u32) -> u32 {
        match child & PACKET {
            0 => self.lowest[child as usize],
            _ => self.faces[(child ^ PACKET) as usize][0],
        }
    }
    /// Returns a packet and its faces.
    #[inline(always)]
    pub(crate) fn packet(&self, number: usize) -> (&Packet, &[u32; 8]) {
        (&self.packets[number], &self.faces[number])
    }
}

impl TreeFrame {
    /// Returns all vertices in the frame, rounded.
    fn corners<S: Scalar<Mask = bool>>(&self, mesh: &Mesh<'_, S>) -> Vec<[f32; 3]> {
        let place = |&vertex: &Vec3<S>| {
            let Vec3 { x, y, z } = self.local(plain(vertex));
            [x as f32, y as f32, z as f32]
        };
        mesh.vertices().iter().map(place).collect()
    }
}

//! Meshes in files of OBJ, STL and PLY, read and written. Needs the feature `mesh-files`.
//!
//! | kind | read | written |
//! | --- | --- | --- |
//! | OBJ | [`read_obj`] | [`FileFormat::Obj`] |
//! | STL, text or binary | [`read_stl`] | [`FileFormat::StlText`], [`FileFormat::StlBinary`] |
//! | PLY, text or binary of either order of bytes | [`read_ply`] | [`FileFormat::PlyText`], [`FileFormat::PlyBinary`] |
//!
//! [`read_mesh_file`] and [`write_mesh_file`] take a path.
//!
//! ```
//! use geograd::Vec3;
//! use geograd::mesh_files::read_ply;
//! let text = b"ply
//! format ascii 1.0
//! element vertex 4
//! property float x
//! property float y
//! property float z
//! element face 1
//! property list uchar int vertex_indices
//! end_header
//! 0 0 0
//! 2 0 0
//! 2 2 0
//! 0 2 0
//! 4 0 1 2 3
//! ";
//! let file = read_ply(text)?;
//! assert_eq!(file.mesh()?.area(), 4.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Files are read whole, and memory is a small multiple of the file's size, whatever numbers the file declares. A
//! [`FileFault`] names the kind of file, the line or the byte, and the flaw. A file may have vertices that no face has, or
//! no faces: [`MeshFile::mesh`] decides.
//!
//! Faces with more than three corners become fans of triangles around their first corner. These fill convex polygons;
//! of another polygon they overlap.
mod file_fault;
mod file_text;
mod mesh_writer;
mod obj_text;
mod ply_body;
mod ply_header;
mod stl_facets;

use crate::mesh::{Mesh, MeshFault};
use crate::{Scalar, Vec3};
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::Path;

pub use file_fault::{FileFault, FileFlaw, FileKind, FilePlace};
pub use mesh_writer::{FileFormat, write_mesh};
pub use obj_text::read_obj;
pub use ply_body::read_ply;
pub use stl_facets::read_stl;

/// The vertices and faces of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshFile {
    /// The vertices, in the order of the file.
    pub vertices: Vec<Vec3<f64>>,
    /// The faces, each three vertices from zero.
    pub faces: Vec<[u32; 3]>,
}

impl MeshFile {
    /// Returns the mesh, checked.
    ///
    /// # Errors
    ///
    /// [`MeshFault::Empty`] for a file without faces. Results of readers have no other fault.
    pub fn mesh(&self) -> Result<Mesh<'_, f64>, MeshFault> {
        Mesh::new(&self.vertices, &self.faces)
    }
    /// Adds a vertex.
    fn add_vertex(&mut self, at: Vec3<f64>) -> Result<(), FileFlaw> {
        if self.vertices.len() >= i32::MAX as usize {
            return Err(FileFlaw::TooLarge);
        }
        self.vertices.push(at);
        Ok(())
    }
    /// Adds a face.
    fn add_face(&mut self, face: [u32; 3]) -> Result<(), FileFlaw> {
        if self.faces.len() >= i32::MAX as usize {
            return Err(FileFlaw::TooLarge);
        }
        self.faces.push(face);
        Ok(())
    }
}

impl FileKind {
    /// Returns the kind that the name of a file tells by its ending, in letters of either case.
    #[must_use]
    pub fn of_name(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match &ending[..] {
            "obj" => Some(FileKind::Obj),
            "stl" => Some(FileKind::Stl),
            "ply" => Some(FileKind::Ply),
            _ => None,
        }
    }
    /// Returns the mesh of a file of this kind.
    ///
    /// # Errors
    ///
    /// As [`read_obj`], [`read_stl`] and [`read_ply`].
    pub fn read(self, bytes: &[u8]) -> Result<MeshFile, FileFault> {
        match self {
            FileKind::Obj => read_obj(bytes),
            FileKind::Stl => read_stl(bytes),
            FileKind::Ply => read_ply(bytes),
        }
    }
}

/// Returns the mesh of a file, whose kind its name tells.
///
/// # Errors
///
/// [`FileFlaw::UnknownKind`] for another name, [`FileFlaw::System`] for a file that the system cannot read, and those of
/// the kind.
pub fn read_mesh_file(path: &Path) -> Result<MeshFile, FileFault> {
    let kind = FileKind::of_name(path).ok_or(FileFault {
        kind: None,
        place: FilePlace::Whole,
        flaw: FileFlaw::UnknownKind,
    })?;
    let bytes = std::fs::read(path).map_err(|error| FileFault::system(Some(kind), &error))?;
    kind.read(&bytes)
}

/// Writes a mesh to a file, whatever its name. A file that fails half way keeps what was written.
///
/// # Errors
///
/// As [`write_mesh`].
pub fn write_mesh_file<S: Scalar<Mask = bool>>(
    mesh: &Mesh<'_, S>,
    format: FileFormat,
    path: &Path,
) -> Result<(), FileFault> {
    let failed = |error| FileFault::system(Some(format.kind()), &error);
    let mut to = BufWriter::new(File::create(path).map_err(failed)?);
    write_mesh(mesh, format, &mut to)?;
    to.flush().map_err(failed)
}

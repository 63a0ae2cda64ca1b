//! Files of meshes, written.
use super::file_fault::{FileFault, FileFlaw, FileKind, FilePlace};
use super::stl_facets::HEAD;
use crate::mesh::{Mesh, plain};
use crate::{Scalar, Vec3};
use std::io::{self, Write};

/// How a file is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FileFormat {
    /// OBJ, a text in double precision.
    Obj,
    /// STL as text, in double precision.
    StlText,
    /// STL in bytes, in single precision.
    StlBinary,
    /// PLY as text, in double precision.
    PlyText,
    /// PLY in bytes, the lowest first, in double precision.
    PlyBinary,
}

impl FileFormat {
    /// Returns the kind of file.
    #[must_use]
    pub fn kind(self) -> FileKind {
        match self {
            FileFormat::Obj => FileKind::Obj,
            FileFormat::StlText | FileFormat::StlBinary => FileKind::Stl,
            FileFormat::PlyText | FileFormat::PlyBinary => FileKind::Ply,
        }
    }
}

/// Writes the statement of a vertex, in digits that are read as the same number.
fn line(to: &mut impl Write, head: &str, at: Vec3<f64>) -> io::Result<()> {
    writeln!(to, "{head}{:?} {:?} {:?}", at.x, at.y, at.z)
}

/// Returns the coordinates in single precision; `None` where one is too large for it.
fn narrow(at: Vec3<f64>) -> Option<[f32; 3]> {
    let narrow = [at.x, at.y, at.z].map(|x| x as f32);
    narrow.iter().all(|x| x.is_finite()).then_some(narrow)
}

/// Writes a mesh in a format. Memory does not grow with the mesh.
///
/// OBJ and PLY keep vertices and faces in their order, to the last bit. STL keeps triangles: [`read_stl`](super::read_stl)
/// makes one vertex of equal places, and none of a vertex without a face.
///
/// ```
/// use geograd::Vec3;
/// use geograd::mesh::Mesh;
/// use geograd::mesh_files::{FileFormat, read_obj, write_mesh};
/// let vertices = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.1, 0.0)].map(|(x, y, z)| Vec3::new(x, y, z));
/// let mesh = Mesh::new(&vertices, &[[0, 1, 2]])?;
/// let mut text = Vec::new();
/// write_mesh(&mesh, FileFormat::Obj, &mut text)?;
/// assert_eq!(text, b"v 0.0 0.0 0.0\nv 1.0 0.0 0.0\nv 0.0 0.1 0.0\nf 1 2 3\n");
/// assert_eq!(read_obj(&text)?.vertices, vertices);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// [`FileFlaw::NotFinite`] for a coordinate that single precision cannot hold, in STL in bytes: with the byte of its
/// triangle. [`FileFlaw::System`] where the output fails; it may have a part of the file then.
pub fn write_mesh<S: Scalar<Mask = bool>>(
    mesh: &Mesh<'_, S>,
    format: FileFormat,
    to: &mut impl Write,
) -> Result<(), FileFault> {
    let written = match format {
        FileFormat::Obj => obj(mesh, to),
        FileFormat::StlText => stl_text(mesh, to),
        FileFormat::StlBinary => {
            if let Some(face) = (0..mesh.faces().len()).find(|&face| {
                let corners = mesh.plain_triangle(face as u32);
                corners.iter().any(|&corner| narrow(corner).is_none())
            }) {
                let place = FilePlace::Byte(HEAD + super::stl_facets::FACET * face);
                return Err(format.kind().fault(place, FileFlaw::NotFinite));
            }
            stl_binary(mesh, to)
        }
        FileFormat::PlyText | FileFormat::PlyBinary => ply(mesh, format, to),
    };
    written.map_err(|error| FileFault::system(Some(format.kind()), &error))
}

fn obj<S: Scalar<Mask = bool>>(mesh: &Mesh<'_, S>, to: &mut impl Write) -> io::Result<()> {
    for &vertex in mesh.vertices() {
        line(to, "v ", plain(vertex))?;
    }
    for face in mesh.faces() {
        let [a, b, c] = face.map(|vertex| u64::from(vertex) + 1);
        writeln!(to, "f {a} {b} {c}")?;
    }
    Ok(())
}

/// Returns the unit normal of a triangle, zero for one without area.
fn normal([a, b, c]: [Vec3<f64>; 3]) -> Vec3<f64> {
    // Largest coordinates of one, so that squares neither vanish nor overflow.
    let (u, v) = (b - a, c - a);
    let size = |v: Vec3<f64>| v.x.abs().max(v.y.abs()).max(v.z.abs());
    let unit = |v: Vec3<f64>| match size(v) {
        0.0 => v,
        size => Vec3::new(v.x / size, v.y / size, v.z / size),
    };
    let normal = unit(unit(u).cross(unit(v))).normalize_or_zero();
    match normal.is_finite() {
        true => normal,
        false => Vec3::zero(),
    }
}

fn stl_text<S: Scalar<Mask = bool>>(mesh: &Mesh<'_, S>, to: &mut impl Write) -> io::Result<()> {
    writeln!(to, "solid geograd")?;
    for face in 0..mesh.faces().len() {
        let corners = mesh.plain_triangle(face as u32);
        line(to, "facet normal ", normal(corners))?;
        writeln!(to, "outer loop")?;
        for corner in corners {
            line(to, "vertex ", corner)?;
        }
        writeln!(to, "endloop\nendfacet")?;
    }
    writeln!(to, "endsolid geograd")
}

fn stl_binary<S: Scalar<Mask = bool>>(mesh: &Mesh<'_, S>, to: &mut impl Write) -> io::Result<()> {
    let mut head = [b' '; HEAD];
    head[..7].copy_from_slice(b"geograd");
    head[HEAD - 4..].copy_from_slice(&(mesh.faces().len() as u32).to_le_bytes());
    to.write_all(&head)?;
    for face in 0..mesh.faces().len() {
        let corners = mesh.plain_triangle(face as u32);
        let [a, b, c] = corners;
        for point in [normal(corners), a, b, c] {
            for number in [point.x, point.y, point.z] {
                to.write_all(&(number as f32).to_le_bytes())?;
            }
        }
        to.write_all(&[0; 2])?;
    }
    Ok(())
}

fn ply<S: Scalar<Mask = bool>>(
    mesh: &Mesh<'_, S>,
    format: FileFormat,
    to: &mut impl Write,
) -> io::Result<()> {
    let is_text = format == FileFormat::PlyText;
    let encoding = if is_text {
        "ascii"
    } else {
        "binary_little_endian"
    };
    write!(
        to,
        "ply\nformat {encoding} 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.vertices().len(),
        mesh.faces().len()
    )?;
    for &vertex in mesh.vertices() {
        let at = plain(vertex);
        if is_text {
            line(to, "", at)?;
            continue;
        }
        for number in [at.x, at.y, at.z] {
            to.write_all(&number.to_le_bytes())?;
        }
    }
    for &[a, b, c] in mesh.faces() {
        if is_text {
            writeln!(to, "3 {a} {b} {c}")?;
            continue;
        }
        to.write_all(&[3])?;
        for vertex in [a, b, c] {
            to.write_all(&vertex.to_le_bytes())?;
        }
    }
    Ok(())
}

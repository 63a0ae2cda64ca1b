//! Wavefront OBJ.
use super::MeshFile;
use super::file_fault::{FileFault, FileFlaw, FileKind, FilePlace};
use super::file_text::{TextLines, coordinate, number, unexpected, words_of};
use crate::Vec3;

/// The mesh so far, and corners that wait for later vertices.
#[derive(Default)]
struct ObjReader {
    mesh: MeshFile,
    /// The line and the number of corners beyond the vertices so far.
    ahead: Vec<(usize, i64)>,
}

impl ObjReader {
    /// Returns the vertex of a corner such as `7`, `-1` or `7/2/3`, from zero.
    fn corner(&mut self, word: &[u8], line: usize) -> Result<u32, FileFlaw> {
        let first = word.split(|&byte| byte == b'/').next().unwrap_or(word);
        let index: i64 = number(first, "an index of a vertex")?;
        let count = self.mesh.vertices.len() as i64;
        let vertex = match index {
            ..0 => count + index,
            _ => index - 1,
        };
        if vertex >= count {
            self.ahead.push((line, index));
        }
        match (index, u32::try_from(vertex)) {
            (0, _) | (_, Err(_)) => Err(FileFlaw::NoVertex { index }),
            (_, Ok(vertex)) => Ok(vertex),
        }
    }
    fn face<'a>(
        &mut self,
        mut words: impl Iterator<Item = &'a [u8]>,
        line: usize,
    ) -> Result<(), FileFlaw> {
        let (mut found, mut first, mut last) = (0, 0, 0);
        for word in &mut words {
            let corner = self.corner(word, line)?;
            match found {
                0 => first = corner,
                1 => {}
                _ => self.mesh.add_face([first, last, corner])?,
            }
            (found, last) = (found + 1, corner);
        }
        match found {
            3.. => Ok(()),
            _ => Err(FileFlaw::Corners { found }),
        }
    }
    fn statement(&mut self, text: &[u8], line: usize) -> Result<(), FileFlaw> {
        let mut words = words_of(text);
        match words.next() {
            Some(b"v") => {
                let mut numbers = [0.0; 3];
                for number in &mut numbers {
                    let expected = "a coordinate";
                    let word = words.next().ok_or(FileFlaw::Ends { expected })?;
                    *number = coordinate(word)?;
                }
                let [x, y, z] = numbers;
                self.mesh.add_vertex(Vec3::new(x, y, z))
            }
            Some(b"f" | b"fo") => self.face(words, line),
            Some(b"call" | b"csh") => Err(FileFlaw::Unsupported {
                part: "commands that run others",
            }),
            // A word of binary data is no keyword.
            Some(word) if !word.iter().all(u8::is_ascii_graphic) => {
                Err(unexpected("a statement of OBJ", word))
            }
            _ => Ok(()),
        }
    }
}

/// Returns the mesh of a file of OBJ: its vertices and faces. Textures, normals, groups, lines,
/// curves and unknown statements are passed over.
///
/// Indices of a face count from 1, negative ones back from the last vertex before it. A face with more than three corners
/// is a fan of triangles around its first corner, which fills convex polygons.
///
/// ```
/// use geograd::mesh_files::read_obj;
/// let file = read_obj(b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4//1 -3//1 -2//1 -1//1\n")?;
/// assert_eq!(file.faces, [[0, 1, 2], [0, 2, 3]]);
/// # Ok::<(), geograd::mesh_files::FileFault>(())
/// ```
///
/// # Errors
///
/// A [`FileFault`] with the line.
pub fn read_obj(bytes: &[u8]) -> Result<MeshFile, FileFault> {
    let mut reader = ObjReader::default();
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut lines = TextLines::after(text, 0);
    let mut joined: Vec<u8> = Vec::new();
    while let Some(line) = lines.next() {
        let number = lines.number;
        let fault = |flaw| FileKind::Obj.fault(FilePlace::Line(number), flaw);
        let text = line.split(|&byte| byte == b'#').next().unwrap_or(line);
        // A backslash at the end of a line continues it.
        if let Some(start) = text.strip_suffix(b"\\") {
            joined.extend_from_slice(start);
            joined.push(b' ');
            continue;
        }
        if joined.is_empty() {
            reader.statement(text, number).map_err(fault)?;
        } else {
            joined.extend_from_slice(text);
            reader.statement(&joined, number).map_err(fault)?;
            joined.clear();
        }
    }
    let number = lines.number;
    let fault = |flaw| FileKind::Obj.fault(FilePlace::Line(number), flaw);
    reader.statement(&joined, number).map_err(fault)?;
    let count = reader.mesh.vertices.len() as i64;
    if let Some(&(line, index)) = reader.ahead.iter().find(|(_, index)| *index > count) {
        let flaw = FileFlaw::NoVertex { index };
        return Err(FileKind::Obj.fault(FilePlace::Line(line), flaw));
    }
    Ok(reader.mesh)
}

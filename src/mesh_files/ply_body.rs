//! The items of a file of PLY.
use super::MeshFile;
use super::file_fault::{FileFault, FileFlaw, FileKind, FilePlace};
use super::file_text::{TextLines, TextWords, coordinate, number};
use super::ply_header::{
    PlyElement, PlyElementKind, PlyEncoding, PlyHeader, PlyMeaning, PlyNumber, PlyProperty,
    read_header,
};
use crate::Vec3;

/// Numbers of a body, one after another.
trait PlyNumbers {
    /// Returns a number that may be anything.
    fn any(&mut self, number: PlyNumber) -> Result<f64, FileFault>;
    /// Returns a finite number.
    fn finite(&mut self, number: PlyNumber) -> Result<f64, FileFault>;
    /// Returns a whole number.
    fn whole(&mut self, number: PlyNumber) -> Result<i64, FileFault>;
    /// Returns a fault at the last number.
    fn fault(&self, flaw: FileFlaw) -> FileFault;
    /// Returns the most words or bytes that may follow.
    fn left(&self) -> usize;
}

impl PlyNumbers for TextWords<'_> {
    fn any(&mut self, _number: PlyNumber) -> Result<f64, FileFault> {
        let word = self.word("a number")?;
        number(word, "a number").map_err(|flaw| TextWords::fault(self, flaw))
    }
    fn finite(&mut self, _number: PlyNumber) -> Result<f64, FileFault> {
        let word = self.word("a coordinate")?;
        coordinate(word).map_err(|flaw| TextWords::fault(self, flaw))
    }
    fn whole(&mut self, _number: PlyNumber) -> Result<i64, FileFault> {
        let expected = "a whole number";
        let word = self.word(expected)?;
        number(word, expected).map_err(|flaw| TextWords::fault(self, flaw))
    }
    fn fault(&self, flaw: FileFlaw) -> FileFault {
        TextWords::fault(self, flaw)
    }
    fn left(&self) -> usize {
        self.bytes_left().div_ceil(2)
    }
}

/// Binary numbers.
struct PlyBytes<'a> {
    bytes: &'a [u8],
    at: usize,
    is_big: bool,
}

impl PlyBytes<'_> {
    /// Returns the bytes of a number, the lowest first.
    fn take(&mut self, size: usize) -> Result<[u8; 8], FileFault> {
        let Some(found) = self.bytes.get(self.at..self.at + size) else {
            let expected = "a number";
            return Err(self.fault(FileFlaw::Ends { expected }));
        };
        let mut low = [0; 8];
        for (k, byte) in found.iter().enumerate() {
            low[if self.is_big { size - 1 - k } else { k }] = *byte;
        }
        self.at += size;
        Ok(low)
    }
}

impl PlyNumbers for PlyBytes<'_> {
    fn any(&mut self, number: PlyNumber) -> Result<f64, FileFault> {
        match number {
            PlyNumber::Float(4) => {
                let [a, b, c, d, ..] = self.take(4)?;
                Ok(f64::from(f32::from_le_bytes([a, b, c, d])))
            }
            PlyNumber::Float(_) => Ok(f64::from_le_bytes(self.take(8)?)),
            _ => Ok(self.whole(number)? as f64),
        }
    }
    fn finite(&mut self, number: PlyNumber) -> Result<f64, FileFault> {
        let found = self.any(number)?;
        match found.is_finite() {
            true => Ok(found),
            false => {
                self.at -= number.size();
                Err(self.fault(FileFlaw::NotFinite))
            }
        }
    }
    fn whole(&mut self, number: PlyNumber) -> Result<i64, FileFault> {
        let unsigned = i64::from_le_bytes(self.take(number.size())?);
        Ok(match number {
            PlyNumber::Signed(1) => i64::from(unsigned as i8),
            PlyNumber::Signed(2) => i64::from(unsigned as i16),
            PlyNumber::Signed(_) => i64::from(unsigned as i32),
            _ => unsigned,
        })
    }
    fn fault(&self, flaw: FileFlaw) -> FileFault {
        FileKind::Ply.fault(FilePlace::Byte(self.at), flaw)
    }
    fn left(&self) -> usize {
        self.bytes.len() - self.at
    }
}

/// Reads a list of corners as a fan of triangles.
fn read_corners(
    from: &mut impl PlyNumbers,
    property: &PlyProperty,
    vertices: u64,
    mesh: &mut MeshFile,
) -> Result<(), FileFault> {
    let count = read_count(from, property)?;
    let (mut first, mut last) = (0, 0);
    for k in 0..count {
        let index = from.whole(property.number)?;
        let Some(corner) = u32::try_from(index)
            .ok()
            .filter(|&i| u64::from(i) < vertices)
        else {
            return Err(from.fault(FileFlaw::NoVertex { index }));
        };
        match k {
            0 => first = corner,
            1 => {}
            _ => {
                let added = mesh.add_face([first, last, corner]);
                added.map_err(|flaw| from.fault(flaw))?;
            }
        }
        last = corner;
    }
    match count {
        3.. => Ok(()),
        _ => Err(from.fault(FileFlaw::Corners {
            found: count as usize,
        })),
    }
}

/// Reads the number of items of a list.
fn read_count(from: &mut impl PlyNumbers, property: &PlyProperty) -> Result<u64, FileFault> {
    let number = property.counted.unwrap_or(property.number);
    let count = from.whole(number)?;
    let expected = "a number of items";
    u64::try_from(count).map_err(|_| {
        let found = count.to_string();
        from.fault(FileFlaw::Unexpected { expected, found })
    })
}

fn read_element(
    from: &mut impl PlyNumbers,
    element: &PlyElement,
    header: &PlyHeader,
    mesh: &mut MeshFile,
) -> Result<(), FileFault> {
    let sizes = element.properties.iter();
    let size: usize = sizes.map(|x| x.least_size(header.encoding)).sum();
    if size == 0 {
        return Ok(());
    }
    if ((from.left() / size) as u64) < element.count {
        let declared = element.count;
        return Err(from.fault(FileFlaw::Count { declared }));
    }
    for _ in 0..element.count {
        let mut place = [0.0; 3];
        for property in &element.properties {
            match (property.meaning, property.counted) {
                (PlyMeaning::Coordinate(axis), _) => place[axis] = from.finite(property.number)?,
                (PlyMeaning::Corners, _) => {
                    read_corners(from, property, header.vertices(), mesh)?;
                }
                (PlyMeaning::None, None) => {
                    from.any(property.number)?;
                }
                (PlyMeaning::None, Some(_)) => {
                    for _ in 0..read_count(from, property)? {
                        from.any(property.number)?;
                    }
                }
            }
        }
        if element.kind == PlyElementKind::Vertex {
            let [x, y, z] = place;
            let added = mesh.add_vertex(Vec3::new(x, y, z));
            added.map_err(|flaw| from.fault(flaw))?;
        }
    }
    Ok(())
}

fn read_body(from: &mut impl PlyNumbers, header: &PlyHeader) -> Result<MeshFile, FileFault> {
    let mut mesh = MeshFile::default();
    for element in &header.elements {
        read_element(from, element, header, &mut mesh)?;
    }
    Ok(mesh)
}

/// Returns the mesh of a file of PLY, text or binary of either order of bytes: the places of its vertices and the corners
/// of its faces. Other properties and elements are passed over. A file without faces is a cloud of points.
///
/// A face with more than three corners is a fan of triangles around its first corner, which fills convex polygons.
///
/// # Errors
///
/// A [`FileFault`] with the line of a text, the byte of binary data. A number of items that the rest of the file cannot hold
/// is refused before any is read.
pub fn read_ply(bytes: &[u8]) -> Result<MeshFile, FileFault> {
    let mut lines = TextLines::after(bytes, 0);
    let header = read_header(&mut lines)?;
    match header.encoding {
        PlyEncoding::Text => read_body(&mut TextWords::new(FileKind::Ply, lines), &header),
        encoding => {
            let mut from = PlyBytes {
                bytes,
                at: bytes.len() - lines.rest().len(),
                is_big: encoding == PlyEncoding::Big,
            };
            read_body(&mut from, &header)
        }
    }
}

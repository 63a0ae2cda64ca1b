//! The header of a file of PLY: its encoding, its elements and their properties.
use super::file_fault::{FileFault, FileFlaw, FileKind, FilePlace};
use super::file_text::{TextLines, number, unexpected, words_of};

/// How numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlyEncoding {
    Text,
    Little,
    Big,
}

/// A type of numbers: its bytes, and how they are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlyNumber {
    Signed(usize),
    Unsigned(usize),
    Float(usize),
}

impl PlyNumber {
    fn of(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => PlyNumber::Signed(1),
            b"short" | b"int16" => PlyNumber::Signed(2),
            b"int" | b"int32" => PlyNumber::Signed(4),
            b"uchar" | b"uint8" => PlyNumber::Unsigned(1),
            b"ushort" | b"uint16" => PlyNumber::Unsigned(2),
            b"uint" | b"uint32" => PlyNumber::Unsigned(4),
            b"float" | b"float32" => PlyNumber::Float(4),
            b"double" | b"float64" => PlyNumber::Float(8),
            _ => return None,
        })
    }
    /// Returns the number of bytes.
    pub fn size(self) -> usize {
        match self {
            PlyNumber::Signed(size) | PlyNumber::Unsigned(size) | PlyNumber::Float(size) => size,
        }
    }
}

/// The meaning of a property for the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlyMeaning {
    /// A coordinate of a vertex: 0, 1 or 2.
    Coordinate(usize),
    /// The corners of a face.
    Corners,
    /// Nothing.
    None,
}

/// A property of an element.
#[derive(Clone, Copy, Debug)]
pub struct PlyProperty {
    /// The type of the number of items, for a list.
    pub counted: Option<PlyNumber>,
    pub number: PlyNumber,
    pub meaning: PlyMeaning,
}

impl PlyProperty {
    /// Returns the least number of bytes that it takes, or of words in a text.
    pub fn least_size(&self, encoding: PlyEncoding) -> usize {
        match encoding {
            PlyEncoding::Text => 1,
            _ => self.counted.unwrap_or(self.number).size(),
        }
    }
}

/// A kind of element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlyElementKind {
    Vertex,
    Face,
    Other,
}

/// An element: so many items with the same properties.
#[derive(Clone, Debug)]
pub struct PlyElement {
    pub kind: PlyElementKind,
    pub count: u64,
    pub properties: Vec<PlyProperty>,
}

/// A header.
#[derive(Clone, Debug)]
pub struct PlyHeader {
    pub encoding: PlyEncoding,
    pub elements: Vec<PlyElement>,
}

impl PlyHeader {
    /// Returns the number of vertices.
    pub fn vertices(&self) -> u64 {
        let vertices = self.elements.iter();
        let vertices = vertices.filter(|element| element.kind == PlyElementKind::Vertex);
        vertices.fold(0, |sum, element| sum.saturating_add(element.count))
    }
}

/// Returns the word that must follow.
fn next<'a>(
    words: &mut impl Iterator<Item = &'a [u8]>,
    expected: &'static str,
) -> Result<&'a [u8], FileFlaw> {
    words.next().ok_or(FileFlaw::Ends { expected })
}

fn number_type(word: &[u8]) -> Result<PlyNumber, FileFlaw> {
    PlyNumber::of(word).ok_or_else(|| unexpected("a type of numbers", word))
}

fn property<'a>(
    mut words: impl Iterator<Item = &'a [u8]>,
    of: PlyElementKind,
) -> Result<PlyProperty, FileFlaw> {
    let kind = next(&mut words, "a type of numbers")?;
    let (counted, number) = match kind {
        b"list" => {
            let counted = next(&mut words, "the type of a number of items")?;
            match number_type(counted)? {
                PlyNumber::Float(_) => return Err(unexpected("a type of whole numbers", counted)),
                whole => (
                    Some(whole),
                    number_type(next(&mut words, "a type of numbers")?)?,
                ),
            }
        }
        own => (None, number_type(own)?),
    };
    let name = next(&mut words, "the name of a property")?;
    let meaning = match (of, counted, name) {
        (PlyElementKind::Vertex, None, b"x") => PlyMeaning::Coordinate(0),
        (PlyElementKind::Vertex, None, b"y") => PlyMeaning::Coordinate(1),
        (PlyElementKind::Vertex, None, b"z") => PlyMeaning::Coordinate(2),
        (PlyElementKind::Face, Some(_), b"vertex_indices" | b"vertex_index") => match number {
            PlyNumber::Float(_) => {
                return Err(unexpected("a list of whole numbers", name));
            }
            _ => PlyMeaning::Corners,
        },
        _ => PlyMeaning::None,
    };
    Ok(PlyProperty {
        counted,
        number,
        meaning,
    })
}

/// Returns the element that the words of a line begin.
fn element<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Result<PlyElement, FileFlaw> {
    let kind = match next(&mut words, "the name of an element")? {
        b"vertex" => PlyElementKind::Vertex,
        b"face" => PlyElementKind::Face,
        b"tristrips" => {
            let part = "strips of triangles";
            return Err(FileFlaw::Unsupported { part });
        }
        _ => PlyElementKind::Other,
    };
    let expected = "a number of items";
    let count = number(next(&mut words, expected)?, expected)?;
    let properties = Vec::new();
    Ok(PlyElement {
        kind,
        count,
        properties,
    })
}

/// Returns `true` for an element that has what the mesh needs of it, each once.
fn is_whole(element: &PlyElement) -> bool {
    let times = |meaning| {
        let own = element.properties.iter();
        own.filter(|property| property.meaning == meaning).count()
    };
    match element.kind {
        PlyElementKind::Vertex => (0..3).all(|axis| times(PlyMeaning::Coordinate(axis)) == 1),
        PlyElementKind::Face => times(PlyMeaning::Corners) == 1,
        PlyElementKind::Other => true,
    }
}

/// Returns the encoding that the words of a line name.
fn encoding<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Result<PlyEncoding, FileFlaw> {
    let expected = "`ascii`, `binary_little_endian` or `binary_big_endian`";
    let encoding = match next(&mut words, expected)? {
        b"ascii" => PlyEncoding::Text,
        b"binary_little_endian" => PlyEncoding::Little,
        b"binary_big_endian" => PlyEncoding::Big,
        other => return Err(unexpected(expected, other)),
    };
    match next(&mut words, "the version 1.0")? {
        b"1.0" => Ok(encoding),
        other => Err(unexpected("the version 1.0", other)),
    }
}

/// Reads a header and leaves the lines after it.
pub fn read_header(lines: &mut TextLines<'_>) -> Result<PlyHeader, FileFault> {
    let (mut found, mut elements) = (None, Vec::<PlyElement>::new());
    let mut is_first = true;
    while let Some(line) = lines.next() {
        let number = lines.number;
        let fault = |flaw| FileKind::Ply.fault(FilePlace::Line(number), flaw);
        let mut words = words_of(line);
        let word = words.next().unwrap_or(b"");
        if is_first {
            if word != b"ply" {
                return Err(fault(unexpected("`ply`", word)));
            }
            is_first = false;
            continue;
        }
        match word {
            b"format" => found = Some(encoding(words).map_err(fault)?),
            b"comment" | b"obj_info" => {}
            b"element" => elements.push(element(words).map_err(fault)?),
            b"property" => {
                let Some(last) = elements.last_mut() else {
                    return Err(fault(unexpected("an element", word)));
                };
                let property = property(words, last.kind).map_err(fault)?;
                last.properties.push(property);
            }
            b"end_header" => {
                let expected = "the format";
                let encoding = found.ok_or_else(|| fault(FileFlaw::Ends { expected }))?;
                if !elements.iter().all(is_whole) {
                    let expected = "one property of x, y and z each, or one list of corners";
                    return Err(fault(FileFlaw::Ends { expected }));
                }
                return Ok(PlyHeader { encoding, elements });
            }
            other => return Err(fault(unexpected("a line of a header", other))),
        }
    }
    let place = FilePlace::Line(lines.number.max(1));
    let expected = if is_first { "`ply`" } else { "`end_header`" };
    Err(FileKind::Ply.fault(place, FileFlaw::Ends { expected }))
}

//! Stereolithography: triangles with corners of their own, as text or binary.
use super::MeshFile;
use super::file_fault::{FileFault, FileFlaw, FileKind, FilePlace};
use super::file_text::{TextLines, TextWords, unexpected};
use crate::Vec3;
use std::collections::HashMap;

/// The bytes before the triangles of a binary file, the last four of which are their number.
pub const HEAD: usize = 84;
/// The bytes of a triangle: a normal, three corners, and two bytes that mean nothing.
pub const FACET: usize = 50;

/// Vertices by their coordinates.
#[derive(Default)]
struct Welded {
    mesh: MeshFile,
    known: HashMap<[u64; 3], u32>,
}

impl Welded {
    fn vertex(&mut self, at: Vec3<f64>) -> Result<u32, FileFlaw> {
        // Zeros of both signs are one place.
        let at = Vec3::new(at.x + 0.0, at.y + 0.0, at.z + 0.0);
        let key = [at.x, at.y, at.z].map(f64::to_bits);
        if let Some(&vertex) = self.known.get(&key) {
            return Ok(vertex);
        }
        let vertex = self.mesh.vertices.len() as u32;
        self.mesh.add_vertex(at)?;
        self.known.insert(key, vertex);
        Ok(vertex)
    }
    fn facet(&mut self, corners: [Vec3<f64>; 3]) -> Result<(), FileFlaw> {
        let [a, b, c] = corners;
        let face = [self.vertex(a)?, self.vertex(b)?, self.vertex(c)?];
        self.mesh.add_face(face)
    }
}

/// Returns the number of triangles that a binary file declares; `None` for one that is too short for a number.
fn declared(bytes: &[u8]) -> Option<usize> {
    let number = bytes.get(HEAD - 4..HEAD)?.try_into().ok()?;
    Some(u32::from_le_bytes(number) as usize)
}

/// Returns `true` for text: it begins with the word `solid`, and its length is not that of a binary file.
fn is_text(bytes: &[u8]) -> bool {
    let is_binary = declared(bytes).is_some_and(|count| bytes.len() == HEAD + FACET * count);
    let start = bytes.trim_ascii_start();
    !is_binary && start.len() >= 5 && start[..5].eq_ignore_ascii_case(b"solid")
}

fn of_bytes(bytes: &[u8]) -> Result<MeshFile, FileFault> {
    let fault = |byte, flaw| FileKind::Stl.fault(FilePlace::Byte(byte), flaw);
    let expected = "the number of triangles";
    let count = declared(bytes).ok_or_else(|| fault(bytes.len(), FileFlaw::Ends { expected }))?;
    let facets = &bytes[HEAD..];
    if facets.len() / FACET < count {
        let declared = count as u64;
        return Err(fault(HEAD - 4, FileFlaw::Count { declared }));
    }
    let mut welded = Welded::default();
    for (k, facet) in facets.chunks_exact(FACET).take(count).enumerate() {
        let mut numbers = [0.0; 9];
        for (number, word) in numbers.iter_mut().zip(facet[12..48].chunks_exact(4)) {
            *number = f64::from(f32::from_le_bytes([word[0], word[1], word[2], word[3]]));
        }
        let place = HEAD + FACET * k;
        if numbers.iter().any(|number| !number.is_finite()) {
            return Err(fault(place, FileFlaw::NotFinite));
        }
        let [a, b, c] = [0, 3, 6].map(|k| Vec3::new(numbers[k], numbers[k + 1], numbers[k + 2]));
        welded.facet([a, b, c]).map_err(|flaw| fault(place, flaw))?;
    }
    Ok(welded.mesh)
}

fn of_text(bytes: &[u8]) -> Result<MeshFile, FileFault> {
    let mut words = TextWords::new(FileKind::Stl, TextLines::after(bytes, 0));
    let mut welded = Welded::default();
    // A file may have several solids.
    while let Some(word) = words.next_word() {
        if !word.eq_ignore_ascii_case(b"solid") {
            return Err(words.fault(unexpected("`solid`", word)));
        }
        // The name of the solid.
        words.skip_line();
        loop {
            let word = words.word("`endsolid`")?;
            if word.eq_ignore_ascii_case(b"endsolid") {
                words.skip_line();
                break;
            }
            if !word.eq_ignore_ascii_case(b"facet") {
                return Err(words.fault(unexpected("`facet` or `endsolid`", word)));
            }
            expect(&mut words, "normal", "`normal`")?;
            for _ in 0..3 {
                // Corners tell the normal; some programs write NaN for that of a triangle without area.
                words.word("a number of a normal")?;
            }
            expect(&mut words, "outer", "`outer`")?;
            expect(&mut words, "loop", "`loop`")?;
            let (mut corners, mut found) = ([Vec3::zero(); 3], 0);
            loop {
                let word = words.word("`endloop`")?;
                if word.eq_ignore_ascii_case(b"endloop") {
                    break;
                }
                if !word.eq_ignore_ascii_case(b"vertex") {
                    return Err(words.fault(unexpected("`vertex` or `endloop`", word)));
                }
                let corner = words.vertex()?;
                if let Some(own) = corners.get_mut(found) {
                    *own = corner;
                }
                found += 1;
            }
            if found != 3 {
                return Err(words.fault(FileFlaw::Corners { found }));
            }
            expect(&mut words, "endfacet", "`endfacet`")?;
            welded.facet(corners).map_err(|flaw| words.fault(flaw))?;
        }
    }
    Ok(welded.mesh)
}

/// Reads a word that must be there, in letters of either case.
fn expect(
    words: &mut TextWords<'_>,
    wanted: &str,
    expected: &'static str,
) -> Result<(), FileFault> {
    let word = words.word(expected)?;
    match word.eq_ignore_ascii_case(wanted.as_bytes()) {
        true => Ok(()),
        false => Err(words.fault(unexpected(expected, word))),
    }
}

/// Returns the mesh of a file of STL, text or binary. Corners at equal places become one vertex, in the order in which they
/// come; normals are passed over.
///
/// A file is text if it begins with `solid` and its length is not that of the binary file that its bytes declare.
///
/// # Errors
///
/// A [`FileFault`] with the line of a text, the byte of binary data.
pub fn read_stl(bytes: &[u8]) -> Result<MeshFile, FileFault> {
    match is_text(bytes) {
        true => of_text(bytes),
        false => of_bytes(bytes),
    }
}

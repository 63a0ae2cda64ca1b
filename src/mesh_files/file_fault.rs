//! Reasons why a file of a mesh is refused.
use std::fmt;
use std::io;

/// A kind of file that holds a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FileKind {
    /// Wavefront OBJ.
    Obj,
    /// Stereolithography, as text or binary.
    Stl,
    /// The Stanford polygon format, as text or binary.
    Ply,
}

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FilePlace {
    /// The file as a whole.
    Whole,
    /// A line, from one.
    Line(usize),
    /// A byte of binary data, from zero.
    Byte(usize),
}

/// A flaw of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FileFlaw {
    /// The file ends, or its line, before what must follow.
    Ends {
        /// The missing part.
        expected: &'static str,
    },
    /// A word is not what must be there.
    Unexpected {
        /// The part that must be there.
        expected: &'static str,
        /// The word, or its beginning.
        found: String,
    },
    /// A coordinate of a vertex is NaN or infinite, or too large for the numbers of the format.
    NotFinite,
    /// A corner of a face is not a vertex of the file.
    NoVertex {
        /// The index as the file has it, or would have it.
        index: i64,
    },
    /// A face has fewer than three corners; in STL another number than three.
    Corners {
        /// The number of corners.
        found: usize,
    },
    /// The file declares more than the bytes that follow can hold.
    Count {
        /// The number that is declared.
        declared: u64,
    },
    /// The file has a part that is not read.
    Unsupported {
        /// The part.
        part: &'static str,
    },
    /// The file has more vertices than 32-bit indices can count.
    TooLarge,
    /// The name of the file does not tell its kind.
    UnknownKind,
    /// The system cannot read or write the file.
    System(io::ErrorKind),
}

/// The reason why a file of a mesh is refused, and where.
///
/// ```
/// use geograd::mesh_files::{FileFlaw, FileKind, FilePlace, read_obj};
/// let fault = read_obj(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n").unwrap_err();
/// assert_eq!((fault.kind, fault.place), (Some(FileKind::Obj), FilePlace::Line(4)));
/// assert_eq!(fault.flaw, FileFlaw::NoVertex { index: 4 });
/// assert_eq!(fault.to_string(), "OBJ, line 4: a face has the vertex 4, which the file does not have");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileFault {
    /// The kind of the file, unless its name does not tell.
    pub kind: Option<FileKind>,
    /// The place of the flaw.
    pub place: FilePlace,
    /// The flaw.
    pub flaw: FileFlaw,
}

impl FileKind {
    /// Returns a fault of a file of this kind.
    pub(super) fn fault(self, place: FilePlace, flaw: FileFlaw) -> FileFault {
        let kind = Some(self);
        FileFault { kind, place, flaw }
    }
}

impl FileFault {
    /// Returns the fault of a call of the system.
    pub(super) fn system(kind: Option<FileKind>, error: &io::Error) -> Self {
        FileFault {
            kind,
            place: FilePlace::Whole,
            flaw: FileFlaw::System(error.kind()),
        }
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            FileKind::Obj => "OBJ",
            FileKind::Stl => "STL",
            FileKind::Ply => "PLY",
        })
    }
}

impl fmt::Display for FileFlaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FileFlaw::Ends { expected } => write!(f, "{expected} is missing"),
            FileFlaw::Unexpected { expected, found } => {
                write!(f, "`{found}` is in the place of {expected}")
            }
            FileFlaw::NotFinite => f.write_str("a coordinate is not a finite number"),
            FileFlaw::NoVertex { index } => write!(
                f,
                "a face has the vertex {index}, which the file does not have"
            ),
            FileFlaw::Corners { found } => write!(f, "a face has {found} corners"),
            FileFlaw::Count { declared } => {
                write!(f, "{declared} items are declared, and fewer bytes follow")
            }
            FileFlaw::Unsupported { part } => write!(f, "{part} are not read"),
            FileFlaw::TooLarge => f.write_str("there are more than 2³¹ − 1 vertices or faces"),
            FileFlaw::UnknownKind => {
                f.write_str("the name of the file ends in none of .obj, .stl and .ply")
            }
            FileFlaw::System(kind) => write!(f, "{kind}"),
        }
    }
}

impl fmt::Display for FileFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(kind) = self.kind {
            write!(f, "{kind}")?;
        }
        match (self.kind, self.place) {
            (_, FilePlace::Line(line)) => write!(f, ", line {line}: ")?,
            (_, FilePlace::Byte(byte)) => write!(f, ", byte {byte}: ")?,
            (Some(_), FilePlace::Whole) => f.write_str(": ")?,
            (None, FilePlace::Whole) => {}
        }
        self.flaw.fmt(f)
    }
}

impl std::error::Error for FileFault {}

//! Errors as data: the argument, the item, the field and the fault.
use crate::rule::Rule;
use std::fmt;

/// The argument of a call to which an error belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Argument {
    /// The only shape of a constructor or a validation.
    Shape,
    /// The first input.
    A,
    /// The second input.
    B,
    /// The third input.
    C,
    /// The fourth input.
    D,
    /// The fifth input.
    E,
    /// The sixth input.
    F,
    /// The caller's slice for the shapes of results with this index.
    Result(usize),
    /// An input by the name that its operation gives it.
    Named(&'static str),
    /// The input of this index, from zero, of a function without names for them.
    Input(usize),
    /// The direction of a derivative, for the input of this index, from zero.
    Direction(usize),
    /// The vertices of a ragged batch.
    Vertices,
    /// The offsets of a ragged batch.
    Offsets,
    /// The cotangents of the results, one number per result.
    Upstream,
    /// The threshold of a reduction.
    Threshold,
    /// The groups of a second list.
    Groups,
    /// The caller's buffer for results.
    Values,
    /// The caller's buffer for gradients of the first input.
    GradA,
    /// The caller's buffer for gradients of the second input.
    GradB,
    /// The caller's buffer for gradients of the vertices.
    GradVertices,
}

impl Argument {
    /// Returns the argument of input `i`, from zero: a letter for each of the first six.
    #[must_use]
    pub const fn input(i: usize) -> Self {
        use Argument::{A, B, C, D, E, F};
        const ALL: [Argument; 6] = [A, B, C, D, E, F];
        if i < ALL.len() {
            ALL[i]
        } else {
            Argument::Input(i)
        }
    }
    /// Returns an input by the name that its operation gives it: `A` for `a`, and so on up to `F`.
    ///
    /// ```
    /// use geograd::error::Argument;
    /// assert_eq!(Argument::named("b"), Argument::B);
    /// assert_eq!(Argument::named("point"), Argument::Named("point"));
    /// ```
    #[must_use]
    pub const fn named(name: &'static str) -> Self {
        match name.as_bytes() {
            b"a" => Argument::A,
            b"b" => Argument::B,
            b"c" => Argument::C,
            b"d" => Argument::D,
            b"e" => Argument::E,
            b"f" => Argument::F,
            _ => Argument::Named(name),
        }
    }
}

impl fmt::Display for Argument {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Argument::Result(index) => return write!(f, "result {index}"),
            Argument::Input(index) => return write!(f, "input {index}"),
            Argument::Direction(index) => return write!(f, "direction {index}"),
            Argument::Shape => "shape",
            Argument::A => "a",
            Argument::B => "b",
            Argument::C => "c",
            Argument::D => "d",
            Argument::E => "e",
            Argument::F => "f",
            Argument::Named(name) => name,
            Argument::Vertices => "vertices",
            Argument::Offsets => "offsets",
            Argument::Upstream => "upstream",
            Argument::Threshold => "threshold",
            Argument::Groups => "groups",
            Argument::Values => "values",
            Argument::GradA => "grad_a",
            Argument::GradB => "grad_b",
            Argument::GradVertices => "grad_vertices",
        })
    }
}

/// A number of a shape, by its name: `heading`, `min.x`, `links[0].x`.
///
/// ```
/// use geograd::error::Field;
/// use geograd::{Aabb2, Fixed};
/// assert_eq!(Aabb2::<f64>::name(3), Field::new("max.y"));
/// assert_eq!(Field::new("x").within_item(2).within("links").to_string(), "links[2].x");
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Field {
    text: [u8; MOST],
    len: u8,
}

/// The most bytes of a field's name: with its length it fills seven words.
const MOST: usize = 55;

impl Field {
    /// A lone number.
    pub const VALUE: Field = Field::new("");

    /// Returns the field of a name; a name longer than 55 bytes is cut to its end, after an ellipsis.
    #[must_use]
    pub const fn new(name: &str) -> Self {
        Field::joined([name, "", ""])
    }
    /// Returns the name of this number as part of a field of another shape.
    #[must_use]
    pub const fn within(self, field: &str) -> Self {
        let is_joined = field.is_empty() || self.len == 0 || self.text[0] == b'[';
        Field::joined([field, if is_joined { "" } else { "." }, self.raw()])
    }
    /// Returns the name of this number as part of an item of an array.
    #[must_use]
    pub fn within_item(self, item: usize) -> Self {
        self.within(&format!("[{item}]"))
    }
    /// Returns the name.
    #[must_use]
    pub const fn as_str(&self) -> &str {
        if self.len == 0 { "value" } else { self.raw() }
    }
    const fn raw(&self) -> &str {
        match std::str::from_utf8(self.text.split_at(self.len as usize).0) {
            Ok(name) => name,
            Err(_) => "",
        }
    }
    const fn joined(parts: [&str; 3]) -> Self {
        let ellipsis = "…".as_bytes();
        let len = parts[0].len() + parts[1].len() + parts[2].len();
        let mut made = Field {
            text: [0; MOST],
            len: 0,
        };
        // The number of bytes to leave out, and `true` if that ends inside of a character.
        let (mut left_out, mut in_character) = (0, false);
        if len > MOST {
            left_out = len - MOST + ellipsis.len();
            in_character = true;
            while (made.len as usize) < ellipsis.len() {
                made.text[made.len as usize] = ellipsis[made.len as usize];
                made.len += 1;
            }
        }
        let mut part = 0;
        while part < parts.len() {
            let (bytes, mut i) = (parts[part].as_bytes(), 0);
            while i < bytes.len() {
                in_character &= left_out > 0 || bytes[i] & 0xc0 == 0x80;
                if left_out > 0 {
                    left_out -= 1;
                } else if !in_character {
                    made.text[made.len as usize] = bytes[i];
                    made.len += 1;
                }
                i += 1;
            }
            part += 1;
        }
        made
    }
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.as_str())
    }
}
impl fmt::Debug for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Field").field(&self.as_str()).finish()
    }
}

/// The rule that an invalid shape breaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Flaw {
    /// A field is NaN or infinite.
    NotFinite(Field),
    /// A size is below zero.
    Negative(Field),
    /// A size that must be above zero is not.
    NotPositive(Field),
    /// A lower bound is above an upper one: the field, and the name of the shape's field that it exceeds.
    Inverted(Field, &'static str),
    /// A direction is the zero vector.
    Zero(Field),
    /// A shape's own rule is broken: the field, and the rule.
    Broken(Field, &'static str),
    /// A vertex of a polygon breaks a rule.
    Vertex {
        /// The vertex, from zero.
        index: usize,
        /// The rule.
        fault: VertexFault,
    },
    /// A vertex of a ring of a polygon breaks a rule.
    Ring {
        /// The ring, from zero.
        ring: usize,
        /// The vertex of that ring, from zero.
        index: usize,
        /// The rule.
        fault: VertexFault,
    },
}

/// The rule that a vertex of a polygon breaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum VertexFault {
    /// A coordinate is NaN or infinite.
    NotFinite,
    /// The polygon needs this vertex and does not have it: fewer than three vertices.
    Missing,
    /// The vertex coincides with an earlier one, in a ring with fewer than three distinct vertices.
    Coincident,
    /// The vertex does not fit into the polygon's capacity.
    Surplus,
    /// The vertex does not fit into the capacity of a hull in space.
    Overfull,
    /// The next vertex coincides with this one.
    Repeated,
    /// The vertex is on the line through its neighbours.
    Straight,
    /// The border turns clockwise here.
    Clockwise,
    /// The border is about to run around the polygon a second time.
    SecondRound,
    /// The border turns in the opposite direction here than at other vertices: it is not convex, or crosses itself.
    NotConvex,
}

impl fmt::Display for VertexFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            VertexFault::NotFinite => "has a coordinate that is not a finite number",
            VertexFault::Missing => "is missing",
            VertexFault::Coincident => {
                "is at the place of an earlier one, and the ring has fewer than three places"
            }
            VertexFault::Surplus => "is beyond the polygon's capacity",
            VertexFault::Overfull => "is beyond the hull's capacity",
            VertexFault::Repeated => "is repeated by the next one",
            VertexFault::Straight => "is on the line through its neighbours",
            VertexFault::Clockwise => "turns clockwise",
            VertexFault::SecondRound => "starts a second round",
            VertexFault::NotConvex => {
                "turns the other way than others: the polygon is not convex, or crosses itself"
            }
        })
    }
}

impl Flaw {
    /// Returns the field that is flawed.
    #[must_use]
    pub fn field(self) -> Field {
        match self {
            Flaw::NotFinite(field)
            | Flaw::Negative(field)
            | Flaw::NotPositive(field)
            | Flaw::Inverted(field, _)
            | Flaw::Zero(field)
            | Flaw::Broken(field, _) => field,
            Flaw::Vertex { index, .. } => Field::VALUE.within_item(index).within("vertices"),
            Flaw::Ring { ring, index, .. } => {
                let vertex = Field::VALUE.within_item(index);
                vertex.within_item(ring).within("rings")
            }
        }
    }
    /// Returns the flaw with its fields renamed.
    #[must_use]
    pub fn renamed(self, name: impl Fn(Field) -> Field) -> Self {
        match self {
            Flaw::NotFinite(field) => Flaw::NotFinite(name(field)),
            Flaw::Negative(field) => Flaw::Negative(name(field)),
            Flaw::NotPositive(field) => Flaw::NotPositive(name(field)),
            Flaw::Inverted(field, upper) => Flaw::Inverted(name(field), upper),
            Flaw::Zero(field) => Flaw::Zero(name(field)),
            Flaw::Broken(field, rule) => Flaw::Broken(name(field), rule),
            Flaw::Vertex { .. } | Flaw::Ring { .. } => self,
        }
    }
    /// Returns the flaw as one of another shape, which has this part as field `field`.
    #[must_use]
    pub fn within(self, field: &str) -> Self {
        self.renamed(|own| own.within(field))
    }
    /// Returns the flaw as one of an item of an array.
    #[must_use]
    pub fn within_item(self, item: usize) -> Self {
        self.renamed(|own| own.within_item(item))
    }
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Flaw::NotFinite(field) => write!(f, "{field} is not a finite number"),
            Flaw::Negative(field) => write!(f, "{field} is negative"),
            Flaw::NotPositive(field) => write!(f, "{field} is not positive"),
            Flaw::Inverted(field, upper) => write!(f, "{field} is above {upper}"),
            Flaw::Broken(field, rule) => write!(f, "{field} {rule}"),
            Flaw::Zero(field) => write!(f, "{field} is zero"),
            Flaw::Vertex { index, fault } => write!(f, "vertex {index} {fault}"),
            Flaw::Ring { ring, index, fault } => {
                write!(f, "ring {ring}: vertex {index} {fault}")
            }
        }
    }
}

impl std::error::Error for Flaw {}

/// The reason why a function cannot be recorded as a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Unrecordable {
    /// It uses a symbol of another recording, of another thread, or made outside any recording.
    ForeignSymbol,
    /// Its result depends on a literal that is infinite or NaN in the format of the program.
    Constant,
    /// Its value without the hints of [`Mask::any`](crate::Mask::any) and
    /// [`Mask::all`](crate::Mask::all) is another than with them.
    Hint,
    /// Its input or its result has whole numbers (codes, counts): programs are of numbers with derivatives.
    Codes,
    /// It searches: its steps depend on its input, and a program is a straight line.
    Search,
    /// It has more operations than a program can hold.
    TooLong,
    /// The requested name is not one that a function can have there.
    Name,
    /// Another recording is open on this thread.
    Nested,
    /// It takes a path of any length: a program is of one length.
    Path,
}

impl fmt::Display for Unrecordable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Unrecordable::ForeignSymbol => "a symbol of another recording, or of none, was used",
            Unrecordable::Constant => "the result depends on an infinite or NaN literal",
            Unrecordable::Hint => {
                "the value depends on the answers of `any` or `all`, which are only hints"
            }
            Unrecordable::Codes => {
                "its shapes have whole numbers, such as a count of vertices: it has value and first derivatives only"
            }
            Unrecordable::Search => {
                "it searches, as functions of polygons do: it has value and first derivatives only, and a program for each record"
            }
            Unrecordable::TooLong => "there are too many operations",
            Unrecordable::Name => "the name is reserved or not an identifier",
            Unrecordable::Path => "it takes a path of any length: it has value and first derivatives only",
            Unrecordable::Nested => "another recording is open on this thread",
        })
    }
}

/// The reason why a call was refused. A refused call computes nothing and writes no buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Error {
    /// An argument has the wrong number of items.
    Length {
        /// The argument.
        argument: Argument,
        /// The number of items of the other arguments.
        expected: usize,
        /// The number of its items.
        found: usize,
    },
    /// An item of an argument is not a valid shape.
    Invalid {
        /// The argument.
        argument: Argument,
        /// The item, from zero.
        item: usize,
        /// The rule that it breaks.
        flaw: Flaw,
    },
    /// A list has no items, and the call gives the largest result of each item of the other list.
    NoLargest {
        /// The list without items.
        argument: Argument,
    },
    /// The offsets of a ragged batch decrease at this item, do not start at zero (item 0) or do not
    /// end at the number of vertices (last item).
    Offsets {
        /// The index into the offsets.
        item: usize,
    },
    /// The offsets of a list decrease, start or end wrongly, in a call with more than one list.
    OffsetsOf {
        /// The list.
        argument: Argument,
        /// The index into its offsets.
        item: usize,
    },
    /// The offsets of the groups of a list decrease at this item, do not start at zero (item 0) or do not end at the
    /// length of the list (last item).
    GroupsOf {
        /// The list.
        argument: Argument,
        /// The index into its offsets.
        item: usize,
    },
    /// Items of an argument have the wrong number of fields.
    Fields {
        /// The argument.
        argument: Argument,
        /// The count of numbers of one of its items.
        expected: usize,
        /// The count of numbers given.
        found: usize,
    },
    /// A call has the wrong number of arguments.
    Arguments {
        /// The number of arguments of the function.
        expected: usize,
        /// The number of arguments given.
        found: usize,
    },
    /// The call is for functions whose result is one number.
    NotOneNumber {
        /// The count of numbers of the result.
        found: usize,
    },
    /// The number of results does not fit in memory.
    TooLarge,
    /// No GPU is available, or a call on it failed.
    Gpu(GpuFault),
    /// The environment variable `GEOGRAD_SIMD`, or a call, requests a level of vector instructions that is unknown or
    /// that this processor lacks.
    Simd,
    /// A function cannot be recorded as a program.
    Program(Unrecordable),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Length {
                argument,
                expected,
                found,
            } => {
                write!(
                    f,
                    "`{argument}` has {found} items where {expected} are needed"
                )
            }
            // A threshold is one number.
            Error::Invalid {
                argument: Argument::Threshold,
                flaw,
                ..
            } => write!(f, "`threshold`: {flaw}"),
            Error::Invalid {
                argument,
                item,
                flaw,
            } => {
                write!(f, "`{argument}` item {item}: {flaw}")
            }
            Error::NoLargest { argument } => {
                write!(
                    f,
                    "`{argument}` has no items, of which one would have the largest result"
                )
            }
            Error::Offsets { item } => {
                write!(
                    f,
                    "`offsets` item {item}: offsets go from 0 to the number of vertices and never decrease"
                )
            }
            Error::OffsetsOf { argument, item } => {
                write!(
                    f,
                    "`{argument}`: offset {item}: offsets go from 0 to the number of vertices and never decrease"
                )
            }
            Error::GroupsOf { argument, item } => {
                write!(
                    f,
                    "groups of `{argument}`: offset {item}: offsets go from 0 to the number of items and never decrease"
                )
            }
            Error::Fields {
                argument,
                expected,
                found,
            } => write!(
                f,
                "items of `{argument}` have {found} numbers where {expected} are needed"
            ),
            Error::Arguments { expected, found } => {
                write!(f, "{found} arguments where {expected} are needed")
            }
            Error::NotOneNumber { found } => {
                write!(f, "the result has {found} numbers where one is needed")
            }
            Error::Program(why) => write!(f, "the function cannot be a program: {why}"),
            Error::TooLarge => f.write_str("more results than memory can hold"),
            Error::Gpu(fault) => fault.fmt(f),
            Error::Simd => f.write_str(
                "vector instructions were asked for that are unknown or that this processor lacks \
                 (GEOGRAD_SIMD is one of baseline, avx2, v4)",
            ),
        }
    }
}

impl std::error::Error for Error {}

/// Shapes with rules of validity. A number is valid if it is finite.
pub trait Validate {
    /// `true` if finite fields make a shape valid; batches then check many shapes at once.
    const FINITE_SUFFICES: bool = false;
    /// The rules of its numbers, beside that they are finite, as data. Bounds in other languages and inputs of the fuzzer
    /// follow them. A shape may have others that only [`validate`](Validate::validate) knows.
    const RULES: &'static [Rule] = &[];
    /// Returns `Ok` when every field is finite and the shape's own rules hold.
    ///
    /// # Errors
    ///
    /// The first flaw found, in the order of the fields.
    fn validate(&self) -> Result<(), Flaw>;
}

/// The reason why no GPU is available or a call on it failed. Inputs are as they were and stay usable,
/// except after [`GpuFault::DeviceLost`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum GpuFault {
    /// This build has no GPU support: build with the feature `gpu`.
    NotBuilt,
    /// No adapter was found at all: install the GPU's driver, or Mesa's lavapipe, which runs on any
    /// processor.
    NoAdapter,
    /// Adapters were found, but none as requested: choose another index, name or kind.
    NoSuchAdapter,
    /// A GPU computes in `f32`, and the call is one of `f64`: convert the numbers, or call the CPU.
    OnlySingle,
    /// Only a driver in software was found, which is slower than the CPU: install the GPU's driver, or request software
    /// with `GEOGRAD_GPU=cpu`. Only [`Backend::auto`] returns it.
    ///
    /// [`Backend::auto`]: crate::kernels::Backend::auto
    OnlySoftware,
    /// The adapter gave no device, or cannot compute.
    AdapterRefused,
    /// The device is gone (removed, reset by its driver, or destroyed), and everything on it: make
    /// a new context and upload again.
    DeviceLost,
    /// The device has not enough memory: give up some handles, or take smaller batches. wgpu does not report it on
    /// OpenGL, where results beyond the memory are undefined.
    OutOfMemory,
    /// The least that a batch can be split into, such as a ring, sixteen items of many numbers or a replayed program,
    /// is larger than any buffer the device allows: split it, or compute it on the CPU. Batches are split as they
    /// need.
    TooLarge {
        /// Its size in bytes.
        bytes: u64,
        /// The size limit of a buffer of the device in bytes ([`Gpu::most_bytes`](crate::kernels::gpu::Gpu)).
        most: u64,
    },
    /// The driver refused a shader or a command: a fault of this library or of the driver. The log has details.
    Shader,
    /// A handle that belongs to another context.
    ForeignBuffer,
}

impl fmt::Display for GpuFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            GpuFault::TooLarge { bytes, most } => {
                return write!(
                    f,
                    "one item takes {bytes} bytes, and buffers of the GPU have {most} at most: split it, or use the CPU"
                );
            }
            GpuFault::NotBuilt => "built without GPU support: build with `--features gpu`",
            GpuFault::NoAdapter => "no GPU found: install its driver",
            GpuFault::NoSuchAdapter => {
                "no GPU found as asked for: choose another with GEOGRAD_GPU (an index, a part of a \
                 name, or `cpu`)"
            }
            GpuFault::OnlySingle => "a GPU computes in `f32`: convert the numbers, or call the CPU",
            GpuFault::OnlySoftware => {
                "no GPU found but a driver in software, which is slower than the CPU: install the \
                 GPU's driver, or ask for software with GEOGRAD_GPU=cpu"
            }
            GpuFault::AdapterRefused => "the GPU gave no device for computing",
            GpuFault::DeviceLost => "the GPU is lost: make a new context and upload again",
            GpuFault::OutOfMemory => {
                "the GPU is out of memory: free handles or take smaller batches"
            }
            GpuFault::Shader => "the GPU's driver refused a command: see the log",
            GpuFault::ForeignBuffer => "a handle belongs to another GPU context",
        })
    }
}

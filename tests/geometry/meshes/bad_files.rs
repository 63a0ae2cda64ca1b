//! Files of meshes that are refused: the flaw and its place are told, and nothing is read that is not there.
use super::good_files::written;
use super::mesh_shapes::cube;
use geograd::Vec3;
use geograd::mesh::{Mesh, MeshFault};
use geograd::mesh_files::FilePlace::{Byte, Line};
use geograd::mesh_files::{
    FileFault, FileFlaw, FileFormat, FileKind, read_mesh_file, read_obj, read_ply, read_stl,
    write_mesh, write_mesh_file,
};
use std::io;
use std::path::Path;
use std::time::Instant;

fn ends(expected: &'static str) -> FileFlaw {
    FileFlaw::Ends { expected }
}
fn unexpected(found: &str, expected: &'static str) -> FileFlaw {
    let found = found.into();
    FileFlaw::Unexpected { expected, found }
}
/// Tests that a file is refused at a line.
fn check_line(kind: FileKind, text: &[u8], line: usize, flaw: FileFlaw) {
    let fault = kind.read(text).unwrap_err();
    let expected = FileFault {
        kind: Some(kind),
        place: Line(line),
        flaw,
    };
    assert_eq!(fault, expected, "{}", String::from_utf8_lossy(text));
}

#[test]
fn flaws_of_obj() {
    let start = "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\n";
    for (text, line, flaw) in [
        ("f 1 2 4", 4, FileFlaw::NoVertex { index: 4 }),
        ("f 1 2 0", 4, FileFlaw::NoVertex { index: 0 }),
        ("f 1 2 -4", 4, FileFlaw::NoVertex { index: -4 }),
        (
            "f 1 2 4\nf 1 2 5\nv 0 0 1",
            5,
            FileFlaw::NoVertex { index: 5 },
        ),
        ("\n\nf 1/9/9 2", 6, FileFlaw::Corners { found: 2 }),
        ("f", 4, FileFlaw::Corners { found: 0 }),
        ("f 1 2 x/1", 4, unexpected("x", "an index of a vertex")),
        ("f 1 2 3.0", 4, unexpected("3.0", "an index of a vertex")),
        (
            "f 1 2 99999999999999999999",
            4,
            unexpected("99999999999999999999", "an index of a vertex"),
        ),
        (
            "f 1 2 9223372036854775807",
            4,
            FileFlaw::NoVertex { index: i64::MAX },
        ),
        (
            "f 1 2 -9223372036854775808",
            4,
            FileFlaw::NoVertex { index: i64::MIN },
        ),
        ("v 1 NaN 0", 4, FileFlaw::NotFinite),
        ("v 1 0 -inf", 4, FileFlaw::NotFinite),
        ("v 1 0 1e999", 4, FileFlaw::NotFinite),
        ("v 1 0", 4, ends("a coordinate")),
        ("v 1,5 0 0", 4, unexpected("1,5", "a coordinate")),
        ("v 1 \\\n 2", 5, ends("a coordinate")),
        ("v 1 2 \\", 4, ends("a coordinate")),
        (
            "call other.obj",
            4,
            FileFlaw::Unsupported {
                part: "commands that run others",
            },
        ),
        (
            "\u{1}\u{2}",
            4,
            unexpected("\u{1}\u{2}", "a statement of OBJ"),
        ),
    ] {
        check_line(
            FileKind::Obj,
            format!("{start}{text}").as_bytes(),
            line,
            flaw,
        );
    }
}

#[test]
fn flaws_of_text_in_stl() {
    let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    for (text, line, flaw) in [
        (format!("solid\n{facet}"), 8, ends("`endsolid`")),
        (
            format!("solid\n{facet}endsolid\nmore"),
            10,
            unexpected("more", "`solid`"),
        ),
        (
            format!("solid\n{facet}vertex 0 0 0"),
            9,
            unexpected("vertex", "`facet` or `endsolid`"),
        ),
        (
            format!("solid\n{}", facet.replace("vertex 1 0 0\n", "")),
            6,
            FileFlaw::Corners { found: 2 },
        ),
        (
            format!(
                "solid\n{}",
                facet.replace("endloop", "vertex 1 1 0\nendloop")
            ),
            8,
            FileFlaw::Corners { found: 4 },
        ),
        (
            format!("solid\n{}", facet.replace("1 0 0", "1 nan 0")),
            5,
            FileFlaw::NotFinite,
        ),
        (
            format!("solid\n{}", facet.replace("1 0 0", "1 0")),
            6,
            unexpected("vertex", "a coordinate"),
        ),
        (
            format!("solid\n{}", facet.replace("outer", "inner")),
            3,
            unexpected("inner", "`outer`"),
        ),
        (
            "solid a\nfacet normal 0 0".into(),
            2,
            ends("a number of a normal"),
        ),
        ("solid".into(), 1, ends("`endsolid`")),
    ] {
        check_line(FileKind::Stl, text.as_bytes(), line, flaw);
    }
}

#[test]
fn flaws_of_bytes_in_stl() {
    let fault = |place, flaw| FileFault {
        kind: Some(FileKind::Stl),
        place,
        flaw,
    };
    let count = ends("the number of triangles");
    assert_eq!(read_stl(b"").unwrap_err(), fault(Byte(0), count.clone()));
    assert_eq!(read_stl(&[0; 83]).unwrap_err(), fault(Byte(83), count));
    let owned = cube();
    let good = written(&owned.mesh(), FileFormat::StlBinary);
    let mut bytes = good.clone();
    bytes[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let declared = u64::from(u32::MAX);
    let flaw = FileFlaw::Count { declared };
    assert_eq!(read_stl(&bytes).unwrap_err(), fault(Byte(80), flaw));
    let mut bytes = good;
    bytes[84 + 50 + 12..84 + 50 + 16].copy_from_slice(&f32::NAN.to_le_bytes());
    let fault = fault(Byte(134), FileFlaw::NotFinite);
    assert_eq!(read_stl(&bytes).unwrap_err(), fault);
    assert_eq!(
        fault.to_string(),
        "STL, byte 134: a coordinate is not a finite number"
    );
}

const VERTICES: &str = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const FACES: &str = "element face 1\nproperty list uchar int vertex_indices\n";

#[test]
fn flaws_of_headers() {
    let ascii = "ply\nformat ascii 1.0\n";
    let numbers = "a type of numbers";
    let whole = "one property of x, y and z each, or one list of corners";
    for (text, line, flaw) in [
        (String::new(), 1, ends("`ply`")),
        ("plx\n".into(), 1, unexpected("plx", "`ply`")),
        (ascii.into(), 2, ends("`end_header`")),
        (
            "ply\nformat ascii 2.0\n".into(),
            2,
            unexpected("2.0", "the version 1.0"),
        ),
        (
            "ply\nformat utf8 1.0\n".into(),
            2,
            unexpected(
                "utf8",
                "`ascii`, `binary_little_endian` or `binary_big_endian`",
            ),
        ),
        (
            format!("ply\n{VERTICES}end_header\n"),
            6,
            ends("the format"),
        ),
        (
            format!("{ascii}property float x\n"),
            3,
            unexpected("property", "an element"),
        ),
        (
            format!("{ascii}element vertex -1\n"),
            3,
            unexpected("-1", "a number of items"),
        ),
        (
            format!("{ascii}element vertex 18446744073709551616\n"),
            3,
            unexpected("18446744073709551616", "a number of items"),
        ),
        (
            format!("{ascii}element vertex\n"),
            3,
            ends("a number of items"),
        ),
        (
            format!("{ascii}element vertex 3\nproperty half x\n"),
            4,
            unexpected("half", numbers),
        ),
        (
            format!("{ascii}element vertex 3\nproperty list float int x\n"),
            4,
            unexpected("float", "a type of whole numbers"),
        ),
        (
            format!("{ascii}element face 3\nproperty list uchar float vertex_index\n"),
            4,
            unexpected("vertex_index", "a list of whole numbers"),
        ),
        (
            format!("{ascii}element vertex 3\nproperty float x\nproperty float y\nend_header\n"),
            6,
            ends(whole),
        ),
        (
            format!("{ascii}{VERTICES}property float x\nend_header\n"),
            8,
            ends(whole),
        ),
        (
            format!("{ascii}element face 3\nproperty int vertex_indices\nend_header\n"),
            5,
            ends(whole),
        ),
        (
            format!("{ascii}element tristrips 1\n"),
            3,
            FileFlaw::Unsupported {
                part: "strips of triangles",
            },
        ),
        (
            format!("{ascii}elements 1\n"),
            3,
            unexpected("elements", "a line of a header"),
        ),
    ] {
        check_line(FileKind::Ply, text.as_bytes(), line, flaw);
    }
}

#[test]
fn flaws_of_text_in_ply() {
    let head = format!("ply\nformat ascii 1.0\n{VERTICES}{FACES}end_header\n0 0 0\n1 0 0\n0 1 0\n");
    for (text, line, flaw) in [
        ("3 0 1 3\n", 13, FileFlaw::NoVertex { index: 3 }),
        ("3 0 1 -1\n", 13, FileFlaw::NoVertex { index: -1 }),
        ("3 0 1\n", 13, ends("a whole number")),
        ("2 0 1\n", 13, FileFlaw::Corners { found: 2 }),
        ("-1 0 1\n", 13, unexpected("-1", "a number of items")),
        ("3 0 1 2.0\n", 13, unexpected("2.0", "a whole number")),
        ("999999999999 0 1 2\n", 13, ends("a whole number")),
        ("", 12, FileFlaw::Count { declared: 1 }),
    ] {
        check_line(
            FileKind::Ply,
            format!("{head}{text}").as_bytes(),
            line,
            flaw,
        );
    }
    let nan = head.replace("1 0 0", "1 nan 0");
    check_line(FileKind::Ply, nan.as_bytes(), 11, FileFlaw::NotFinite);
}

/// Numbers that no file could hold are refused at once and without memory for them.
#[test]
fn declared_counts_allocate_nothing() {
    let start = Instant::now();
    for encoding in ["ascii", "binary_little_endian", "binary_big_endian"] {
        for (more, is_count) in [
            (
                "element vertex 18446744073709551615\nproperty char x\nproperty char y\nproperty char z\n",
                true,
            ),
            (
                "element face 4000000000000000000\nproperty list uchar int vertex_indices\n",
                true,
            ),
            (
                "element other 18446744073709551615\nproperty list uchar double a\n",
                true,
            ),
            // Items without properties have no bytes.
            ("element other 18446744073709551615\n", false),
        ] {
            let text = format!("ply\nformat {encoding} 1.0\n{more}end_header\n1 1 1 1 ");
            let done = read_ply(text.as_bytes());
            match is_count {
                true => assert!(matches!(done.unwrap_err().flaw, FileFlaw::Count { .. })),
                false => assert!(done.unwrap().vertices.is_empty()),
            }
        }
    }
    // A list that declares four milliards of corners.
    let head = format!(
        "ply\nformat binary_little_endian 1.0\n{VERTICES}{}end_header\n",
        FACES.replace("uchar", "uint")
    );
    let mut bytes = head.into_bytes();
    let from = bytes.len();
    bytes.extend_from_slice(&[0; 36]);
    bytes.extend_from_slice(&u32::MAX.to_le_bytes());
    bytes.extend_from_slice(&[0; 40]);
    let fault = read_ply(&bytes).unwrap_err();
    assert_eq!(
        (fault.place, fault.flaw),
        (Byte(from + 80), ends("a number"))
    );
    assert!(start.elapsed().as_secs() < 10, "{:?}", start.elapsed());
}

/// An output that takes so many bytes.
struct Full(usize);

impl io::Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.0 < bytes.len() {
            return Err(io::ErrorKind::StorageFull.into());
        }
        self.0 -= bytes.len();
        Ok(bytes.len())
    }
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn systems_that_refuse() {
    let fault = read_mesh_file(Path::new("nowhere/mesh.off")).unwrap_err();
    assert_eq!(
        (fault.kind, fault.flaw.clone()),
        (None, FileFlaw::UnknownKind)
    );
    assert_eq!(
        fault.to_string(),
        "the name of the file ends in none of .obj, .stl and .ply"
    );
    let missing = FileFlaw::System(io::ErrorKind::NotFound);
    let fault = read_mesh_file(Path::new("nowhere/mesh.obj")).unwrap_err();
    assert_eq!(
        (fault.kind, fault.flaw),
        (Some(FileKind::Obj), missing.clone())
    );
    let owned = cube();
    let path = Path::new("nowhere/mesh.ply");
    let fault = write_mesh_file(&owned.mesh(), FileFormat::PlyText, path).unwrap_err();
    assert_eq!(fault.flaw, missing);
    let full = FileFlaw::System(io::ErrorKind::StorageFull);
    for format in [
        FileFormat::Obj,
        FileFormat::StlBinary,
        FileFormat::PlyBinary,
    ] {
        let fault = write_mesh(&owned.mesh(), format, &mut Full(100)).unwrap_err();
        assert_eq!(fault.flaw, full);
    }
}

#[test]
fn coordinates_beyond_single_precision() {
    let mut vertices = cube().vertices;
    vertices[7] = Vec3::new(1e39, 0.0, 0.0);
    let faces = cube().faces;
    let mesh = Mesh::new(&vertices, &faces).unwrap();
    let mut bytes = Vec::new();
    let fault = write_mesh(&mesh, FileFormat::StlBinary, &mut bytes).unwrap_err();
    let face = faces.iter().position(|face| face.contains(&7)).unwrap();
    assert_eq!(
        (fault.place, fault.flaw),
        (Byte(84 + 50 * face), FileFlaw::NotFinite)
    );
    assert!(bytes.is_empty());
    write_mesh(&mesh, FileFormat::StlText, &mut bytes).unwrap();
    assert!(read_stl(&bytes).unwrap().vertices.contains(&vertices[7]));
    assert_eq!(
        read_obj(b"v 1 2 3").unwrap().mesh().unwrap_err(),
        MeshFault::Empty
    );
}

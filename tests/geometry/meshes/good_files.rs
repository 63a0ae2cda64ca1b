//! Files of meshes: what is written is read again, and what other programs write.
use super::mesh_shapes::{all, bumpy_sphere};
use geograd::Vec3;
use geograd::mesh::{Mesh, MeshFault};
use geograd::mesh_files::{
    FileFormat, MeshFile, read_mesh_file, read_obj, read_ply, read_stl, write_mesh, write_mesh_file,
};
use proptest::prelude::*;

const FORMATS: [FileFormat; 5] = [
    FileFormat::Obj,
    FileFormat::StlText,
    FileFormat::StlBinary,
    FileFormat::PlyText,
    FileFormat::PlyBinary,
];

pub fn written(mesh: &Mesh<'_, f64>, format: FileFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_mesh(mesh, format, &mut bytes).unwrap();
    bytes
}

fn corners(vertices: &[Vec3<f64>], faces: &[[u32; 3]]) -> Vec<[Vec3<f64>; 3]> {
    let face = |face: &[u32; 3]| face.map(|vertex| vertices[vertex as usize]);
    faces.iter().map(face).collect()
}

/// A mesh is read as it was written: OBJ and PLY to the last bit, STL as triangles, in bytes in single precision.
fn check_trip(vertices: &[Vec3<f64>], faces: &[[u32; 3]]) {
    let mesh = Mesh::new(vertices, faces).unwrap();
    for format in FORMATS {
        let file = format.kind().read(&written(&mesh, format)).unwrap();
        let bits = |v: &Vec3<f64>| [v.x, v.y, v.z].map(f64::to_bits);
        match format {
            FileFormat::Obj | FileFormat::PlyText | FileFormat::PlyBinary => {
                let found: Vec<_> = file.vertices.iter().map(bits).collect();
                let expected: Vec<_> = vertices.iter().map(bits).collect();
                assert_eq!((found, &file.faces[..]), (expected, faces), "{format:?}");
            }
            FileFormat::StlText | FileFormat::StlBinary => {
                let narrow = |x: f64| match format {
                    FileFormat::StlBinary => f64::from(x as f32),
                    _ => x,
                };
                let round = |v: Vec3<f64>| Vec3::new(narrow(v.x), narrow(v.y), narrow(v.z));
                let expected = corners(vertices, faces);
                let expected: Vec<_> = expected.iter().map(|face| face.map(round)).collect();
                let found = corners(&file.vertices, &file.faces);
                assert_eq!(found, expected, "{format:?}");
                for (i, v) in file.vertices.iter().enumerate() {
                    assert!(!file.vertices[..i].contains(v), "{v} twice");
                }
            }
        }
    }
}

#[test]
fn meshes_come_back() {
    for owned in all() {
        // The last one is compared with all before it.
        let count = owned.faces.len().min(400);
        check_trip(&owned.vertices, &owned.faces[..count]);
    }
}

/// Numbers of any size that single precision holds, zeros of both signs among them.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        -1e3..1e3,
        (-1.0..1.0, -120..120).prop_map(|(x, e)| x * 2.0_f64.powi(e)),
        Just(0.0),
        Just(-0.0),
        Just(f64::from(f32::MIN_POSITIVE)),
        Just(0.1),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn any_mesh_comes_back(
        places in prop::collection::vec((number(), number(), number()), 1..30),
        picks in prop::collection::vec((0..1000_usize, 0..1000_usize, 0..1000_usize), 1..40),
    ) {
        let vertices: Vec<_> = places.iter().map(|&(x, y, z)| Vec3::new(x, y, z)).collect();
        let pick = |k: usize| (k % vertices.len()) as u32;
        let faces: Vec<_> = picks.iter().map(|&(a, b, c)| [pick(a), pick(b), pick(c)]).collect();
        check_trip(&vertices, &faces);
    }
}

fn places(all: &[[f64; 3]]) -> Vec<Vec3<f64>> {
    all.iter().map(|&[x, y, z]| Vec3::new(x, y, z)).collect()
}

#[test]
fn obj_of_other_programs() {
    let text = b"\xef\xbb\xbf# made by hand\r\nmtllib a.mtl\r\no Stra\xdfe\r\nv 0 0 0 1.0\r\nv 1 0 0 0.5 0.5 0.5\r\n\
        vt 0.5 0.5\r\nvn nan 0 1\r\ng one two\r\nusemtl steel\r\ns off\r\n  v\t1 1. +0 # a comment\r\nv 0 1e0 -0\r\n\
        f 1/1/1 2/1/1 3//1 4\r\nf -1 -2 -3\r\nl 1 2\r\nf 1 2 \\\r\n 5\r\nv .5 .5 2\r\n";
    let file = read_obj(text).unwrap();
    let expected = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.5, 0.5, 2.0],
    ];
    assert_eq!(file.vertices, places(&expected));
    assert_eq!(file.faces, [[0, 1, 2], [0, 2, 3], [3, 2, 1], [0, 1, 4]]);
    // Lines may end in either byte, and the last one in none.
    let file = read_obj(b"v 1 2 3\rv 4 5 6\n\rv 7 8 9\nf 1 2 3").unwrap();
    assert_eq!(
        (file.vertices.len(), &file.faces[..]),
        (3, &[[0, 1, 2]][..])
    );
    let none = read_obj(b"").unwrap();
    assert_eq!(none, MeshFile::default());
    assert_eq!(none.mesh().unwrap_err(), MeshFault::Empty);
}

#[test]
fn stl_of_other_programs() {
    let text = b"solid a name with facet in it\n FACET NORMAL nan 0 1\n  outer loop\n vertex 0 0 0 vertex 1 0 0\n\
        vertex -0 1 0\n endloop endfacet\nfacet normal 0 0 1 outer loop vertex 1 0 0 vertex 1 1 0 vertex 0 1 0 endloop\n\
        endfacet endsolid\nsolid\nendsolid of nothing\n";
    let file = read_stl(text).unwrap();
    assert_eq!(file.faces, [[0, 1, 2], [1, 3, 2]]);
    // A binary file that begins like a text.
    let owned = bumpy_sphere(1);
    let mut bytes = written(&owned.mesh(), FileFormat::StlBinary);
    let plain = read_stl(&bytes).unwrap();
    assert_eq!((plain.vertices.len(), plain.faces.len()), (42, 80));
    bytes[..5].copy_from_slice(b"solid");
    assert_eq!(read_stl(&bytes).unwrap(), plain);
    // Bytes after the last triangle are no part of the mesh.
    bytes[..5].copy_from_slice(b"other");
    bytes.extend_from_slice(b"more");
    assert_eq!(read_stl(&bytes).unwrap(), plain);
}

/// The normals that are written, which no reader here takes.
#[test]
fn stl_has_normals() {
    let vertices = places(&[
        [0.0, 0.0, 0.0],
        [1e-200, 0.0, 0.0],
        [0.0, 1e-200, 0.0],
        [0.0, 0.0, 1e200],
    ]);
    let mesh = Mesh::new(&vertices, &[[0, 1, 2], [0, 3, 1], [0, 0, 1]]).unwrap();
    let text = String::from_utf8(written(&mesh, FileFormat::StlText)).unwrap();
    let normals = text
        .lines()
        .filter_map(|line| line.strip_prefix("facet normal "));
    let normals: Vec<_> = normals.collect();
    assert_eq!(normals, ["0.0 0.0 1.0", "0.0 1.0 0.0", "0.0 0.0 0.0"]);
}

#[test]
fn ply_of_other_programs() {
    let text = b"ply\r\nformat ascii 1.0\r\ncomment by hand\r\nobj_info none\r\nelement face 2\r\n\
        property list uint8 float32 texcoord\r\nproperty list uchar uint32 vertex_index\r\nproperty uchar red\r\n\
        element nothing 5\r\nelement vertex 5\r\nproperty float nx\r\nproperty double z\r\nproperty int x\r\n\
        property float y\r\nelement edge 1\r\nproperty list int short ends\r\nend_header\r\n\
        2 0.5 nan 3 0 1 2 255\r\n0 5 0 1 2 3 4 255\r\n0 0.5 0 0\r\nnan 0 1 0\r\n0 0 1 1\r\n0 0 0 1 0 0 -1\r\n0.5\r\n2 0 1\r\n";
    let file = read_ply(text).unwrap();
    let expected = [
        [0.0, 0.0, 0.5],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, 0.5, 0.0],
    ];
    assert_eq!(file.vertices, places(&expected));
    assert_eq!(file.faces, [[0, 1, 2], [0, 1, 2], [0, 2, 3], [0, 3, 4]]);
    // A cloud of points.
    let cloud = read_ply(b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3").unwrap();
    assert_eq!(cloud.vertices, [Vec3::new(1.0, 2.0, 3.0)]);
    assert_eq!(cloud.mesh().unwrap_err(), MeshFault::Empty);
}

/// Both orders of bytes, and every type of numbers.
#[test]
fn ply_in_bytes() {
    let header = |order: &str| {
        format!(
            "ply\nformat binary_{order}_endian 1.0\nelement vertex 3\nproperty short x\nproperty float y\n\
             property double z\nproperty list ushort int8 rest\nelement face 1\nproperty char flag\n\
             property list int32 uint16 vertex_indices\nend_header\n"
        )
    };
    let (mut little, mut big) = (header("little").into_bytes(), header("big").into_bytes());
    let mut both = |low: &[u8]| {
        little.extend_from_slice(low);
        big.extend(low.iter().rev());
    };
    for k in 0..3_i16 {
        both(&(-300 * k).to_le_bytes());
        both(&(0.25 * f32::from(k)).to_le_bytes());
        both(&(1e-3 * f64::from(k)).to_le_bytes());
        both(&(k as u16).to_le_bytes());
        for _ in 0..k {
            both(&[0xff]);
        }
    }
    both(&[0x80]);
    both(&3_i32.to_le_bytes());
    for vertex in [2_u16, 0, 1] {
        both(&vertex.to_le_bytes());
    }
    for bytes in [little, big] {
        let file = read_ply(&bytes).unwrap();
        let expected = [[0.0; 3], [-300.0, 0.25, 1e-3], [-600.0, 0.5, 2e-3]];
        assert_eq!(file.vertices, places(&expected));
        assert_eq!(file.faces, [[2, 0, 1]]);
    }
}

#[test]
fn files_by_their_names() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("mesh_files");
    std::fs::create_dir_all(&folder).unwrap();
    let owned = bumpy_sphere(2);
    for (name, format) in [
        ("a.obj", FileFormat::Obj),
        ("b.STL", FileFormat::StlText),
        ("c.stl", FileFormat::StlBinary),
        ("d.Ply", FileFormat::PlyText),
        ("e.ply", FileFormat::PlyBinary),
    ] {
        let path = folder.join(name);
        write_mesh_file(&owned.mesh(), format, &path).unwrap();
        let file = read_mesh_file(&path).unwrap();
        assert_eq!(file.faces.len(), owned.faces.len(), "{name}");
        let (volume, expected) = (file.mesh().unwrap().volume(), owned.mesh().volume());
        assert!((volume - expected).abs() < 1e-6 * expected, "{name}");
    }
}

//! Files of meshes that lack bytes or have others.
use super::good_files::written;
use super::mesh_shapes::{bumpy_sphere, cube};
use crate::space::draw::Random;
use geograd::mesh_files::{FileFormat, FilePlace};

/// Every beginning of a file is a mesh or refused; one that lacks bytes is refused.
#[test]
fn truncated_files() {
    let owned = bumpy_sphere(0);
    for (format, at_least) in [
        (FileFormat::Obj, None),
        (FileFormat::StlText, Some(17)),
        (FileFormat::StlBinary, Some(0)),
        // A last number may lose digits.
        (FileFormat::PlyText, Some(3)),
        (FileFormat::PlyBinary, Some(0)),
    ] {
        let good = written(&owned.mesh(), format);
        for end in 0..good.len() {
            let done = format.kind().read(&good[..end]);
            if let Some(spare) = at_least {
                assert!(
                    done.is_err() || end + spare >= good.len(),
                    "{format:?} {end}"
                );
            }
        }
    }
}

/// Files with bytes changed, removed and doubled are valid meshes or refused.
#[test]
fn damaged_files() {
    let mut random = Random(0xbad_f11e_5eed_0001);
    let owned = cube();
    let (mut read, mut refused) = (0, 0);
    for format in [
        FileFormat::Obj,
        FileFormat::StlText,
        FileFormat::StlBinary,
        FileFormat::PlyText,
        FileFormat::PlyBinary,
    ] {
        let good = written(&owned.mesh(), format);
        for _ in 0..2000 {
            let mut bytes = good.clone();
            for _ in 0..=random.below(4) {
                let at = random.below(bytes.len());
                match random.below(4) {
                    0 => bytes[at] = random.below(256) as u8,
                    1 => bytes[at] = b"0123456789-. \n\r/einf"[random.below(20)],
                    2 => drop(bytes.drain(at..(at + 1 + random.below(9)).min(bytes.len()))),
                    _ => bytes.extend_from_within(at..),
                }
                if bytes.is_empty() {
                    break;
                }
            }
            match format.kind().read(&bytes) {
                Ok(file) => {
                    read += 1;
                    let mesh = file.mesh();
                    assert!(mesh.is_ok() || file.faces.is_empty(), "{mesh:?}");
                }
                Err(fault) => {
                    refused += 1;
                    assert_eq!(fault.kind, Some(format.kind()));
                    assert!(fault.place != FilePlace::Whole, "{fault}");
                }
            }
        }
    }
    assert!(read > 1000 && refused > 3000, "{read} {refused}");
}

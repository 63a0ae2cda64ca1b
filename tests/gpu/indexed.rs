//! Columns by indices on a GPU: the bits of columns with the items themselves.
use crate::gpu;
use geograd::kernels::{Area, Cpu, Distance, Indexed};
use geograd::{Pack, Triangle3, Vec3};

/// A wavy sheet of vertices, and its faces.
fn sheet(side: usize) -> (Vec<Vec3<f32>>, Vec<[u32; 3]>) {
    let place = |k: usize| {
        let (x, y) = ((k % side) as f32 * 0.25, (k / side) as f32 * 0.25);
        Vec3::new(x, y, (3.0 * x).sin() * (2.0 * y).cos())
    };
    let corner = |i: usize, j: usize| (j * side + i) as u32;
    let quads = (0..side - 1).flat_map(|j| (0..side - 1).map(move |i| (i, j)));
    let faces = quads.flat_map(|(i, j)| {
        let (a, b) = (corner(i, j), corner(i + 1, j));
        let (c, d) = (corner(i + 1, j + 1), corner(i, j + 1));
        [[a, b, c], [a, c, d]]
    });
    ((0..side * side).map(place).collect(), faces.collect())
}

#[test]
fn columns_by_indices_are_columns_of_a_gpu() {
    let Some((_turn, gpu)) = gpu() else { return };
    let (vertices, indices) = sheet(20);
    let column = Indexed::new(&vertices, &indices).unwrap();
    let faces: Vec<Triangle3<f32>> = (0..indices.len()).map(|k| column.shape(k)).collect();
    assert_eq!(gpu.aligned(Area, column), gpu.aligned(Area, &faces));
    let points: Vec<Vec3<f32>> = (0..faces.len())
        .map(|k| Vec3::new(0.01 * k as f32, 3.0 - 0.004 * k as f32, 1.5))
        .collect();
    let found = gpu
        .aligned(Distance.value_grad(), (&points, column))
        .unwrap();
    let same = gpu
        .aligned(Distance.value_grad(), (&points, &faces))
        .unwrap();
    assert_eq!(found, same);
    // Cotangents of shared vertices are those of the CPU, within the GPU's roundings.
    let (values, (_, by_face)) = found;
    let cpu = Cpu::new();
    let (known, (_, by_known)) = cpu
        .aligned(Distance.value_grad(), (&points, column))
        .unwrap();
    assert!(
        values
            .iter()
            .zip(&known)
            .all(|(&a, &b)| (a - b).abs() <= 1e-5)
    );
    let (found, known) = (column.gathered(&by_face), column.gathered(&by_known));
    let numbers =
        |all: Vec<Vec3<f32>>| -> Vec<f32> { all.iter().flat_map(Pack::scalars).collect() };
    let (found, known) = (numbers(found.unwrap()), numbers(known.unwrap()));
    assert!(known.iter().any(|x| x.abs() > 1.0));
    for (k, (&found, &known)) in found.iter().zip(&known).enumerate() {
        let bound = 1e-4 * known.abs().max(1.0);
        assert!(
            (found - known).abs() <= bound,
            "number {k}: {found} {known}"
        );
    }
}

//! The derivative of a clearance as that of the nearest pairs alone.
//!
//! Searches for the least of many distances differentiate the least ones; a pull-back through the joints gives the rest.
//! The distances of all pairs as one recorded function take five times as long.
use crate::arm::{Joints, Solids, scene, solids};
use geograd::kernels::verbs::SignedDistance;
use geograd::kernels::{Cpu, Function, One, Single, function};
use geograd::{Capsule3, Error, Fixed};
use std::ops::Range;

/// The clearance of some configurations, with its derivatives.
#[derive(Debug, Default)]
pub struct Found {
    pub values: Vec<f32>,
    pub by_joints: Vec<Joints<f32>>,
    pub by_radius: Vec<f32>,
}

/// The least distance of an arm so far, and the sum of the derivatives of those that are equal.
#[derive(Clone, Copy)]
struct Least {
    value: f32,
    ties: f32,
    by_arm: Solids<f32>,
}

impl Least {
    fn of(value: f32) -> Self {
        let (ties, by_arm) = (0.0, Solids::filled(0.0));
        Least {
            value,
            ties,
            by_arm,
        }
    }
    /// Takes a distance, and its derivatives if it counts.
    fn take(&mut self, value: f32, add: impl FnOnce(&mut Solids<f32>)) {
        if value < self.value {
            *self = Least::of(value);
        }
        if value == self.value {
            self.ties += 1.0;
            add(&mut self.by_arm);
        }
    }
}

/// Returns the least distance of every row from what is around, and its derivative by the row.
fn of_rows<A, B>(rows: &[A], around: &[B]) -> Result<Vec<(f32, A)>, Error>
where
    A: Single<Scalar = f32>,
    B: Single<Scalar = f32>,
    SignedDistance: Function<(A, B), Out = f32>,
{
    let (near, by_rows, _) = Cpu::new().row_min_grad(SignedDistance, rows, around, f32::MAX)?;
    let values = near.into_iter().flatten().map(|best| best.value);
    Ok(values.zip(by_rows).collect())
}

/// As [`of_rows`], of columns.
fn of_columns<A, B>(around: &[A], columns: &[B]) -> Result<Vec<(f32, B)>, Error>
where
    A: Single<Scalar = f32>,
    B: Single<Scalar = f32>,
    SignedDistance: Function<(A, B), Out = f32>,
{
    let (near, _, by_columns) =
        Cpu::new().column_min_grad(SignedDistance, around, columns, f32::MAX)?;
    let values = near.into_iter().flatten().map(|best| best.value);
    Ok(values.zip(by_columns).collect())
}

/// Returns the clearance of every configuration, with its derivatives by joints and radius. Parts that are equally near
/// share the derivative equally.
pub fn clearances(joints: &[Joints<f32>], radius: f32) -> Result<Found, Error> {
    let (cpu, around) = (Cpu::new(), scene::<f32>());
    let columns = (joints, One(radius));
    let arms = cpu.aligned(function(solids), columns)?;
    let mut least = vec![Least::of(f32::INFINITY); arms.len()];
    let links = |range: Range<usize>| -> Vec<Capsule3<f32>> {
        let each = arms.iter().flat_map(|arm| &arm.links[range.clone()]);
        each.copied().collect()
    };
    let hands: Vec<_> = arms.iter().map(|arm| arm.hand).collect();
    for (from, found) in [
        (0, of_rows(&links(0..5), &around.rods)?),
        (0, of_rows(&links(0..5), &around.boxes)?),
        (1, of_columns(&[around.floor], &links(1..5))?),
        (2, of_rows(&links(2..5), &[around.pedestal])?),
    ] {
        for (i, (value, by)) in found.into_iter().enumerate() {
            let (arm, link) = (i / (5 - from), from + i % (5 - from));
            least[arm].take(value, |arm| arm.links[link] = arm.links[link].plus(by));
        }
    }
    let [a, b] = around.boxes;
    for found in [
        of_rows(&hands, &[a, b, around.pedestal])?,
        of_columns(&around.rods, &hands)?,
        of_columns(&[around.floor], &hands)?,
    ] {
        for (least, (value, by)) in least.iter_mut().zip(found) {
            least.take(value, |arm| arm.hand = arm.hand.plus(by));
        }
    }
    // Parts of one arm that are not neighbours.
    let run = SignedDistance.value_grad();
    for k in [0, 1] {
        let near = links(k..k + 1);
        for j in [3, 4] {
            let (values, by) = cpu.aligned(run, (&near[..], &links(j..j + 1)[..]))?;
            for (i, least) in least.iter_mut().enumerate() {
                least.take(values[i], |arm| {
                    arm.links[k] = arm.links[k].plus(by.0[i]);
                    arm.links[j] = arm.links[j].plus(by.1[i]);
                });
            }
        }
        let (values, by) = cpu.aligned(run, (&near[..], &hands[..]))?;
        for (i, least) in least.iter_mut().enumerate() {
            least.take(values[i], |arm| {
                arm.links[k] = arm.links[k].plus(by.0[i]);
                arm.hand = arm.hand.plus(by.1[i]);
            });
        }
    }
    let by_arm: Vec<_> = least
        .iter()
        .map(|near| near.by_arm.scaled_by(1.0 / near.ties))
        .collect();
    let (by_joints, by_radius) = cpu.aligned(function(solids).vjp(), (columns, &by_arm[..]))?;
    let values = least.iter().map(|near| near.value).collect();
    Ok(Found {
        values,
        by_joints,
        by_radius,
    })
}

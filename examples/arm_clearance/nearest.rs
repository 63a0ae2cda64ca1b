//! The derivative of a clearance as that of the nearest pairs alone.
//!
//! The derivative of the least of many distances is that of the least one. A batch of values finds the nearest pairs;
//! one batch for each kind of pair differentiates their distance; a pull-back through the joints gives the rest.
//!
//! The gradient of all pairs as one recorded function has 260 000 operations and takes more than ten times as long.
use crate::arm::{Form, Joints, PAIRS, Part, Solids, distances, form, scene, solids};
use geograd::kernels::verbs::SignedDistance;
use geograd::kernels::{Cpu, One, function};
use geograd::{Error, Fixed};

/// The clearance of some configurations, with its derivatives.
#[derive(Debug, Default)]
pub struct Found {
    pub values: Vec<f32>,
    pub by_joints: Vec<Joints<f32>>,
    pub by_radius: Vec<f32>,
}

/// Pairs of one kind: where they count, by how much, and the shapes of both.
struct Kind<A, B> {
    at: Vec<(usize, f32, Part, Part)>,
    a: Vec<A>,
    b: Vec<B>,
}

impl<A, B> Kind<A, B> {
    fn new() -> Self {
        Kind {
            at: Vec::new(),
            a: Vec::new(),
            b: Vec::new(),
        }
    }
    fn push(&mut self, at: (usize, f32, Part, Part), a: A, b: B) {
        self.at.push(at);
        self.a.push(a);
        self.b.push(b);
    }
}

/// Adds the derivative by a part to that by its arm; what is around the arm is fixed.
fn add(arm: &mut Solids<f32>, part: Part, by: Form<f32>) {
    match (part, by) {
        (Part::Link(k), Form::Round(by)) => arm.links[k] = arm.links[k].plus(by),
        (Part::Hand, Form::Cubic(by)) => arm.hand = arm.hand.plus(by),
        _ => (),
    }
}

/// The clearance of every configuration, with its derivatives by joints and radius. Pairs that are equally near share
/// the derivative equally.
pub fn clearances(joints: &[Joints<f32>], radius: f32) -> Result<Found, Error> {
    let (cpu, around) = (Cpu::new(), scene::<f32>());
    let columns = (joints, One(radius));
    let all = cpu.aligned(function(distances), columns)?;
    let arms = cpu.aligned(function(solids), columns)?;
    let mut found = Found::default();
    let (mut rr, mut rc, mut cc) = (Kind::new(), Kind::new(), Kind::new());
    let (mut fr, mut fc) = (Kind::new(), Kind::new());
    for (i, (all, arm)) in all.iter().zip(&arms).enumerate() {
        let least = all.iter().copied().fold(f32::INFINITY, f32::min);
        let share = 1.0 / all.iter().filter(|&&distance| distance == least).count() as f32;
        found.values.push(least);
        for (&(a, b), _) in PAIRS
            .iter()
            .zip(all)
            .filter(|(_, distance)| **distance == least)
        {
            use Form::{Cubic, Flat, Round};
            match (form(a, arm, &around), form(b, arm, &around)) {
                (Round(x), Round(y)) => rr.push((i, share, a, b), x, y),
                (Round(x), Cubic(y)) => rc.push((i, share, a, b), x, y),
                (Cubic(x), Round(y)) => rc.push((i, share, b, a), y, x),
                (Cubic(x), Cubic(y)) => cc.push((i, share, a, b), x, y),
                (Round(x), Flat(y)) => fr.push((i, share, b, a), y, x),
                (Flat(x), Round(y)) => fr.push((i, share, a, b), x, y),
                (Cubic(x), Flat(y)) => fc.push((i, share, b, a), y, x),
                (Flat(x), Cubic(y)) => fc.push((i, share, a, b), x, y),
                (Flat(_), Flat(_)) => (),
            }
        }
    }
    let mut by_arm = vec![Solids::filled(0.0); joints.len()];
    macro_rules! add {
        ($kind:ident, $A:ident, $B:ident) => {
            let columns = (&$kind.a[..], &$kind.b[..]);
            let (_, (by_a, by_b)) = cpu.aligned(SignedDistance.value_grad(), columns)?;
            for ((&(i, share, a, b), by_a), by_b) in $kind.at.iter().zip(by_a).zip(by_b) {
                add(&mut by_arm[i], a, Form::$A(by_a.scaled_by(share)));
                add(&mut by_arm[i], b, Form::$B(by_b.scaled_by(share)));
            }
        };
    }
    add!(rr, Round, Round);
    add!(rc, Round, Cubic);
    add!(cc, Cubic, Cubic);
    add!(fr, Flat, Round);
    add!(fc, Flat, Cubic);
    let columns = (columns, &by_arm[..]);
    (found.by_joints, found.by_radius) = cpu.aligned(function(solids).vjp(), columns)?;
    Ok(found)
}

//! How shapes lie: a batch for every two kinds, and one per kind for the walls, over data that stay.
use crate::forms::{CLEARANCE, Form, Kind, Place, Size, Step, cost};
use geograd::kernels::Backend;
use geograd::kernels::resident::Held;
use geograd::{Error, Program, Sym};

type Sized32 = (Size<f32>, Place<f32>);
/// The gap of two shapes, and its derivatives by all that they are made of.
type Gap = (f32, (Size<f32>, Place<f32>, Size<f32>, Place<f32>));

/// All pairs of two kinds.
struct Gaps {
    program: Program<(Size<f32>, Place<f32>, Size<f32>, Place<f32>), Gap>,
    pairs: Vec<(usize, usize)>,
    sizes: [Held<Size<f32>>; 2],
    places: [Held<Place<f32>>; 2],
    found: Option<Held<Gap>>,
}

/// All shapes of a kind, and what they lack of their distance from the walls.
struct Walls {
    program: Program<Sized32, (f32, Sized32)>,
    own: Vec<usize>,
    sizes: Held<Size<f32>>,
    places: Held<Place<f32>>,
    found: Option<Held<(f32, Sized32)>>,
}

/// Looks at shapes wherever a backend computes.
pub struct Judge<'a> {
    here: Backend<'a>,
    forms: Vec<Form>,
    gaps: Vec<Gaps>,
    walls: Vec<Walls>,
}

fn narrow<const N: usize>(all: impl Iterator<Item = [f64; N]>) -> Vec<[f32; N]> {
    all.map(|numbers| numbers.map(|x| x as f32)).collect()
}

impl<'a> Judge<'a> {
    /// Records what two kinds have to do with each other, and brings what shapes measure to the machine.
    pub fn new(backend: Backend<'a>, forms: &[Form]) -> Result<Self, Error> {
        let here = backend.resident();
        let of = |kind| (0..forms.len()).filter(move |&i| forms[i].kind == kind);
        let sizes = |own: &[usize]| here.upload(&narrow(own.iter().map(|&i| forms[i].size)));
        let places = |count| here.upload(&vec![[0.0; 3]; count]);
        let (mut gaps, mut walls) = (Vec::new(), Vec::new());
        for (k, &first) in Kind::ALL.iter().enumerate() {
            for &second in &Kind::ALL[..=k] {
                let both = of(first).flat_map(|i| of(second).map(move |j| (i, j)));
                // Every two shapes of one kind are a pair once.
                let pairs: Vec<_> = both.filter(|(i, j)| first != second || i > j).collect();
                type Recorded = (
                    Size<Sym<f32>>,
                    Place<Sym<f32>>,
                    Size<Sym<f32>>,
                    Place<Sym<f32>>,
                );
                let program =
                    Program::trace(|(a, p, b, q): Recorded| first.at(a, p).gap(second.at(b, q)))?;
                let (i, j): (Vec<_>, Vec<_>) = pairs.iter().copied().unzip();
                gaps.push(Gaps {
                    program: program.value_grad(),
                    sizes: [sizes(&i)?, sizes(&j)?],
                    places: [places(pairs.len())?, places(pairs.len())?],
                    pairs,
                    found: None,
                });
            }
            let program = Program::trace(|(size, place): (Size<Sym<f32>>, Place<Sym<f32>>)| {
                let [left, bottom, right, top] = first.at(size, place).room().map(cost);
                (left + bottom) + (right + top)
            })?;
            let own: Vec<usize> = of(first).collect();
            walls.push(Walls {
                program: program.value_grad(),
                sizes: sizes(&own)?,
                places: places(own.len())?,
                own,
                found: None,
            });
        }
        Ok(Judge {
            here,
            forms: forms.to_vec(),
            gaps,
            walls,
        })
    }

    /// The loss, its derivatives by every place, and the deepest penetration.
    pub fn judge(&mut self, all: &[Place<f64>]) -> Result<(Step, Vec<Place<f64>>), Error> {
        let mut derivatives = vec![[0.0; 3]; all.len()];
        let mut step = Step {
            loss: 0.0,
            penetration: 0.0,
        };
        let mut add = |i: usize, derivative: Place<f32>, factor: f64| {
            for (sum, s) in derivatives[i].iter_mut().zip(derivative) {
                *sum += factor * f64::from(s);
            }
        };
        for (form, &place) in self.forms.iter().zip(all) {
            for gap in form.at(place).room() {
                step.penetration = step.penetration.max(-gap);
            }
        }
        let here = self.here;
        for walls in &mut self.walls {
            walls
                .places
                .update(&narrow(walls.own.iter().map(|&i| all[i])))?;
            let columns = (&walls.sizes, &walls.places);
            let found = compute(here, &walls.program, columns, &mut walls.found)?;
            let (losses, (_, by_place)) = found.download()?;
            for ((&i, loss), derivative) in walls.own.iter().zip(losses).zip(by_place) {
                step.loss += f64::from(loss);
                add(i, derivative, 1.0);
            }
        }
        for gaps in &mut self.gaps {
            let [a, b] = &mut gaps.places;
            a.update(&narrow(gaps.pairs.iter().map(|pair| all[pair.0])))?;
            b.update(&narrow(gaps.pairs.iter().map(|pair| all[pair.1])))?;
            let columns = (&gaps.sizes[0], &*a, &gaps.sizes[1], &*b);
            let found = compute(here, &gaps.program, columns, &mut gaps.found)?;
            let (widths, (_, by_a, _, by_b)) = found.download()?;
            for (k, &(i, j)) in gaps.pairs.iter().enumerate() {
                let gap = f64::from(widths[k]);
                step.penetration = step.penetration.max(-gap);
                step.loss += cost(gap);
                let steep = -2.0 * (CLEARANCE - gap).max(0.0);
                add(i, by_a[k], steep);
                add(j, by_b[k], steep);
            }
        }
        Ok((step, derivatives))
    }
}

/// Runs a program, from the second time on over the results of the time before.
fn compute<'f, C, In, Out>(
    here: Backend<'_>,
    program: &Program<In, Out>,
    columns: C,
    found: &'f mut Option<Held<Out>>,
) -> Result<&'f Held<Out>, Error>
where
    C: geograd::kernels::Columns<Item = In, Place = geograd::kernels::machine::There>,
    In: geograd::kernels::Item<Scalar = f32>,
    Out: geograd::kernels::Item<Scalar = f32>,
{
    match found {
        Some(held) => here.aligned_into(program, columns, held)?,
        None => *found = Some(here.aligned(program, columns)?),
    }
    Ok(found.as_ref().expect("just computed"))
}

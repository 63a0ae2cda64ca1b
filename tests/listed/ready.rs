//! Batches with all that they take, on any machine.
use crate::list::Tested;
use geograd::Error;
use geograd::ad::check::sample::Draw;
use geograd::kernels::Backend;
use geograd::kernels::dynamic::{Function, Layout, Mode, OnPaths, Rows};
use geograd::kernels::resident::{HeldNumbers, Matrix};

/// Corners of the paths.
pub const CORNERS: usize = 16;
/// Different shapes; more items repeat them.
const DIFFERENT: usize = 4096;

/// A batch with all that it takes where it is computed.
pub trait Ready {
    fn run(&mut self) -> Result<(), Error>;
    /// The results of the last run, a list for every shape of a result.
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error>;
    /// A number of a list, computed on the processor at inputs moved by a few last digits in many ways:
    /// beside a kink or a jump the results differ. `None` for paths.
    fn beside(&self, _list: usize, _at: usize) -> Result<Option<Vec<f32>>, Error> {
        Ok(None)
    }
}

/// The number of ways in which items are moved.
const WAYS: usize = 64;

/// Items of several columns, item after item.
#[derive(Clone)]
struct Items {
    row: &'static Tested,
    layouts: Vec<Layout<f32>>,
    all: Vec<Vec<f32>>,
}

impl Items {
    /// So many inputs of a row that are valid.
    fn drawn(row: &'static Tested, count: usize) -> Self {
        let (mut draw, layouts) = (Draw::new(1), row.operation.layouts::<f32>());
        let mut items = Items {
            row,
            layouts,
            all: Vec::new(),
        };
        while items.all.len() < count.min(DIFFERENT) {
            let item: Vec<f32> = row.ordinary(&mut draw).iter().map(|&x| x as f32).collect();
            if items.accept(&item) {
                items.all.push(item);
            }
        }
        items.all = (0..count)
            .map(|i| items.all[i % DIFFERENT].clone())
            .collect();
        items
    }
    /// Whether an item has valid shapes, for which the row is defined.
    fn accept(&self, item: &[f32]) -> bool {
        let mut rest = item;
        let is_valid = self.layouts.iter().all(|layout| {
            let (own, others) = rest.split_at(layout.fields());
            rest = others;
            layout.check(own).is_ok()
        });
        let arguments = self.row.operation.arguments().len();
        let own = self.layouts.iter().take(arguments);
        let own: usize = own.map(Layout::fields).sum();
        let numbers: Vec<f64> = item[..own].iter().map(|&x| f64::from(x)).collect();
        is_valid && self.row.operation.is_inside(&numbers)
    }
    /// The column of an argument.
    fn column(&self, k: usize) -> Vec<f32> {
        let from: usize = self.layouts[..k].iter().map(Layout::fields).sum();
        let own = from..from + self.layouts[k].fields();
        self.all
            .iter()
            .flat_map(|x| x[own.clone()].to_vec())
            .collect()
    }
    fn columns(&self) -> Vec<(Vec<f32>, usize)> {
        let fields = |k: usize| self.layouts[k].fields();
        (0..self.layouts.len())
            .map(|k| (self.column(k), fields(k)))
            .collect()
    }
    /// An item moved in many ways by up to sixteen last digits of its largest number. No number changes its sign, so
    /// that sizes stay sizes; where the item would not be valid any more, it stays as it is.
    fn moved(&self, item: &[f32], draw: &mut Draw) -> Items {
        let largest = item.iter().fold(0.0_f32, |most, x| most.max(x.abs()));
        // Whole numbers stay.
        let is_scalar = self.layouts.iter().flat_map(|layout| {
            let scalars = layout.fields() - layout.codes();
            (0..layout.fields()).map(move |i| i < scalars)
        });
        let is_scalar: Vec<bool> = is_scalar.collect();
        let mut way = |way: usize| -> Vec<f32> {
            let digit = f32::EPSILON * largest * [1.0, 4.0, 16.0][way % 3];
            let numbers = item.iter().zip(&is_scalar).map(|(&x, &is_scalar)| {
                let there = x + digit * (2.0 * draw.unit() - 1.0) as f32;
                if there * x < 0.0 || !is_scalar {
                    x
                } else {
                    there
                }
            });
            let there: Vec<f32> = numbers.collect();
            if self.accept(&there) {
                there
            } else {
                item.to_vec()
            }
        };
        Items {
            row: self.row,
            layouts: self.layouts.clone(),
            all: (0..WAYS).map(&mut way).collect(),
        }
    }
}

fn rows(columns: &[(Vec<f32>, usize)]) -> Vec<Rows<'_, f32>> {
    columns.iter().map(|(x, n)| Rows::new(x, *n)).collect()
}

struct Aligned<'a> {
    here: Backend<'a>,
    run: Function<f32>,
    items: Items,
    held: HeldNumbers,
    found: Option<HeldNumbers>,
}

impl Ready for Aligned<'_> {
    fn run(&mut self) -> Result<(), Error> {
        let found = self.found.take();
        self.found = Some(self.here.aligned_rows(&self.run, &self.held, found)?);
        Ok(())
    }
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error> {
        self.found
            .as_ref()
            .map_or(Ok(Vec::new()), HeldNumbers::numbers)
    }
    fn beside(&self, list: usize, at: usize) -> Result<Option<Vec<f32>>, Error> {
        let width = self.run.gives()[list];
        let there = self
            .items
            .moved(&self.items.all[at / width], &mut Draw::new(at as u64));
        let found = &self.run.aligned(&rows(&there.columns()))?[list];
        let way = |way: usize| found[way * width + at % width];
        Ok(Some((0..WAYS).map(way).collect()))
    }
}

/// So many items side by side.
pub fn aligned<'a>(
    backend: Backend<'a>,
    row: &'static Tested,
    mode: Mode,
    count: usize,
) -> Result<Box<dyn Ready + 'a>, Error> {
    let (here, mut items) = (backend.resident(), Items::drawn(row, count));
    let run = row
        .operation
        .function::<f32>(mode)
        .expect("is of fixed size");
    // Cotangents of one are arguments, too.
    items.layouts = run.takes().into_iter().map(|(_, layout)| layout).collect();
    let wide: usize = items.layouts.iter().map(Layout::fields).sum();
    items.all.iter_mut().for_each(|item| item.resize(wide, 1.0));
    let held = here.upload_rows(&rows(&items.columns()))?;
    let mut ready = Aligned {
        here,
        run,
        items,
        held,
        found: None,
    };
    ready.run()?;
    Ok(Box::new(ready))
}

struct Pairs<'a> {
    here: Backend<'a>,
    run: Function<f32>,
    items: Items,
    a: HeldNumbers,
    b: HeldNumbers,
    matrix: Option<Matrix>,
    /// The derivatives, if they are wanted.
    derivatives: Option<Vec<HeldNumbers>>,
}

impl Pairs<'_> {
    /// Derivatives of every row of a matrix of moved shapes, or of every column.
    fn sums(&self, a: &[f32], b: &[f32], list: usize) -> Result<Vec<f32>, Error> {
        let [n, m] = [0, 1].map(|k| self.items.layouts[k].fields());
        let (a, b) = (Rows::new(a, n), Rows::new(b, m));
        let matrix = self.run.all_pairs(a, b)?;
        let (by_a, by_b) = self.run.all_pairs_vjp(a, b, &matrix)?;
        Ok(if list == 0 { by_a } else { by_b })
    }
}

impl Ready for Pairs<'_> {
    fn run(&mut self) -> Result<(), Error> {
        let (run, a, b) = (&self.run, &self.a, &self.b);
        match (&mut self.derivatives, &self.matrix) {
            (Some(derivatives), Some(matrix)) => {
                *derivatives = self.here.all_pairs_vjp_rows(run, a, b, matrix)?.into();
            }
            _ => {
                let into = self.matrix.take();
                self.matrix = Some(self.here.all_pairs_rows(run, a, b, into)?);
            }
        }
        Ok(())
    }
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error> {
        match &self.derivatives {
            Some(derivatives) => derivatives
                .iter()
                .map(|own| Ok(own.numbers()?.concat()))
                .collect(),
            None => self.matrix.iter().map(Matrix::download).collect(),
        }
    }
    fn beside(&self, list: usize, at: usize) -> Result<Option<Vec<f32>>, Error> {
        let mut draw = Draw::new(at as u64);
        let (items, n) = (&self.items, self.items.layouts[0].fields());
        let side = items.all.len();
        if self.derivatives.is_none() {
            let pair = [&items.all[at / side][..n], &items.all[at % side][n..]].concat();
            let there = items.moved(&pair, &mut draw).columns();
            return Ok(Some(self.run.aligned(&rows(&there))?.concat()));
        }
        // A sum over all of the others, each of which is moved, too.
        let width = items.layouts[list].fields();
        let all: Vec<Items> = items
            .all
            .iter()
            .map(|x| items.moved(x, &mut draw))
            .collect();
        let way = |way: usize| {
            let mine = &all[at / width].all[way];
            let others = all.iter().flat_map(|x| match list {
                0 => x.all[way][n..].to_vec(),
                _ => x.all[way][..n].to_vec(),
            });
            let others: Vec<f32> = others.collect();
            let found = match list {
                0 => self.sums(&mine[..n], &others, list)?,
                _ => self.sums(&others, &mine[n..], list)?,
            };
            Ok(found[at % width])
        };
        (0..WAYS).map(way).collect::<Result<_, _>>().map(Some)
    }
}

/// The matrix of `side` rows and as many columns, ready to run.
pub fn pairs<'a>(
    backend: Backend<'a>,
    row: &'static Tested,
    side: usize,
    derivatives: bool,
) -> Result<Box<dyn Ready + 'a>, Error> {
    let (here, items) = (backend.resident(), Items::drawn(row, side));
    let columns = items.columns();
    let lists = rows(&columns);
    let (a, b) = (
        here.upload_rows(&lists[..1])?,
        here.upload_rows(&lists[1..])?,
    );
    let mut ready = Pairs {
        here,
        run: row.operation.value::<f32>().expect("is of fixed size"),
        items,
        a,
        b,
        matrix: None,
        derivatives: None,
    };
    ready.run()?;
    if derivatives {
        ready.derivatives = Some(Vec::new());
        ready.run()?;
    }
    Ok(Box::new(ready))
}

/// Stars, one after another, as numbers: of two or three a vertex.
fn stars(count: usize, wide: usize) -> (Vec<f32>, Vec<usize>) {
    let mut draw = Draw::new(2);
    let corner = |k: usize| {
        let (radius, angle) = (
            0.5 + draw.unit(),
            k as f64 * std::f64::consts::TAU / CORNERS as f64,
        );
        let mut corner = vec![(radius * angle.cos()) as f32, (radius * angle.sin()) as f32];
        corner.resize_with(wide, || draw.unit() as f32);
        corner
    };
    let different: Vec<_> = (0..CORNERS * DIFFERENT).map(corner).collect();
    let vertices = (0..CORNERS * count).flat_map(|k| different[k % different.len()].clone());
    (
        vertices.collect(),
        (0..=count).map(|i| i * CORNERS).collect(),
    )
}

struct Paths<'a> {
    backend: Backend<'a>,
    run: OnPaths<f32>,
    contexts: Vec<(Vec<f32>, usize)>,
    vertices: Vec<f32>,
    offsets: Vec<usize>,
    values: Vec<f32>,
    ups: Vec<f32>,
    derivatives: (Vec<Vec<f32>>, Vec<f32>),
}

impl Ready for Paths<'_> {
    fn run(&mut self) -> Result<(), Error> {
        let (contexts, run) = (rows(&self.contexts), &self.run);
        let (backend, vertices, offsets) = (self.backend, &self.vertices, &self.offsets);
        match self.ups.is_empty() {
            true => self.values = run.on(backend)?.values(&contexts, vertices, offsets)?,
            false => {
                self.derivatives = run
                    .on(backend)?
                    .vjp(&contexts, vertices, offsets, &self.ups)?
            }
        }
        Ok(())
    }
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error> {
        let (contexts, vertices) = &self.derivatives;
        Ok(vec![
            self.values.clone(),
            contexts.concat(),
            vertices.clone(),
        ])
    }
}

/// So many paths.
pub fn paths<'a>(
    backend: Backend<'a>,
    row: &'static Tested,
    count: usize,
    derivatives: bool,
) -> Result<Box<dyn Ready + 'a>, Error> {
    let run = row.operation.on_paths::<f32>().expect("takes paths");
    let (vertices, offsets) = stars(count, run.vertex());
    let mut draw = Draw::new(1);
    let takes = run.takes();
    let wide: usize = takes.iter().map(|(_, layout)| layout.fields()).sum();
    let different = (0..count.min(DIFFERENT)).map(|_| {
        let item = row.ordinary(&mut draw);
        item[..wide].iter().map(|&x| x as f32).collect()
    });
    let mut items = Items {
        row,
        layouts: takes.into_iter().map(|(_, layout)| layout).collect(),
        all: different.collect(),
    };
    items.all = (0..count)
        .map(|i| items.all[i % DIFFERENT].clone())
        .collect();
    let ups = if derivatives { count * run.gives() } else { 0 };
    let mut ready = Paths {
        backend,
        run,
        contexts: items.columns(),
        vertices,
        offsets,
        values: Vec::new(),
        ups: vec![1.0; ups],
        derivatives: (Vec::new(), Vec::new()),
    };
    ready.run()?;
    Ok(Box::new(ready))
}

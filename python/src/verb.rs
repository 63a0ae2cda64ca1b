//! Verbs: a row for every choice of shapes.
use crate::arrays::symbolic;
use crate::at_once;
use crate::catalogue::{self, Row};
use crate::column::{CLOUD3, Column, Kind, NUMBER, NUMBERS, POLYLINE, POLYLINE3, RING};
use crate::forms::Call;
use crate::grouped::SuppressArguments;
use crate::machine::Machine;
use crate::number::{Any, Form, Number};
use crate::pairs::Pairs;
use crate::polygons::Polygons;
use crate::raised;
use crate::shapes::{Content, Paths, Shape, dressed_items};
use crate::symbol::{Symbol, number};
use crate::table::table;
use crate::traced::{Program, listed};
use geograd::kernels::dynamic::{Program as Replay, Sort};
use numpy::{PyArray2, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::{PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString, PyTuple};

type Object<'py> = Bound<'py, PyAny>;

/// A verb: a function of shapes, of which the shapes choose the row.
#[pyclass(frozen, subclass, module = "geograd")]
pub struct Verb {
    place: usize,
}

/// The shape of an argument as far as it says one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ShapeHint {
    /// A plain array, which fits lone numbers, and shapes of one.
    Nothing,
    Kind(Kind),
    /// Paths of any sort with so many numbers a vertex.
    Path(usize),
}

impl ShapeHint {
    fn of(x: &Object<'_>) -> ShapeHint {
        if let Ok(shape) = x.cast::<Shape>() {
            return ShapeHint::Kind(shape.get().kind);
        }
        if let Ok(paths) = x.cast::<Paths>() {
            let paths = paths.get();
            return paths
                .kind
                .map_or(ShapeHint::Path(paths.width), ShapeHint::Kind);
        }
        ShapeHint::Nothing
    }
    fn fits(self, kind: Kind) -> bool {
        match self {
            ShapeHint::Nothing => kind == NUMBER || table().is_one_number(kind),
            ShapeHint::Kind(own) => own == kind,
            ShapeHint::Path(2) => kind == RING || kind == POLYLINE,
            ShapeHint::Path(_) => kind == POLYLINE3 || kind == CLOUD3,
        }
    }
    fn name(self) -> String {
        match self {
            ShapeHint::Nothing => "array".to_owned(),
            ShapeHint::Kind(kind) => table().name(kind).to_owned(),
            ShapeHint::Path(_) => "paths".to_owned(),
        }
    }
}

/// The meaning of an argument `kind`.
enum RequestedKinds {
    Nothing,
    /// The same kind for all shapes.
    All(Kind),
    Each(Vec<Option<Kind>>),
}

impl RequestedKinds {
    fn of(kind: Option<&Object<'_>>) -> PyResult<RequestedKinds> {
        let Some(kind) = kind.filter(|kind| !kind.is_none()) else {
            return Ok(RequestedKinds::Nothing);
        };
        if let Ok(list) = kind.cast::<PyTuple>() {
            return RequestedKinds::each(list.iter());
        }
        if let Ok(list) = kind.cast::<PyList>() {
            return RequestedKinds::each(list.iter());
        }
        one_kind(kind).map(RequestedKinds::All)
    }
    fn each<'py>(list: impl Iterator<Item = Object<'py>>) -> PyResult<RequestedKinds> {
        let one = |kind: Object<'py>| match kind.is_none() {
            true => Ok(None),
            false => one_kind(&kind).map(Some),
        };
        list.map(one)
            .collect::<PyResult<Vec<_>>>()
            .map(RequestedKinds::Each)
    }
}

/// A shape by its name or its class.
fn one_kind(kind: &Object<'_>) -> PyResult<Kind> {
    if let Ok(name) = kind.cast::<PyString>() {
        let name = name.to_cow()?;
        return match table().kind(&name) {
            Some(kind) => Ok(kind),
            None => Err(unknown_shape(kind.py(), &name)?),
        };
    }
    match kind.getattr("_kind") {
        Ok(kind) => kind.extract(),
        Err(_) => Err(PyTypeError::new_err(
            "kind: the name of a shape, its class, or a tuple of such is needed",
        )),
    }
}

/// Returns the error for a name that no shape has: the names that are like it, or all.
fn unknown_shape(py: Python<'_>, name: &str) -> PyResult<PyErr> {
    let known: Vec<&str> = table()
        .shapes
        .iter()
        .map(|shape| shape.name.as_str())
        .collect();
    let is_alike = |known: &&&str| known.eq_ignore_ascii_case(name);
    let alike: Vec<String> = match known.iter().find(is_alike) {
        Some(&known) => vec![known.to_owned()],
        None => py
            .import("difflib")?
            .call_method1("get_close_matches", (name, &known))?
            .extract()?,
    };
    let hint = match &alike[..] {
        [] => format!("shapes are {}", known.join(", ")),
        alike => format!("is it {}?", alike.join(" or ")),
    };
    Ok(PyValueError::new_err(format!(
        "kind: no shape is called {name:?}; {hint}"
    )))
}

/// How many arguments a form takes beside those of the row.
fn further(row: &Row, form: &str) -> usize {
    match form {
        "vjp" => row.call.gives().len(),
        "jvp" | "hvp" => row.takes.len(),
        _ => 0,
    }
}

impl Verb {
    fn of(&self) -> &'static catalogue::Verb {
        &catalogue::verbs()[self.place]
    }
    /// The row for the arguments of a form.
    fn row(
        &self,
        arguments: &[Object<'_>],
        kind: Option<&Object<'_>>,
        to: Option<&Object<'_>>,
        form: &str,
    ) -> PyResult<&'static Row> {
        let verb = self.of();
        let said: Vec<ShapeHint> = arguments.iter().map(ShapeHint::of).collect();
        let wanted = RequestedKinds::of(kind)?;
        let to = to.filter(|to| !to.is_none()).map(one_kind).transpose()?;
        let fits = |row: &&Row| {
            let n = row.takes.len();
            if n + further(row, form) != said.len()
                || to.is_some_and(|to| row.call.gives()[0].kind != to)
            {
                return false;
            }
            row.takes.iter().enumerate().all(|(k, &kind)| {
                let by_kind = match &wanted {
                    RequestedKinds::Nothing => None,
                    // Paths say themselves what they are; lists of symbols do not.
                    RequestedKinds::All(_)
                        if said[k] != ShapeHint::Nothing
                            && matches!(kind, RING | POLYLINE | POLYLINE3 | CLOUD3) =>
                    {
                        None
                    }
                    RequestedKinds::All(all) => {
                        (kind != NUMBER && !table().is_one_number(kind)).then_some(*all)
                    }
                    RequestedKinds::Each(each) => each.get(k).copied().flatten(),
                };
                match (said[k], by_kind) {
                    (ShapeHint::Nothing, Some(named)) => named == kind,
                    (own, Some(named)) => own.fits(kind) && named == kind,
                    (own, None) => own.fits(kind),
                }
            })
        };
        if let RequestedKinds::Each(each) = &wanted {
            let lengths = |row: &&Row| row.takes.len() == each.len();
            if !verb.rows.iter().any(|row| lengths(&row)) {
                return Err(self.refused(
                    &said,
                    form,
                    "kind: a shape for every argument is needed",
                ));
            }
        }
        let mut rows: Vec<&Row> = verb.rows.iter().filter(fits).collect();
        // One kind for all shapes is that of one at least, and of as many as can be: lone numbers fit it, too.
        if let RequestedKinds::All(all) = wanted {
            let named = |row: &Row| row.takes.iter().filter(|&&kind| kind == all).count();
            let most = rows.iter().map(|row| named(row)).max().unwrap_or(0);
            rows.retain(|row| most > 0 && named(row) == most);
        }
        match rows[..] {
            [row] => Ok(row),
            [_, _, ..] => {
                let results: Vec<&str> = rows
                    .iter()
                    .map(|row| table().name(row.call.gives()[0].kind))
                    .collect();
                let why = format!(
                    "several results are possible; say which by to=, one of {}",
                    results.join(", ")
                );
                Err(self.refused(&said, form, &why))
            }
            [] => {
                let plain =
                    said.contains(&ShapeHint::Nothing) && matches!(wanted, RequestedKinds::Nothing);
                let why = match plain {
                    true => {
                        "a plain array does not say which shape its rows are: wrap it, as in geograd.Obb2(array), or pass kind="
                    }
                    false => "no row takes these shapes",
                };
                Err(self.refused(&said, form, why))
            }
        }
    }
    /// Why no row was found, with the rows that are there.
    fn refused(&self, said: &[ShapeHint], form: &str, why: &str) -> PyErr {
        let verb = self.of();
        let given: Vec<String> = said.iter().map(|said| said.name()).collect();
        let rows: Vec<String> = verb.rows.iter().map(|row| signature(&row.takes)).collect();
        let form = if form == "value" {
            String::new()
        } else {
            format!(".{form}")
        };
        PyTypeError::new_err(format!(
            "geograd.{}{form} of ({}): {why}. Shapes that go together: {}",
            verb.name,
            given.join(", "),
            rows.join(", ")
        ))
    }
    fn call<'a, 'py>(
        &self,
        py: Python<'py>,
        row: &'static Row,
        arguments: &'a [Object<'py>],
        out: Option<&'a Object<'py>>,
        backend: Option<&str>,
    ) -> PyResult<Call<'a, 'py>> {
        Ok(Call {
            py,
            of: &row.call,
            name: &self.of().name,
            arguments,
            out,
            machine: Machine::named(backend)?,
        })
    }
    /// The program of a form for inputs like one item.
    fn replayed<T: Number>(
        &self,
        py: Python<'_>,
        row: &'static Row,
        arguments: &[Object<'_>],
        form: Form,
    ) -> PyResult<Replay<T>> {
        let (Some(operation), false) = (row.call.operation(), row.call.is_of_paths()) else {
            // Which says why there is none.
            return form.of(row.call.program::<T>(Form::Value)?);
        };
        self.of_one_item(py, row, arguments, |numbers| {
            form.of(&operation.replay::<T>(numbers).map_err(raised)?)
        })
    }
    /// The hints of a search for one item; none of other rows.
    fn hinted<T: Number>(
        &self,
        py: Python<'_>,
        row: &'static Row,
        arguments: &[Object<'_>],
    ) -> PyResult<Vec<f64>> {
        let (Some(operation), false) = (row.call.operation(), row.call.is_of_paths()) else {
            return Ok(Vec::new());
        };
        self.of_one_item(py, row, arguments, |numbers| {
            let hints = operation.hints::<T>(numbers).map_err(raised)?;
            Ok(hints.into_iter().map(T::widen).collect())
        })
    }
    /// What a closure makes of the numbers of one item.
    fn of_one_item<T: Number, X>(
        &self,
        py: Python<'_>,
        row: &'static Row,
        arguments: &[Object<'_>],
        make: impl FnOnce(&[&[T]]) -> PyResult<X>,
    ) -> PyResult<X> {
        let takes = &row.call.takes;
        let call = self.call(py, row, arguments, None, None)?;
        let lent = call.lent::<T>(call.given(takes)?, takes)?;
        for (own, column) in lent.iter().zip(takes) {
            if own.count() != 1 {
                return Err(PyValueError::new_err(format!(
                    "{}: a replay is of one item, not of {}",
                    column.name,
                    own.count()
                )));
            }
        }
        let numbers = lent.iter().map(|own| own.numbers());
        let numbers = numbers.collect::<PyResult<Vec<_>>>()?;
        make(&numbers)
    }
    /// The row of a form of two lists.
    fn row_of_pairs(
        &self,
        lists: &[Object<'_>],
        kind: Option<&Object<'_>>,
        form: &str,
    ) -> PyResult<&'static Row> {
        let row = self.row(lists, kind, None, form)?;
        if let Some(argument) = lists.iter().position(|x| symbol_in(x, 0).is_some()) {
            let column = row.call.takes.get(argument);
            return Err(symbolic(column.map_or("a", |column| &column.name)));
        }
        if row.call.is_of_paths() {
            return Err(PyTypeError::new_err(format!("paths have no {form}")));
        }
        Ok(row)
    }
    /// Runs a form item by item.
    fn items<'py>(
        &self,
        py: Python<'py>,
        (name, form): (&str, Form),
        arguments: &[Object<'py>],
        [kind, to, out]: [Option<&Object<'py>>; 3],
        backend: Option<&str>,
    ) -> PyResult<Object<'py>> {
        if arguments.iter().any(|x| x.is_instance_of::<Polygons>()) || self.is_of_points(arguments)
        {
            return self.of_polygons(py, name, arguments, [kind, to, out], backend);
        }
        let row = self.row(arguments, kind, to, name)?;
        if let Some(like) = arguments.iter().find_map(|x| symbol_in(x, 0)) {
            if out.is_some() {
                return Err(PyTypeError::new_err("out is for arrays, not for symbols"));
            }
            return match like {
                Any::Single(_) => self.recorded::<f32>(py, row, form, arguments),
                Any::Double(_) => self.recorded::<f64>(py, row, form, arguments),
            };
        }
        let call = self.call(py, row, arguments, out, backend)?;
        match row.call.is_of_paths() {
            true => call.paths(form),
            false => call.item_by_item(form),
        }
    }
    /// Returns `true` for a verb of sets of points, given as paths.
    fn is_of_points(&self, arguments: &[Object<'_>]) -> bool {
        const OF_POINTS: [&str; 4] = ["diameter", "minimum_circle", "minimum_rectangle", "width"];
        arguments
            .first()
            .is_some_and(|x| x.is_instance_of::<Paths>())
            && OF_POINTS.contains(&self.of().name.as_str())
    }
    /// Runs a form of polygons, whose arguments Python arranges.
    fn of_polygons<'py>(
        &self,
        py: Python<'py>,
        form: &str,
        arguments: &[Object<'py>],
        options: [Option<&Object<'py>>; 3],
        backend: Option<&str>,
    ) -> PyResult<Object<'py>> {
        if options.iter().flatten().any(|x| !x.is_none()) || backend.is_some_and(|x| x != "cpu") {
            return Err(PyTypeError::new_err(format!(
                "geograd.{}.{form} of Polygons takes no options: they are columns of one kind, on the CPU",
                self.of().name
            )));
        }
        let run = py.import("geograd._polygons")?.getattr("run")?;
        run.call1((&self.of().name, form, PyTuple::new(py, arguments)?))
    }
    /// The row of symbols, as part of the function that is being recorded.
    fn recorded<'py, T: Number>(
        &self,
        py: Python<'py>,
        row: &'static Row,
        form: Form,
        arguments: &[Object<'py>],
    ) -> PyResult<Object<'py>> {
        let is_path = row.call.is_of_paths();
        if is_path && form != Form::Value {
            return Err(symbolic(&self.of().name));
        }
        let mut lists = Vec::new();
        for (k, argument) in arguments.iter().enumerate() {
            let mut list = Vec::new();
            flat::<T>(argument, &mut list, 0)?;
            if let Some(column) = row
                .call
                .takes
                .get(k)
                .filter(|column| column.fields() != list.len())
            {
                return Err(PyTypeError::new_err(format!(
                    "`{}` has {} numbers where {} are needed",
                    column.name,
                    list.len(),
                    column.fields()
                )));
            }
            lists.push(list);
        }
        let slices: Vec<&[_]> = lists.iter().map(Vec::as_slice).collect();
        let (numbers, gives) = match (form, row.call.operation()) {
            (Form::Value, Some(operation)) => (
                operation.on_symbols::<T>(&slices).map_err(raised)?,
                row.call.gives(),
            ),
            _ => {
                let program = row.call.program::<T>(form)?;
                (
                    program.on_symbols(&slices).map_err(raised)?,
                    &row.call.signature(form)?.gives[..],
                )
            }
        };
        let mut numbers = numbers.into_iter();
        let mut results = Vec::new();
        for column in gives {
            let own = numbers.by_ref().take(column.fields());
            let own = own
                .map(|x| Ok(Py::new(py, Symbol(T::any(x)))?.into_any()))
                .collect::<PyResult<Vec<_>>>()?;
            results.push(match (&column.axes[..], own.len()) {
                ([], 1) => own
                    .into_iter()
                    .next()
                    .unwrap_or_else(|| py.None())
                    .into_bound(py),
                (axes, _) => dressed_items(py, own, column.kind, axes)?,
            });
        }
        let call = self.call(py, row, arguments, None, None)?;
        call.arranged(form, results)
    }
}

/// The shapes of a row as they are written.
fn signature(kinds: &[Kind]) -> String {
    let names: Vec<&str> = kinds.iter().map(|&kind| table().name(kind)).collect();
    format!("({})", names.join(", "))
}

/// A symbol in an argument.
fn symbol_in(x: &Object<'_>, depth: usize) -> Option<Any> {
    if let Ok(symbol) = x.cast::<Symbol>() {
        return Some(symbol.get().0);
    }
    if let Ok(shape) = x.cast::<Shape>() {
        return match &shape.get().content {
            Content::Items(items) => items
                .iter()
                .find_map(|item| symbol_in(item.bind(x.py()), depth + 1)),
            Content::Array(_) | Content::Columns(_) | Content::Indexed(_) => None,
        };
    }
    let is_list = x.cast::<PyList>().is_ok() || x.cast::<PyTuple>().is_ok() || is_of_objects(x);
    if is_list && depth < 4 {
        let mut items = x.try_iter().ok()?;
        return items.find_map(|item| symbol_in(&item.ok()?, depth + 1));
    }
    None
}

fn is_of_objects(x: &Object<'_>) -> bool {
    x.cast::<PyUntypedArray>().is_ok_and(|array| {
        array.ndim() > 0 && numpy::PyArrayDescrMethods::kind(&array.dtype()) == b'O'
    })
}

/// The numbers of an argument one by one: symbols, and literals.
fn flat<T: Number>(
    x: &Object<'_>,
    into: &mut Vec<geograd::kernels::dynamic::Symbol<T>>,
    depth: usize,
) -> PyResult<()> {
    if let Ok(shape) = x.cast::<Shape>() {
        return match &shape.get().content {
            Content::Items(items) => items
                .iter()
                .try_for_each(|item| flat(item.bind(x.py()), into, depth + 1)),
            Content::Array(array) => flat(array.bind(x.py()), into, depth + 1),
            Content::Indexed(items) => flat(items.array(x.py())?.bind(x.py()), into, depth + 1),
            Content::Columns(columns) => columns
                .iter()
                .try_for_each(|own| flat(own.bind(x.py()), into, depth + 1)),
        };
    }
    if let Some(symbol) = number::<T>(x)? {
        into.push(symbol);
        return Ok(());
    }
    if let Ok(paths) = x.cast::<Paths>() {
        // Constant vertices: those of one path.
        let paths = paths.get();
        return match paths.offsets.bind(x.py()).len() {
            2 => flat(paths.vertices.bind(x.py()), into, depth + 1),
            _ => Err(PyTypeError::new_err(
                "a verb of symbols takes one path: write a loop over several, or the minimum of their results",
            )),
        };
    }
    let is_list = x.cast::<PyList>().is_ok()
        || x.cast::<PyTuple>().is_ok()
        || x.cast::<PyUntypedArray>()
            .is_ok_and(|array| array.ndim() > 0);
    if !is_list || depth > 4 {
        return Err(PyTypeError::new_err(format!(
            "a verb of symbols takes shapes of symbols, symbols and numbers, one item each, not {}",
            x.get_type().name()?
        )));
    }
    for item in x.try_iter()? {
        flat(&item?, into, depth + 1)?;
    }
    Ok(())
}

#[pymethods]
impl Verb {
    #[new]
    fn new(name: &str) -> PyResult<Self> {
        let place = catalogue::verbs().iter().position(|verb| verb.name == name);
        place
            .map(|place| Verb { place })
            .ok_or_else(|| PyKeyError::new_err(name.to_owned()))
    }
    #[getter]
    fn __name__(&self) -> &'static str {
        &self.of().name
    }
    #[getter]
    fn __qualname__(&self) -> &'static str {
        &self.of().name
    }
    fn __repr__(&self) -> String {
        format!(
            "<geograd.{} of {} rows>",
            self.of().name,
            self.of().rows.len()
        )
    }
    fn __reduce__(slf: &Bound<'_, Self>) -> PyResult<(Py<PyAny>, (&'static str,))> {
        Ok((slf.get_type().into_any().unbind(), (&slf.get().of().name,)))
    }

    /// Item i of every argument.
    #[pyo3(signature = (*arguments, kind=None, to=None, out=None, backend=None))]
    fn __call__<'py>(
        &self,
        py: Python<'py>,
        arguments: &Bound<'py, PyTuple>,
        kind: Option<&Object<'py>>,
        to: Option<&Object<'py>>,
        out: Option<&Object<'py>>,
        backend: Option<&str>,
    ) -> PyResult<Object<'py>> {
        if [kind, to, out].iter().all(Option::is_none)
            && backend.is_none()
            && let Some(value) = at_once::value(py, self.of(), arguments)?
        {
            return Ok(value);
        }
        self.items(
            py,
            ("value", Form::Value),
            &listed(arguments),
            [kind, to, out],
            backend,
        )
    }
    /// A form, item by item.
    #[pyo3(signature = (form, arguments, kind=None, to=None, out=None, backend=None))]
    #[allow(clippy::too_many_arguments)] // They have names in Python.
    fn _run<'py>(
        &self,
        py: Python<'py>,
        form: &str,
        arguments: &Bound<'py, PyTuple>,
        kind: Option<&Object<'py>>,
        to: Option<&Object<'py>>,
        out: Option<&Object<'py>>,
        backend: Option<&str>,
    ) -> PyResult<Object<'py>> {
        let named = (form, Form::named(form)?);
        self.items(py, named, &listed(arguments), [kind, to, out], backend)
    }
    /// A form of two lists.
    #[pyo3(signature = (form, a, b, more=None, kind=None, out=None, backend=None, groups=None))]
    #[allow(clippy::too_many_arguments)] // They have names in Python.
    fn _of_pairs<'py>(
        &self,
        py: Python<'py>,
        form: &str,
        a: Object<'py>,
        b: Object<'py>,
        more: Option<&Object<'py>>,
        kind: Option<&Object<'py>>,
        out: Option<&Object<'py>>,
        backend: Option<&str>,
        groups: Option<&Object<'py>>,
    ) -> PyResult<Object<'py>> {
        let lists = [a, b];
        if lists.iter().any(|x| x.is_instance_of::<Polygons>()) {
            return self.of_polygons(py, form, &lists, [kind, groups, out], backend);
        }
        let row = self.row_of_pairs(&lists, kind, form)?;
        let call = self.call(py, row, &lists, out, backend)?;
        call.of_pairs(Pairs::named(form)?, more, groups)
    }
    /// The places of the shapes that suppression keeps.
    #[allow(clippy::too_many_arguments)] // They have names in Python.
    fn _suppress<'py>(
        &self,
        py: Python<'py>,
        shapes: Object<'py>,
        scores: Object<'py>,
        overlap: f64,
        classes: Option<Vec<u32>>,
        score: Option<f64>,
        most: Option<usize>,
        groups: Option<&Object<'py>>,
        kind: Option<&Object<'py>>,
    ) -> PyResult<Object<'py>> {
        let asked = SuppressArguments::new(&scores, overlap, classes, score, most, groups)?;
        let lists = [shapes.clone(), shapes];
        let row = self.row_of_pairs(&lists, kind, "suppress")?;
        self.call(py, row, &lists, None, None)?.suppress(&asked)
    }
    /// The operations of a form of a row, in a format.
    #[pyo3(signature = (*, kind, to=None, form="value", double=true))]
    fn program(
        &self,
        kind: &Object<'_>,
        to: Option<&Object<'_>>,
        form: &str,
        double: bool,
    ) -> PyResult<Program> {
        let wanted = RequestedKinds::of(Some(kind))?;
        let to = to.map(one_kind).transpose()?;
        let fits = |row: &&Row| match &wanted {
            _ if to.is_some_and(|to| row.call.gives()[0].kind != to) => false,
            RequestedKinds::Nothing => false,
            RequestedKinds::All(all) => {
                row.takes.iter().all(|&kind| kind == *all || kind == NUMBER)
            }
            RequestedKinds::Each(each) => {
                row.takes.len() == each.len()
                    && row
                        .takes
                        .iter()
                        .zip(each)
                        .all(|(&kind, wanted)| wanted.is_none_or(|wanted| wanted == kind))
            }
        };
        let mut rows = self.of().rows.iter().filter(fits);
        match (rows.next(), rows.next()) {
            (Some(row), None) => Program::of(&row.call, form, double),
            _ => Err(self.refused(&[], "program", "kind= must name one row")),
        }
    }
    /// The operations of a form for inputs like one item: of a search its replay, by the decisions that it makes there.
    #[pyo3(signature = (*arguments, kind=None, to=None, form="value", double=true))]
    fn replay<'py>(
        &self,
        py: Python<'py>,
        arguments: &Bound<'py, PyTuple>,
        kind: Option<&Object<'py>>,
        to: Option<&Object<'py>>,
        form: &str,
        double: bool,
    ) -> PyResult<Program> {
        let (arguments, form) = (listed(arguments), Form::named(form)?);
        let row = self.row(&arguments, kind, to, "value")?;
        Ok(match double {
            true => Program::double(self.replayed(py, row, &arguments, form)?),
            false => Program::single(self.replayed(py, row, &arguments, form)?),
        })
    }
    /// The hints of a search for one item, which its replay takes after the arguments: numbers that the search has found
    /// beside its decisions. Other rows have none.
    #[pyo3(signature = (*arguments, kind=None, to=None, double=true))]
    fn hints(
        &self,
        py: Python<'_>,
        arguments: &Bound<'_, PyTuple>,
        kind: Option<&Object<'_>>,
        to: Option<&Object<'_>>,
        double: bool,
    ) -> PyResult<Vec<f64>> {
        let arguments = listed(arguments);
        let row = self.row(&arguments, kind, to, "value")?;
        match double {
            true => self.hinted::<f64>(py, row, &arguments),
            false => self.hinted::<f32>(py, row, &arguments),
        }
    }
    /// A module of JavaScript that exports a form of a row, by the verb's name if none is given.
    #[pyo3(signature = (*, kind, to=None, form="value", name=None))]
    fn javascript(
        &self,
        kind: &Object<'_>,
        to: Option<&Object<'_>>,
        form: &str,
        name: Option<&str>,
    ) -> PyResult<String> {
        let program = self.program(kind, to, form, true)?;
        program.javascript(name.unwrap_or(&self.of().name))
    }
}

/// The shapes of the table: name; fields, what each is and which values it may have; how many are whole numbers.
#[pyfunction]
pub fn shapes() -> Vec<(
    &'static str,
    Vec<(&'static str, &'static str, &'static str)>,
    usize,
)> {
    let shape = |shape: &'static crate::table::Shape| {
        let fields = shape.fields.iter().zip(&shape.meaning);
        let fields = fields.map(|(name, (unit, limit))| (name.as_str(), *unit, limit.as_str()));
        (shape.name.as_str(), fields.collect(), shape.codes)
    };
    table().shapes.iter().map(shape).collect()
}

/// Random valid inputs of a row, in all numbers of its arguments.
#[pyfunction]
pub fn valid_samples<'py>(
    py: Python<'py>,
    row: &str,
    count: usize,
    seed: u64,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    use geograd::check::Draw;
    let operation = geograd_rows::operations()
        .iter()
        .find(|one| one.name == row);
    let operation = operation.ok_or_else(|| PyKeyError::new_err(row.to_owned()))?;
    let (samplers, layouts, mut draw) = (
        operation.samplers(),
        operation.layouts::<f64>(),
        Draw::new(seed),
    );
    let mut all: Vec<Vec<f64>> = Vec::new();
    for _ in 0..count.saturating_mul(50) {
        if all.len() == count {
            break;
        }
        let mut parts = Vec::new();
        for (sampler, layout) in samplers.iter().zip(&layouts) {
            let scalars = sampler.draw(&mut draw);
            // The number of vertices of a polygon, which is all that a whole number of an argument says.
            let with = |code: usize| [&scalars[..], &vec![code as f64; layout.codes()]].concat();
            let codes = (0..=scalars.len() / 2).rev().map(with);
            parts.extend(
                codes
                    .take(if layout.codes() == 0 { 1 } else { usize::MAX })
                    .find(|x| layout.check(x).is_ok()),
            );
        }
        let is_valid = parts.len() == layouts.len();
        let numbers = parts.concat();
        if is_valid && operation.is_inside(&numbers) {
            all.push(numbers);
        }
    }
    PyArray2::from_vec2(py, &all).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// The names of all verbs.
#[pyfunction]
pub fn verbs() -> Vec<&'static str> {
    catalogue::verbs()
        .iter()
        .map(|verb| verb.name.as_str())
        .collect()
}

/// The entries of the table for the rows of a verb.
#[pyfunction]
pub fn rows<'py>(py: Python<'py>, verb: &str) -> PyResult<Vec<Bound<'py, PyDict>>> {
    let verb = catalogue::verbs()
        .iter()
        .find(|one| one.name == verb)
        .ok_or_else(|| PyKeyError::new_err(verb.to_owned()))?;
    let row = |row: &'static Row| {
        let operation = row
            .call
            .operation()
            .ok_or_else(|| PyValueError::new_err("no operation"))?;
        let described = PyDict::new(py);
        described.set_item("name", operation.name)?;
        described.set_item("summary", operation.summary())?;
        described.set_item(
            "sort",
            match operation.sort {
                Sort::Straight => "straight",
                Sort::Search => "search",
                Sort::Fold => "fold",
            },
        )?;
        let kinds: Vec<&str> = row.takes.iter().map(|&kind| table().name(kind)).collect();
        described.set_item("kinds", kinds)?;
        let columns = |columns: &[Column]| -> Vec<(String, String, usize)> {
            let one = |column: &Column| {
                let name = if column.kind == NUMBERS {
                    "numbers"
                } else {
                    table().name(column.kind)
                };
                (
                    column.name.clone(),
                    name.to_owned(),
                    column.axes.first().copied().unwrap_or(0),
                )
            };
            columns.iter().map(one).collect()
        };
        described.set_item("takes", columns(&row.call.takes))?;
        described.set_item("gives", columns(row.call.gives()))?;
        described.set_item("jumps", format!("{:?}", operation.jumps))?;
        Ok(described)
    };
    verb.rows.iter().map(row).collect()
}

//! Symbols with Python's operators and NumPy's functions.
use crate::number::{Any, Number, mixed};
use crate::raised;
use geograd::kernels::dynamic::symbol as f;
use geograd::kernels::dynamic::{Symbol as Of, Truth as TruthOf};
use numpy::{PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::{PyAttributeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

/// A truth in either format.
#[derive(Clone, Copy)]
enum AnyTruth {
    Single(TruthOf<f32>),
    Double(TruthOf<f64>),
}

/// Converts an error about symbols to an exception.
fn refused(error: geograd::Error) -> PyErr {
    match error {
        geograd::Error::Program(geograd::Unrecordable::ForeignSymbol) => mixed(),
        geograd::Error::Program(geograd::Unrecordable::TooLong) => PyTypeError::new_err(
            "the function has more than 4 million operations: is there a loop that records one item after another? Record one \
             item, and call the function with arrays",
        ),
        error => raised(error),
    }
}

/// A number of a function that is being recorded.
#[pyclass(frozen, name = "Symbol", module = "geograd")]
pub struct Symbol(pub Any);

/// The truth of a comparison in a function that is being recorded.
#[pyclass(frozen, name = "Truth", module = "geograd")]
pub struct Truth(AnyTruth);

/// Returns a literal in the format of a symbol.
fn literal(like: Any, x: f64) -> PyResult<Any> {
    let is_finite = match like {
        Any::Single(_) => (x as f32).is_finite(),
        Any::Double(_) => x.is_finite(),
    };
    if !is_finite {
        return Err(PyTypeError::new_err(format!(
            "{x} cannot be recorded: a traced function is of finite numbers (start a minimum or maximum from its first item)"
        )));
    }
    match like {
        Any::Single(_) => f::literal(x).map(Any::Single),
        Any::Double(_) => f::literal(x).map(Any::Double),
    }
    .map_err(refused)
}

/// Returns the operand of an operation with a symbol: a symbol or a number; `None` for other objects.
pub fn operand(like: Any, other: &Bound<'_, PyAny>) -> PyResult<Option<Any>> {
    if let Ok(symbol) = other.cast::<Symbol>() {
        return Ok(Some(symbol.get().0));
    }
    if other.cast::<Truth>().is_ok()
        || other
            .cast::<PyUntypedArray>()
            .is_ok_and(|array| array.ndim() > 0)
    {
        return Ok(None);
    }
    match other.extract::<f64>() {
        Ok(x) => literal(like, x).map(Some),
        Err(_) => Ok(None),
    }
}

/// Returns a number in the format of the open recording.
pub fn number<T: Number>(other: &Bound<'_, PyAny>) -> PyResult<Option<Of<T>>> {
    if let Ok(symbol) = other.cast::<Symbol>() {
        let symbol = T::symbol(symbol.get().0)?;
        symbol.belongs().map_err(refused)?;
        return Ok(Some(symbol));
    }
    let like = T::any(f::literal::<T>(0.0).map_err(refused)?);
    operand(like, other)?.map(T::symbol).transpose()
}

/// Calls one function in either format.
macro_rules! one {
    ($x:expr, $function:path) => {
        match $x {
            Any::Single(x) => $function(x).map(Any::Single),
            Any::Double(x) => $function(x).map(Any::Double),
        }
        .map_err(refused)
    };
}
macro_rules! two {
    ($a:expr, $b:expr, $function:path, $Out:ident) => {
        match ($a, $b) {
            (Any::Single(a), Any::Single(b)) => $function(a, b).map($Out::Single).map_err(refused),
            (Any::Double(a), Any::Double(b)) => $function(a, b).map($Out::Double).map_err(refused),
            _ => Err(mixed()),
        }
    };
}

type Out = PyResult<Py<PyAny>>;
type Two = fn(Any, Any) -> PyResult<Any>;
type Compare = fn(Any, Any) -> PyResult<AnyTruth>;

fn made(py: Python<'_>, x: Any) -> Out {
    Ok(Py::new(py, Symbol(x))?.into_any())
}
fn truth(py: Python<'_>, x: AnyTruth) -> Out {
    Ok(Py::new(py, Truth(x))?.into_any())
}

fn add(a: Any, b: Any) -> PyResult<Any> {
    two!(a, b, f::add, Any)
}
fn sub(a: Any, b: Any) -> PyResult<Any> {
    two!(a, b, f::sub, Any)
}
fn mul(a: Any, b: Any) -> PyResult<Any> {
    two!(a, b, f::mul, Any)
}
fn over(a: Any, b: Any) -> PyResult<Any> {
    two!(a, b, f::over, Any)
}
fn least(a: Any, b: Any) -> PyResult<Any> {
    two!(a, b, f::least, Any)
}
fn most(a: Any, b: Any) -> PyResult<Any> {
    two!(a, b, f::most, Any)
}
/// Returns `x`, or NaN where `of` is NaN.
fn known(x: Any, of: Any) -> PyResult<Any> {
    two!(x, of, f::known, Any)
}
/// Returns the smaller number; NaN where either is NaN, as in NumPy.
fn minimum(a: Any, b: Any) -> PyResult<Any> {
    known(known(least(a, b)?, a)?, b)
}
/// Returns the larger number; NaN where either is NaN.
fn maximum(a: Any, b: Any) -> PyResult<Any> {
    known(known(most(a, b)?, a)?, b)
}
fn atan2(a: Any, b: Any) -> PyResult<Any> {
    two!(a, b, f::atan2, Any)
}
fn hypot(a: Any, b: Any) -> PyResult<Any> {
    two!(a, b, f::hypot, Any)
}
fn signed_as(a: Any, b: Any) -> PyResult<Any> {
    two!(a, b, f::signed_as, Any)
}
fn below(a: Any, b: Any) -> PyResult<AnyTruth> {
    two!(a, b, f::below, AnyTruth)
}
fn at_most(a: Any, b: Any) -> PyResult<AnyTruth> {
    two!(a, b, f::at_most, AnyTruth)
}
fn equals(a: Any, b: Any) -> PyResult<AnyTruth> {
    two!(a, b, f::equals, AnyTruth)
}
fn swapped(f: Compare, a: Any, b: Any) -> PyResult<AnyTruth> {
    f(b, a)
}
/// Returns a power with a constant exponent.
fn power(x: Any, power: f64) -> PyResult<Any> {
    if power.is_nan() || power.abs() > f64::from(1 << 30) {
        return Err(PyTypeError::new_err(format!(
            "a power is a number to 2**30, not {power}"
        )));
    }
    match x {
        Any::Single(x) => f::power(x, power).map(Any::Single),
        Any::Double(x) => f::power(x, power).map(Any::Double),
    }
    .map_err(refused)
}
/// Returns a power whose exponent is a symbol: of a base of at least zero.
fn power_of(x: Any, power: Any) -> PyResult<Any> {
    two!(x, power, f::power_of, Any)
}
fn logaddexp(a: Any, b: Any) -> PyResult<Any> {
    two!(a, b, f::ln_of_exponentials, Any)
}
fn floor_divide(a: Any, b: Any) -> PyResult<Any> {
    two!(a, b, f::floor_divide, Any)
}
fn remainder(a: Any, b: Any) -> PyResult<Any> {
    two!(a, b, f::remainder, Any)
}

/// Returns the result of NumPy's function `name` of one symbol.
fn of_one(name: &str, x: Any) -> Option<PyResult<Any>> {
    let by = |factor: f64| literal(x, factor).and_then(|factor| mul(x, factor));
    Some(match name {
        "negative" => one!(x, f::neg),
        "positive" => Ok(x),
        "absolute" | "fabs" | "abs" => one!(x, f::magnitude),
        "sqrt" => one!(x, f::root_or_nan),
        "cbrt" => one!(x, f::cbrt),
        "square" => one!(x, f::squared),
        "reciprocal" => literal(x, 1.0).and_then(|one| over(one, x)),
        "sin" => one!(x, f::sin),
        "cos" => one!(x, f::cos),
        "tan" => one!(x, f::tan),
        "exp" => one!(x, f::exp),
        "log" => one!(x, f::ln),
        "exp2" => literal(x, 2.0).and_then(|two| power_of(two, x)),
        "expm1" => one!(x, f::exp_m1),
        "log1p" => one!(x, f::ln_1p),
        "log2" => one!(x, f::log2),
        "log10" => one!(x, f::log10),
        "sinh" => one!(x, f::sinh),
        "cosh" => one!(x, f::cosh),
        "tanh" => one!(x, f::tanh),
        "arcsinh" => one!(x, f::arcsinh),
        "arccosh" => one!(x, f::arccosh),
        "arctanh" => one!(x, f::arctanh),
        "arcsin" => one!(x, f::arcsin),
        "arccos" => one!(x, f::arccos),
        "arctan" => one!(x, f::arctan),
        "rint" => one!(x, f::rint),
        "floor" => one!(x, f::floor),
        "ceil" => one!(x, f::ceil),
        "trunc" => one!(x, f::trunc),
        "sign" => one!(x, f::sign),
        "deg2rad" | "radians" => by(1.0_f64.to_radians()),
        "rad2deg" | "degrees" => by(1.0_f64.to_degrees()),
        _ => return None,
    })
}

/// Returns NumPy's function `name` of two symbols.
fn of_two(name: &str) -> Option<Two> {
    Some(match name {
        "add" => add,
        "subtract" => sub,
        "multiply" => mul,
        "divide" | "true_divide" => over,
        "minimum" => minimum,
        "maximum" => maximum,
        "fmin" => least,
        "fmax" => most,
        "arctan2" => atan2,
        "hypot" => hypot,
        "copysign" => signed_as,
        "power" | "float_power" => power_of,
        "logaddexp" => logaddexp,
        "floor_divide" => floor_divide,
        "remainder" | "mod" => remainder,
        _ => return None,
    })
}

/// Returns NumPy's comparison `name`.
fn comparison(name: &str) -> Option<Compare> {
    Some(match name {
        "less" => below,
        "less_equal" => at_most,
        "greater" => |a, b| swapped(below, a, b),
        "greater_equal" => |a, b| swapped(at_most, a, b),
        "equal" => equals,
        _ => return None,
    })
}

/// The operations that can be recorded, for messages.
const RECORDED: &str = "+ - * / // % **, abs, sign, sqrt, cbrt, square, power, floor, ceil, trunc, rint, sin, cos, tan, \
                        arcsin, arccos, arctan, arctan2, sinh, cosh, tanh, arcsinh, arccosh, arctanh, exp, exp2, expm1, log, \
                        log1p, log2, log10, logaddexp, hypot, copysign, minimum, maximum, clip, where, comparisons and \
                        geograd's verbs";

/// NumPy's functions of one argument that are not methods of a symbol: it calls them on items of arrays of objects.
const OF_ITEMS: [&str; 23] = [
    "cbrt", "exp2", "expm1", "log1p", "log2", "log10", "sinh", "cosh", "tanh", "arcsinh",
    "arccosh", "arctanh", "arcsin", "arccos", "arctan", "rint", "trunc", "floor", "ceil",
    "deg2rad", "rad2deg", "radians", "degrees",
];

/// Calls NumPy's function `name` on symbols and numbers; `None` where an argument is neither.
fn called(py: Python<'_>, name: &str, inputs: &[Bound<'_, PyAny>]) -> PyResult<Option<Py<PyAny>>> {
    if let "logical_and" | "bitwise_and" | "logical_or" | "bitwise_or" | "logical_not" | "invert" =
        name
    {
        let truths: Option<Vec<AnyTruth>> = inputs
            .iter()
            .map(|x| x.cast::<Truth>().ok().map(|x| x.get().0))
            .collect();
        let joined = match (name, truths.as_deref()) {
            ("logical_and" | "bitwise_and", Some([a, b])) => joined(*a, *b, true)?,
            ("logical_or" | "bitwise_or", Some([a, b])) => joined(*a, *b, false)?,
            ("logical_not" | "invert", Some([a])) => inverted(*a)?,
            _ => return Ok(None),
        };
        return truth(py, joined).map(Some);
    }
    let like = inputs
        .iter()
        .find_map(|x| x.cast::<Symbol>().ok().map(|x| x.get().0));
    let Some(like) = like else { return Ok(None) };
    let mut all = Vec::with_capacity(inputs.len());
    for input in inputs {
        match operand(like, input)? {
            Some(x) => all.push(x),
            None => return Ok(None),
        }
    }
    let unknown = || {
        PyTypeError::new_err(format!(
            "numpy.{name} cannot be recorded; what can: {RECORDED}"
        ))
    };
    match &all[..] {
        [x] => made(py, of_one(name, *x).ok_or_else(unknown)??).map(Some),
        [x, _] if matches!(name, "power" | "float_power") && inputs[1].extract::<f64>().is_ok() => {
            made(py, power(*x, inputs[1].extract()?)?).map(Some)
        }
        [a, b] => match (of_two(name), comparison(name)) {
            (Some(f), _) => made(py, f(*a, *b)?).map(Some),
            (_, Some(f)) => truth(py, f(*a, *b)?).map(Some),
            _ => Err(unknown()),
        },
        _ => Err(unknown()),
    }
}

fn joined(a: AnyTruth, b: AnyTruth, both: bool) -> PyResult<AnyTruth> {
    match (a, b, both) {
        (AnyTruth::Single(a), AnyTruth::Single(b), true) => f::and(a, b).map(AnyTruth::Single),
        (AnyTruth::Single(a), AnyTruth::Single(b), false) => f::or(a, b).map(AnyTruth::Single),
        (AnyTruth::Double(a), AnyTruth::Double(b), true) => f::and(a, b).map(AnyTruth::Double),
        (AnyTruth::Double(a), AnyTruth::Double(b), false) => f::or(a, b).map(AnyTruth::Double),
        _ => return Err(mixed()),
    }
    .map_err(refused)
}
fn inverted(a: AnyTruth) -> PyResult<AnyTruth> {
    match a {
        AnyTruth::Single(a) => f::not(a).map(AnyTruth::Single),
        AnyTruth::Double(a) => f::not(a).map(AnyTruth::Double),
    }
    .map_err(refused)
}

fn binary(me: &Symbol, other: &Bound<'_, PyAny>, f: impl Fn(Any, Any) -> PyResult<Any>) -> Out {
    let py = other.py();
    match operand(me.0, other)? {
        Some(b) => made(py, f(me.0, b)?),
        None => Ok(py.NotImplemented()),
    }
}
fn compared(
    me: &Symbol,
    other: &Bound<'_, PyAny>,
    f: impl Fn(Any, Any) -> PyResult<AnyTruth>,
) -> Out {
    let py = other.py();
    match operand(me.0, other)? {
        Some(b) => truth(py, f(me.0, b)?),
        None => Ok(py.NotImplemented()),
    }
}

fn no_number() -> PyErr {
    PyTypeError::new_err(
        "a symbol is no number yet: the function is recorded once for all inputs. Use geograd.sqrt or numpy.sqrt (sin, cos, exp, \
         log, …) instead of math.sqrt, and numpy.trunc and numpy.rint instead of int() and round(); there is no float()",
    )
}

#[pymethods]
impl Symbol {
    fn __add__(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, add)
    }
    fn __radd__(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, |a, b| add(b, a))
    }
    fn __sub__(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, sub)
    }
    fn __rsub__(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, |a, b| sub(b, a))
    }
    fn __mul__(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, mul)
    }
    fn __rmul__(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, |a, b| mul(b, a))
    }
    fn __truediv__(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, over)
    }
    fn __rtruediv__(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, |a, b| over(b, a))
    }
    fn __pow__(&self, exponent: &Bound<'_, PyAny>, _modulo: &Bound<'_, PyAny>) -> Out {
        match exponent.extract::<f64>() {
            Ok(constant) => made(exponent.py(), power(self.0, constant)?),
            Err(_) => binary(self, exponent, power_of),
        }
    }
    fn __rpow__(&self, base: &Bound<'_, PyAny>, _modulo: &Bound<'_, PyAny>) -> Out {
        binary(self, base, |a, b| power_of(b, a))
    }
    fn __mod__(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, remainder)
    }
    fn __rmod__(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, |a, b| remainder(b, a))
    }
    fn __floordiv__(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, floor_divide)
    }
    fn __rfloordiv__(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, |a, b| floor_divide(b, a))
    }
    // NumPy calls these for items, by way of `math`.
    fn __floor__(&self) -> PyResult<Symbol> {
        one!(self.0, f::floor).map(Symbol)
    }
    fn __ceil__(&self) -> PyResult<Symbol> {
        one!(self.0, f::ceil).map(Symbol)
    }
    fn __trunc__(&self) -> PyResult<Symbol> {
        one!(self.0, f::trunc).map(Symbol)
    }
    /// A function of NumPy as a method, as it is called on items of arrays of objects.
    fn __getattr__(slf: &Bound<'_, Self>, name: &str) -> Out {
        let py = slf.py();
        if !OF_ITEMS.contains(&name) {
            return Err(PyAttributeError::new_err(format!(
                "a symbol is one number, without {name}"
            )));
        }
        let elementary = py.import("geograd._core")?.getattr("elementary")?;
        let partial = py.import("functools")?.getattr("partial")?;
        Ok(partial.call1((elementary, name, slf))?.unbind())
    }
    fn __lt__(&self, other: &Bound<'_, PyAny>) -> Out {
        compared(self, other, below)
    }
    fn __le__(&self, other: &Bound<'_, PyAny>) -> Out {
        compared(self, other, at_most)
    }
    fn __gt__(&self, other: &Bound<'_, PyAny>) -> Out {
        compared(self, other, |a, b| below(b, a))
    }
    fn __ge__(&self, other: &Bound<'_, PyAny>) -> Out {
        compared(self, other, |a, b| at_most(b, a))
    }
    fn __eq__(&self, _other: &Bound<'_, PyAny>) -> Out {
        Err(PyTypeError::new_err(
            "symbols are not compared by == or `in`: write (a <= b) & (a >= b), or numpy.equal(a, b)",
        ))
    }
    fn __ne__(&self, _other: &Bound<'_, PyAny>) -> Out {
        Err(PyTypeError::new_err(
            "symbols are not compared by !=: write (a < b) | (a > b)",
        ))
    }
    #[classattr]
    const __hash__: Option<Py<PyAny>> = None;
    fn __neg__(&self) -> PyResult<Symbol> {
        one!(self.0, f::neg).map(Symbol)
    }
    fn __pos__(slf: Py<Self>) -> Py<Self> {
        slf
    }
    fn __abs__(&self) -> PyResult<Symbol> {
        one!(self.0, f::magnitude).map(Symbol)
    }
    fn __bool__(&self) -> PyResult<bool> {
        Err(no_truth())
    }
    fn __float__(&self) -> PyResult<f64> {
        Err(no_number())
    }
    fn __int__(&self) -> PyResult<i64> {
        Err(no_number())
    }
    #[pyo3(signature = (_digits=None))]
    fn __round__(&self, _digits: Option<&Bound<'_, PyAny>>) -> PyResult<Symbol> {
        Err(PyTypeError::new_err(
            "round() cannot be recorded: write numpy.rint, whose derivative is zero",
        ))
    }
    fn __iter__(&self) -> PyResult<Symbol> {
        Err(PyTypeError::new_err("a symbol is one number, not a list"))
    }
    /// The same number again.
    fn conjugate(slf: Py<Self>) -> Py<Self> {
        slf
    }
    /// The format in which the function is recorded: float32 or float64.
    #[getter]
    fn dtype(&self) -> &'static str {
        match self.0 {
            Any::Single(_) => "float32",
            Any::Double(_) => "float64",
        }
    }
    fn __repr__(&self) -> &'static str {
        "<geograd.Symbol>"
    }

    // NumPy calls these on the items of arrays of objects.
    fn sqrt(&self) -> PyResult<Symbol> {
        one!(self.0, f::root_or_nan).map(Symbol)
    }
    fn square(&self) -> PyResult<Symbol> {
        one!(self.0, f::squared).map(Symbol)
    }
    fn sin(&self) -> PyResult<Symbol> {
        one!(self.0, f::sin).map(Symbol)
    }
    fn cos(&self) -> PyResult<Symbol> {
        one!(self.0, f::cos).map(Symbol)
    }
    fn tan(&self) -> PyResult<Symbol> {
        one!(self.0, f::tan).map(Symbol)
    }
    fn exp(&self) -> PyResult<Symbol> {
        one!(self.0, f::exp).map(Symbol)
    }
    fn log(&self) -> PyResult<Symbol> {
        one!(self.0, f::ln).map(Symbol)
    }
    fn arctan2(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, atan2)
    }
    fn hypot(&self, other: &Bound<'_, PyAny>) -> Out {
        binary(self, other, hypot)
    }
    /// The nearest value between two bounds.
    #[pyo3(signature = (low=None, high=None, **_more))]
    fn clip(
        &self,
        py: Python<'_>,
        low: Option<&Bound<'_, PyAny>>,
        high: Option<&Bound<'_, PyAny>>,
        _more: Option<&Bound<'_, PyDict>>,
    ) -> Out {
        made(py, clipped(self.0, low, high)?)
    }

    #[pyo3(signature = (ufunc, method, *inputs, **_options))]
    fn __array_ufunc__(
        &self,
        ufunc: &Bound<'_, PyAny>,
        method: &str,
        inputs: &Bound<'_, PyTuple>,
        _options: Option<&Bound<'_, PyDict>>,
    ) -> Out {
        universal(ufunc, method, inputs)
    }
    fn __array_function__(
        &self,
        function: &Bound<'_, PyAny>,
        _types: &Bound<'_, PyAny>,
        arguments: &Bound<'_, PyTuple>,
        options: &Bound<'_, PyDict>,
    ) -> Out {
        numpys(function, arguments, options)
    }
}

/// Returns the nearest value between two bounds, either of which may be missing.
fn clipped(
    x: Any,
    low: Option<&Bound<'_, PyAny>>,
    high: Option<&Bound<'_, PyAny>>,
) -> PyResult<Any> {
    let bound = |bound: Option<&Bound<'_, PyAny>>| match bound {
        Some(bound) if !bound.is_none() => match operand(x, bound)? {
            Some(bound) => Ok(Some(bound)),
            None => Err(PyTypeError::new_err(
                "clip takes symbols and numbers as bounds",
            )),
        },
        _ => Ok(None),
    };
    let x = bound(low)?.map_or(Ok(x), |low| maximum(x, low))?;
    bound(high)?.map_or(Ok(x), |high| minimum(x, high))
}

/// Calls a universal function of NumPy.
fn universal(ufunc: &Bound<'_, PyAny>, method: &str, inputs: &Bound<'_, PyTuple>) -> Out {
    let py = ufunc.py();
    let name: String = ufunc.getattr("__name__")?.extract()?;
    if method != "__call__" {
        return Err(PyTypeError::new_err(format!(
            "numpy.{name}.{method} cannot be recorded; write a loop, or sum()"
        )));
    }
    let all: Vec<Bound<'_, PyAny>> = inputs.iter().collect();
    if let Some(made) = called(py, &name, &all)? {
        return Ok(made);
    }
    // With an array of numbers: item by item.
    if all.iter().any(|x| x.cast::<PyUntypedArray>().is_ok()) {
        let object = |x: &Bound<'_, PyAny>| -> PyResult<Py<PyAny>> {
            if x.cast::<PyUntypedArray>().is_ok() {
                return Ok(x.call_method1("astype", ("O",))?.unbind());
            }
            let lone = py.import("numpy")?.getattr("empty")?.call1(((), "O"))?;
            lone.set_item((), x)?;
            Ok(lone.unbind())
        };
        let objects = all.iter().map(object).collect::<PyResult<Vec<_>>>()?;
        return Ok(ufunc.call1(PyTuple::new(py, objects)?)?.unbind());
    }
    Ok(py.NotImplemented())
}

/// Calls a function of NumPy that is not universal.
fn numpys(
    function: &Bound<'_, PyAny>,
    arguments: &Bound<'_, PyTuple>,
    options: &Bound<'_, PyDict>,
) -> Out {
    let py = function.py();
    let name: String = function.getattr("__name__")?.extract()?;
    let argument = |k: usize, names: &[&str]| -> PyResult<Option<Bound<'_, PyAny>>> {
        if k < arguments.len() {
            return arguments.get_item(k).map(Some);
        }
        for name in names {
            if let Some(found) = options.get_item(name)? {
                return Ok(Some(found));
            }
        }
        Ok(None)
    };
    match name.as_str() {
        "where" if arguments.len() == 3 => where_(
            &arguments.get_item(0)?,
            &arguments.get_item(1)?,
            &arguments.get_item(2)?,
        ),
        "clip" => {
            let x = arguments.get_item(0)?;
            let Ok(symbol) = x.cast::<Symbol>() else {
                return Err(PyTypeError::new_err(
                    "numpy.clip of a number between symbols: write numpy.minimum and numpy.maximum",
                ));
            };
            let (low, high) = (
                argument(1, &["a_min", "min"])?,
                argument(2, &["a_max", "max"])?,
            );
            made(py, clipped(symbol.get().0, low.as_ref(), high.as_ref())?)
        }
        _ => Err(PyTypeError::new_err(format!(
            "numpy.{name} cannot be recorded; what can: {RECORDED}"
        ))),
    }
}

fn no_truth() -> PyErr {
    PyTypeError::new_err(
        "the truth of a symbolic comparison is not known while a function is recorded: write geograd.where(condition, a, b) instead \
         of `if`, numpy.minimum and numpy.maximum instead of min() and max(), `&`, `|`, `~` instead of `and`, `or`, `not`, and \
         (a < x) & (x < b) instead of a < x < b",
    )
}

fn beside(me: &Truth, other: &Bound<'_, PyAny>, both: bool) -> Out {
    let py = other.py();
    match other.cast::<Truth>() {
        Ok(other) => truth(py, joined(me.0, other.get().0, both)?),
        Err(_) => Ok(py.NotImplemented()),
    }
}

#[pymethods]
impl Truth {
    fn __and__(&self, other: &Bound<'_, PyAny>) -> Out {
        beside(self, other, true)
    }
    fn __or__(&self, other: &Bound<'_, PyAny>) -> Out {
        beside(self, other, false)
    }
    fn __invert__(&self) -> PyResult<Truth> {
        inverted(self.0).map(Truth)
    }
    fn __bool__(&self) -> PyResult<bool> {
        Err(no_truth())
    }
    fn __repr__(&self) -> &'static str {
        "<geograd.Truth>"
    }
    #[pyo3(signature = (ufunc, method, *inputs, **_options))]
    fn __array_ufunc__(
        &self,
        ufunc: &Bound<'_, PyAny>,
        method: &str,
        inputs: &Bound<'_, PyTuple>,
        _options: Option<&Bound<'_, PyDict>>,
    ) -> Out {
        universal(ufunc, method, inputs)
    }
    fn __array_function__(
        &self,
        function: &Bound<'_, PyAny>,
        _types: &Bound<'_, PyAny>,
        arguments: &Bound<'_, PyTuple>,
        options: &Bound<'_, PyDict>,
    ) -> Out {
        numpys(function, arguments, options)
    }
}

/// `a` where a symbolic condition holds, else `b`.
#[pyfunction]
#[pyo3(name = "where")]
pub fn where_(condition: &Bound<'_, PyAny>, a: &Bound<'_, PyAny>, b: &Bound<'_, PyAny>) -> Out {
    let py = condition.py();
    let wrong = || {
        PyTypeError::new_err(
            "where takes a comparison of symbols, and symbols or numbers to choose from",
        )
    };
    let Ok(condition) = condition.cast::<Truth>() else {
        return match condition.extract::<bool>() {
            // A condition without symbols selects now.
            Ok(true) => Ok(a.clone().unbind()),
            Ok(false) => Ok(b.clone().unbind()),
            Err(_) => Err(wrong()),
        };
    };
    let of = condition.get().0;
    let like = match of {
        AnyTruth::Single(_) => Any::Single(f::literal(0.0).map_err(refused)?),
        AnyTruth::Double(_) => Any::Double(f::literal(0.0).map_err(refused)?),
    };
    let [a, b] = [
        operand(like, a)?.ok_or_else(wrong)?,
        operand(like, b)?.ok_or_else(wrong)?,
    ];
    let chosen = match (of, a, b) {
        (AnyTruth::Single(c), Any::Single(a), Any::Single(b)) => {
            f::select(c, a, b).map(Any::Single)
        }
        (AnyTruth::Double(c), Any::Double(a), Any::Double(b)) => {
            f::select(c, a, b).map(Any::Double)
        }
        _ => return Err(mixed()),
    };
    made(py, chosen.map_err(refused)?)
}

/// A function of NumPy's name where an argument is a symbol; `None` where none is.
#[pyfunction]
#[pyo3(signature = (name, *inputs))]
pub fn elementary(
    py: Python<'_>,
    name: &str,
    inputs: &Bound<'_, PyTuple>,
) -> PyResult<Option<Py<PyAny>>> {
    let all: Vec<Bound<'_, PyAny>> = inputs.iter().collect();
    called(py, name, &all)
}

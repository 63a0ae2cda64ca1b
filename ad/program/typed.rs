//! Programs with the types of their argument and result.
use super::cost::Cost;
use super::graph::Format;
use super::packed::numbers;
use super::print::print;
use super::record::record;
use super::recorded::Recorded;
use super::sym::Sym;
use super::{c, javascript, wgsl};
use crate::scalar::real::OneNumber;
use crate::scalar::{Guard, guarded};
use crate::{Error, Fixed, Real, Scalar};
use std::any::Any;
use std::fmt;
use std::marker::PhantomData;
use std::sync::{Arc, OnceLock};

/// A recorded function from one shape to another, in `f32` or `f64`.
///
/// Several arguments are a tuple. See the [module](super) for what can be recorded.
///
/// ```
/// use geograd::ad::program::{Program, Sym};
/// use geograd::{Fixed, Obb2, Vec2};
/// # fn main() -> Result<(), geograd::Error> {
/// let reach = Program::trace(|(p, car): (Vec2<Sym<f32>>, Obb2<Sym<f32>>)| (p - car.center).length())?;
/// let (p, car) = (Vec2::new(4.0, 6.0), Obb2::new(1.0, 2.0, 4.5, 1.8, 0.3));
/// assert_eq!(reach.eval((p, car)), 5.0);
///
/// let (value, (by_p, by_car)) = reach.value_grad().eval((p, car));
/// assert_eq!((value, by_p.x, by_car.center.y), (5.0, 0.6, -0.8));
///
/// assert_eq!(reach.value_grad().cost().roots, 1);
/// assert!(reach.wgsl("reach")?.starts_with("fn reach(x: array<f32, 7>) -> array<f32, 1> {"));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Program<In, Out> {
    recorded: Recorded,
    /// The derived data, shared by clones.
    pub(crate) kept: Arc<DerivedData>,
    shapes: PhantomData<fn(In) -> Out>,
}

/// Data that are derived from a program once.
#[derive(Debug, Default)]
pub(crate) struct DerivedData {
    /// The program of the result with its Jacobian.
    jacobian: OnceLock<Arc<Recorded>>,
    /// The recording that machines run.
    pub(crate) recording: OnceLock<Arc<dyn Any + Send + Sync>>,
}

impl<In, Out> Program<In, Out> {
    pub(crate) fn of(recorded: Recorded) -> Self {
        Program {
            recorded,
            kept: Arc::default(),
            shapes: PhantomData,
        }
    }

    /// Records a function of shapes over [`Sym`]: in `f32` or `f64`, the format of its symbols.
    ///
    /// The function is called once for the recording, and, if it uses hints, some hundred times more to compare.
    /// Numbers that it captures become constants.
    ///
    /// # Errors
    ///
    /// [`Error::Program`] if the function uses symbols of another recording, if its result depends on
    /// an infinite or NaN literal, or if its value depends on hints
    /// ([`Mask::any`](crate::Mask::any), [`Mask::all`](crate::Mask::all)).
    pub fn trace<T, X, Y>(function: impl Fn(X) -> Y) -> Result<Self, Error>
    where
        T: Real,
        X: Fixed<Scalar = Sym<T>, Of<T> = In>,
        Y: Fixed<Scalar = Sym<T>, Of<T> = Out>,
    {
        record(function).map(Self::of)
    }

    /// Returns the format of its numbers: `f32` or `f64`.
    #[must_use]
    pub fn format(&self) -> Format {
        self.recorded.format()
    }

    /// Returns the number of operations of a value, by kind.
    #[must_use]
    pub fn cost(&self) -> Cost {
        Cost::of(&self.recorded.value.graph)
    }

    /// Returns the operations.
    pub(crate) fn recorded(&self) -> &Recorded {
        &self.recorded
    }
}

impl<T: Real, In: Fixed<Scalar = T>, Out: Fixed<Scalar = T>> Program<In, Out> {
    /// Returns the result for an input, with the bits of the function on plain numbers. Zeros have no sign.
    #[must_use]
    pub fn eval(&self, input: In) -> Out {
        guarded(input, |input| {
            Out::load(&self.recorded.run(&numbers(input)))
        })
    }

    /// Returns the result for an input on any scalar, with its derivatives if it has any. Literals have the format of
    /// the program.
    ///
    /// ```
    /// use geograd::ad::program::{Program, Sym};
    /// use geograd::{Jet, Scalar};
    /// let cube = Program::trace(|x: Sym<f64>| x.powi(3)).unwrap();
    /// let derivative = cube.eval_on(Jet::<f64, 1>::variable(2.0, 0)).derivative;
    /// assert_eq!(derivative, [12.0]);
    /// ```
    #[must_use]
    pub fn eval_on<S: Scalar>(&self, input: In::Of<S>) -> Out::Of<S> {
        guarded(input, |input| {
            <Out::Of<S> as Fixed>::load(&self.recorded.run_on(&numbers(input)))
        })
    }

    /// Returns the pull-back as a program: from an input and a cotangent of the result, of the result's shape,
    /// to the cotangent of the input, of the input's shape.
    #[must_use]
    pub fn vjp(&self) -> Program<(In, Out), In> {
        Program::of(self.recorded.vjp())
    }

    /// Returns the value and its gradient, of the input's shape, as a program.
    #[must_use]
    pub fn value_grad(&self) -> Program<In, (Out, In)>
    where
        Out: OneNumber,
    {
        Program::of(self.recorded.value_grad())
    }

    /// Returns the result with its Jacobian: the result's shape with its gradient, of the input's shape, in the place
    /// of every number. It [runs](crate::kernels::Function) in aligned batches.
    ///
    /// ```
    /// use geograd::ad::program::{Program, Sym};
    /// use geograd::kernels::Cpu;
    /// use geograd::Vec2;
    /// let both = Program::trace(|v: Vec2<Sym<f64>>| (v.length_squared(), v.x * v.y))?;
    /// let (_, (by_square, by_product)) = both.jacobian().eval(Vec2::new(3.0, 4.0));
    /// assert_eq!((by_square, by_product), (Vec2::new(6.0, 8.0), Vec2::new(4.0, 3.0)));
    /// let ((squares, _), derivatives) = Cpu::new().aligned(both.jacobian(), &[Vec2::new(3.0, 4.0)])?;
    /// assert_eq!((squares[0], derivatives[0].0), (25.0, by_square));
    /// # Ok::<(), geograd::Error>(())
    /// ```
    #[must_use]
    pub fn jacobian(&self) -> Jacobian<Self> {
        Jacobian(self.clone())
    }

    /// Returns the push-forward as a program: from an input and a direction, of the input's shape, to the
    /// result and its derivative along the direction, of the result's shape.
    #[must_use]
    pub fn jvp(&self) -> Program<(In, In), (Out, Out)> {
        Program::of(self.recorded.jvp())
    }
}

impl<T: Real, In: Fixed<Scalar = T>> Program<In, T> {
    /// Returns the Hessian times a direction as a program: from an input and a direction, of the input's
    /// shape, to the derivative of the gradient along it.
    #[must_use]
    pub fn hvp(&self) -> Program<(In, In), In> {
        Program::of(self.recorded.hvp())
    }

    /// Returns the Hessian as a program: in row `i` the derivative of the gradient with respect to number `i` of the
    /// input. `N` must be the count of numbers of the input, or the call does not compile.
    ///
    /// ```
    /// use geograd::ad::program::{Program, Sym};
    /// use geograd::Vec2;
    /// let f = Program::trace(|v: Vec2<Sym<f64>>| v.x * v.x * v.y).unwrap();
    /// let [by_x, by_y]: [Vec2<f64>; 2] = f.hessian().eval(Vec2::new(3.0, 5.0));
    /// assert_eq!((by_x, by_y), (Vec2::new(10.0, 6.0), Vec2::new(6.0, 0.0)));
    /// ```
    #[must_use]
    pub fn hessian<const N: usize>(&self) -> Program<In, [In; N]> {
        const { assert!(N == In::LEN, "a Hessian has a row for every number") };
        Program::of(self.recorded.hessian())
    }

    /// Returns this program with the gradient by another function, which is recorded, too: an adjoint by hand.
    /// [`value_grad`](Program::value_grad), [`vjp`](Program::vjp), [`jvp`](Program::jvp) and second derivatives come
    /// from it. The harness checks it.
    ///
    /// ```
    /// use geograd::ad::program::{Program, Sym};
    /// use geograd::{Scalar, Vec2};
    /// let norm = Program::trace(|v: Vec2<Sym<f64>>| v.x.hypot(v.y)).unwrap();
    /// let by_hand = norm.with_adjoint(|v: Vec2<Sym<f64>>| v * Sym::one().over(v.x.hypot(v.y)));
    /// let (_, derivatives) = by_hand.unwrap().value_grad().eval(Vec2::new(3.0, 4.0));
    /// assert_eq!(derivatives, Vec2::new(0.6000000000000001, 0.8));
    /// ```
    ///
    /// # Errors
    ///
    /// As for [`trace`](Program::trace).
    pub fn with_adjoint<X>(&self, gradient: impl Fn(X) -> X) -> Result<Self, Error>
    where
        X: Fixed<Scalar = Sym<T>, Of<T> = In>,
    {
        Ok(Self::of(self.recorded.with_gradient(&record(gradient)?)))
    }

    /// Returns the result as part of a larger function that is being recorded, with its adjoint by hand.
    #[must_use]
    pub fn eval_within(&self, input: In::Of<Sym<T>>) -> Sym<T> {
        let guard = Guard::of(&input);
        let input = numbers(input);
        let value = guard.result(self.recorded.run_on(&input)[0]);
        match self.recorded.gradient_by_hand() {
            None => value,
            Some(gradient) => {
                let derivatives = gradient.run_on(&input);
                Sym::with_derivatives(value, input.into_iter().zip(derivatives))
            }
        }
    }
}

/// A function with its Jacobian: see [`Program::jacobian`] and [`Op::jacobian`](crate::kernels::Op::jacobian).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Jacobian<O>(pub(crate) O);

impl<T: Real, In: Fixed<Scalar = T>, Out: Fixed<Scalar = T>> Jacobian<Program<In, Out>> {
    /// Returns the result for an input and its Jacobian: in the place of every number of the result its gradient.
    #[must_use]
    pub fn eval(&self, input: In) -> (Out, Out::With<In>) {
        // The gradients follow the result.
        let guard = Guard::of(&input);
        let all = self.recorded().run(&numbers(input));
        let result = guard.result(Out::load(&all));
        let mut gradients = all[Out::LEN..].chunks(In::LEN.max(1));
        let mut gradient = || guard.result(In::load(gradients.next().unwrap_or_default()));
        let jacobian = result.remake(&mut |_| gradient());
        (result, jacobian)
    }
    /// Returns the number of operations of a result and its Jacobian, by kind.
    #[must_use]
    pub fn cost(&self) -> Cost {
        Cost::of(&self.recorded().value.graph)
    }
    /// Returns the operations, which are made once for a program and its clones.
    fn recorded(&self) -> Arc<Recorded> {
        let made = || Arc::new(self.0.recorded.value_jacobian());
        Arc::clone(self.0.kept.jacobian.get_or_init(made))
    }
}

impl<In: Fixed<Scalar = f32>, Out: Fixed<Scalar = f32>> Program<In, Out> {
    /// Returns the program as a function in WGSL, from an array of numbers to an array of numbers, in the order of the
    /// fields. It calls functions of [`WGSL`](super::WGSL), which the shader must contain once.
    ///
    /// # Errors
    ///
    /// If the name is not an identifier, or has a meaning in WGSL or in those functions.
    pub fn wgsl(&self, name: &str) -> Result<String, Error> {
        wgsl::checked(name).map_err(Error::Program)?;
        Ok(wgsl::function(name, &self.recorded))
    }
}

impl<In: Fixed, Out: Fixed<Scalar = In::Scalar>> Program<In, Out>
where
    In::Scalar: Real,
{
    /// Returns the program as a module of JavaScript that exports a function of this name: from a list of numbers to a
    /// list of numbers, in the order of the fields. It needs nothing else, and its results have the bits of
    /// [`eval`](Program::eval); one of `f32` rounds every result to 32 bits.
    ///
    /// ```
    /// use geograd::ad::program::{Program, Sym};
    /// use geograd::Vec2;
    /// let length = Program::trace(|v: Vec2<Sym<f64>>| v.length())?;
    /// let module = length.value_grad().javascript("length")?;
    /// assert!(module.contains("export function length(x) {"));
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If the name is not an identifier, or has a meaning in JavaScript or in the module.
    pub fn javascript(&self, name: &str) -> Result<String, Error> {
        javascript::checked(name).map_err(Error::Program)?;
        let input = |i| In::name(i).to_string();
        Ok(javascript::module(name, &self.recorded, input))
    }
    /// Returns the program as a function of C, `void NAME(const double *x, double *out)`, of `float` for `f32`: from
    /// numbers to numbers, in the order of the fields. It is C99 and C++, allocates nothing, calls `fabs`, `floor` and
    /// `sqrt` alone, and has the bits of [`eval`](Program::eval) if a compiler does not contract products and sums.
    ///
    /// ```
    /// use geograd::ad::program::{Program, Sym};
    /// use geograd::Vec2;
    /// let length = Program::trace(|v: Vec2<Sym<f64>>| v.length())?;
    /// let source = length.value_grad().c("length")?;
    /// assert!(source.contains("void length(const double *x, double *out) {"));
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If the name is not an identifier, or has a meaning in C, C++, CUDA or in the text.
    pub fn c(&self, name: &str) -> Result<String, Error> {
        c::checked(name).map_err(Error::Program)?;
        Ok(c::function(name, &self.recorded, |i| {
            In::name(i).to_string()
        }))
    }
    /// Returns the header of [`c`](Program::c), which names the numbers.
    ///
    /// # Errors
    ///
    /// As `c`.
    pub fn c_header(&self, name: &str) -> Result<String, Error> {
        c::checked(name).map_err(Error::Program)?;
        Ok(c::header(name, &self.recorded, |i| In::name(i).to_string()))
    }
    /// Returns the program as a kernel of CUDA over rows, `NAME(count, inner, of_x, x_step, x_inner, out0)`: a thread
    /// computes row `i inner + j` of `out0` from the row of `of_x` at `i x_step + j x_inner`. NVRTC compiles it without
    /// headers.
    ///
    /// # Errors
    ///
    /// As [`c`](Program::c).
    pub fn cuda(&self, name: &str) -> Result<String, Error> {
        c::checked(name).map_err(Error::Program)?;
        let arguments = [("x".to_owned(), In::LEN)];
        let input = |i| In::name(i).to_string();
        Ok(c::kernel(
            name,
            &self.recorded,
            &arguments,
            &[Out::LEN],
            input,
        ))
    }
}

/// The operations one by one, in the order in which they are carried out.
impl<In: Fixed, Out: Fixed> fmt::Display for Program<In, Out> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        print(
            f,
            self.recorded(),
            |i| In::name(i).to_string(),
            |i| Out::name(i).to_string(),
        )
    }
}

//! A recorded [`Program`] as the function under check, with its own derivatives and witnesses.
use crate::ad::check::bent::Bent;
use crate::ad::check::trace::{Traced, num_duals, of_num_duals, trace};
use crate::ad::check::{Check, narrow};
use crate::ad::program::Program;
use crate::ad::program::recorded::Recorded;
use crate::{Fixed, Jet, Real, Scalar};
use std::fmt::Debug;
use std::rc::Rc;

/// Returns numbers with a derivative each.
fn jets<T: Scalar>(x: &[f64], derivatives: &[f64], of: impl Fn(f64) -> T) -> Vec<Jet<T, 1>> {
    let jet = |(&value, &derivative)| Jet {
        value: of(value),
        derivative: [of(derivative)],
    };
    x.iter().zip(derivatives).map(jet).collect()
}

/// Returns numbers with derivatives along two directions, `u` and `v`.
fn bent<T: Scalar>([x, u, v]: [&[f64]; 3], of: impl Fn(f64) -> T) -> Vec<Bent<T>> {
    let jet = |value, derivative| Jet {
        value: of(value),
        derivative: [of(derivative)],
    };
    (0..x.len())
        .map(|i| Jet {
            value: jet(x[i], v[i]),
            derivative: [jet(u[i], 0.0)],
        })
        .collect()
}

fn unbent<T: Scalar>(y: Vec<Bent<T>>, of: impl Fn(T) -> f64) -> Vec<Bent<f64>> {
    let jet = |jet: Jet<T, 1>| Jet {
        value: of(jet.value),
        derivative: [of(jet.derivative[0])],
    };
    let all = y.into_iter().map(|y| Jet {
        value: jet(y.value),
        derivative: [jet(y.derivative[0])],
    });
    all.collect()
}

impl<'a, S: Real, X: Fixed<Scalar = S> + Debug + 'a> Check<'a, X> {
    /// Sets a recorded function with its derivatives: those by hand, if it [has](Program::with_adjoint) some, else
    /// those of its recording by the reverse pass. Witnesses are the recording on duals, on traced numbers, in double
    /// precision, and for one result on duals of duals.
    ///
    /// ```
    /// use geograd::check::*;
    /// use geograd::{Program, Sym, Vec2};
    /// let norm = Program::trace(|v: Vec2<Sym<f64>>| v.x.hypot(v.y))?;
    /// Check::among([Vec2::new(3.0, 4.0), Vec2::zero()]).program(&norm).assert();
    /// // Derivatives by hand that are wrong where y is not zero.
    /// let wrong = norm.with_adjoint(|v: Vec2<Sym<f64>>| Vec2::new(v.x.over(v.x.hypot(v.y)), Sym::zero()))?;
    /// let report = Check::at(Vec2::new(3.0, 4.0)).program(&wrong).run();
    /// assert!(report.refused_for(Reason::Disagree(Witness::Adjoint, Witness::Difference)));
    /// # Ok::<(), geograd::Error>(())
    /// ```
    #[must_use]
    pub fn program<Y: Fixed<Scalar = S>>(mut self, program: &Program<X, Y>) -> Self {
        let widened = |list: Vec<S>| list.iter().map(|x| x.widen()).collect::<Vec<f64>>();
        let derivatives: Rc<Recorded> = Rc::new(program.recorded().vjp());
        // Duals and all other witnesses use the value alone, whatever derivatives the program has.
        let value: Rc<Recorded> = Rc::new(program.recorded().clone());
        let numbers = |x: &X| -> Vec<f64> { x.scalars().iter().map(|x| x.widen()).collect() };

        let of = Rc::clone(&value);
        self.value = Some(Box::new(move |x| widened(of.run(&x.scalars()))));
        let of = Rc::clone(&derivatives);
        self.adjoint = Some(Box::new(move |x, y_bar| {
            widened(of.run(&[x.scalars(), narrow(y_bar)].concat()))
        }));
        let of = Rc::clone(&value);
        self.dual = Some(Box::new(move |x, direction| {
            let out = of.run_on(&jets(&numbers(x), direction, S::nearest));
            let values = out.iter().map(|jet| jet.value.widen()).collect();
            let derivatives = out.iter().map(|jet| jet.derivative[0].widen()).collect();
            (values, derivatives)
        }));
        if program.recorded().gradient_by_hand().is_some() {
            let of = Rc::clone(&value);
            self.num_dual = Some(Box::new(move |x, direction| {
                of_num_duals::<S>(of.run_on(&num_duals::<S>(&numbers(x), direction)))
            }));
        }
        let of = Rc::clone(&value);
        self.traced = Some(Box::new(move |x| {
            let input: Vec<Traced<S>> = x.scalars().into_iter().map(Traced).collect();
            let (out, trace) = trace(|| of.run_on(&input));
            (out.iter().map(|y| y.0.widen()).collect(), trace)
        }));
        let of = Rc::clone(&value);
        self.wide = Some(Box::new(move |_, at| {
            trace(|| unbent(of.run_on(&bent(at, Traced)), |x: Traced<f64>| x.0))
        }));
        if Y::LEN == 1 {
            let of = Rc::clone(&derivatives);
            self.curvature = Some(Box::new(move |x, direction| {
                let mut input = jets(&numbers(x), direction, S::nearest);
                input.push(<Jet<S, 1> as Scalar>::lit(1.0));
                let derivatives = of.run_on(&input);
                derivatives
                    .iter()
                    .map(|jet| jet.derivative[0].widen())
                    .collect()
            }));
            self.second_order = Some(Box::new(move |_, at| {
                unbent(value.run_on(&bent(at, S::nearest)), S::widen)
            }));
        }
        self
    }
}

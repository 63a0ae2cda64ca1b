//! The two formats of numbers.
use arrow::array::{ArrayRef, ArrowPrimitiveType, PrimitiveArray};
use arrow::datatypes::{ArrowNativeType, DataType, Float32Type, Float64Type};
use common::cli::Machine;
use geograd::Error;
use geograd::kernels::Groups;
use geograd::kernels::dynamic::{Format, Function, Rows};
use geograd::kernels::reduce::Found;
use std::str::FromStr;
use std::sync::Arc;

/// `f32` or `f64`.
pub trait Number: Format + FromStr + ArrowNativeType {
    /// Its type in tables.
    type Arrow: ArrowPrimitiveType<Native = Self>;

    /// The number nearest to one of f64.
    fn near(x: f64) -> Self;
    /// A function of item i of every column, on a machine.
    fn aligned(
        function: &Function<Self>,
        machine: &Machine,
        rows: &[Rows<'_, Self>],
    ) -> Result<Vec<Vec<Self>>, Error>;
    /// Pairs with a result above a threshold, on a machine.
    fn found(
        function: &Function<Self>,
        machine: &Machine,
        rows: [Rows<'_, Self>; 2],
        threshold: Self,
    ) -> Result<Vec<Found<Self>>, Error>;

    /// The same within groups.
    fn found_grouped(
        function: &Function<Self>,
        machine: &Machine,
        rows: [Rows<'_, Self>; 2],
        groups: Groups<'_>,
        threshold: Self,
    ) -> Result<Vec<Found<Self>>, Error>;

    /// Its type in tables, as a value.
    fn data_type() -> DataType {
        Self::Arrow::DATA_TYPE
    }
    /// Numbers as a column of a table.
    fn column(numbers: Vec<Self>) -> ArrayRef {
        Arc::new(PrimitiveArray::<Self::Arrow>::new(numbers.into(), None))
    }
}

impl Number for f32 {
    type Arrow = Float32Type;

    fn near(x: f64) -> f32 {
        x as f32
    }
    fn aligned(
        function: &Function<f32>,
        machine: &Machine,
        rows: &[Rows<'_, f32>],
    ) -> Result<Vec<Vec<f32>>, Error> {
        function.aligned_on(machine.backend(), rows)
    }
    fn found(
        function: &Function<f32>,
        machine: &Machine,
        [a, b]: [Rows<'_, f32>; 2],
        threshold: f32,
    ) -> Result<Vec<Found>, Error> {
        function.above_on(machine.backend(), a, b, threshold)
    }
    fn found_grouped(
        function: &Function<f32>,
        machine: &Machine,
        [a, b]: [Rows<'_, f32>; 2],
        groups: Groups<'_>,
        threshold: f32,
    ) -> Result<Vec<Found>, Error> {
        function.above_grouped_on(machine.backend(), a, b, groups, threshold)
    }
}

impl Number for f64 {
    type Arrow = Float64Type;

    fn near(x: f64) -> f64 {
        x
    }
    fn aligned(
        function: &Function<f64>,
        _: &Machine,
        rows: &[Rows<'_, f64>],
    ) -> Result<Vec<Vec<f64>>, Error> {
        function.aligned(rows)
    }
    fn found(
        function: &Function<f64>,
        _: &Machine,
        [a, b]: [Rows<'_, f64>; 2],
        threshold: f64,
    ) -> Result<Vec<Found<f64>>, Error> {
        function.above(a, b, threshold)
    }
    fn found_grouped(
        function: &Function<f64>,
        _: &Machine,
        [a, b]: [Rows<'_, f64>; 2],
        groups: Groups<'_>,
        threshold: f64,
    ) -> Result<Vec<Found<f64>>, Error> {
        function.above_grouped(a, b, groups, threshold)
    }
}

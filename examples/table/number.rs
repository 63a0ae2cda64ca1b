//! The two formats of numbers as columns of tables.
use arrow::array::{ArrayRef, ArrowPrimitiveType, PrimitiveArray};
use arrow::datatypes::{ArrowNativeType, DataType, Float32Type, Float64Type};
use common::compute;
use std::sync::Arc;

/// `f32` or `f64`.
pub trait Number: compute::Number + ArrowNativeType {
    /// Its type in tables.
    type Arrow: ArrowPrimitiveType<Native = Self>;

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
}

impl Number for f64 {
    type Arrow = Float64Type;
}

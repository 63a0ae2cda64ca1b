//! Columns of lists.
use arrow::array::{Array, ArrayRef, AsArray};
use arrow::datatypes::DataType;

/// A fault of a list, at a row of the column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrong {
    /// It has so many numbers.
    Width { row: usize, found: usize },
    /// One of its numbers is null.
    Null { row: usize, field: usize },
}

/// The values of a column of lists that have `fields` numbers each, one list after another.
pub fn values(column: &ArrayRef, fields: usize) -> Result<ArrayRef, Wrong> {
    let values = match column.data_type() {
        DataType::FixedSizeList(_, size) if *size as usize != fields => {
            let found = *size as usize;
            return Err(Wrong::Width { row: 0, found });
        }
        DataType::FixedSizeList(_, _) => {
            // A part of it has a part of the values.
            column.as_fixed_size_list().values().clone()
        }
        _ => {
            let list = column.as_list::<i32>();
            let width = |row: usize| list.value_length(row) as usize;
            if let Some(row) = (0..list.len()).find(|&row| width(row) != fields) {
                let found = width(row);
                return Err(Wrong::Width { row, found });
            }
            // A part of a longer column shares its values.
            let first = list.value_offsets()[0] as usize;
            list.values().slice(first, list.len() * fields)
        }
    };
    match (0..values.len()).find(|&k| values.is_null(k)) {
        Some(k) => Err(Wrong::Null {
            row: k / fields,
            field: k % fields,
        }),
        None => Ok(values),
    }
}

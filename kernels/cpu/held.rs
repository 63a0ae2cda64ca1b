//! Columns that stay on the CPU: plain vectors.
use crate::Real;
use crate::error::{Argument, Error};
use crate::kernels::cpu::checked::check_numbers;
use crate::kernels::machine::Numbers;
use crate::kernels::machine::{MachineColumn, Pending};
use crate::kernels::row::item::Leaf;
use std::any::Any;

impl<T: Real> MachineColumn<T> for Numbers<T> {
    fn fields(&self) -> usize {
        self.fields
    }
    fn here(&self) -> Option<&[T]> {
        Some(&self.rows)
    }
    fn check(&self, leaf: Leaf<T>, numbers: &[T]) -> Result<(), Error> {
        check_numbers(Argument::Shape, leaf, numbers)
    }
    fn update(&mut self, rows: Vec<T>) {
        self.replace(rows);
    }
    fn started(&self, all: &[Box<dyn MachineColumn<T>>]) -> Result<Pending<Vec<Vec<T>>>, Error> {
        let all = all
            .iter()
            .map(|own| own.here().unwrap_or_default().to_vec());
        Ok(Pending::ready(all.collect()))
    }
    fn any(&self) -> &dyn Any {
        self
    }
}

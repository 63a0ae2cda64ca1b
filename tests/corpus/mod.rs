#![doc = include_str!("README.md")]
pub mod checkers;
mod colour;
pub mod faults;
pub mod function;
mod gis;
mod graphics;
pub mod inputs;
pub mod kind;
mod learning;
pub mod measure;
pub mod mutant;
pub mod record;
mod robotics;
pub mod tables;
mod tools;
mod vision;

use function::Function;

/// All functions, by field.
pub const FIELDS: &[(&str, &[Function])] = &[
    ("robotics", robotics::FUNCTIONS),
    ("vision", vision::FUNCTIONS),
    ("learning", learning::FUNCTIONS),
    ("gis", gis::FUNCTIONS),
    ("graphics", graphics::FUNCTIONS),
    ("graphics", colour::FUNCTIONS),
];

//! The table of rows: shapes by number, and the arguments and results of every row.
use crate::column::{Column, Kind, NUMBER, NUMBERS, RING};
use geograd::kernels::dynamic::{Bound, Layout, Operation, Sampler, Sort};
use geograd_rows::{names, operations};
use std::collections::HashMap;
use std::sync::OnceLock;

/// The names of numbers and paths, in the order of their kinds.
const FIRST: [&str; 5] = ["number", "ring", "polyline", "polyline3", "cloud3"];
/// A shape of the table.
pub struct Shape {
    pub name: String,
    /// The names of its numbers, whole numbers last.
    pub fields: Vec<String>,
    /// The number of whole numbers among them.
    pub codes: usize,
    /// The unit of each of them, and its limits.
    pub meaning: Vec<(&'static str, String)>,
    /// The row and its argument from which the layout is taken.
    layout: Option<(usize, usize)>,
}

/// A row: a verb with certain shapes.
pub struct TableRow {
    pub verb: String,
    pub kinds: Vec<Kind>,
    pub operation: &'static Operation,
    /// The arguments, without paths.
    pub takes: Vec<Column>,
    pub gives: Vec<Column>,
}

/// All shapes and rows.
pub struct Table {
    pub shapes: Vec<Shape>,
    pub rows: Vec<TableRow>,
    by_name: HashMap<String, Kind>,
}

impl Table {
    /// Returns the kind of a shape by its name.
    pub fn kind(&self, name: &str) -> Option<Kind> {
        self.by_name.get(name).copied()
    }
    /// Returns `true` if a lone number stands for the shape, which has no other.
    pub fn is_one_number(&self, kind: Kind) -> bool {
        self.shapes
            .get(usize::from(kind))
            .is_some_and(|shape| shape.fields.len() == 1)
    }
    /// Returns the name of a shape.
    pub fn name(&self, kind: Kind) -> &str {
        self.shapes
            .get(usize::from(kind))
            .map_or("numbers", |shape| &shape.name)
    }
    /// Returns the layout of a shape in a format.
    pub fn layout<T: geograd::Real>(&self, kind: Kind) -> Option<Layout<T>> {
        let (row, argument) = self.shapes.get(usize::from(kind))?.layout?;
        operations()[row].layouts::<T>().get(argument).copied()
    }
    /// Returns the harness's distribution of a shape.
    pub fn sampler(&self, kind: Kind) -> Option<Sampler> {
        let (row, argument) = self.shapes.get(usize::from(kind))?.layout?;
        operations()[row].samplers().get(argument).copied()
    }
    fn add(&mut self, shape: Shape) -> Kind {
        let kind = Kind::try_from(self.shapes.len()).unwrap_or(NUMBERS);
        self.by_name.insert(shape.name.clone(), kind);
        self.shapes.push(shape);
        kind
    }
    fn new() -> Self {
        let mut table = Table {
            shapes: Vec::new(),
            rows: Vec::new(),
            by_name: HashMap::new(),
        };
        for name in FIRST {
            table.add(Shape {
                name: name.to_owned(),
                fields: Vec::new(),
                codes: 0,
                meaning: Vec::new(),
                layout: None,
            });
        }
        for (place, (operation, name)) in operations().iter().zip(names_in_order()).enumerate() {
            let mut takes: Vec<Column> = Vec::new();
            let mut gives: Vec<Column> = Vec::new();
            for (k, argument) in operation.arguments().into_iter().enumerate() {
                let kind = table.kind_of(&argument.shape, Some((place, k)));
                takes.push(column(
                    argument.name.to_string(),
                    kind,
                    argument.shape.fields.len(),
                ));
            }
            for shape in operation.result() {
                let kind = table.kind_of(&shape, None);
                gives.push(column("result".to_owned(), kind, shape.fields.len()));
            }
            let mut kinds: Vec<Kind> = takes.iter().map(|column| column.kind).collect();
            if operation.sort == Sort::Fold {
                let path = FIRST.iter().position(|&path| name.shapes == [path]);
                kinds.push(path.map_or(RING, |path| path as Kind));
            }
            table.rows.push(TableRow {
                verb: name.verb,
                kinds,
                operation,
                takes,
                gives,
            });
        }
        table
    }
    /// Returns the index of a shape, and adds a new one to the table.
    fn kind_of(
        &mut self,
        shape: &geograd::kernels::dynamic::Shape,
        layout: Option<(usize, usize)>,
    ) -> Kind {
        let name = identifier(&shape.name);
        if let Some(kind) = self.kind(&name) {
            let known = &mut self.shapes[usize::from(kind)];
            known.layout = known.layout.or(layout);
            return kind;
        }
        let fields = shape
            .fields
            .iter()
            .map(|field| field.name.to_string())
            .collect();
        let codes = shape
            .fields
            .iter()
            .filter(|field| is_whole(field.bound))
            .count();
        let numbers = shape.fields.iter();
        let meaning = numbers
            .map(|field| (unit(field), limit(shape, field.bound)))
            .collect();
        self.add(Shape {
            name,
            fields,
            codes,
            meaning,
            layout,
        })
    }
}

/// Returns the name of a shape as an identifier of Python: `ConvexPolygon6` for `ConvexPolygon<6>`, `Hull3_8` for
/// `Hull3<8>`, `Vec2x4` for `[Vec2; 4]`.
fn identifier(name: &str) -> String {
    let name = name.replace("; ", "x").replace("3<", "3_");
    name.chars()
        .filter(|c| c.is_alphanumeric() || *c == '_')
        .collect()
}

/// Returns the unit of a number.
fn unit(field: &geograd::kernels::dynamic::Number) -> &'static str {
    use geograd::check::Kind;
    match (field.bound, field.kind) {
        (Bound::Whole, _) => "whole number",
        (_, Kind::X | Kind::Y | Kind::Z) => "coordinate",
        (_, Kind::Length) => "length",
        (_, Kind::Offset) => "distance from the origin",
        (_, Kind::Angle | Kind::AngleX | Kind::AngleY) => "angle in radians",
        (_, Kind::DirectionX | Kind::DirectionY | Kind::DirectionZ) => "part of a direction",
        (_, Kind::RotationVectorX | Kind::RotationVectorY | Kind::RotationVectorZ) => {
            "part of a rotation vector in radians"
        }
        (_, Kind::QuaternionW | Kind::QuaternionX | Kind::QuaternionY | Kind::QuaternionZ) => {
            "part of a quaternion"
        }
        (_, Kind::Number) => "number",
    }
}

/// Returns the limits of a number's values.
fn limit(shape: &geograd::kernels::dynamic::Shape, bound: Bound) -> String {
    let of = |what: &str, place: usize| {
        let field = shape.fields.get(place);
        field.map_or_else(String::new, |field| format!("{what} {}", field.name))
    };
    match bound {
        Bound::NotNegative => "at least 0".to_owned(),
        Bound::Positive => "above 0".to_owned(),
        Bound::AtMost(place) => of("at most", place),
        Bound::AtLeast(place) => of("at least", place),
        Bound::Direction => "not all parts 0".to_owned(),
        _ => String::new(),
    }
}

fn is_whole(bound: Bound) -> bool {
    bound == Bound::Whole
}

fn column(name: String, kind: Kind, fields: usize) -> Column {
    let axes = if kind == NUMBER {
        Vec::new()
    } else {
        vec![fields]
    };
    Column { name, kind, axes }
}

/// Returns the names of rows in the order of [`operations`], which differs from that of the list.
fn names_in_order() -> Vec<geograd::kernels::dynamic::Name> {
    let mut by_row: HashMap<&'static str, geograd::kernels::dynamic::Name> =
        names().into_iter().map(|name| (name.row, name)).collect();
    let row = |operation: &Operation| by_row.remove(operation.name);
    operations().iter().filter_map(row).collect()
}

/// Returns the table, which is made at the first call.
pub fn table() -> &'static Table {
    static TABLE: OnceLock<Table> = OnceLock::new();
    TABLE.get_or_init(Table::new)
}

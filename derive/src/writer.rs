//! A struct with the pieces of text that its implementations share.
use crate::parse::{Field, Form, Parameter, Shape};
use proc_macro::{Group, TokenStream, TokenTree};

/// Returns the name that stands for a field's type until [`weave`].
pub fn hole(i: usize) -> String {
    format!("__type_{i}")
}

/// Parses text and puts types into its holes.
pub fn weave(text: &str, types: &[&TokenStream]) -> TokenStream {
    fn fill(tokens: TokenStream, types: &[&TokenStream]) -> TokenStream {
        let one = |token| match token {
            TokenTree::Group(group) => {
                let mut filled = Group::new(group.delimiter(), fill(group.stream(), types));
                filled.set_span(group.span());
                TokenTree::from(filled).into()
            }
            TokenTree::Ident(name) => {
                let i = name.to_string().strip_prefix("__type_").map(str::parse);
                match i {
                    Some(Ok::<usize, _>(i)) => types[i].clone(),
                    _ => TokenTree::Ident(name).into(),
                }
            }
            token => TokenStream::from(token),
        };
        tokens.into_iter().flat_map(one).collect()
    }
    fill(text.parse().expect("the derive writes Rust"), types)
}

/// Returns the number of scalars of a field.
pub fn len(i: usize) -> String {
    format!("<{} as __g::Fixed>::LEN", hole(i))
}

/// Returns the name of a field in messages.
pub fn shown(field: &Field) -> &str {
    field.member.strip_prefix("r#").unwrap_or(&field.member)
}

/// A struct with what text needs of it.
pub struct Writer<'a> {
    pub shape: &'a Shape,
}

impl Writer<'_> {
    /// `impl<S: bound, const N: usize>`.
    pub fn generics(&self, bound: &str) -> String {
        let each = self.shape.parameters.iter().map(|p| match p {
            Parameter::Scalar => format!("{}: {bound}", self.shape.scalar),
            Parameter::Const { name, of } => format!("const {name}: {of}"),
        });
        format!("<{}>", each.collect::<Vec<_>>().join(", "))
    }
    /// Returns the same without a scalar.
    pub fn constants(&self) -> String {
        let each = self.shape.parameters.iter().filter_map(|p| match p {
            Parameter::Scalar => None,
            Parameter::Const { name, of } => Some(format!("const {name}: {of}")),
        });
        each.collect::<Vec<_>>().join(", ")
    }
    /// Returns the struct of another scalar.
    pub fn of(&self, scalar: &str) -> String {
        let each = self.shape.parameters.iter().map(|p| match p {
            Parameter::Scalar => scalar,
            Parameter::Const { name, .. } => name,
        });
        let each = each.collect::<Vec<_>>().join(", ");
        format!("{}<{each}>", self.shape.name)
    }
    /// Something of every field: its number, the field, whether it is a code.
    pub fn fields(&self, mut of: impl FnMut(usize, &Field, bool) -> String) -> String {
        let each = self.shape.fields.iter().enumerate().map(|(i, field)| {
            let is_code = matches!(field.form, Form::Code);
            of(i, field, is_code)
        });
        each.collect()
    }
    /// `Name { field: value, … }`.
    pub fn made(&self, mut of: impl FnMut(usize, &Field, bool) -> String) -> String {
        let name = &self.shape.name;
        let all = self
            .fields(|i, field, is_code| format!("{}: {}, ", field.member, of(i, field, is_code)));
        format!("{name} {{ {all} }}")
    }
    /// Returns the number of scalars before a field.
    pub fn before(&self, field: usize) -> String {
        let scalars = (0..field).filter(|&i| !matches!(self.shape.fields[i].form, Form::Code));
        scalars.fold("0".to_owned(), |sum, i| format!("{sum} + {}", len(i)))
    }
    /// Returns the same of the field with a name.
    pub fn before_field(&self, member: &str) -> String {
        let mut fields = self.shape.fields.iter();
        let place = fields.position(|field| field.member == member);
        self.before(place.unwrap_or_default())
    }
    pub fn leaves(&self, name: &str) -> bool {
        self.shape.except.iter().any(|x| x == name)
    }
}

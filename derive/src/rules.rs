//! The rules of a shape: refused where they mean nothing, written as checks and as data.
use crate::parse::{Field, Form, Refusal, Shape};
use crate::writer::{Writer, hole, len, shown};
use proc_macro::Span;

impl Shape {
    /// Returns `Ok` when rules are of scalars and the fields that they name exist.
    pub fn check_rules(&self, span: Span) -> Result<(), Refusal> {
        for field in &self.fields {
            for other in field.at_most.iter().chain(&field.differs_from) {
                let other_field = self.fields.iter().find(|field| field.member == *other);
                let Some(other_field) = other_field else {
                    return Refusal::new(span, format!("there is no field `{other}`"));
                };
                if other == &field.member || matches!(other_field.form, Form::Code) {
                    return Refusal::new(
                        span,
                        format!(
                            "`{}` is compared with `{other}`: name another field of scalars",
                            field.member
                        ),
                    );
                }
            }
            if field.is_ruled() && matches!(field.form, Form::Code) {
                return Refusal::new(
                    span,
                    format!(
                        "`{}` is a count or code: rules are of scalars",
                        field.member
                    ),
                );
            }
        }
        Ok(())
    }
}

impl Field {
    /// Returns `true` if its numbers have a rule.
    pub fn is_ruled(&self) -> bool {
        let relations = [&self.at_most, &self.differs_from];
        self.non_negative
            || self.positive
            || self.non_zero
            || relations.iter().any(|other| other.is_some())
    }
}

impl Form {
    /// Returns `true` for a lone scalar.
    pub fn is_scalar(&self) -> bool {
        matches!(self, Form::Scalar)
    }
    /// Returns `true` if there are shapes in it.
    pub fn has_shapes(&self) -> bool {
        match self {
            Form::Shape => true,
            Form::Array(element) => element.has_shapes(),
            Form::Tuple(parts) => parts.iter().any(Form::has_shapes),
            Form::Scalar | Form::Code => false,
        }
    }
}

/// Returns the check of every rule of the attributes and the rule as data, in the order of checks.
fn rules(writer: &Writer<'_>) -> Vec<(String, String)> {
    let fields = || writer.shape.fields.iter().enumerate();
    let mut rules = Vec::new();
    for (i, field) in fields() {
        let (member, at, count) = (&field.member, writer.before(i), len(i));
        if field.non_negative {
            rules.push((
                format!("__g::non_negative(self, &self.{member}, {at})?;"),
                format!("__g::Rule::NotNegative {{ first: {at}, count: {count} }},"),
            ));
        }
        if field.positive {
            rules.push((
                format!("__g::positive(self, &self.{member}, {at})?;"),
                format!("__g::Rule::Positive {{ first: {at}, count: {count} }},"),
            ));
        }
        if let Some(other) = &field.at_most {
            let high = writer.before_field(other);
            rules.push((
                format!("__g::at_most(self, &self.{member}, &self.{other}, {at}, {other:?})?;"),
                format!("__g::Rule::Ordered {{ low: {at}, high: {high}, count: {count} }},"),
            ));
        }
    }
    // Rules of several numbers together.
    for (i, field) in fields() {
        let (member, name, at, count) = (&field.member, shown(field), writer.before(i), len(i));
        if field.non_zero {
            rules.push((
                format!("__g::non_zero(&self.{member}, {name:?})?;"),
                format!("__g::Rule::NonZero {{ first: {at}, count: {count} }},"),
            ));
        }
        if let Some(other) = &field.differs_from {
            let (broken, place) = (format!("is the {other}"), writer.before_field(other));
            rules.push((
                format!("__g::differs_from(&self.{member}, &self.{other}, {name:?}, {broken:?})?;"),
                format!("__g::Rule::Distinct {{ first: {at}, other: {place}, count: {count} }},"),
            ));
        }
    }
    if writer.shape.non_zero {
        let broken = match &writer.shape.fields[..] {
            [a, b] if a.form.is_scalar() && b.form.is_scalar() => {
                format!("and {} are both zero", shown(b))
            }
            _ => "and the others are all zero".to_owned(),
        };
        rules.push((
            format!("__g::not_all_zero(self, {broken:?})?;"),
            "__g::Rule::NonZero { first: 0, count: <Self as __g::Fixed>::LEN },".to_owned(),
        ));
    }
    rules
}

/// Returns the implementation of `Validate`.
pub fn validate(writer: &Writer<'_>) -> String {
    let of = writer.of(&writer.shape.scalar);
    let generics = writer.generics("__g::Scalar<Mask = bool>");
    let finite = writer.fields(|_, field, is_code| match (is_code, &field.names[..]) {
        (true, _) => String::new(),
        (_, []) => format!("__g::valid(&self.{}, {:?})?;", field.member, shown(field)),
        (_, names) => format!("__g::valid_as(&self.{}, &{names:?})?;", field.member),
    });
    let rules = rules(writer);
    let (checks, rules): (String, String) = rules.into_iter().unzip();
    // The functions follow the types in the list of holes.
    let own = (0..writer.shape.rules.len()).map(|i| {
        let rule = hole(writer.shape.fields.len() + i);
        format!("{rule}(self)?;")
    });
    let has_rules = !checks.is_empty() || !writer.shape.rules.is_empty();
    // Lone scalars have no rules.
    let parts = writer.fields(|i, field, _| match field.form.has_shapes() {
        true => format!(
            "__g::Rule::Parts {{
                first: {}, count: 1, width: {}, rules: <{} as __g::Validate>::RULES,
            }},",
            writer.before(i),
            len(i),
            hole(i)
        ),
        false => String::new(),
    });
    let finite_suffices = writer.fields(|i, _, is_code| match is_code || has_rules {
        true => " && false".into(),
        false => format!(" && <{} as __g::Validate>::FINITE_SUFFICES", hole(i)),
    });
    format!(
        "#[automatically_derived]
        impl{generics} __g::Validate for {of} {{
            const FINITE_SUFFICES: bool = true{finite_suffices};
            const RULES: &'static [__g::Rule] = &[{parts}{rules}];
            #[inline]
            fn validate(&self) -> ::core::result::Result<(), __g::Flaw> {{
                {finite} {checks} {own}
                ::core::result::Result::Ok(())
            }}
        }}",
        own = own.collect::<String>(),
    )
}

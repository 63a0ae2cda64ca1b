//! The output of the derive, as text; the types of fields keep their tokens, so that the compiler's
//! errors point at them.
use crate::parse::{Field, Form, Motions, Shape};
use crate::rules::validate;
use crate::writer::{Writer, hole, shown, weave};
use proc_macro::TokenStream;
use std::fmt::Write;

/// Returns the value of a place with every scalar replaced.
fn remake(form: &Form, place: &str, depth: usize) -> String {
    match form {
        Form::Scalar => format!("__f(&{place})"),
        Form::Shape => format!("__g::Pack::remake(&{place}, __f)"),
        Form::Array(element) => {
            let inner = remake(element, &format!("{place}[__i{depth}]"), depth + 1);
            format!("::core::array::from_fn(|__i{depth}| {inner})")
        }
        Form::Tuple(parts) => {
            let parts = parts.iter().enumerate();
            let parts = parts.map(|(i, part)| remake(part, &format!("{place}.{i}"), depth) + ", ");
            format!("({})", parts.collect::<String>())
        }
        Form::Code => format!("::core::clone::Clone::clone(&{place})"),
    }
}

/// Returns code that visits every scalar of a place.
fn each(form: &Form, place: &str, depth: usize) -> String {
    match form {
        Form::Scalar => format!("__f(&mut {place});"),
        Form::Shape => format!("__g::Pack::each(&mut {place}, __f);"),
        Form::Array(element) => {
            let inner = each(element, &format!("(*__x{depth})"), depth + 1);
            format!("for __x{depth} in &mut {place} {{ {inner} }}")
        }
        Form::Tuple(parts) => {
            let parts = parts.iter().enumerate();
            let parts = parts.map(|(i, part)| each(part, &format!("{place}.{i}"), depth));
            parts.collect()
        }
        Form::Code => String::new(),
    }
}

/// Returns the text of a test that two places are about equal; `compare` is a function's name and its further
/// arguments.
fn about(form: &Form, [a, b]: [&str; 2], depth: usize, compare: (&str, &str)) -> String {
    match form {
        Form::Scalar | Form::Shape => format!("{}(&{a}, &{b}, {})", compare.0, compare.1),
        Form::Array(element) => {
            let places = [&*format!("(*__x{depth})"), &*format!("(*__y{depth})")];
            let inner = about(element, places, depth + 1, compare);
            format!("{a}.iter().zip({b}.iter()).all(|(__x{depth}, __y{depth})| {inner})")
        }
        Form::Tuple(parts) => {
            let parts = parts.iter().enumerate().map(|(i, part)| {
                let places = [&*format!("{a}.{i}"), &*format!("{b}.{i}")];
                about(part, places, depth, compare)
            });
            let parts: Vec<_> = parts.collect();
            format!("(true && {})", parts.join(" && "))
        }
        Form::Code => format!("{a} == {b}"),
    }
}

/// Returns all implementations.
pub fn impls(shape: &Shape) -> TokenStream {
    let writer = Writer { shape };
    let mut text = derived(&writer) + &pack(&writer) + &fixed(&writer) + &item(&writer);
    if !writer.leaves("Validate") {
        text += &validate(&writer);
    }
    if !writer.leaves("approx") {
        text += &approx(&writer);
    }
    if !writer.leaves("Sample") {
        text += &sample(&writer);
    }
    if !writer.leaves("Arbitrary") {
        let (constants, of) = (writer.constants(), writer.of("f64"));
        write!(text, "::geograd::__arbitrary! {{ [{constants}] {of} }}").ok();
    }
    let text =
        format!("#[allow(unused)] const _: () = {{ use ::geograd::derived as __g; {text} }};");
    let text = text.replace("::geograd::", &format!("{}::", shape.library));
    let types: Vec<_> = shape
        .fields
        .iter()
        .map(|field| &field.tokens)
        .chain(&shape.rules)
        .collect();
    weave(&text, &types)
}

/// Returns the first error if a derive of the standard library is missing. Whoever writes a part by hand may not need
/// all.
fn derived(writer: &Writer<'_>) -> String {
    if writer.leaves("approx") || writer.leaves("Sample") {
        return String::new();
    }
    let (constants, of) = (writer.constants(), writer.of("f64"));
    format!("#[automatically_derived] impl<{constants}> __g::Derived for {of} {{}}")
}

fn pack(writer: &Writer<'_>) -> String {
    let (scalar, of) = (&writer.shape.scalar, writer.of(&writer.shape.scalar));
    let generics = writer.generics("::core::clone::Clone");
    let mapped =
        writer.made(|_, field, _| remake(&field.form, &format!("self.{}", field.member), 0));
    let each = writer.fields(|_, field, _| each(&field.form, &format!("self.{}", field.member), 0));
    format!(
        "#[automatically_derived]
        impl{generics} __g::Pack for {of} {{
            type Scalar = {scalar};
            type With<__T: ::core::clone::Clone> = {with};
            #[inline(always)]
            fn remake<__T: ::core::clone::Clone>(
                &self, __f: &mut impl ::core::ops::FnMut(&{scalar}) -> __T,
            ) -> {with} {{
                {mapped}
            }}
            #[inline(always)]
            fn each(&mut self, __f: &mut impl ::core::ops::FnMut(&mut {scalar})) {{ {each} }}
        }}",
        with = writer.of("__T"),
    )
}

fn fixed(writer: &Writer<'_>) -> String {
    let (scalar, of) = (&writer.shape.scalar, writer.of(&writer.shape.scalar));
    let generics = writer.generics("__g::Scalar");
    let len = writer.fields(|i, _, is_code| match is_code {
        true => String::new(),
        false => format!(" + <{} as __g::Fixed>::LEN", hole(i)),
    });
    let codes = writer.fields(|i, _, is_code| match is_code {
        true => format!(" + <{} as __g::Code>::CODES", hole(i)),
        false => format!(" + <{} as __g::Fixed>::CODES", hole(i)),
    });
    let load = writer.made(|_, _, is_code| match is_code {
        true => "__g::no_code()".to_owned(),
        false => "__g::load(&mut __from)".to_owned(),
    });
    let store = writer.fields(|_, field, is_code| match is_code {
        true => String::new(),
        false => format!("__g::store(self.{}, &mut __to);", field.member),
    });
    let filled = writer.made(|_, _, is_code| match is_code {
        true => "__g::no_code()".to_owned(),
        false => "__g::Fixed::filled(__scalar)".to_owned(),
    });
    let load_codes = writer.made(|_, field, is_code| match is_code {
        true => "__g::load_code(&mut __from)".to_owned(),
        false => format!("__g::load_codes(self.{}, &mut __from)", field.member),
    });
    let store_codes = writer.fields(|_, field, is_code| {
        let how = if is_code { "store_code" } else { "store_codes" };
        format!("__g::{how}(self.{}, &mut __to);", field.member)
    });
    let bounding = match writer.shape.bounding {
        true => format!(
            "fn axis_bounds(self) -> __g::Vec<{scalar}> {{ __g::Pack::scalars(&self.bounding()) }}"
        ),
        false => String::new(),
    };
    let names = writer.fields(|i, field, is_code| {
        let hole = hole(i);
        match (is_code, &field.names[..]) {
            (true, _) => String::new(),
            (_, []) => format!(
                "({:?}, <{hole} as __g::Fixed>::LEN, <{hole} as __g::Fixed>::name),",
                shown(field)
            ),
            (_, names) => format!(
                "(\"\", {{
                    const {{ ::core::assert!(
                        <{hole} as __g::Fixed>::LEN == {count},
                        \"a name for every number\"
                    ) }};
                    {count}
                }}, |__i| __g::Field::new({names:?}[__i])),",
                count = names.len()
            ),
        }
    });
    format!(
        "#[automatically_derived]
        impl{generics} __g::Fixed for {of} {{
            type Of<__R: __g::Scalar> = {other};
            const LEN: usize = 0{len};
            const CODES: usize = 0{codes};
            #[inline(always)]
            fn load(__from: &[{scalar}]) -> Self {{
                let mut __from = &__from[..Self::LEN];
                let __made = {load};
                __made
            }}
            #[inline(always)]
            fn store(self, __to: &mut [{scalar}]) {{
                let mut __to = &mut __to[..Self::LEN];
                {store}
                let _ = __to;
            }}
            #[inline(always)]
            fn filled(__scalar: {scalar}) -> Self {{ {filled} }}
            fn name(__i: usize) -> __g::Field {{ __g::name(__i, &[{names}]) }}
            #[inline]
            fn load_codes(self, mut __from: &[u32]) -> Self {{ {load_codes} }}
            #[inline]
            fn store_codes(self, mut __to: &mut [u32]) {{ {store_codes} let _ = __to; }}
            {bounding}
        }}",
        other = writer.of("__R"),
    )
}

fn item(writer: &Writer<'_>) -> String {
    let of = writer.of(&writer.shape.scalar);
    let generics = writer.generics("__g::Real");
    format!(
        "#[automatically_derived]
        impl{generics} __g::Item for {of} where {of}: __g::Validate {{
            ::geograd::__item_of_one!();
        }}"
    )
}

fn approx(writer: &Writer<'_>) -> String {
    let (scalar, of) = (&writer.shape.scalar, writer.of(&writer.shape.scalar));
    let head = |name: &str| {
        let generics = writer.generics(&format!(
            "__g::approx::{name}<Epsilon: ::core::clone::Clone>"
        ));
        format!("#[automatically_derived] impl{generics} __g::approx::{name} for {of}")
    };
    let all = |compare: (&str, &str)| {
        let method = format!("__g::approx::{}", compare.0);
        writer.fields(|_, field, _| {
            let (a, b) = (
                format!("self.{}", field.member),
                format!("__other.{}", field.member),
            );
            let same = about(&field.form, [&a, &b], 0, (&method, compare.1));
            format!(" && {same}")
        })
    };
    format!(
        "{} {{
            type Epsilon = {scalar}::Epsilon;
            fn default_epsilon() -> {scalar}::Epsilon {{ {scalar}::default_epsilon() }}
            fn abs_diff_eq(&self, __other: &Self, __e: {scalar}::Epsilon) -> bool {{ true{} }}
        }}
        {} {{
            fn default_max_relative() -> {scalar}::Epsilon {{ {scalar}::default_max_relative() }}
            fn relative_eq(
                &self, __other: &Self, __e: {scalar}::Epsilon, __m: {scalar}::Epsilon,
            ) -> bool {{ true{} }}
        }}
        {} {{
            fn default_max_ulps() -> u32 {{ {scalar}::default_max_ulps() }}
            fn ulps_eq(&self, __other: &Self, __e: {scalar}::Epsilon, __m: u32) -> bool {{ true{} }}
        }}",
        head("AbsDiffEq"),
        all(("AbsDiffEq::abs_diff_eq", "__e.clone()")),
        head("RelativeEq"),
        all(("RelativeEq::relative_eq", "__e.clone(), __m.clone()")),
        head("UlpsEq"),
        all(("UlpsEq::ulps_eq", "__e.clone(), __m")),
    )
}

fn sample(writer: &Writer<'_>) -> String {
    let (constants, of) = (writer.constants(), writer.of("f64"));
    // Numbers as the rules want them.
    let mended = writer.fields(|_, field, _| {
        let mut mended = String::new();
        let member = &field.member;
        if matches!(&field.kind, Some(Motions::Kind(kind)) if kind.starts_with("Angle")) {
            write!(mended, "__g::as_angle(&mut __x.{member});").ok();
        }
        if field.non_negative {
            write!(mended, "__g::as_non_negative(&mut __x.{member});").ok();
        }
        if field.positive {
            write!(mended, "__g::as_positive(&mut __x.{member});").ok();
        }
        if let Some(other) = &field.at_most {
            write!(
                mended,
                "__g::in_order(&mut __x.{member}, &mut __x.{other});"
            )
            .ok();
        }
        mended
    });
    let drawn = |how: &str| {
        writer.made(|_, _, is_code| match is_code {
            true => "__g::no_code()".to_owned(),
            false => format!("__g::Sample::{how}(__draw)"),
        })
    };
    // A list of every field's hard cases, and one of each of them.
    let cases = writer.fields(|i, _, is_code| match is_code {
        true => String::new(),
        false => format!("let __hard{i} = __g::hard();"),
    });
    let counts = writer.fields(|i, _, is_code| match is_code {
        true => "1, ".to_owned(),
        false => format!("__hard{i}.len(), "),
    });
    let combined = writer.made(|i, _, is_code| match is_code {
        true => "__g::no_code()".to_owned(),
        false => format!("::core::clone::Clone::clone(&__hard{i}[__at[{i}]])"),
    });
    let every = |what: &dyn Fn(&Field) -> String| {
        writer.fields(|_, field, is_code| match is_code {
            true => String::new(),
            false => what(field) + ", ",
        })
    };
    let kinds = every(&|field| match &field.kind {
        Some(Motions::Points(as_)) => {
            format!("__g::{as_}(__g::Sample::kinds(&self.{}))", field.member)
        }
        Some(Motions::Kind(kind)) => format!(
            "__g::all(__g::Kind::{kind}, __g::Pack::count(&self.{}))",
            field.member
        ),
        None if field.non_negative || field.positive => {
            format!(
                "__g::as_lengths(__g::Sample::kinds(&self.{}))",
                field.member
            )
        }
        None => format!("__g::Sample::kinds(&self.{})", field.member),
    });
    let scales = every(&|field| format!("__g::Sample::scales(&self.{})", field.member));
    let outlines = every(&|field| format!("__g::Sample::outlines(&self.{})", field.member));
    let lengths = every(&|field| format!("__g::Pack::count(&__x.{})", field.member));
    format!(
        "#[automatically_derived]
        impl<{constants}> __g::Sample for {of} {{
            fn ordinary(__draw: &mut __g::Draw) -> Self {{
                __g::drawn(__draw, |__draw| {ordinary}, |__x| {{ {mended} }})
            }}
            fn thin(__draw: &mut __g::Draw) -> Self {{
                __g::drawn(__draw, |__draw| {thin}, |__x| {{ {mended} }})
            }}
            fn draw(__draw: &mut __g::Draw) -> Self {{
                let __x: Self = __g::one_of(__draw);
                let __lengths = [{lengths}];
                __g::mingled(__x, &__lengths, __draw)
            }}
            fn hard() -> __g::Vec<Self> {{
                {cases}
                __g::combined(&[{counts}], |__at| {combined}, |__x| {{ {mended} }})
            }}
            fn kinds(&self) -> __g::Vec<__g::Kind> {{ __g::joined([{kinds}]) }}
            fn scales(&self) -> __g::Vec<f64> {{
                __g::together(__g::joined([{scales}]), &__g::Sample::kinds(self))
            }}
            fn outlines(&self) -> __g::Vec<__g::Vec<[f64; 2]>> {{ __g::joined([{outlines}]) }}
            fn inside(&self) -> bool {{ __g::Validate::validate(self).is_ok() }}
        }}",
        ordinary = drawn("ordinary"),
        thin = drawn("thin"),
    )
}

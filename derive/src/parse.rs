//! The declaration of a struct, read from its tokens.
use proc_macro::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

/// The reason why a struct is not a shape, and its location.
pub struct Refusal {
    text: String,
    span: Span,
}

impl Refusal {
    pub fn new<T>(span: Span, text: impl Into<String>) -> Result<T, Self> {
        let text = text.into();
        Err(Refusal { text, span })
    }
    /// Returns the tokens `compile_error!("…");` at the location.
    pub fn into_tokens(self) -> TokenStream {
        let message = TokenTree::from(Literal::string(&self.text));
        let all = [
            Ident::new("compile_error", self.span).into(),
            Punct::new('!', Spacing::Alone).into(),
            Group::new(Delimiter::Parenthesis, message.into()).into(),
            Punct::new(';', Spacing::Alone).into(),
        ];
        let spanned = |mut token: TokenTree| {
            token.set_span(self.span);
            token
        };
        all.into_iter().map(spanned).collect()
    }
}

/// The declaration of a shape.
pub struct Shape {
    pub name: String,
    /// The parameter that stands for the scalar.
    pub scalar: String,
    pub parameters: Vec<Parameter>,
    pub fields: Vec<Field>,
    /// Not all its numbers are zero.
    pub non_zero: bool,
    /// Its method `bounding` returns an axis-aligned box around it.
    pub bounding: bool,
    /// Functions with further rules.
    pub rules: Vec<TokenStream>,
    /// The traits that the author implements by hand.
    pub except: Vec<String>,
    /// The path of the library, if it is renamed.
    pub library: String,
}

/// A generic parameter.
pub enum Parameter {
    Scalar,
    Const { name: String, of: String },
}

/// A field.
pub struct Field {
    /// The name of the field in code: an identifier or a number.
    pub member: String,
    pub tokens: TokenStream,
    pub form: Form,
    /// The names of its numbers, if they do not follow from the field's.
    pub names: Vec<String>,
    pub non_negative: bool,
    pub positive: bool,
    /// Not all its numbers are zero.
    pub non_zero: bool,
    /// The field that is an upper bound.
    pub at_most: Option<String>,
    /// The field whose value it may not have.
    pub differs_from: Option<String>,
    /// The effect of motions on its numbers.
    pub kind: Option<Motions>,
}

/// The effect of motions on the numbers of a field.
pub enum Motions {
    /// Each number is of this kind.
    Kind(String),
    /// Its points are directions, or rotation vectors; the function for this kind.
    Points(&'static str),
}

/// The structure of a type in terms of scalars.
pub enum Form {
    Scalar,
    Array(Box<Form>),
    Tuple(Vec<Form>),
    Shape,
    /// A count or code, without scalars.
    Code,
}

type Tokens<'a> = &'a [TokenTree];

fn is_punct(token: Option<&TokenTree>, c: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == c)
}
fn is_ident(token: Option<&TokenTree>, name: &str) -> bool {
    matches!(token, Some(TokenTree::Ident(ident)) if ident.to_string() == name)
}
fn group(token: Option<&TokenTree>, delimiter: Delimiter) -> Option<&Group> {
    match token {
        Some(TokenTree::Group(group)) if group.delimiter() == delimiter => Some(group),
        _ => None,
    }
}
/// Returns the tokens, with groups from macros expanded.
fn list(stream: TokenStream) -> Vec<TokenTree> {
    let one = |token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::None => list(group.stream()),
        token => vec![token],
    };
    stream.into_iter().flat_map(one).collect()
}
fn span_of(tokens: Tokens<'_>) -> Span {
    tokens.first().map_or_else(Span::call_site, TokenTree::span)
}

/// Splits at a sign outside of angle brackets. A sign at the end adds no empty part.
fn split(tokens: Tokens<'_>, at: char) -> Vec<Tokens<'_>> {
    let (mut parts, mut start, mut depth) = (Vec::new(), 0, 0_i32);
    for (i, token) in tokens.iter().enumerate() {
        if is_punct(Some(token), '<') {
            depth += 1;
        } else if is_punct(Some(token), '>') {
            depth -= 1;
        } else if depth == 0 && is_punct(Some(token), at) {
            parts.push(&tokens[start..i]);
            start = i + 1;
        }
    }
    if start < tokens.len() {
        parts.push(&tokens[start..]);
    }
    parts
}

/// Takes attributes off the front. Returns the contents of `#[shape(…)]`.
fn attributes<'a>(tokens: &mut Tokens<'a>) -> Vec<TokenTree> {
    let mut found = Vec::new();
    while is_punct(tokens.first(), '#') {
        if let Some(attribute) = group(tokens.get(1), Delimiter::Bracket) {
            let inner = list(attribute.stream());
            if is_ident(inner.first(), "shape")
                && let Some(inside) = group(inner.get(1), Delimiter::Parenthesis)
            {
                found.extend(inside.stream());
                found.push(Punct::new(',', Spacing::Alone).into());
            }
        }
        *tokens = tokens.get(2..).unwrap_or_default();
    }
    found
}

/// Takes `pub` and `pub(…)` off the front.
fn visibility(tokens: &mut Tokens<'_>) {
    if !is_ident(tokens.first(), "pub") {
        return;
    }
    *tokens = &tokens[1..];
    if let Some(inside) = group(tokens.first(), Delimiter::Parenthesis) {
        let inside = list(inside.stream());
        let words = ["crate", "self", "super", "in"];
        if words.iter().any(|word| is_ident(inside.first(), word)) {
            *tokens = &tokens[1..];
        }
    }
}

/// Returns a string literal's text.
fn text_of(token: Option<&TokenTree>) -> Option<String> {
    let text = token?.to_string();
    let text = text.strip_prefix('"')?.strip_suffix('"')?;
    Some(text.to_owned())
}

/// Reads a struct.
pub fn shape(input: TokenStream) -> Result<Shape, Refusal> {
    let all = list(input);
    let mut tokens: Tokens<'_> = &all;
    let about = attributes(&mut tokens);
    visibility(&mut tokens);
    if !is_ident(tokens.first(), "struct") {
        return Refusal::new(
            span_of(tokens),
            "only a struct can be a shape: every value has the same numbers",
        );
    }
    let Some(TokenTree::Ident(name)) = tokens.get(1) else {
        return Refusal::new(span_of(tokens), "expected the name of a struct");
    };
    tokens = &tokens[2..];
    let (scalar, parameters) = parameters(&mut tokens, name)?;
    let (fields, is_named) = match tokens.first() {
        Some(TokenTree::Group(group)) if group.delimiter() != Delimiter::Bracket => {
            let is_named = group.delimiter() == Delimiter::Brace;
            (list(group.stream()), is_named)
        }
        Some(token) if is_ident(Some(token), "where") => {
            return Refusal::new(token.span(), UNBOUND);
        }
        _ => return Refusal::new(name.span(), "a shape has fields"),
    };
    if is_ident(tokens.get(1), "where") {
        return Refusal::new(tokens[1].span(), UNBOUND);
    }
    let mut shape = Shape {
        name: name.to_string(),
        fields: Vec::new(),
        non_zero: false,
        bounding: false,
        rules: Vec::new(),
        except: Vec::new(),
        library: "::geograd".to_owned(),
        scalar,
        parameters,
    };
    for (i, field) in split(&fields, ',').into_iter().enumerate() {
        let place = (!is_named).then_some(i);
        shape.fields.push(self::field(field, place, &shape.scalar)?);
    }
    for item in split(&about, ',') {
        if is_ident(item.first(), "validate") && is_punct(item.get(1), '=') {
            shape.rules.push(item[2..].iter().cloned().collect());
        } else if item.len() == 1 && is_ident(item.first(), "non_zero") {
            shape.non_zero = true;
        } else if item.len() == 1 && is_ident(item.first(), "bounding") {
            shape.bounding = true;
        } else if is_ident(item.first(), "except")
            && let Some(inside) = group(item.get(1), Delimiter::Parenthesis)
        {
            let inside = list(inside.stream());
            for name in split(&inside, ',') {
                let word = name[0].to_string();
                if !EXCEPTIONS.contains(&word.as_str()) {
                    let known = EXCEPTIONS.join(", ");
                    return Refusal::new(span_of(name), format!("expected one of {known}"));
                }
                shape.except.push(word);
            }
        } else if is_ident(item.first(), "crate")
            && is_punct(item.get(1), '=')
            && let Some(path) = text_of(item.get(2))
        {
            shape.library = format!("::{path}");
        } else {
            return Refusal::new(
                span_of(item),
                "a shape knows `non_zero`, `bounding`, `validate = function`, `except(…)` and `crate = \"name\"`",
            );
        }
    }
    shape.check_rules(name.span())?;
    Ok(shape)
}

const UNBOUND: &str = "a shape's struct has no bounds: functions of it have";

/// The traits whose implementation can be left to the author.
const EXCEPTIONS: [&str; 4] = ["Validate", "approx", "Sample", "Arbitrary"];

/// Takes generic parameters off the front. Returns the scalar's name, and all parameters in order.
fn parameters(tokens: &mut Tokens<'_>, name: &Ident) -> Result<(String, Vec<Parameter>), Refusal> {
    let missing = format!("a shape is generic over its scalar: `struct {name}<S>`");
    if !is_punct(tokens.first(), '<') {
        return Refusal::new(name.span(), missing);
    }
    let mut depth = 0_i32;
    let end = tokens.iter().position(|token| {
        depth += i32::from(is_punct(Some(token), '<')) - i32::from(is_punct(Some(token), '>'));
        depth == 0
    });
    let Some(end) = end else {
        return Refusal::new(name.span(), missing);
    };
    let (inside, rest) = (&tokens[1..end], &tokens[end + 1..]);
    *tokens = rest;
    let (mut scalar, mut all) = (None, Vec::new());
    for parameter in split(inside, ',') {
        let declared = split(parameter, '=')[0];
        match declared {
            [TokenTree::Punct(lifetime), ..] => {
                return Refusal::new(lifetime.span(), "a shape owns its numbers");
            }
            [first, TokenTree::Ident(name), _, of @ ..] if is_ident(Some(first), "const") => {
                let of: TokenStream = of.iter().cloned().collect();
                let (name, of) = (name.to_string(), of.to_string());
                all.push(Parameter::Const { name, of });
            }
            [TokenTree::Ident(name)] if scalar.is_none() => {
                scalar = Some(name.to_string());
                all.push(Parameter::Scalar);
            }
            [TokenTree::Ident(name)] => {
                return Refusal::new(name.span(), "a shape is generic over one scalar only");
            }
            _ => return Refusal::new(span_of(parameter), UNBOUND),
        }
    }
    match scalar {
        Some(scalar) => Ok((scalar, all)),
        None => Refusal::new(name.span(), missing),
    }
}

/// Reads a field; `place` is its index in a tuple.
fn field(mut tokens: Tokens<'_>, place: Option<usize>, scalar: &str) -> Result<Field, Refusal> {
    let about = attributes(&mut tokens);
    visibility(&mut tokens);
    let member = match place {
        Some(place) => place.to_string(),
        None => {
            let name = tokens[0].to_string();
            tokens = &tokens[2..];
            name
        }
    };
    let mut field = Field {
        member,
        tokens: tokens.iter().cloned().collect(),
        form: Form::Code,
        names: Vec::new(),
        non_negative: false,
        positive: false,
        non_zero: false,
        at_most: None,
        differs_from: None,
        kind: None,
    };
    let mut is_code = false;
    for item in split(&about, ',') {
        match (item[0].to_string().as_str(), item.len()) {
            ("code", 1) => is_code = true,
            ("non_negative", 1) => field.non_negative = true,
            ("positive", 1) => field.positive = true,
            ("non_zero", 1) => field.non_zero = true,
            ("length", 1) => field.kind = Some(Motions::Kind("Length".to_owned())),
            ("angle", 1) => field.kind = Some(Motions::Kind("Angle".to_owned())),
            ("number", 1) => field.kind = Some(Motions::Kind("Number".to_owned())),
            ("direction", 1) => field.kind = Some(Motions::Points("as_directions")),
            ("rotation_vector", 1) => field.kind = Some(Motions::Points("as_rotation_vectors")),
            ("kind", 3) if text_of(item.get(2)).is_some() => {
                field.kind = text_of(item.get(2)).map(Motions::Kind);
            }
            ("at_most", 3) if text_of(item.get(2)).is_some() => {
                field.at_most = text_of(item.get(2));
            }
            ("differs_from", 3) if text_of(item.get(2)).is_some() => {
                field.differs_from = text_of(item.get(2));
            }
            ("names", 2) if group(item.get(1), Delimiter::Parenthesis).is_some() => {
                let inside = group(item.get(1), Delimiter::Parenthesis).map(Group::stream);
                let inside = list(inside.unwrap_or_default());
                field.names = inside.iter().filter_map(|x| text_of(Some(x))).collect();
            }
            _ => {
                return Refusal::new(
                    span_of(item),
                    "a field of a shape knows `non_negative`, `positive`, `non_zero`, `at_most = \"field\"`, \
                     `differs_from = \"field\"`, `names(\"a\", \"b\")`, `angle`, `length`, \
                     `number`, `direction`, `rotation_vector`, `kind = \"AngleY\"` and `code`",
                );
            }
        }
    }
    if !is_code {
        field.form = form(tokens, scalar)?;
    }
    Ok(field)
}

/// Returns the structure of a type in terms of scalars.
fn form(tokens: Tokens<'_>, scalar: &str) -> Result<Form, Refusal> {
    if let [TokenTree::Group(inside)] = tokens {
        let inner = list(inside.stream());
        match inside.delimiter() {
            Delimiter::Bracket => {
                let [element, _] = split(&inner, ';')[..] else {
                    return Refusal::new(inside.span(), "a shape has a fixed number of scalars");
                };
                return Ok(Form::Array(Box::new(form(element, scalar)?)));
            }
            Delimiter::Parenthesis => {
                let parts = split(&inner, ',');
                if parts.len() == 1 && !is_punct(inner.last(), ',') {
                    return form(parts[0], scalar);
                }
                let parts: Result<_, _> = parts.into_iter().map(|x| form(x, scalar)).collect();
                return Ok(Form::Tuple(parts?));
            }
            Delimiter::Brace | Delimiter::None => {}
        }
    }
    match tokens {
        [one] if is_ident(Some(one), scalar) => Ok(Form::Scalar),
        [first, ..] if is_punct(Some(first), '&') => {
            Refusal::new(first.span(), "a shape owns its numbers")
        }
        [first, ..] if is_ident(Some(first), "Vec") => {
            Refusal::new(first.span(), "a shape has a fixed number of scalars")
        }
        _ if mentions(tokens, scalar) => Ok(Form::Shape),
        _ => Refusal::new(
            span_of(tokens),
            format!("not made of `{scalar}`; a count or code is marked `#[shape(code)]`"),
        ),
    }
}

/// Returns `true` if a type contains the scalar.
fn mentions(tokens: Tokens<'_>, scalar: &str) -> bool {
    tokens.iter().any(|token| match token {
        TokenTree::Group(group) => mentions(&list(group.stream()), scalar),
        token => is_ident(Some(token), scalar),
    })
}

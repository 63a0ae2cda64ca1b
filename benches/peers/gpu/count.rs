//! Operations of a shader's function, counted in the shader itself as naga parses it.
use naga::{
    BinaryOperator as B, Block, Expression as E, Function, Handle, MathFunction as M, Module,
    Statement as S, TypeInner, UnaryOperator,
};

/// Operations on single numbers, by what a GPU takes for them. Nothing is fused.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Additions, subtractions and multiplications.
    pub arithmetic: usize,
    pub divisions: usize,
    /// Least and most.
    pub bounds: usize,
    /// Comparisons, choices, and what is done to their results.
    pub choices: usize,
    /// Bits of numbers.
    pub bits: usize,
}

impl Counts {
    pub fn total(self) -> usize {
        self.arithmetic + self.divisions + self.bounds + self.choices + self.bits
    }

    fn add(&mut self, other: Counts) {
        self.arithmetic += other.arithmetic;
        self.divisions += other.divisions;
        self.bounds += other.bounds;
        self.choices += other.choices;
        self.bits += other.bits;
    }
}

/// The instructions of a call of the function from its beginning to its end. Code under a run-time
/// condition does not count: early returns, and branches that only parallel boxes need.
pub fn count(text: &str, function: &str) -> Counts {
    let module = naga::front::wgsl::parse_str(text).expect("the shaders are tested to be valid");
    let info = naga::valid::Validator::new(
        naga::valid::ValidationFlags::all(),
        naga::valid::Capabilities::SUBGROUP,
    )
    .validate(&module)
    .expect("the shaders are tested to be valid");
    let found = module
        .functions
        .iter()
        .find(|(_, own)| own.name.as_deref() == Some(function))
        .map(|(handle, _)| handle)
        .expect("every shader has the function");
    Counter {
        module: &module,
        info: &info,
    }
    .function(found)
}

struct Counter<'a> {
    module: &'a Module,
    info: &'a naga::valid::ModuleInfo,
}

impl Counter<'_> {
    fn function(&self, handle: Handle<Function>) -> Counts {
        self.block(handle, &self.module.functions[handle].body)
    }

    fn block(&self, of: Handle<Function>, block: &Block) -> Counts {
        let function = &self.module.functions[of];
        let mut all = Counts::default();
        for statement in block {
            match statement {
                S::Emit(range) => {
                    for expression in range.clone() {
                        all.add(self.expression(of, expression));
                    }
                }
                S::Call { function, .. } => all.add(self.function(*function)),
                S::Block(block) => all.add(self.block(of, block)),
                S::If {
                    condition,
                    accept,
                    reject,
                } => {
                    if let E::Literal(naga::Literal::Bool(yes)) = function.expressions[*condition] {
                        let taken = if yes { accept } else { reject };
                        all.add(self.block(of, taken));
                        if ends(taken) {
                            return all;
                        }
                    }
                }
                S::Return { .. } => return all,
                _ => {}
            }
        }
        all
    }

    /// One for every component of the result.
    fn expression(&self, of: Handle<Function>, handle: Handle<E>) -> Counts {
        let resolved = self.info[of][handle].ty.inner_with(&self.module.types);
        let width = match resolved {
            TypeInner::Vector { size, .. } => *size as usize,
            _ => 1,
        };
        let mut own = Counts::default();
        match &self.module.functions[of].expressions[handle] {
            E::Binary { op, .. } => match op {
                B::Add | B::Subtract | B::Multiply => own.arithmetic = width,
                B::Divide | B::Modulo => own.divisions = width,
                B::And | B::InclusiveOr | B::ExclusiveOr | B::ShiftLeft | B::ShiftRight => {
                    own.bits = width;
                }
                _ => own.choices = width,
            },
            E::Select { .. } => own.choices = width,
            // A sign is part of the operand it belongs to, and so is a magnitude.
            E::Unary { op, .. } if *op == UnaryOperator::LogicalNot => own.choices = width,
            E::Math { fun, .. } => match fun {
                M::Abs => {}
                M::Min | M::Max => own.bounds = width,
                M::Clamp => own.bounds = 2 * width,
                _ => own.arithmetic = width,
            },
            _ => {}
        }
        own
    }
}

fn ends(block: &Block) -> bool {
    matches!(block.last(), Some(S::Return { .. }))
}

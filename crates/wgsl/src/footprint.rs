//! How much a user's own snippets ask of a driver: the memory of their arrays, and their length with every call filled in, as
//! drivers do it.
//!
//! Some drivers never come back from, or crash over, what the language allows; so this is known before they see it. What is
//! built in is not counted: it is known to compile.

use naga::proc::Layouter;
use naga::valid::{FunctionInfo, ModuleInfo};
use naga::{AddressSpace, Block, Expression, Function, Handle, Module, Span, Statement, Type, TypeInner};

/// Bytes that arrays may take for every ray. Mesa's software driver needs about 2 s to compile arrays of this size that are indexed
/// by what is not constant, 6 s for twice and 20 s for four times as much.
pub(crate) const MOST_BYTES: u64 = 1024;

/// Expressions that snippets may have with every call filled in: far more than anybody writes. Mesa's software driver compiles
/// 2400 in 7 s and twice as many in 23 s.
pub(crate) const MOST_EXPRESSIONS: u64 = 4_000;

/// Bytes from which a variable without arrays counts as one with: structures of structures grow as fast.
const LARGE: u64 = 256;

/// What is counted, and where the largest part of it stands.
#[derive(Clone, Copy, Default)]
struct Sum {
    total: u64,
    largest: u64,
    place: Span,
}

impl Sum {
    fn add(&mut self, (amount, place): (u64, Span)) {
        self.total = self.total.saturating_add(amount);
        if amount > self.largest {
            (self.largest, self.place) = (amount, place);
        }
    }
}

/// What one function asks for together with all that it calls.
#[derive(Clone, Copy, Default)]
struct Footprint {
    bytes: Sum,
    expressions: Sum,
}

/// Where the own snippets of a valid module ask for more than drivers can bear, and what to say about it. `is_own` tells which
/// places are in a user's own texts.
pub(crate) fn excess(module: &Module, info: &ModuleInfo, is_own: impl Fn(Span) -> bool) -> Option<(Span, String)> {
    let count = Count::of(module, is_own)?;
    let mut private = Sum::default();
    for (handle, global) in module.global_variables.iter().filter(|(_, global)| global.space == AddressSpace::Private) {
        private.add(count.bytes(global.ty, || module.global_variables.get_span(handle)));
    }
    // Functions come after those that they call.
    let mut known: Vec<Footprint> = Vec::with_capacity(module.functions.len());
    for (handle, function) in module.functions.iter() {
        let found = count.footprint(function, module.functions.get_span(handle), &info[handle], &known);
        known.push(found);
    }
    let entries = module.entry_points.iter().enumerate();
    let entries =
        entries.map(|(at, entry)| count.footprint(&entry.function, Span::default(), info.get_entry_point(at), &known));
    entries.map(|entry| judge(entry, private)).find_map(|excess| excess)
}

fn judge(mut entry: Footprint, private: Sum) -> Option<(Span, String)> {
    entry.bytes.add((private.total, private.place));
    let Footprint { bytes, expressions } = entry;
    if bytes.total > MOST_BYTES {
        let message = format!(
            "arrays and other large values take {} bytes for every ray (a function counts as often as it is called), but a \
             shader may have {MOST_BYTES}; make them smaller",
            bytes.total
        );
        return Some((bytes.place, message));
    }
    (expressions.total > MOST_EXPRESSIONS).then(|| {
        let message = format!(
            "the snippets have {} expressions (a function counts as often as it is called), but may have {MOST_EXPRESSIONS}; \
             call this function less often, or in a loop",
            expressions.total
        );
        (expressions.place, message)
    })
}

/// Whether an expression makes a whole value of its type, which drivers then keep somewhere.
fn is_value(expression: &Expression) -> bool {
    matches!(
        expression,
        Expression::Compose { .. }
            | Expression::ZeroValue(_)
            | Expression::Constant(_)
            | Expression::Load { .. }
            | Expression::Select { .. }
            | Expression::CallResult(_)
            | Expression::FunctionArgument(_)
    )
}

/// Visits all calls of a block, also in blocks inside.
fn calls(block: &Block, visit: &mut impl FnMut(Handle<Function>)) {
    for statement in block {
        match statement {
            Statement::Call { function, .. } => visit(*function),
            Statement::Block(inner) => calls(inner, visit),
            Statement::If { accept, reject, .. } => [accept, reject].into_iter().for_each(|inner| calls(inner, visit)),
            Statement::Switch { cases, .. } => cases.iter().for_each(|case| calls(&case.body, visit)),
            Statement::Loop { body, continuing, .. } => {
                [body, continuing].into_iter().for_each(|inner| calls(inner, visit));
            }
            _ => {}
        }
    }
}

/// Counts what functions of a module ask for.
struct Count<'a, F> {
    module: &'a Module,
    layouter: Layouter,
    is_own: F,
}

impl<'a, F: Fn(Span) -> bool> Count<'a, F> {
    /// `None` for a module with types that have no size, which no valid one has.
    fn of(module: &'a Module, is_own: F) -> Option<Self> {
        let mut layouter = Layouter::default();
        layouter.update(module.to_ctx()).ok()?;
        Some(Self { module, layouter, is_own })
    }

    fn footprint(&self, function: &Function, place: Span, info: &FunctionInfo, known: &[Footprint]) -> Footprint {
        let mut sum = Footprint::default();
        for (handle, variable) in function.local_variables.iter() {
            sum.bytes.add(self.bytes(variable.ty, || function.local_variables.get_span(handle)));
        }
        for (handle, expression) in function.expressions.iter() {
            if is_value(expression)
                && let Some(ty) = info[handle].ty.handle()
            {
                sum.bytes.add(self.bytes(ty, || function.expressions.get_span(handle)));
            }
        }
        if (self.is_own)(place) {
            sum.expressions.add((function.expressions.len() as u64, place));
        }
        calls(&function.body, &mut |callee| {
            if let Some(Footprint { bytes, expressions }) = known.get(callee.index()) {
                sum.bytes.add((bytes.total, bytes.place));
                sum.expressions.add((expressions.total, expressions.place));
            }
        });
        sum
    }

    /// The bytes of a type if they count: those of arrays, and of whatever is large, in a user's own texts.
    fn bytes(&self, ty: Handle<Type>, place: impl FnOnce() -> Span) -> (u64, Span) {
        let size = u64::from(self.layouter[ty].size);
        if size <= LARGE && !has_array(self.module, ty) {
            return (0, Span::default());
        }
        let place = place();
        (if (self.is_own)(place) { size } else { 0 }, place)
    }
}

fn has_array(module: &Module, ty: Handle<Type>) -> bool {
    match &module.types[ty].inner {
        TypeInner::Array { .. } => true,
        TypeInner::Struct { members, .. } => members.iter().any(|member| has_array(module, member.ty)),
        _ => false,
    }
}

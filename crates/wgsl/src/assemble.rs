//! Fills the skeleton with the chosen snippets and keeps the origin of every line.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::TRAVERSAL;
use crate::choice::{Choice, Features};
use crate::declaration::{Declaration, Parameter};
use crate::diagnostic::{Diagnostic, Origin, SourceMap};
use crate::lexer::{line_and_column, module_scope_names, tokens};
use crate::library::{Library, SourceKind};
use crate::limits;
use crate::rename::{Renaming, loops};
use crate::slot::{Slot, contract, signature};

const MAX_INCLUDE_DEPTH: usize = 16;

/// The first binding of the outputs: colour of output k at `FIRST_OUTPUT_BINDING + 2 k`, its depth one further.
pub(crate) const FIRST_OUTPUT_BINDING: usize = 16;

/// A complete shader with the origin of its lines.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembled {
    /// WGSL.
    pub text: String,
    /// Origin of every line.
    pub map: SourceMap,
    /// What the loop contains.
    pub features: Features,
    /// Parameters of the snippets that are in the text: (field of the uniform struct, place, parameter).
    /// The place is the slot's id, or `out1`, `out2`, `out3` for compositing.
    pub parameters: Vec<(String, String, Parameter)>,
    /// File, line and column of every loop that counts its rounds: the one with number n is at n - 1.
    pub loops: Vec<(Arc<str>, u32, u32)>,
}

/// Assembles the ray traversal for a choice.
///
/// # Errors
/// A refused combination (as a diagnostic without line), a snippet that does not keep its slot's contract,
/// an unknown or cyclic include, a malformed directive: each with file and line.
pub fn assemble(library: &Library, choice: &Choice) -> Result<Assembled, Vec<Diagnostic>> {
    let mut features = choice.check(library).map_err(|problems| {
        problems.into_iter().map(|problem| Diagnostic::new("ray traversal", 0, 0, problem.message)).collect::<Vec<_>>()
    })?;
    let places = places(library, choice, &features);
    if places.iter().any(|place| place.is_own) {
        features.flags.insert("own".to_owned());
    }
    if places.iter().any(|place| place.is_own && place.may_loop()) {
        features.flags.insert("bounded".to_owned());
    }
    let skeleton = library.source(TRAVERSAL).map_or("", |source| &source.text);
    let problems: Vec<_> = places
        .iter()
        .flat_map(|place| {
            let others = places.iter().filter(|other| other.prefix != place.prefix);
            let foreign: Vec<_> = others.flat_map(|other| other.private_names(skeleton)).collect();
            let mut problems = place.breaches(skeleton);
            problems.extend(limits::breaches(&place.path, &place.text, &foreign));
            problems
        })
        .collect();
    if !problems.is_empty() {
        return Err(problems);
    }
    let mut writer = Writer {
        library,
        features: &features,
        places: &places,
        skeleton,
        done: BTreeSet::new(),
        open: Vec::new(),
        text: String::new(),
        map: SourceMap::default(),
        loops: Vec::new(),
    };
    writer.file(TRAVERSAL, None).map_err(|problem| vec![problem])?;
    let Writer { text, map, loops, .. } = writer;
    let parameters = places
        .iter()
        .flat_map(|place| {
            place
                .declaration
                .parameters
                .iter()
                .map(|parameter| (place.field(parameter), place.prefix.clone(), parameter.clone()))
        })
        .collect();
    Ok(Assembled { text, map, features, parameters, loops })
}

/// A snippet in its place: the slot, or the output for compositing.
struct Place {
    slot: Slot,
    output: Option<usize>,
    prefix: String,
    path: Arc<str>,
    text: Arc<str>,
    declaration: Arc<Declaration>,
    /// Whether it is not built in, but a user's.
    is_own: bool,
}

fn places(library: &Library, choice: &Choice, features: &Features) -> Vec<Place> {
    let slots = choice
        .snippets
        .iter()
        .filter(|(slot, _)| features.slots.contains(slot))
        .map(|(slot, path)| (*slot, None, path));
    let outputs = choice
        .outputs
        .iter()
        .enumerate()
        .filter_map(|(index, path)| Some((Slot::Compositing, Some(index), path.as_ref()?)));
    slots
        .chain(outputs)
        .filter_map(|(slot, output, path)| {
            let source = library.source(path)?;
            Some(Place {
                slot,
                output,
                prefix: output.map_or_else(|| slot.id().to_owned(), |index| format!("out{}", index + 1)),
                path: path.clone(),
                text: source.text.clone(),
                declaration: library.declaration(path)?.clone(),
                is_own: source.kind != SourceKind::BuiltIn,
            })
        })
        .collect()
}

impl Place {
    /// Whether there may be loops in its text, or in other files of a user's that it includes.
    fn may_loop(&self) -> bool {
        !loops(&tokens(&self.text)).is_empty() || self.text.contains("\"user/")
    }

    fn field(&self, parameter: &Parameter) -> String {
        format!("{}_{}", self.prefix, parameter.name)
    }

    /// The names that the skeleton calls as they are; those of compositing get the prefix of their output.
    fn kept_names(&self, skeleton: &str) -> Vec<String> {
        match self.output {
            Some(_) => Vec::new(),
            None => contract(skeleton, self.slot).into_iter().map(|prototype| prototype.name).collect(),
        }
    }

    /// The names at module scope that are private to the snippet, as they are in the shader.
    fn private_names(&self, skeleton: &str) -> Vec<String> {
        let kept = self.kept_names(skeleton);
        let names = module_scope_names(&self.text).into_iter().filter(|(name, _)| !kept.iter().any(|k| k == name));
        names.map(|(name, _)| format!("{}_{name}", self.prefix)).collect()
    }

    /// What the snippet lacks of its slot's contract, and parameters it reads without declaring them.
    fn breaches(&self, skeleton: &str) -> Vec<Diagnostic> {
        let names = module_scope_names(&self.text);
        let mut problems = Vec::new();
        for prototype in contract(skeleton, self.slot) {
            let wanted = &prototype.text;
            let message = if prototype.text.starts_with("struct") {
                names
                    .iter()
                    .all(|(name, _)| *name != prototype.name)
                    .then(|| (1, 1, format!("a {} snippet must define `{wanted}`", self.slot)))
            } else {
                match (signature(&self.text, &prototype.name), signature(wanted, &prototype.name)) {
                    (None, _) => Some((1, 1, format!("a {} snippet must define `{wanted}`", self.slot))),
                    (Some((found, at)), Some((expected, _))) if found != expected => {
                        let (line, column) = line_and_column(&self.text, at);
                        Some((line, column, format!("the contract of slot {} is `{wanted}`", self.slot)))
                    }
                    _ => None,
                }
            };
            if let Some((line, column, message)) = message {
                problems.push(Diagnostic::new(&self.path, line, column, message).with_excerpt(&self.text));
            }
        }
        problems.extend(self.undeclared_parameters());
        problems
    }

    fn undeclared_parameters(&self) -> Vec<Diagnostic> {
        let list = crate::lexer::tokens(&self.text);
        list.windows(3)
            .filter(|three| three[0].text == "params" && three[1].text == ".")
            .filter(|three| self.declaration.parameters.iter().all(|parameter| parameter.name != three[2].text))
            .map(|three| {
                let (line, column) = line_and_column(&self.text, three[2].start);
                let name = three[2].text;
                let message = format!("no parameter `{name}` is declared; add a line such as `//! param {name}: f32 = 1 [0, 2] -- what it does`");
                Diagnostic::new(&self.path, line, column, message).with_excerpt(&self.text)
            })
            .collect()
    }
}

struct Writer<'a> {
    library: &'a Library,
    features: &'a Features,
    places: &'a [Place],
    skeleton: &'a str,
    /// Files included already.
    done: BTreeSet<Arc<str>>,
    /// Files being included, outermost first.
    open: Vec<Arc<str>>,
    text: String,
    map: SourceMap,
    loops: Vec<(Arc<str>, u32, u32)>,
}

/// A line of a file on its way out: its number in the file, its text, and its column shifts.
struct Line {
    number: u32,
    text: String,
    shifts: Vec<(u32, u32, u32)>,
}

fn lines(text: &str, renaming: &Renaming) -> Vec<Line> {
    renaming
        .apply(text)
        .into_iter()
        .zip(1..)
        .map(|(line, number)| Line { number, text: line.text, shifts: line.shifts })
        .collect()
}

impl Writer<'_> {
    fn file(&mut self, path: &str, from: Option<(&str, u32)>) -> Result<(), Diagnostic> {
        let at = |message: String| {
            Diagnostic::new(from.map_or(path, |from| from.0), from.map_or(0, |from| from.1), 0, message)
        };
        let Some(source) = self.library.source(path) else {
            return Err(at(format!("the file `{path}` to include does not exist")));
        };
        if self.open.iter().any(|open| **open == *path) || self.open.len() > MAX_INCLUDE_DEPTH {
            let chain: Vec<_> = self.open.iter().map(|open| &**open).chain([path]).collect();
            return Err(at(format!("files include each other: {}", chain.join(" -> "))));
        }
        if !self.done.insert(source.path.clone()) {
            return Ok(());
        }
        if source.kind != SourceKind::BuiltIn
            && let Some(problem) = limits::breaches(&source.path, &source.text, &[]).into_iter().next()
        {
            return Err(problem);
        }
        self.open.push(source.path.clone());
        let own = source.kind != SourceKind::BuiltIn;
        let renaming = self.bounded(Renaming::default(), &source.path, &source.text, own);
        let result = self.lines(&source.path, lines(&source.text, &renaming), None);
        self.open.pop();
        result
    }

    fn snippet(&mut self, place: &Place) -> Result<(), Diagnostic> {
        let keep = place.kept_names(self.skeleton);
        let parameters: Vec<_> = place.declaration.parameters.iter().map(|parameter| parameter.name.clone()).collect();
        let renaming = Renaming::scoped(&place.text, &place.prefix, &keep, &parameters);
        let renaming = self.bounded(renaming, &place.path, &place.text, place.is_own);
        self.open.push(place.path.clone());
        let result = self.lines(&place.path, lines(&place.text, &renaming), place.output);
        self.open.pop();
        result
    }

    /// Bounds the loops of a text that is a user's own.
    fn bounded(&mut self, renaming: Renaming, file: &Arc<str>, text: &str, own: bool) -> Renaming {
        if !own {
            return renaming;
        }
        let first = self.loops.len() as u32 + 1;
        self.loops.extend(loops(&tokens(text)).into_iter().map(|(word, _)| {
            let (line, column) = line_and_column(text, word.start);
            (file.clone(), line, column)
        }));
        renaming.bounding_loops(first)
    }

    /// Writes lines, obeying directives.
    fn lines(&mut self, file: &Arc<str>, lines: Vec<Line>, output: Option<usize>) -> Result<(), Diagnostic> {
        // For every open #if: (is the branch taken, line of the #if).
        let mut branches: Vec<(bool, u32)> = Vec::new();
        let mut lines = lines.into_iter();
        while let Some(line) = lines.next() {
            let fail = |message: String| Diagnostic {
                excerpt: line.text.clone(),
                ..Diagnostic::new(file, line.number, 0, message)
            };
            let live = branches.iter().all(|(taken, _)| *taken);
            let Some(directive) = line.text.trim_start().strip_prefix('#') else {
                if live && !line.text.starts_with("//!") {
                    self.push(file, line);
                }
                continue;
            };
            let (word, rest) = directive.trim().split_once(char::is_whitespace).unwrap_or((directive.trim(), ""));
            let rest = rest.trim();
            match word {
                "if" => branches.push((
                    rest.strip_prefix('!')
                        .map_or_else(|| self.features.has(rest), |flag| !self.features.has(flag.trim())),
                    line.number,
                )),
                "else" => match branches.last_mut() {
                    Some((taken, _)) => *taken = !*taken,
                    None => return Err(fail("#else without #if".into())),
                },
                "endif" => {
                    branches.pop().ok_or_else(|| fail("#endif without #if".into()))?;
                }
                "each" | "snippet" | "parameters" if self.in_snippet() => {
                    return Err(fail(format!("`#{word}` is up to the skeleton; a snippet may use #include and #if")));
                }
                "each" => {
                    let block = each_block(&mut lines).ok_or_else(|| fail("#each without #end".into()))?;
                    if live {
                        self.each_output(file, &block)?;
                    }
                }
                _ if !live => {}
                "include" => {
                    let path = rest.trim_matches('"');
                    self.file(path, Some((file, line.number)))?;
                }
                "snippet" => {
                    self.snippets(rest, output).ok_or_else(|| fail(format!("there is no slot `{rest}`")))??
                }
                "parameters" => self.parameters(),
                _ => {
                    return Err(fail(format!(
                        "unknown directive `#{word}`; directives are #include, #if, #else, #endif, #each, #end, #snippet and #parameters"
                    )));
                }
            }
        }
        match branches.last() {
            Some((_, number)) => Err(Diagnostic::new(file, *number, 0, "#if without #endif")),
            None => Ok(()),
        }
    }

    /// Whether a snippet, or what one includes, is being written.
    fn in_snippet(&self) -> bool {
        self.open.iter().any(|path| self.library.declaration(path).is_some())
    }

    fn push(&mut self, file: &Arc<str>, line: Line) {
        self.text += &line.text;
        self.text.push('\n');
        self.map.lines.push(Origin { file: file.clone(), line: line.number, renames: line.shifts });
    }

    fn each_output(&mut self, file: &Arc<str>, block: &[Line]) -> Result<(), Diagnostic> {
        for place in self.places.iter().filter(|place| place.output.is_some()) {
            let repeated = block.iter().map(|line| {
                let output = place.output.unwrap_or(0);
                let binding = FIRST_OUTPUT_BINDING + 2 * output;
                let text = line
                    .text
                    .replace("OUT_COLOR_BINDING", &binding.to_string())
                    .replace("OUT_DEPTH_BINDING", &(binding + 1).to_string())
                    .replace("OUT_INDEX", &format!("{output}u"));
                let renamed = Renaming::output(&text, &place.prefix).apply(&text);
                let text = renamed.into_iter().map(|line| line.text).collect();
                Line { number: line.number, text, shifts: Vec::new() }
            });
            self.lines(file, repeated.collect(), place.output)?;
        }
        Ok(())
    }

    /// Inserts the snippet of a slot; inside `#each output` that of the output. `None` for an unknown slot.
    fn snippets(&mut self, slot: &str, output: Option<usize>) -> Option<Result<(), Diagnostic>> {
        let slot = Slot::from_id(slot)?;
        let places = self.places;
        Some(
            places
                .iter()
                .filter(|place| place.slot == slot && place.output == output)
                .try_for_each(|place| self.snippet(place)),
        )
    }

    /// The uniform struct with the snippets' parameters, or nothing when there are none.
    fn parameters(&mut self) {
        let fields: Vec<_> = self
            .places
            .iter()
            .flat_map(|place| {
                place
                    .declaration
                    .parameters
                    .iter()
                    .map(|parameter| format!("    {}: {},", place.field(parameter), parameter.ty.wgsl()))
            })
            .collect();
        if fields.is_empty() {
            return;
        }
        let file: Arc<str> = "<generated: parameters>".into();
        let head = ["struct Params {".to_owned()];
        let tail = ["}".to_owned(), "@group(0) @binding(1) var<uniform> params: Params;".to_owned()];
        for (text, number) in head.into_iter().chain(fields).chain(tail).zip(1..) {
            self.push(&file, Line { number, text, shifts: Vec::new() });
        }
    }
}

/// The lines up to `#end`.
fn each_block(lines: &mut impl Iterator<Item = Line>) -> Option<Vec<Line>> {
    let mut block = Vec::new();
    for line in lines {
        if line.text.trim() == "#end" {
            return Some(block);
        }
        block.push(line);
    }
    None
}

//! Fills a skeleton with the chosen snippets and keeps the origin of every line.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::checked::{At, Checked, Features, Place, source_prefix};
use crate::declaration::Parameter;
use crate::diagnostic::{Diagnostic, Origin, SourceMap};
use crate::lexer::{line_and_column, module_scope_names, tokens};
use crate::library::{Library, Source, SourceKind};
use crate::limits;
use crate::moved::moved;
use crate::rename::{Renaming, loops};
use crate::shake::used_lines;
use crate::skeleton::Skeleton;
use crate::slot::{Slot, contract, signature};

const MAX_INCLUDE_DEPTH: usize = 16;

/// In place of the number of a binding: the assembler counts.
const BINDING: &str = "@binding(auto)";

/// A complete shader with the origin of its lines.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembled {
    /// WGSL.
    pub text: String,
    /// Origin of every line.
    pub map: SourceMap,
    /// What the shader contains.
    pub features: Features,
    /// Parameters of the snippets that are in the text: (field of the uniform struct, where, slot, parameter).
    pub parameters: Vec<(String, At, Slot, Parameter)>,
    /// File, line and column of every loop that counts its rounds: the one with number n is at n - 1.
    pub loops: Vec<(Arc<str>, u32, u32)>,
    /// The texts of the snippets that are a user's own, by path.
    own: BTreeMap<Arc<str>, Arc<str>>,
}

impl Assembled {
    /// Whether a file that the shader was made from is a user's own.
    pub(crate) fn is_own(&self, library: &Library, path: &str) -> bool {
        let of_library = |source: &Source| source.kind != SourceKind::BuiltIn;
        self.own.contains_key(path) || library.source(path).is_some_and(of_library)
    }

    /// The text of a file that the shader was made from.
    pub(crate) fn source<'a>(&'a self, library: &'a Library, path: &str) -> &'a str {
        self.own.get(path).map(|text| &**text).or_else(|| Some(&*library.source(path)?.text)).unwrap_or("")
    }
}

/// Assembles a skeleton with what was checked.
///
/// # Errors
/// A snippet that does not keep its slot's contract, an unknown or cyclic include, a malformed directive: each with file and line.
pub fn assemble(library: &Library, skeleton: &Skeleton, checked: &Checked) -> Result<Assembled, Vec<Diagnostic>> {
    let places: Vec<&Place> = checked.places.iter().filter(|place| skeleton.scope(place.slot).is_some()).collect();
    let head = library.source(skeleton.path).map_or("", |source| &source.text);
    let problems: Vec<_> = places.iter().flat_map(|place| place_problems(place, &places, head)).collect();
    if !problems.is_empty() {
        return Err(problems);
    }
    let mut writer = Writer {
        library,
        checked,
        places: &places,
        head,
        source: None,
        done: BTreeSet::new(),
        open: Vec::new(),
        text: String::new(),
        map: SourceMap::default(),
        loops: Vec::new(),
    };
    writer.file(skeleton.path, None).map_err(|problem| vec![problem])?;
    let Writer { text, map, loops, .. } = writer;
    let parameters = places.iter().flat_map(|place| {
        let parameters = place.declaration().parameters.iter();
        parameters.map(|parameter| (place.field(parameter), place.at, place.slot, parameter.clone()))
    });
    let own = places.iter().filter(|place| place.snippet.is_own());
    let assembled = Assembled {
        text,
        map,
        features: checked.features.clone(),
        parameters: parameters.collect(),
        loops,
        own: own.map(|place| (place.path().clone(), place.snippet.text().clone())).collect(),
    };
    Ok(numbered(shaken(assembled, library)))
}

/// Without what nothing uses. Texts of a user's own stay whole, so that what is wrong in them is found.
fn shaken(mut assembled: Assembled, library: &Library) -> Assembled {
    let is_own = |line: usize| assembled.is_own(library, &assembled.map.lines[line].file);
    let used = used_lines(&assembled.text, is_own);
    let kept = |line: &usize| used.get(*line).copied().unwrap_or(true);
    let lines = assembled.text.lines().enumerate().filter(|(line, _)| kept(line));
    assembled.text = lines.map(|(_, line)| format!("{line}\n")).collect();
    let origins = std::mem::take(&mut assembled.map.lines).into_iter().enumerate();
    assembled.map.lines = origins.filter(|(line, _)| kept(line)).map(|(_, origin)| origin).collect();
    assembled
}

/// With a number for every binding, in the order of the text.
fn numbered(mut assembled: Assembled) -> Assembled {
    let mut parts = assembled.text.split(BINDING);
    let mut text = parts.next().unwrap_or_default().to_owned();
    for (number, part) in parts.enumerate() {
        text += &format!("@binding({number}){part}");
    }
    assembled.text = text;
    assembled
}

/// What is wrong with a snippet in its place.
fn place_problems(place: &Place, places: &[&Place], head: &str) -> Vec<Diagnostic> {
    let mut problems = place.breaches(head);
    if place.snippet.is_own() {
        let others = places.iter().filter(|other| other.prefix() != place.prefix() && !other.is_of_program());
        let foreign: Vec<_> = others.flat_map(|other| other.private_names(head)).collect();
        problems.extend(limits::breaches(place.path(), place.snippet.text(), &foreign));
        problems.extend(moved(place.path(), place.snippet.text()));
    }
    problems
}

impl Place {
    /// The names that the skeleton calls as they are; those of compositing get the prefix of their output.
    fn kept_names(&self, head: &str) -> Vec<String> {
        match self.at {
            At::Output(_) => Vec::new(),
            _ => contract(head, self.slot).into_iter().map(|prototype| prototype.name).collect(),
        }
    }

    /// The names at module scope that are private to the snippet, as they are in the shader.
    fn private_names(&self, head: &str) -> Vec<String> {
        let kept = self.kept_names(head);
        let names = module_scope_names(self.snippet.text());
        let names = names.into_iter().filter(|(name, _)| !kept.iter().any(|k| k == name));
        names.map(|(name, _)| format!("{}_{name}", self.prefix())).collect()
    }

    /// What the snippet lacks of its slot's contract, and parameters it reads without declaring them.
    fn breaches(&self, head: &str) -> Vec<Diagnostic> {
        let text = &**self.snippet.text();
        let names = module_scope_names(text);
        let mut problems = Vec::new();
        for prototype in contract(head, self.slot) {
            let wanted = &prototype.text;
            let missing = || Some((1, 1, format!("a {} snippet must define `{wanted}`", self.slot)));
            let fault = if wanted.starts_with("struct") {
                names.iter().all(|(name, _)| *name != prototype.name).then(missing).flatten()
            } else {
                match (signature(text, &prototype.name), signature(wanted, &prototype.name)) {
                    (None, _) => missing(),
                    (Some((found, at)), Some((expected, _))) if found != expected => {
                        let (line, column) = line_and_column(text, at);
                        Some((line, column, format!("the contract of slot {} is `{wanted}`", self.slot)))
                    }
                    _ => None,
                }
            };
            if let Some((line, column, message)) = fault {
                problems.push(Diagnostic::new(self.path(), line, column, message).with_excerpt(text));
            }
        }
        problems.extend(self.undeclared_parameters());
        problems
    }

    fn undeclared_parameters(&self) -> Vec<Diagnostic> {
        let text = &**self.snippet.text();
        let declared = |name: &str| self.declaration().parameters.iter().any(|parameter| parameter.name == name);
        let list = tokens(text);
        let reads = list.windows(3).filter(|three| three[0].text == "params" && three[1].text == ".");
        let undeclared = reads.filter(|three| !declared(three[2].text)).map(|three| {
            let (line, column) = line_and_column(text, three[2].start);
            let name = three[2].text;
            let message = format!("no parameter `{name}` is declared; add a line such as `//! param {name}: f32 = 1 [0, 2] -- what it does`");
            Diagnostic::new(self.path(), line, column, message).with_excerpt(text)
        });
        undeclared.collect()
    }
}

struct Writer<'a> {
    library: &'a Library,
    checked: &'a Checked,
    places: &'a [&'a Place],
    /// Text of the skeleton, whose head states the contracts.
    head: &'a str,
    /// The volume whose part is being written.
    source: Option<usize>,
    /// Files included already, those of a volume's part for each volume.
    done: BTreeSet<(Option<usize>, Arc<str>)>,
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
    let renamed = renaming.apply(text).into_iter().zip(1..);
    renamed.map(|(line, number)| Line { number, text: line.text, shifts: line.shifts }).collect()
}

impl Writer<'_> {
    fn has(&self, flag: &str) -> bool {
        let of_source = self.source.or((self.checked.sources.len() == 1).then_some(0));
        let of_source = of_source.and_then(|source| self.checked.sources.get(source));
        self.checked.common.flags.contains(flag) || of_source.is_some_and(|source| source.flags.contains(flag))
    }

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
        if self.done.contains(&(None, source.path.clone())) || !self.done.insert((self.source, source.path.clone())) {
            return Ok(());
        }
        let own = source.kind != SourceKind::BuiltIn;
        if own && let Some(problem) = limits::breaches(&source.path, &source.text, &[]).into_iter().next() {
            return Err(problem);
        }
        self.open.push(source.path.clone());
        let renaming = self.bounded(self.of_source(&source.text), &source.path, &source.text, own);
        let result = self.lines(&source.path, lines(&source.text, &renaming), None);
        self.open.pop();
        result
    }

    fn snippet(&mut self, place: &Place) -> Result<(), Diagnostic> {
        let text = place.snippet.text();
        let renaming = match place.is_of_program() {
            true => self.of_source(text),
            false => {
                let keep = place.kept_names(self.head);
                let parameters: Vec<_> = place.declaration().parameters.iter().map(|p| p.name.clone()).collect();
                Renaming::scoped(text, &place.own_prefix(), &keep, &parameters)
            }
        };
        let renaming = self.bounded(renaming, place.path(), text, place.snippet.is_own());
        self.open.push(place.path().clone());
        let output = match place.at {
            At::Output(output) => Some(output),
            _ => None,
        };
        let result = self.lines(place.path(), lines(text, &renaming), output);
        self.open.pop();
        result
    }

    /// Names that begin with `SRC_` are those of the volume at hand.
    fn of_source(&self, text: &str) -> Renaming {
        match self.source {
            Some(source) => Renaming::marked(text, "SRC_", &source_prefix(source)),
            None => Renaming::default(),
        }
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
                    rest.strip_prefix('!').map_or_else(|| self.has(rest), |flag| !self.has(flag.trim())),
                    line.number,
                )),
                "else" => match branches.last_mut() {
                    Some((taken, _)) => *taken = !*taken,
                    None => return Err(fail("#else without #if".into())),
                },
                "endif" => {
                    branches.pop().ok_or_else(|| fail("#endif without #if".into()))?;
                }
                "each" | "snippet" | "parameters" | "constants" if self.in_snippet() => {
                    return Err(fail(format!("`#{word}` is up to the skeleton; a snippet may use #include and #if")));
                }
                "each" => {
                    let block = each_block(&mut lines).ok_or_else(|| fail("#each without #end".into()))?;
                    match rest {
                        _ if !live => {}
                        "output" => self.each_output(file, &block)?,
                        "source" => self.each_source(file, &block)?,
                        _ => return Err(fail(format!("`#each {rest}` means nothing; there are output and source"))),
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
                "constants" => self.constants(),
                _ => {
                    return Err(fail(format!(
                        "unknown directive `#{word}`; directives are #include, #if, #else, #endif, #each, #end, #snippet, #parameters and #constants"
                    )));
                }
            }
        }
        match branches.last() {
            Some((_, number)) => Err(Diagnostic::new(file, *number, 0, "#if without #endif")),
            None => Ok(()),
        }
    }

    /// Whether a snippet that users may choose, or what one includes, is being written.
    fn in_snippet(&self) -> bool {
        self.open.iter().any(|path| {
            let here = |place: &&&Place| place.path() == path;
            self.places.iter().find(here).is_some_and(|place| !place.is_of_program())
        })
    }

    fn push(&mut self, file: &Arc<str>, line: Line) {
        self.text += &line.text;
        self.text.push('\n');
        self.map.lines.push(Origin { file: file.clone(), line: line.number, renames: line.shifts });
    }

    fn each_output(&mut self, file: &Arc<str>, block: &[Line]) -> Result<(), Diagnostic> {
        for output in self.checked.outputs() {
            let repeated = block.iter().map(|line| {
                let text = line.text.replace("OUT_INDEX", &format!("{output}u"));
                repeat(line.number, &text, "OUT_", &format!("out{}_", output + 1))
            });
            self.lines(file, repeated.collect(), Some(output))?;
        }
        Ok(())
    }

    /// What belongs to one volume is written for each. The names of the first are as they are written, those of others get a
    /// prefix; inside of functions, names that begin with `SRC_` are a volume's.
    fn each_source(&mut self, file: &Arc<str>, block: &[Line]) -> Result<(), Diagnostic> {
        for source in 0..self.checked.sources.len() {
            let prefix = source_prefix(source);
            let repeated = block.iter().map(|line| repeat(line.number, &line.text, "SRC_", &prefix)).collect();
            let outer = self.source.replace(source);
            let (start, first) = (self.text.len(), self.map.lines.len());
            let result = self.lines(file, repeated, None);
            self.source = outer;
            result?;
            if source > 0 {
                self.rename_source(source, start, first);
            }
        }
        Ok(())
    }

    /// Gives the names at module scope in what was written last, from byte `start` and line `first` on, the prefix of a volume.
    fn rename_source(&mut self, source: usize, start: usize, first: usize) {
        let part = self.text.split_off(start);
        let prefix = source_prefix(source);
        let fields = self.places.iter().filter(|place| place.at == At::Source(source)).flat_map(|place| {
            let plain = |name: &str| format!("{}_{name}", place.own_prefix());
            place.declaration().parameters.iter().map(move |p| (plain(&p.name), place.field(p))).collect::<Vec<_>>()
        });
        let renaming = Renaming::prefixed(&part, &prefix, fields.collect());
        for (line, origin) in renaming.apply(&part).into_iter().zip(self.map.lines[first..].iter_mut()) {
            self.text += &line.text;
            self.text.push('\n');
            origin.shift(&line.shifts);
        }
    }

    /// Inserts the snippet of a slot; inside `#each` that of the output or volume. `None` for an unknown slot.
    fn snippets(&mut self, slot: &str, output: Option<usize>) -> Option<Result<(), Diagnostic>> {
        let slot = Slot::from_id(slot)?;
        let places = self.places;
        let source = self.source;
        let here = |place: &&&Place| {
            place.slot == slot
                && match place.at {
                    At::Ray => true,
                    At::Source(at) => source == Some(at),
                    At::Output(at) => output == Some(at),
                }
        };
        Some(places.iter().filter(here).try_for_each(|place| self.snippet(place)))
    }

    /// The uniform struct with the snippets' parameters, or nothing when there are none.
    fn parameters(&mut self) {
        let fields = self.places.iter().flat_map(|place| {
            let parameters = place.declaration().parameters.iter();
            parameters.map(|parameter| format!("    {}: {},", place.field(parameter), parameter.ty.wgsl()))
        });
        let fields: Vec<_> = fields.collect();
        if fields.is_empty() {
            return;
        }
        let head = ["struct Params {".to_owned()];
        let tail = ["}".to_owned(), format!("@group(0) {BINDING} var<uniform> params: Params;")];
        self.generated("<generated: parameters>", head.into_iter().chain(fields).chain(tail));
    }

    /// The constants of a volume, or of all rays.
    fn constants(&mut self) {
        let settings = self.source.and_then(|source| self.checked.sources.get(source));
        let constants = &settings.unwrap_or(&self.checked.common).constants;
        let lines: Vec<_> = constants.iter().map(|(name, value)| format!("const {name} = {value};")).collect();
        self.generated("<generated: constants>", lines);
    }

    fn generated(&mut self, file: &str, lines: impl IntoIterator<Item = String>) {
        let file: Arc<str> = file.into();
        for (text, number) in lines.into_iter().zip(1..) {
            self.push(&file, Line { number, text, shifts: Vec::new() });
        }
    }
}

/// A line of a block that is repeated: names that begin with `mark` get `prefix` instead.
fn repeat(number: u32, text: &str, mark: &str, prefix: &str) -> Line {
    let renamed = Renaming::marked(text, mark, prefix).apply(text);
    Line { number, text: renamed.into_iter().map(|line| line.text).collect(), shifts: Vec::new() }
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

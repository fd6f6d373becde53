//! The evaluator: runs exactly the processors whose result would differ from the one it has.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Instant;

use crate::job::{Backend, Input, Inputs, Job, Outputs, ProcessError, Unfinished};
use crate::names::{Address, quoted};
use crate::network::{Connection, Network, Processor};
use crate::plan::Plan;
use crate::port::Facts;
use crate::processor::Declaration;
use crate::property::{Level, PropertyDecl};
use crate::readiness::{causes, chains};
use crate::report::{Outcome, Reason, Report, Request, Run};
use crate::signature::{Signature, diff};

/// Brings sinks and watched outports of a network up to date.
///
/// It keeps, for each processor, the result of its last run and what went into it: property values, revisions of the inputs,
/// outports that were wanted, render size. An evaluation compares these with the network as it is and runs what differs, so a
/// burst of edits costs one run and a value set back costs none. Results of processors that nothing needs at the moment are
/// kept until the processor is removed from the network.
pub struct Evaluator<B: Backend> {
    memories: BTreeMap<String, Memory<B::Data>>,
    standings: BTreeMap<String, Standing>,
    asked: BTreeMap<String, (Level, Vec<Reason>)>,
    revision: u64,
}

/// The last run of a processor.
struct Memory<D> {
    type_id: String,
    signature: Signature,
    data: BTreeMap<String, D>,
    revision: u64,
    run: Run,
    unfinished: Option<Unfinished>,
}

/// What came of a run.
struct Made<D> {
    run: Run,
    data: BTreeMap<String, D>,
    unfinished: Option<Unfinished>,
}

/// How a processor came out of the last evaluation that needed it.
enum Standing {
    Current,
    /// Its own causes (not those of what feeds it).
    NotReady(Vec<String>),
    Failed,
}

/// Why a processor cannot run now: its own causes; none when it only waits for others.
struct Blocked(Vec<String>);

impl<B: Backend> Default for Evaluator<B> {
    fn default() -> Self {
        Self::new()
    }
}

impl<B: Backend> Evaluator<B> {
    /// An evaluator that has no results yet.
    pub fn new() -> Self {
        Self { memories: BTreeMap::new(), standings: BTreeMap::new(), asked: BTreeMap::new(), revision: 0 }
    }

    /// Brings what the request names up to date. A processor that fails keeps its error and is not tried again before
    /// something that goes into it changes; what it feeds is not ready; everything else goes on.
    pub fn evaluate(&mut self, network: &Network, backend: &mut B, request: &Request) -> Report {
        let start = Instant::now();
        let plan = Plan::new(network, request);
        self.memories.retain(|id, memory| network.processor(id).is_some_and(|p| p.type_id() == memory.type_id));
        self.asked.retain(|id, _| network.processor(id).is_some());
        self.standings.clear();
        let mut report = Report::default();
        for processor in plan.order.iter().filter_map(|id| network.processor(id)) {
            let standing = match backend.interrupted() {
                true => None,
                false => self.visit(network, backend, &plan, processor, &mut report),
            };
            let Some(standing) = standing else {
                report.interrupted = true;
                break;
            };
            self.standings.insert(processor.id().to_owned(), standing);
        }
        self.conclude(network, &plan, &mut report);
        report.stale = self.outdated(network, &plan);
        report.needed = plan.order;
        report.elapsed = start.elapsed();
        report
    }

    /// As [`Evaluator::evaluate`], and goes on until nothing is unfinished, for whoever needs the final result. The report tells
    /// of all runs.
    pub fn finish(&mut self, network: &Network, backend: &mut B, request: &Request) -> Report {
        let mut report = self.evaluate(network, backend, request);
        while !report.unfinished.is_empty() && !report.interrupted {
            let Report { mut runs, elapsed, .. } = report;
            let next = self.evaluate(network, backend, request);
            runs.extend(next.runs);
            report = Report { runs, elapsed: elapsed + next.elapsed, ..next };
        }
        report
    }

    /// The data of an outport as of the last evaluation; `None` if that did not need the processor, or it is not ready or failed.
    pub fn output(&self, processor: &str, outport: &str) -> Option<&B::Data> {
        match self.standings.get(processor)? {
            Standing::Current => self.memories.get(processor)?.data.get(outport),
            _ => None,
        }
    }

    /// The data that feeds an inport as of the last evaluation, sorted by where it comes from.
    pub fn inputs<'a>(
        &'a self,
        network: &'a Network,
        processor: &'a str,
        inport: &'a str,
    ) -> impl Iterator<Item = &'a B::Data> {
        let into = network.inputs_in_order(processor).into_iter();
        let into = into.filter(move |connection| connection.to.item == inport);
        into.filter_map(|connection| self.output(&connection.from.processor, &connection.from.item))
    }

    /// The last run of a processor, however long ago: its times, notes, statistics and outcome.
    pub fn last_run(&self, processor: &str) -> Option<&Run> {
        self.memories.get(processor).map(|memory| &memory.run)
    }

    /// Makes a processor run at the next evaluation that needs it, for a reason the network does not know ("the file changed").
    pub fn invalidate(&mut self, processor: &str, level: Level, reason: impl Into<String>) {
        let (highest, reasons) = self.asked.entry(processor.to_owned()).or_default();
        *highest = level.max(*highest);
        let reason = Reason::Asked(reason.into());
        if !reasons.contains(&reason) {
            reasons.push(reason);
        }
    }

    /// Tells that a processor was renamed, so that it keeps its result.
    pub fn rename(&mut self, id: &str, new: &str) {
        if let Some(memory) = self.memories.remove(id) {
            self.memories.insert(new.to_owned(), memory);
        }
        if let Some(standing) = self.standings.remove(id) {
            self.standings.insert(new.to_owned(), standing);
        }
        if let Some(asked) = self.asked.remove(id) {
            self.asked.insert(new.to_owned(), asked);
        }
    }

    /// Forgets all results.
    pub fn clear(&mut self) {
        self.memories.clear();
        self.standings.clear();
        self.asked.clear();
    }

    /// Runs one processor if it must and can; `None` if it was interrupted.
    fn visit(
        &mut self,
        network: &Network,
        backend: &mut B,
        plan: &Plan,
        processor: &Processor,
        report: &mut Report,
    ) -> Option<Standing> {
        let id = processor.id();
        let inputs = match self.gather(network, backend, processor) {
            Ok(inputs) => inputs,
            Err(Blocked(causes)) => return Some(Standing::NotReady(causes)),
        };
        let (Some(processor_type), Some(&size)) = (processor.processor_type(), plan.size.get(id)) else {
            return Some(Standing::NotReady(Vec::new()));
        };
        let (decls, properties) = processor.resolve();
        let signature = Signature {
            properties,
            inputs: sources(&inputs),
            wanted: plan.wanted.get(id).cloned().unwrap_or_default(),
            size: processor_type.declaration().uses_render_size.then_some(size),
        };
        if let Some((level, reasons)) = self.stale(id, &signature, &decls) {
            let job = Job {
                id,
                processor_type,
                properties: &signature.properties,
                inputs: &inputs,
                wanted: &signature.wanted,
                size,
                level,
                reasons: &reasons,
            };
            let before = self.memories.get(id).and_then(|memory| memory.unfinished.as_ref()).filter(|_| job.refines());
            let made = run(backend, &job, before);
            if matches!(made.run.outcome, Outcome::Failed(_)) && backend.interrupted() {
                self.ask_again(made.run);
                return None;
            }
            report.runs.push(made.run.clone());
            self.remember(processor, signature, made);
        }
        Some(match self.error(id) {
            Some(_) => Standing::Failed,
            None => Standing::Current,
        })
    }

    /// What someone asked of a run that was interrupted is asked of the next.
    fn ask_again(&mut self, run: Run) {
        let asked: Vec<Reason> = run.reasons.into_iter().filter(|reason| matches!(reason, Reason::Asked(_))).collect();
        if !asked.is_empty() {
            self.asked.insert(run.processor, (run.level, asked));
        }
    }

    /// Why a processor must run and what is stale at most; `None` if its result is still right.
    fn stale(&mut self, id: &str, signature: &Signature, decls: &[PropertyDecl]) -> Option<(Level, Vec<Reason>)> {
        let mut reasons = match self.memories.get(id) {
            Some(memory) => diff(id, &memory.signature, signature, decls),
            None => vec![(Level::Ports, Reason::FirstRun)],
        };
        let unfinished = self.memories.get(id).is_some_and(|memory| memory.unfinished.is_some());
        if unfinished && reasons.is_empty() {
            reasons.push((Level::Result, Reason::Refines));
        }
        if let Some((level, asked)) = self.asked.remove(id) {
            reasons.extend(asked.into_iter().map(|reason| (level, reason)));
        }
        let level = reasons.iter().map(|(level, _)| *level).max()?;
        Some((level, reasons.into_iter().map(|(_, reason)| reason).collect()))
    }

    fn remember(&mut self, processor: &Processor, signature: Signature, made: Made<B::Data>) {
        self.revision += 1;
        let (type_id, revision) = (processor.type_id().to_owned(), self.revision);
        let Made { run, data, unfinished } = made;
        let memory = Memory { type_id, signature, data, revision, run, unfinished };
        self.memories.insert(processor.id().to_owned(), memory);
    }

    /// The data at every connected inport, or why it is not all there.
    fn gather(&self, network: &Network, backend: &B, processor: &Processor) -> Result<Inputs<B::Data>, Blocked> {
        let id = processor.id();
        let mut blocked = Blocked(causes(network, processor));
        let mut complete = blocked.0.is_empty();
        let mut inputs = Inputs::new();
        for connection in network.inputs_in_order(id) {
            let Address { processor: source, item } = &connection.from;
            let revision = self.memories.get(source).map(|memory| memory.revision);
            let (Some(data), Some(revision)) = (self.output(source, item), revision) else {
                complete = false;
                continue;
            };
            let unmet = unmet(processor, connection, &backend.facts(data));
            complete &= unmet.is_empty();
            blocked.0.extend(unmet);
            let input = Input { data: data.clone(), from: connection.from.clone(), revision };
            inputs.entry(connection.to.item.clone()).or_default().push(input);
        }
        if complete { Ok(inputs) } else { Err(blocked) }
    }

    /// Fills in what is not ready, with chains down to the causes, what failed and what is unfinished.
    fn conclude(&self, network: &Network, plan: &Plan, report: &mut Report) {
        let causes = |id: &str| match self.standings.get(id) {
            Some(Standing::NotReady(causes)) => causes.clone(),
            // Why is in the report, once.
            Some(Standing::Failed) => vec![format!("{id} failed")],
            _ => Vec::new(),
        };
        let mut chains = chains(network, plan.order.iter().map(String::as_str), &causes);
        for id in &plan.order {
            match self.standings.get(id) {
                Some(Standing::NotReady(_)) => {
                    report.not_ready.insert(id.clone(), chains.remove(id.as_str()).unwrap_or_default());
                }
                Some(Standing::Failed) => report.failed.extend(self.error(id).map(|error| (id.clone(), error.clone()))),
                Some(Standing::Current) => {
                    let unfinished = self.memories.get(id).and_then(|memory| memory.unfinished.clone());
                    report.unfinished.extend(unfinished.map(|unfinished| (id.clone(), unfinished)));
                }
                None => {}
            }
        }
    }

    /// Processors outside of the plan that have a result, but another than they would give now: their properties changed, or
    /// what feeds them, or something before that.
    fn outdated(&self, network: &Network, plan: &Plan) -> BTreeSet<String> {
        let mut outdated = BTreeSet::new();
        let unneeded = network.order().into_iter().filter(|id| !plan.wanted.contains_key(*id));
        for (processor, memory) in unneeded.filter_map(|id| Some((network.processor(id)?, self.memories.get(id)?))) {
            let id = processor.id();
            let mut feeding: BTreeMap<String, Vec<(Address, u64)>> = BTreeMap::new();
            let mut follows = false;
            for Connection { from, to } in network.inputs_in_order(id) {
                follows |= outdated.contains(&from.processor);
                let revision = self.memories.get(&from.processor).map_or(0, |memory| memory.revision);
                feeding.entry(to.item.clone()).or_default().push((from.clone(), revision));
            }
            let changed = memory.signature.inputs != feeding || memory.signature.properties != processor.resolve().1;
            if follows || changed || memory.unfinished.is_some() || self.asked.contains_key(id) {
                outdated.insert(id.to_owned());
            }
        }
        outdated
    }

    fn error(&self, id: &str) -> Option<&ProcessError> {
        match &self.memories.get(id)?.run.outcome {
            Outcome::Failed(error) => Some(error),
            Outcome::Done => None,
        }
    }
}

/// The conditions of an inport that the data of a connection does not satisfy, as causes. Where several connections may end,
/// they say which one it is.
fn unmet(processor: &Processor, connection: &Connection, facts: &Facts) -> Vec<String> {
    let Connection { from, to } = connection;
    let Some(decl) = processor.declaration().and_then(|declaration| declaration.inport(&to.item)) else {
        return Vec::new();
    };
    let which = if decl.several { format!(" from {from}") } else { String::new() };
    decl.conditions
        .iter()
        .filter(|condition| !(condition.holds)(facts))
        .map(|condition| format!("{}: input `{}` needs {}{which}", to.processor, to.item, condition.message))
        .collect()
}

/// Where the data at each inport comes from, with revisions.
fn sources<D>(inputs: &Inputs<D>) -> BTreeMap<String, Vec<(Address, u64)>> {
    let source = |input: &Input<D>| (input.from.clone(), input.revision);
    inputs.iter().map(|(inport, inputs)| (inport.clone(), inputs.iter().map(source).collect())).collect()
}

/// Runs a job, takes its time and checks what comes out. `before` is how far the run had come that this one goes on from.
fn run<B: Backend>(backend: &mut B, job: &Job<'_, B::Data>, before: Option<&Unfinished>) -> Made<B::Data> {
    let start = Instant::now();
    let result = backend.process(job);
    let cpu = start.elapsed();
    let checked = result.and_then(|outputs| {
        check_outputs(backend, job.processor_type.declaration(), job.wanted, &outputs)?;
        check_share(outputs.unfinished.as_ref(), before)?;
        Ok(outputs)
    });
    let (outcome, outputs) = match checked {
        Ok(outputs) => (Outcome::Done, outputs),
        Err(error) => (Outcome::Failed(error), Outputs::new()),
    };
    let Outputs { data, gpu_time, notes, statistics, unfinished } = outputs;
    let (processor, reasons) = (job.id.to_owned(), job.reasons.to_vec());
    let run = Run { processor, reasons, level: job.level, cpu, gpu: gpu_time, outcome, notes, statistics };
    Made { run, data, unfinished }
}

/// Who goes on must come to an end: the share that is done is below 1 and grows with every run.
fn check_share(now: Option<&Unfinished>, before: Option<&Unfinished>) -> Result<(), ProcessError> {
    let Some(share) = now.map(|unfinished| unfinished.share) else { return Ok(()) };
    let past = before.map(|unfinished| unfinished.share);
    if (0.0..1.0).contains(&share) && past.is_none_or(|past| past < share) {
        return Ok(());
    }
    let past = past.map(|past| format!(" after {past}")).unwrap_or_default();
    Err(ProcessError::new(format!("it says that {share} of its work is done{past}, which comes to no end")))
}

/// Everything wanted must be there, and nothing that was not declared or is of another type.
fn check_outputs<B: Backend>(
    backend: &B,
    declaration: &Declaration,
    wanted: &BTreeSet<String>,
    outputs: &Outputs<B::Data>,
) -> Result<(), ProcessError> {
    let missing: Vec<&String> = wanted.iter().filter(|outport| !outputs.data.contains_key(*outport)).collect();
    if !missing.is_empty() {
        return Err(ProcessError::new(format!("it ran but gave nothing on {}", quoted(&missing, ", "))));
    }
    for (outport, data) in &outputs.data {
        let found = backend.facts(data).port_type();
        match declaration.outport(outport) {
            Some(decl) if decl.port_type == found => {}
            Some(decl) => {
                let expected = decl.port_type;
                return Err(ProcessError::new(format!(
                    "it gave {found} on `{outport}`, which is declared as {expected}"
                )));
            }
            None => {
                return Err(ProcessError::new(format!("it gave data on `{outport}`, which it does not declare")));
            }
        }
    }
    Ok(())
}

//! Evaluation on a thread of its own, so that the window never waits for a picture.

use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use rayloom_gpu::{Gpu, GpuError};
use rayloom_network::{
    Address, Backend, Evaluator, Facts, Job, Level, Network, Outputs, ProcessError, Report, Request, Run, Sinks,
    Unfinished,
};
use rayloom_processors::{Data, Image, Picture, Process, Runner, Trace, snippet_revision, types};
use rayloom_volume::Progress;
use rayloom_wgsl::Validated;

use crate::probe::Ray;

/// Lets orders in a hurry end the evaluation of one that is not.
///
/// Orders in a hurry (something moves under the pointer) come faster than pictures and never end each other: there would be no
/// picture at all.
#[derive(Default)]
struct Hurry {
    /// Number of the last order that was in a hurry.
    newest: AtomicU64,
    /// Number of the order that is at work and has time; 0 if there is none.
    patient: AtomicU64,
    /// Number of the last order.
    last: AtomicU64,
    /// Number of the order whose first picture is being refined; 0 if there is none. Any newer one ends that.
    refining: AtomicU64,
}

impl Hurry {
    fn interrupts(&self) -> bool {
        let ends = |newest: &AtomicU64, at_work: &AtomicU64| {
            let at_work = at_work.load(Ordering::Relaxed);
            at_work > 0 && newest.load(Ordering::Relaxed) > at_work
        };
        ends(&self.newest, &self.patient) || ends(&self.last, &self.refining)
    }

    /// Something is at work from now on.
    fn begin(&self, order: &Order) {
        let patient = if order.in_a_hurry { 0 } else { order.number };
        self.patient.store(patient, Ordering::Relaxed);
        self.refining.store(if order.refines { order.number } else { 0 }, Ordering::Relaxed);
    }

    /// Nothing is at work any more.
    fn end(&self) {
        self.patient.store(0, Ordering::Relaxed);
        self.refining.store(0, Ordering::Relaxed);
    }
}

/// What to evaluate. Only the newest order counts.
struct Order {
    network: Network,
    request: Request,
    ray: Option<Ray>,
    number: u64,
    in_a_hurry: bool,
    /// Whether its first results are there and are to be refined.
    refines: bool,
    /// Processors to run although nothing that the network knows of changed, and why.
    refresh: Vec<(String, String)>,
}

/// A picture to make besides what the window shows.
struct Shot {
    network: Network,
    canvas: String,
    size: [u32; 2],
    answer: Sender<Result<Picture, String>>,
}

/// What the thread is told.
enum Task {
    Evaluate(Box<Order>),
    Shoot(Box<Shot>),
    Stop,
}

/// What the thread says.
enum News {
    /// It made a picture that is not for the window.
    Shot,
    Running(String),
    Progress(String, Progress),
    Results(Box<Results>),
}

/// What has been computed.
#[derive(Default)]
pub struct Results {
    /// The order that these results belong to; grows with every evaluation.
    pub number: u64,
    /// What was asked for.
    pub request: Request,
    /// What ran in the last evaluation, what failed, what is not ready and why.
    pub report: Report,
    /// The report of the last evaluation in which anything ran.
    pub frame: Report,
    /// The last run of every processor that ever ran.
    pub runs: BTreeMap<String, Run>,
    /// What is on the outports.
    pub outputs: BTreeMap<Address, Data>,
    /// What arrives at the canvases.
    pub canvases: BTreeMap<String, Arc<Image>>,
    /// The last good shader of every ray traversal.
    pub shaders: BTreeMap<String, Arc<Validated>>,
    /// The ray that was asked for, in the picture as it is now.
    pub trace: Option<Arc<Result<Trace, ProcessError>>>,
}

impl Results {
    /// What stays from the results before: the report about work, while nothing has to be done, and where something failed the
    /// last good picture on the canvases; the failure is told beside it.
    fn keep(&mut self, previous: Results) {
        self.frame = if self.report.runs.is_empty() { previous.frame } else { self.report.clone() };
        if self.report.failed.is_empty() {
            return;
        }
        for (id, image) in previous.canvases {
            if self.report.not_ready.contains_key(&id) {
                self.canvases.entry(id).or_insert(image);
            }
        }
    }
}

/// The evaluation thread as the window sees it.
pub struct Engine {
    tasks: Sender<Task>,
    news: Receiver<News>,
    thread: Option<JoinHandle<()>>,
    /// Number of the last order.
    ordered: u64,
    hurry: Arc<Hurry>,
    /// What the next order is to run in any case.
    refresh: Vec<(String, String)>,
    last: Option<(u64, Request, Option<Ray>)>,
    /// When it was asked for something while it had nothing to do.
    began: Instant,
    /// Results of orders before this one are about another document.
    first: u64,
    /// A ray to follow behind every evaluation; asked for anew in every frame.
    pub ray: Option<Ray>,
    /// The latest results.
    pub results: Results,
    /// The processor that is at work.
    pub running: Option<String>,
    /// How far slow processors are.
    pub progress: BTreeMap<String, Progress>,
}

impl Engine {
    /// Starts the thread on a device, with processors that there are besides those of the program. `wake` is called from it
    /// whenever there is news.
    ///
    /// # Errors
    /// The device cannot be used.
    pub fn start(
        gpu: Gpu,
        more: Vec<Arc<dyn Process>>,
        wake: impl Fn() + Send + Clone + 'static,
    ) -> Result<Self, GpuError> {
        let mut runner = Runner::with(gpu, more)?;
        runner.measure(true);
        let (tasks, inbox) = channel();
        let (outbox, news) = channel();
        let (progress_outbox, progress_wake) = (outbox.clone(), wake.clone());
        runner.context.progress = Some(Box::new(move |id, progress| {
            // The window may be gone; then nobody needs to know.
            let _ = progress_outbox.send(News::Progress(id.to_owned(), progress));
            progress_wake();
        }));
        let hurry = Arc::new(Hurry::default());
        let interrupting = hurry.clone();
        runner.context.interrupt = Some(Box::new(move || interrupting.interrupts()));
        let telling = Telling { runner, news: outbox, hurry: hurry.clone() };
        let thread = std::thread::spawn(move || work(telling, &inbox, &wake));
        Ok(Self {
            tasks,
            news,
            thread: Some(thread),
            ordered: 0,
            hurry,
            refresh: Vec::new(),
            last: None,
            began: Instant::now(),
            first: 0,
            ray: None,
            results: Results::default(),
            running: None,
            progress: BTreeMap::new(),
        })
    }

    /// Has processors run at the next order, for a reason that the network does not know.
    pub fn refresh(&mut self, processors: Vec<String>, reason: &str) {
        self.refresh.extend(processors.into_iter().map(|id| (id, reason.to_owned())));
        self.look_again();
    }

    /// Has the next order evaluated although it may be what was asked for last.
    pub fn look_again(&mut self) {
        self.last = None;
    }

    /// Asks for an evaluation unless it is what was asked for last. `revision` tells states of the network apart. An order in a
    /// hurry ends the evaluation of one that is not.
    pub fn order(&mut self, revision: u64, network: &Network, request: Request, in_a_hurry: bool) {
        let same = |(last, wanted, ray): &(u64, Request, Option<Ray>)| {
            *last == revision && *wanted == request && *ray == self.ray
        };
        if self.last.as_ref().is_some_and(same) {
            return;
        }
        if !self.is_busy() {
            self.began = Instant::now();
        }
        self.ordered += 1;
        let ray = self.ray.clone();
        let order = Order {
            network: network.clone(),
            request: request.clone(),
            ray: ray.clone(),
            number: self.ordered,
            in_a_hurry,
            refines: false,
            refresh: std::mem::take(&mut self.refresh),
        };
        self.last = Some((revision, request, ray));
        self.hurry.last.store(self.ordered, Ordering::Relaxed);
        if in_a_hurry {
            self.hurry.newest.store(self.ordered, Ordering::Relaxed);
        }
        // A thread that ended says so by its silence: `is_busy` stays true and the status line shows it.
        let _ = self.tasks.send(Task::Evaluate(Box::new(order)));
    }

    /// Makes pictures of other sizes than the window's.
    pub fn photographer(&self) -> Photographer {
        Photographer(self.tasks.clone())
    }

    /// Takes in what has been computed since the last call; whether there is anything new.
    pub fn listen(&mut self) -> bool {
        let mut heard = false;
        while let Ok(news) = self.news.try_recv() {
            heard = true;
            match news {
                News::Running(id) => self.running = Some(id),
                News::Progress(id, progress) => {
                    self.progress.insert(id, progress);
                }
                News::Shot => {
                    self.progress.clear();
                    self.running = None;
                }
                News::Results(results) => {
                    self.progress.clear();
                    self.running = None;
                    if results.number < self.first {
                        continue;
                    }
                    let previous = std::mem::replace(&mut self.results, *results);
                    self.results.keep(previous);
                }
            }
        }
        heard
    }

    /// Forgets what was computed, for another document.
    pub fn forget(&mut self) {
        self.first = self.ordered + 1;
        self.results = Results { number: self.results.number, ..Results::default() };
        self.look_again();
    }

    /// For how long something has been computed; zero when nothing is.
    pub fn busy_for(&self) -> Duration {
        if self.is_busy() { self.began.elapsed() } else { Duration::ZERO }
    }

    /// Whether something is still to be computed.
    pub fn is_busy(&self) -> bool {
        self.results.number < self.ordered || !self.results.report.unfinished.is_empty()
    }

    /// What is being refined, and how far that is, while nothing newer was ordered.
    pub fn refining(&self) -> Option<(&str, &Unfinished)> {
        let (id, unfinished) = self.results.report.unfinished.iter().next()?;
        (self.results.number == self.ordered).then_some((id, unfinished))
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        // Whatever is at work need not be finished.
        self.hurry.newest.store(u64::MAX, Ordering::Relaxed);
        self.hurry.last.store(u64::MAX, Ordering::Relaxed);
        // A thread that has ended needs not to be told.
        let _ = self.tasks.send(Task::Stop);
        if let Some(thread) = self.thread.take() {
            // A panic of the thread was printed when it happened.
            let _ = thread.join();
        }
    }
}

/// Runs processors and tells which.
struct Telling {
    runner: Runner,
    news: Sender<News>,
    hurry: Arc<Hurry>,
}

impl Backend for Telling {
    type Data = Data;

    fn facts(&self, data: &Data) -> Facts {
        self.runner.facts(data)
    }

    fn interrupted(&self) -> bool {
        self.runner.interrupted()
    }

    fn process(&mut self, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
        // No frame for its own sake: short runs need not be seen.
        let _ = self.news.send(News::Running(job.id.to_owned()));
        self.runner.process(job)
    }
}

/// Makes pictures of other sizes than the window's, on the evaluation's thread.
#[derive(Clone)]
pub struct Photographer(Sender<Task>);

impl Photographer {
    /// What a canvas of a network shows at a size in pixels: exactly what the command line renders. Waits for it, so it is not
    /// for the window's thread.
    ///
    /// # Errors
    /// Why there is no picture, for the user to read.
    pub fn picture(&self, network: Network, canvas: &str, size: [u32; 2]) -> Result<Picture, String> {
        let (answer, picture) = channel();
        let shot = Shot { network, canvas: canvas.to_owned(), size, answer };
        let gone = || "the evaluation has ended; restart the program".to_owned();
        self.0.send(Task::Shoot(Box::new(shot))).map_err(|_| gone())?;
        picture.recv().unwrap_or_else(|_| Err(gone()))
    }
}

fn work(mut backend: Telling, tasks: &Receiver<Task>, wake: &impl Fn()) {
    let mut evaluator = Evaluator::new();
    let mut snippets = snippet_revision();
    let mut waiting = VecDeque::new();
    loop {
        match waiting.pop_front().map_or_else(|| tasks.recv(), Ok) {
            Err(_) | Ok(Task::Stop) => return,
            Ok(Task::Shoot(shot)) => {
                let picture = shoot(&shot, &mut evaluator, &mut backend);
                // Whoever asked may be gone, and so may the window.
                let _ = shot.answer.send(picture);
                let _ = backend.news.send(News::Shot);
            }
            Ok(Task::Evaluate(mut order)) => {
                // A burst of edits is one evaluation: of the newest.
                while let Ok(task) = tasks.try_recv() {
                    match task {
                        Task::Evaluate(mut newer) => {
                            newer.refresh.append(&mut order.refresh);
                            order = newer;
                        }
                        other => waiting.push_back(other),
                    }
                }
                backend.hurry.begin(&order);
                let results = Box::new(evaluate(&mut order, &mut snippets, &mut evaluator, &mut backend));
                backend.hurry.end();
                let interrupted = results.report.interrupted;
                order.refines = !results.report.unfinished.is_empty();
                // What interrupted it is the next order.
                if !interrupted && backend.news.send(News::Results(results)).is_err() {
                    return;
                }
                waiting.extend(tasks.try_iter());
                // Whoever orders something newer waits for that.
                let replaced = waiting.iter().any(|task| matches!(task, Task::Evaluate(_) | Task::Stop));
                if order.refines && !interrupted && !replaced {
                    waiting.push_back(Task::Evaluate(order));
                }
            }
        }
        wake();
    }
}

/// The ray traversals of a network.
fn traversals(network: &Network) -> impl Iterator<Item = &str> {
    network.processors().filter(|processor| processor.type_id() == types::RAY_TRAVERSAL).map(|processor| processor.id())
}

fn shaders(network: &Network, runner: &mut Runner) -> BTreeMap<String, Arc<Validated>> {
    traversals(network).filter_map(|id| Some((id.to_owned(), runner.shader(id)?))).collect()
}

/// Follows a ray of the picture that a traversal has on any of its outports.
fn follow(runner: &mut Runner, outputs: &BTreeMap<Address, Data>, ray: &Ray) -> Result<Trace, ProcessError> {
    let own = outputs.iter().filter(|(outport, _)| outport.processor == ray.processor);
    let size = own.into_iter().find_map(|(_, data)| match data {
        Data::Image(image) => Some(image.size()),
        _ => None,
    });
    let absent = || ProcessError::new(format!("`{}` has no picture at the moment, so no rays", ray.processor));
    let outside = || ProcessError::new("the probed ray lies outside of the picture now; pick another");
    runner.trace(&ray.processor, ray.pixel(size.ok_or_else(absent)?).ok_or_else(outside)?)
}

fn evaluate(
    order: &mut Order,
    snippets: &mut u64,
    evaluator: &mut Evaluator<Telling>,
    backend: &mut Telling,
) -> Results {
    for (id, reason) in order.refresh.drain(..) {
        evaluator.invalidate(&id, Level::Result, reason);
    }
    let newest = snippet_revision();
    if std::mem::replace(snippets, newest) != newest {
        for id in traversals(&order.network) {
            evaluator.invalidate(id, Level::Shader, "your snippets were read anew");
        }
    }
    let report = evaluator.evaluate(&order.network, backend, &order.request);
    backend.runner.tidy(|id| order.network.processor(id).is_some());
    let mut results = collect(order, report, evaluator);
    results.shaders = shaders(&order.network, &mut backend.runner);
    results.trace = order.ray.as_ref().map(|ray| Arc::new(follow(&mut backend.runner, &results.outputs, ray)));
    results
}

/// Evaluates one canvas at a size of its own and fetches its image.
fn shoot(shot: &Shot, evaluator: &mut Evaluator<Telling>, backend: &mut Telling) -> Result<Picture, String> {
    let Shot { network, canvas, size, .. } = shot;
    let sinks = Sinks::Only(vec![canvas.clone()]);
    let report = evaluator.finish(network, backend, &Request { sinks, size: Some(*size), ..Request::default() });
    match evaluator.inputs(network, canvas, "image").next() {
        Some(Data::Image(image)) => image.read_back(&backend.runner.context).map_err(|error| error.to_string()),
        _ => {
            let failed = report.failed.iter().map(|(id, error)| format!("{id} failed: {error}"));
            let causes: Vec<String> = failed.chain(report.not_ready.values().flatten().cloned()).collect();
            Err(if causes.is_empty() { format!("`{canvas}` shows nothing") } else { causes.join("\n") })
        }
    }
}

fn collect(order: &Order, report: Report, evaluator: &Evaluator<Telling>) -> Results {
    let (number, request) = (order.number, order.request.clone());
    let mut results = Results { number, request, report, ..Results::default() };
    for processor in order.network.processors() {
        let id = processor.id();
        results.runs.extend(evaluator.last_run(id).map(|run| (id.to_owned(), run.clone())));
        let Some(declaration) = processor.declaration() else { continue };
        for outport in &declaration.outports {
            let data = evaluator.output(id, &outport.id);
            results.outputs.extend(data.map(|data| ((id, outport.id.as_str()).into(), data.clone())));
        }
        if declaration.sink
            && let Some(Data::Image(image)) = evaluator.inputs(&order.network, id, "image").next()
        {
            results.canvases.insert(id.to_owned(), image.clone());
        }
    }
    results
}

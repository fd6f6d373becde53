//! What a processor does, and the backend that lets it.

use std::collections::BTreeMap;
use std::sync::Arc;

use rayloom_gpu::{Gpu, GpuError};
use rayloom_network::{
    Backend, Declaration, Evaluator, Facts, Job, Network, Outputs, ProcessError, ProcessorType, Report, Request,
};

use crate::{Context, Data, processors};

/// A processor type together with its work.
pub trait Process: ProcessorType {
    /// Computes the wanted outputs. Device errors that nobody catches inside come out as the processor's error.
    fn process(&self, context: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError>;
}

/// What a processor does that is nothing but a function of context and job.
pub type Work = fn(&mut Context, &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError>;

/// A processor type made of a declaration and a function.
pub struct PlainProcess {
    declaration: Declaration,
    work: Work,
}

impl PlainProcess {
    /// A processor type that is declared so and does this.
    pub fn shared(declaration: Declaration, work: Work) -> Arc<dyn Process> {
        Arc::new(Self { declaration, work })
    }
}

impl ProcessorType for PlainProcess {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }
}

impl Process for PlainProcess {
    fn process(&self, context: &mut Context, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
        (self.work)(context, job)
    }
}

/// Free render targets of up to this many bytes are kept for the next evaluation.
const KEPT_TARGETS: u64 = 256 << 20;

/// Runs processors on one device: the network's backend.
pub struct Runner {
    /// The device and its caches.
    pub context: Context,
    processes: BTreeMap<String, Arc<dyn Process>>,
}

impl Runner {
    /// A runner for all processors of this crate.
    pub fn new(gpu: Gpu) -> Result<Self, GpuError> {
        Self::with(gpu, Vec::new())
    }

    /// A runner for all processors of this crate and some more.
    pub fn with(gpu: Gpu, more: Vec<Arc<dyn Process>>) -> Result<Self, GpuError> {
        let processes = processors().into_iter().chain(more).map(|process| (process.declaration().id.clone(), process));
        let processes = processes.collect();
        Ok(Self { context: Context::new(gpu)?, processes })
    }

    /// Evaluates a network to the end, again and on a new device if the device is lost meanwhile or was before. What had been computed is
    /// computed again then, for it was on the old device; a note on the first run says so.
    ///
    /// # Errors
    /// No new device can be opened.
    pub fn evaluate(
        &mut self,
        evaluator: &mut Evaluator<Self>,
        network: &Network,
        request: &Request,
    ) -> Result<Report, GpuError> {
        let mut is_new = self.replace_lost(evaluator)?;
        let mut report = evaluator.finish(network, self, request);
        if self.replace_lost(evaluator)? {
            is_new = true;
            report = evaluator.finish(network, self, request);
        }
        if let Some(first) = report.runs.first_mut().filter(|_| is_new) {
            first.notes.push("the graphics device was lost; everything was computed again on a new one".to_owned());
        }
        Ok(report)
    }

    /// Opens a new device if the one in use is lost, and forgets what was on the old one; whether it was.
    fn replace_lost(&mut self, evaluator: &mut Evaluator<Self>) -> Result<bool, GpuError> {
        if !self.context.gpu.is_lost() {
            return Ok(false);
        }
        self.context.renew(self.context.gpu.reopen()?)?;
        evaluator.clear();
        Ok(true)
    }

    /// Switches measuring GPU time on or off; off at first, because reading the clock waits for the device.
    pub fn measure(&mut self, enabled: bool) {
        self.context.timer.set_enabled(enabled);
    }

    /// Switches counting of rays and samples on or off; off at first. They come as statistics of the ray traversals.
    pub fn count_samples(&mut self, enabled: bool) {
        self.context.count_samples = enabled;
    }

    /// Switches explaining on or off; off at first. What runs then do and save themselves is read with
    /// [`crate::Explanation::of`].
    pub fn explain(&mut self, enabled: bool) {
        self.context.ledger.enable(enabled);
    }

    /// Frees what is left of processors that are gone, and render targets beyond what the next evaluation may want.
    /// To be called after an evaluation or an edit.
    pub fn tidy(&mut self, exists: impl Fn(&str) -> bool) {
        self.context.forget_others(exists);
        self.context.pool.trim(KEPT_TARGETS);
    }
}

impl Backend for Runner {
    type Data = Data;

    fn facts(&self, data: &Data) -> Facts {
        data.facts()
    }

    fn interrupted(&self) -> bool {
        self.context.interrupted()
    }

    fn process(&mut self, job: &Job<'_, Data>) -> Result<Outputs<Data>, ProcessError> {
        let id = &job.processor_type.declaration().id;
        let process = self.processes.get(id).cloned().ok_or_else(|| {
            ProcessError::new(format!(
                "this program cannot run processors of the type `{id}`; use a newer version of it"
            ))
        })?;
        let context = &mut self.context;
        context.ledger.begin();
        let gpu = context.gpu.clone();
        let result = gpu.guarded(job.id, || process.process(context, job));
        let mut outputs = match result {
            Ok(Ok(outputs)) => outputs,
            Ok(Err(error)) => return self.failed(error),
            Err(error) => return self.failed(error.into()),
        };
        self.context.ledger.finish(job, &mut outputs);
        let measured = self.context.timer.finish(&gpu)?;
        outputs.gpu_time = outputs.gpu_time.or(measured);
        Ok(outputs)
    }
}

impl Runner {
    fn failed<T>(&self, error: ProcessError) -> Result<T, ProcessError> {
        // Some of the passes were perhaps never submitted.
        self.context.timer.discard();
        Err(error)
    }
}

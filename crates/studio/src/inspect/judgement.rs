//! How good a picture is, told without a reference while nothing moves.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use rayloom_gpu::Gpu;
use rayloom_measure::{Estimate, MeasureError, Refiner};
use rayloom_network::{Address, Network};
use rayloom_processors::{Data, Image};

use crate::session::Session;

/// How long a picture must have stood still.
const STILLNESS: Duration = Duration::from_millis(500);

/// What is known about a picture of a ray traversal.
#[derive(Clone, Copy, Debug)]
pub struct Judgement {
    /// Its error, by Richardson's estimate from pictures with half and twice the sampling rate.
    pub estimate: Estimate,
    /// Share of the samples taken that changed the picture, 0 to 1.
    pub contributing: f64,
}

/// A judgement and the picture that it is about.
type About = (Arc<Image>, Result<Judgement, MeasureError>);

/// Judges pictures in the background.
#[derive(Default)]
pub(super) struct Judge {
    refiner: Arc<Mutex<Option<Refiner>>>,
    judgements: super::latest::Latest<Address, Image, About>,
    /// The picture in sight and since when.
    still: Option<(Arc<Image>, Instant)>,
}

impl Judge {
    /// How long the picture has stood still.
    fn stillness(&mut self, image: &Arc<Image>) -> Duration {
        match &self.still {
            Some((known, since)) if Arc::ptr_eq(known, image) => since.elapsed(),
            _ => {
                self.still = Some((image.clone(), Instant::now()));
                Duration::ZERO
            }
        }
    }

    pub(super) fn end_frame(&mut self) {
        self.judgements.end_frame();
    }
}

impl Session {
    /// How good the picture on an outport of a ray traversal is; `None` while it changes and until that has been found out.
    /// Costs about as much as three and a half pictures, once for every picture that stands still.
    pub fn judgement(&mut self, context: &egui::Context, outport: &Address) -> Option<Result<Judgement, String>> {
        let Some(Data::Image(image)) = self.engine.results.outputs.get(outport).cloned() else { return None };
        let still = self.inspection.judge.stillness(&image);
        if self.interacting || self.engine.is_busy() || still < STILLNESS {
            context.request_repaint_after(STILLNESS);
            return None;
        }
        let (gpu, network) = (self.display.gpu().clone(), self.network().clone());
        let feeding = network.inputs(&outport.processor).map(|connection| connection.from.clone());
        let outputs = &self.engine.results.outputs;
        let inputs = feeding.filter_map(|from| Some((from.clone(), outputs.get(&from)?.clone()))).collect();
        let (refiner, of) = (self.inspection.judge.refiner.clone(), outport.clone());
        let answer = move |image: Arc<Image>| {
            let judgement = judge(&refiner, gpu, &network, &inputs, &of);
            (image, judgement)
        };
        let found = self.inspection.judge.judgements.get(outport, &image, context, answer)?;
        let (about, judgement) = &*found;
        Arc::ptr_eq(about, &image).then(|| judgement.as_ref().copied().map_err(ToString::to_string))
    }
}

fn judge(
    refiner: &Mutex<Option<Refiner>>,
    gpu: Gpu,
    network: &Network,
    inputs: &BTreeMap<Address, Data>,
    outport: &Address,
) -> Result<Judgement, MeasureError> {
    let mut refiner = refiner.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let refiner = match &mut *refiner {
        Some(refiner) => refiner,
        none => none.insert(Refiner::new(gpu)?),
    };
    let mut picture = |factor| refiner.picture(network, |port| inputs.get(port), outport, factor);
    let (coarser, _) = picture(0.5)?;
    let (own, counts) = picture(1.0)?;
    let (finer, _) = picture(2.0)?;
    let estimate = Estimate::of(Some(&coarser[..]), &own, &finer)?.of_coarser();
    Ok(Judgement { estimate, contributing: counts.contributing as f64 / counts.samples.max(1) as f64 })
}

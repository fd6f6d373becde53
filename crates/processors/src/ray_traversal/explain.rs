//! Why the ray loop is as it is: told from the plan and the shader that ran.

use rayloom_network::{ProcessError, Properties};
use rayloom_wgsl::{Library, Slot};

use super::choose::Plan;
use super::dispatch::Pass;
use crate::explain::{Explanation, Role};

/// What a global variable of the shader is for.
pub(super) fn purpose(name: &str) -> &'static str {
    match name {
        "frame" => "what all rays share: matrices, step, light",
        "params" => "numbers of the snippets; changing one assembles nothing",
        "volume" => "what is sampled",
        "linear_sampler" => "the sampling snippet leaves interpolation to the texture unit",
        "entry_points" | "exit_points" => "where rays begin and end",
        "transfer_table" => "classification looks values up: emission and extinction a reference length",
        "transfer_table_2d" => "classification looks values and gradient magnitudes up",
        "preintegrated_table" => "classification looks up pairs of values",
        "label_volume" | "label_table" => "classification goes by labels",
        "skip_map" => "tells empty bricks",
        "gap_map" => "tells voxels without a value, which are not drawn",
        "counters" => "samples are counted",
        "sample_map" => "the samples of every ray are wanted",
        _ => "the picture and its depth",
    }
}

impl Pass<'_> {
    fn has(&self, feature: &str) -> bool {
        self.shader.assembled.features.has(feature)
    }

    /// What the shader computes and leaves out, and why.
    pub(super) fn explanations(&self) -> Result<Vec<Explanation>, ProcessError> {
        let [width, height] = self.inputs.view.size;
        let lines = self.shader.assembled.text.lines().count();
        let loop_of = format!("ray loop of {lines} lines for {width} x {height} rays");
        let mut found = vec![Explanation::new(Role::Computed, loop_of, "one pass, assembled from the snippets in use")];
        for slot in [Slot::Sampling, Slot::Classification, Slot::Gradient, Slot::Shading, Slot::Refinement] {
            found.push(self.slot(slot));
        }
        found.push(self.skipping());
        found.extend(self.termination());
        found.extend(self.faint_sums());
        found.extend(self.cuts());
        found.extend(self.pre_integration()?);
        let switches = [
            ("jitter", "jitter of the samples", "switched off"),
            ("gaps", "map of voxels without a value", "every voxel has one"),
            ("statistics", "counting of samples", "nobody asked for it"),
        ];
        let off = switches.into_iter().filter(|(feature, ..)| !self.has(feature));
        found.extend(off.map(|(_, what, why)| Explanation::new(Role::LeftOut, what, why)));
        Ok(found)
    }

    /// A slot that is filled at most once.
    fn slot(&self, slot: Slot) -> Explanation {
        let chosen = match self.plan.choice.snippets.get(&slot) {
            Some(path) if path.starts_with("edited/") => "text of your own",
            Some(path) => Library::id(path),
            None => "none",
        };
        if self.has(&format!("slot_{slot}")) {
            let why = match slot {
                Slot::Gradient => self.readers_of_the_gradient(),
                Slot::Shading if self.has("search") => {
                    "chosen; visible samples are searched first and shaded together".into()
                }
                _ => "chosen".into(),
            };
            return Explanation::new(Role::Computed, format!("{slot} `{chosen}`"), why);
        }
        let why = match slot {
            _ if chosen == "none" => "`none` is chosen",
            Slot::Gradient => "neither shading, classification nor compositing reads it",
            Slot::Refinement => "the compositing looks for no surface",
            Slot::Classification => "the compositing looks at values only",
            _ => "the compositing has nothing to light",
        };
        Explanation::new(Role::LeftOut, slot.to_string(), why)
    }

    fn readers_of_the_gradient(&self) -> String {
        let readers = [
            ("shaded_gradient", "shading reads it"),
            ("classified_gradient", "classification reads it"),
            ("loop_gradient", "it is needed at every sample"),
        ];
        let readers: Vec<&str> = readers.into_iter().filter(|(f, _)| self.has(f)).map(|(_, why)| why).collect();
        if readers.is_empty() { "compositing reads it".into() } else { readers.join("; ") }
    }

    fn skipping(&self) -> Explanation {
        let Plan { choice, skipping_why, .. } = self.plan;
        match choice.snippets.get(&Slot::Skipping).filter(|_| self.has("skipping")) {
            Some(path) => {
                Explanation::new(Role::Computed, format!("skipping `{}`", Library::id(path)), skipping_why.clone())
            }
            None => Explanation::new(Role::LeftOut, "skipping structure", skipping_why.clone()),
        }
    }

    /// Sums of faint samples, where a compositing snippet keeps them.
    fn faint_sums(&self) -> Option<Explanation> {
        let Plan { library, choice, .. } = self.plan;
        let keeps = |path| library.source(path).is_some_and(|source| source.text.contains("#if long_rays"));
        choice.outputs.iter().flatten().any(|path| keeps(path)).then(|| match self.has("long_rays") {
            true => Explanation::new(Role::Computed, "sums of faint samples", "rays may take more than 8192 samples"),
            false => Explanation::new(Role::LeftOut, "sums of faint samples", "no ray takes more than 8192 samples"),
        })
    }

    /// How steps of the transfer function are met.
    fn cuts(&self) -> Option<Explanation> {
        let what = "cuts of the transfer function's table";
        self.has("transfer_function").then(|| match self.has("steps") {
            true => Explanation::new(
                Role::Computed,
                what,
                "the function has steps or steep ramps, which its entries would blunt",
            ),
            false => Explanation::new(Role::LeftOut, what, "the function has no steps and no steep ramps"),
        })
    }

    fn termination(&self) -> Vec<Explanation> {
        match (self.has("stop"), self.plan.choice.early_termination) {
            (true, true) => vec![Explanation::new(
                Role::Computed,
                "early termination",
                "rays stop where the rest is below the allowed error, or nothing more is looked for",
            )],
            (true, false) => vec![],
            (false, true) => {
                vec![Explanation::new(Role::LeftOut, "early termination", "the compositing needs the whole ray")]
            }
            (false, false) => {
                vec![Explanation::new(Role::LeftOut, "early termination", "the allowed error is 0: whole rays")]
            }
        }
    }

    /// Why there is no pre-integrated table where the transfer function is looked up sample by sample.
    fn pre_integration(&self) -> Result<Option<Explanation>, ProcessError> {
        if !self.has("transfer_function") {
            return Ok(None);
        }
        let why = match steps(self.job.properties)? {
            0 => {
                "samples are classified one by one: the transfer function has no step, so midpoints err less".to_owned()
            }
            _ => "samples are classified one by one, though the transfer function has a step, which `preintegrated_full` \
                  would meet exactly"
                .to_owned(),
        };
        Ok(Some(Explanation::new(Role::LeftOut, "pre-integrated table", why)))
    }
}

/// How often the transfer function jumps.
fn steps(properties: &Properties) -> Result<usize, ProcessError> {
    let knots = &properties.transfer_function("transfer_function")?.knots;
    let split = knots.iter().filter(|knot| knot.right.is_some()).count();
    Ok(split + knots.windows(2).filter(|pair| pair[0].at == pair[1].at).count())
}

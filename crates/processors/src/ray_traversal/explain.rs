//! Why the ray loop is as it is: told from the plan and the shader that ran.

use rayloom_network::{ProcessError, Properties};
use rayloom_wgsl::{Slot, SourceKind};

use super::choose::Plan;
use super::dispatch::Pass;
use crate::explain::{Explanation, Role};

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
        let chosen = match self.plan.choice.snippet(slot) {
            Some(snippet) if snippet.kind() == SourceKind::Edited => "text of your own",
            Some(snippet) => snippet.id(),
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
        match choice.snippet(Slot::Skipping).filter(|_| self.has("skipping")) {
            Some(snippet) => {
                Explanation::new(Role::Computed, format!("skipping `{}`", snippet.id()), skipping_why.clone())
            }
            None => Explanation::new(Role::LeftOut, "skipping structure", skipping_why.clone()),
        }
    }

    /// Sums of faint samples, where a compositing snippet keeps them.
    fn faint_sums(&self) -> Option<Explanation> {
        let mut outputs = self.plan.choice.outputs.iter().flatten();
        outputs.any(|output| output.text().contains("#if long_rays")).then(|| match self.has("long_rays") {
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

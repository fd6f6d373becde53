//! The knobs that tuning turns.

use std::collections::BTreeMap;

use rayloom_network::{Address, Network, Value};
use serde_json::{Value as Json, json};

use crate::run::setting::{Assignment, Setting, plain};
use crate::subject::chain::Chain;

/// Samples per voxel, rung by rung: two rungs are a factor of two. Fewer than one sample in two voxels may miss what some views
/// show and others do not, so that the error of one view says nothing about that of another.
pub(super) const RATES: [f64; 23] = [
    0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0, 96.0, 128.0, 192.0, 256.0, 384.0,
    512.0, 768.0, 1024.0,
];
/// The rung of one sample a voxel.
pub(super) const ONE: usize = 2;
/// Rungs that a surface is given beyond the one that met the target. A ray misses a surface whose inside it crosses between two
/// samples: near the outline of a ball of radius R, those are a share of `d^2 / 4 R^2` of its pixels with a step of `d`, and
/// thin sheets lose a share of `d`. Views of a few hundred pixels cannot tell 0.1 % from 1 % of them, and a miss is as wrong
/// as a pixel can be. Twice the samples leave half to a quarter of the misses.
const BEYOND_SURFACES: usize = 2;
/// Share of the allowed error that early termination may cause.
const TERMINATION_SHARE: f64 = 0.25;

/// Values for all knobs.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Candidate {
    /// Index into [`RATES`].
    pub rung: usize,
    /// Whether it has twice the samples that met the target, for the sake of surfaces.
    pub secured: bool,
    values: BTreeMap<Address, Json>,
}

/// The knobs of a network.
pub(super) struct Knobs<'a> {
    network: &'a Network,
    chain: &'a Chain,
}

impl<'a> Knobs<'a> {
    pub fn new(network: &'a Network, chain: &'a Chain) -> Self {
        Self { network, chain }
    }

    /// Where every search begins: one sample a voxel, an error of early termination that leaves room for others, and storage
    /// that loses nothing. What the network shows is left as it is.
    pub fn start(&self, max_error: f64) -> Candidate {
        let traversal = |property| Some(Address::new(self.chain.traversal(), property));
        let linear = matches!(self.text("sampling").as_str(), "filtered" | "trilinear") && self.free("sampling");
        let surface = self.text(&self.compositing()).starts_with("isosurface") && self.free("refinement");
        let values = [
            (traversal("termination_error"), json!(round_down(TERMINATION_SHARE * max_error).min(0.5))),
            (traversal("jitter"), json!(false)),
            (traversal("target"), json!("32-bit")),
            (traversal("sampling").filter(|_| linear), json!("filtered")),
            (traversal("refinement").filter(|_| surface), json!("secant")),
            (traversal("skipping").filter(|_| self.free("skipping")), json!("auto")),
            (Some(Address::new(&self.chain.view, "format")), json!("32-bit")),
            (self.source("precision"), json!("auto")),
        ];
        let values = values.into_iter().filter_map(|(address, value)| Some((address?, value))).collect();
        self.at(&Candidate { rung: ONE, secured: false, values }, ONE)
    }

    /// The lowest rung worth a look: a surface may hide between samples farther apart than voxels.
    pub fn lowest(&self) -> usize {
        if self.shows_surfaces() { ONE } else { 0 }
    }

    /// What a candidate that met the target needs so that views never seen can be trusted to meet it, too.
    pub fn secured(&self, candidate: &Candidate, rungs: usize) -> Candidate {
        match self.shows_surfaces() {
            true => {
                let rung = (candidate.rung + BEYOND_SURFACES).min(rungs - 1).max(candidate.rung);
                Candidate { secured: rung == candidate.rung + BEYOND_SURFACES, ..self.at(candidate, rung) }
            }
            false => candidate.clone(),
        }
    }

    /// Whether a ray ends, or changes at once, where it meets a surface.
    pub fn shows_surfaces(&self) -> bool {
        let compositing = self.text(&self.compositing());
        compositing.starts_with("isosurface") || compositing.starts_with("first_hit")
    }

    /// What the network has for the values of a candidate.
    pub fn saved(&self, candidate: &Candidate) -> Candidate {
        let value = |(address, value): (&Address, &Json)| (address.clone(), self.own(address).unwrap_or(value.clone()));
        Candidate { rung: candidate.rung, secured: false, values: candidate.values.iter().map(value).collect() }
    }

    fn own(&self, address: &Address) -> Option<Json> {
        Some(self.network.value(&address.processor, &address.item)?.to_json())
    }

    /// The candidate with another sampling rate.
    pub fn at(&self, candidate: &Candidate, rung: usize) -> Candidate {
        let mut values = candidate.values.clone();
        values.insert(Address::new(self.chain.traversal(), "sampling_rate"), json!(RATES[rung]));
        Candidate { rung, secured: false, values }
    }

    /// The candidate with each integrator that the network may have.
    pub fn integrators(&self, candidate: &Candidate) -> Vec<Candidate> {
        const INTEGRATORS: [&str; 3] = ["transfer_function", "preintegrated_full", "preintegrated_fast"];
        let compositing = self.text(&self.compositing());
        // What has no thickness, or takes single values from the ray, has nothing to integrate.
        let projects = ["mip", "minip", "mean", "sum", "isosurface", "isosurfaces"].contains(&compositing.as_str())
            || compositing.starts_with("first_hit");
        if projects || !self.free("classification") || !INTEGRATORS.contains(&self.text("classification").as_str()) {
            return vec![candidate.clone()];
        }
        INTEGRATORS.map(|id| self.with(candidate, "classification", id)).to_vec()
    }

    /// The candidate with weights of interpolation in floats, where the device's sampler may be what limits it.
    pub fn finer(&self, candidate: &Candidate) -> Option<Candidate> {
        let finer = self.with(candidate, "sampling", "trilinear");
        candidate.values.contains_key(&Address::new(self.chain.traversal(), "sampling")).then_some(finer)
    }

    /// Values that may make any candidate cheaper.
    pub fn savings(&self) -> Vec<(Address, Json)> {
        let traversal = |property, value| (Address::new(self.chain.traversal(), property), json!(value));
        let skipping = ["none", "distance"].map(|id| traversal("skipping", id)).into_iter();
        let skipping = skipping.filter(|_| self.free("skipping"));
        let precision = self.source("precision").map(|precision| (precision, json!("16-bit")));
        skipping.chain([traversal("target", "16-bit")]).chain(precision).collect()
    }

    /// The candidate with one value changed.
    pub fn changed(&self, candidate: &Candidate, (address, value): (Address, Json)) -> Candidate {
        let mut candidate = candidate.clone();
        candidate.values.insert(address, value);
        candidate
    }

    /// The candidate as a setting, named by what differs from the network as saved.
    pub fn setting(&self, candidate: &Candidate) -> Setting {
        let differs = |(address, value): &(&Address, &Json)| {
            self.own(address)
                .is_none_or(|own| own != **value && own.as_f64().is_none_or(|own| value.as_f64() != Some(own)))
        };
        let part = |(address, value): (&Address, &Json)| format!("{} {}", address.item, plain(value));
        let name = candidate.values.iter().filter(differs).map(part).collect::<Vec<_>>().join(", ");
        let assignment =
            |(property, value): (&Address, &Json)| Assignment { property: property.clone(), value: value.clone() };
        Setting {
            name: if name.is_empty() { "as saved".into() } else { name },
            assignments: candidate.values.iter().map(assignment).collect(),
        }
    }

    fn with(&self, candidate: &Candidate, property: &str, value: &str) -> Candidate {
        self.changed(candidate, (Address::new(self.chain.traversal(), property), json!(value)))
    }

    fn source(&self, property: &str) -> Option<Address> {
        Some(Address::new(self.chain.source.as_deref()?, property))
    }

    fn compositing(&self) -> String {
        self.chain.image.item.replacen("image", "compositing", 1)
    }

    fn text(&self, property: &str) -> String {
        match self.network.value(self.chain.traversal(), property) {
            Some(Value::Text(text)) => text,
            _ => String::new(),
        }
    }

    /// Whether a slot holds no text of the user's own.
    fn free(&self, slot: &str) -> bool {
        self.text(&format!("{slot}.text")).trim().is_empty()
    }
}

/// To one significant digit, so that presets read well.
fn round_down(x: f64) -> f64 {
    let exponent = x.max(1e-12).log10().floor();
    let digit = (x / 10f64.powf(exponent)).floor().clamp(1.0, 9.0);
    // By way of text: a product of powers of ten would be a little off.
    format!("{digit}e{exponent}").parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_rungs_are_a_factor_of_two() {
        assert_eq!(RATES[ONE], 1.0);
        assert!(RATES.windows(3).all(|rates| rates[2] == 2.0 * rates[0]));
        assert_eq!([0.00098, 0.25, 0.005].map(round_down), [0.0009, 0.2, 0.005]);
    }
}

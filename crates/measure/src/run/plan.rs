//! What to measure.

use rayloom_network::{Address, Network};

use crate::run::ladder::{LADDERS, ladder};
use crate::run::setting::{Setting, combinations, count};
use crate::subject::chain::Chain;
use crate::{MeasureError, Standard, Vary};

/// Settings that one measurement may have.
pub const MOST_SETTINGS: usize = 256;

/// Told what is being done and which share of it is finished, 0 to 1; from any thread.
pub type Listener<'a> = &'a (dyn Fn(&str, f64) + Sync);

/// Listens to nothing.
pub fn silent(_: &str, _: f64) {}

/// What to measure, and how.
#[derive(Debug, Clone)]
pub struct Plan {
    /// Where the network comes from, for the report.
    pub origin: String,
    /// The image to measure; the only ray traversal's if not given.
    pub port: Option<Address>,
    /// Properties varied against each other, in every combination.
    pub vary: Vec<Vary>,
    /// Names of [`LADDERS`], or `all`, varied one at a time. All of them if nothing is to be varied.
    pub ladders: Vec<String>,
    /// Number of camera views, at least one.
    pub views: usize,
    /// Number of timings of every setting and view, at least one.
    pub rounds: usize,
    /// Width and height of the pictures in pixels.
    pub size: [u32; 2],
    /// What pictures are compared with; the exact picture where the reference can draw it, else the finest, if not given.
    pub standard: Option<Standard>,
    /// Whether to split the error into its causes.
    pub budget: bool,
}

impl Plan {
    /// The settings to measure, the network as saved first.
    pub(crate) fn settings(&self, network: &Network, chain: &Chain) -> Result<Vec<Setting>, MeasureError> {
        let mut settings = vec![Setting::saved()];
        if !self.vary.is_empty() {
            check_count(count(&self.vary))?;
            let combinations = combinations(&self.vary);
            check_values(network, &combinations)?;
            settings.extend(combinations);
        }
        let all = || LADDERS.iter().map(|ladder| ladder.name.to_owned()).collect::<Vec<_>>();
        let names = match self.ladders.is_empty() && self.vary.is_empty() {
            true => all(),
            false => {
                self.ladders.iter().flat_map(|name| if name == "all" { all() } else { vec![name.clone()] }).collect()
            }
        };
        for name in names {
            let found = LADDERS.iter().find(|ladder| ladder.name == name).ok_or_else(|| unknown(&name))?;
            settings.extend(ladder(found, network, chain));
        }
        check_count(settings.len())?;
        Ok(settings)
    }
}

fn unknown(name: &str) -> MeasureError {
    let known: Vec<&str> = LADDERS.iter().map(|ladder| ladder.name).collect();
    MeasureError::Plan(format!("There is no ladder `{name}`: choose all or one of {}.", known.join(", ")))
}

/// A value that the network takes in no combination is a mistake, and better told before an hour of measuring than behind it.
fn check_values(network: &Network, combinations: &[Setting]) -> Result<(), MeasureError> {
    let (mut accepted, mut refused) = (Vec::new(), Vec::new());
    for setting in combinations {
        match setting.applied(network) {
            Ok(_) => accepted.extend(&setting.assignments),
            Err(error) => refused.push((setting, error)),
        }
    }
    let hopeless = |setting: &Setting| setting.assignments.iter().any(|one| !accepted.contains(&one));
    match refused.into_iter().find(|(setting, _)| hopeless(setting)) {
        Some((_, error)) => Err(error.into()),
        None => Ok(()),
    }
}

fn check_count(found: usize) -> Result<(), MeasureError> {
    match found > MOST_SETTINGS {
        true => Err(MeasureError::Plan(format!(
            "These are {found} settings, and a measurement takes at most {MOST_SETTINGS}: vary fewer properties, or give fewer \
             values."
        ))),
        false => Ok(()),
    }
}

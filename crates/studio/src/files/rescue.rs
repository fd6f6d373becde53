//! Keeps the copy of this program's changes, and offers those of programs that ended without saving theirs.

use std::path::Path;
use std::task::Poll;
use std::time::Duration;

use egui::{Context, Ui};

use super::bar;
use super::recovery::{Abandoned, Recovery};
use crate::later::Later;
use crate::session::{Session, Severity};

/// What was found, and what is wrong with the rest.
type Found = (Vec<Abandoned>, Vec<String>);

/// The copy of this program, and those of others that it found when it started.
#[derive(Default)]
pub(super) struct Rescue {
    recovery: Option<Recovery>,
    finding: Option<Later<Found>>,
    offers: Vec<Abandoned>,
}

impl Rescue {
    /// Looks for abandoned copies in a folder, and takes a place for the own one there.
    ///
    /// # Errors
    /// The folder cannot be written to; then there is no recovery, which the user should know.
    pub fn start(folder: &Path, context: &Context) -> Result<Self, String> {
        let recovery = Recovery::start(folder)
            .map_err(|error| format!("{}: changes cannot be kept safe here: {error}", folder.display()))?;
        let folder = folder.to_owned();
        let finding = Later::start(context, move || Abandoned::find(&folder));
        Ok(Self { recovery: Some(recovery), finding: Some(finding), offers: Vec::new() })
    }

    /// To be called every frame.
    pub fn follow(&mut self, session: &mut Session) {
        if let Some(finding) = &self.finding
            && let Poll::Ready(found) = finding.poll()
        {
            self.finding = None;
            let (offers, problems) = found.unwrap_or_default();
            self.offers = offers;
            problems.into_iter().for_each(|problem| session.tell(Severity::Error, problem));
        }
        if let Some(recovery) = &mut self.recovery {
            recovery.follow(&session.document);
            if let Some(problem) = recovery.problem() {
                session.tell(Severity::Error, format!("changes that are not saved are not safe: {problem}"));
            }
        }
    }

    /// Offers the newest copy, if any; whether the user wants it.
    pub fn show(&mut self, ui: &mut Ui) -> bool {
        let Some(offer) = self.offers.first() else { return false };
        match bar::show(ui, "recovery", &sentence(offer), &["Recover", "Discard"]) {
            Some(0) => return true,
            Some(_) => self.offers.remove(0).discard(),
            None => {}
        }
        false
    }

    /// Shows the newest copy as the document.
    pub fn recover(&mut self, session: &mut Session) {
        if self.offers.is_empty() {
            return;
        }
        let offer = self.offers.remove(0);
        match offer.document(&session.registry) {
            Ok(document) => {
                session.show(document, &[]);
                session.tell(Severity::Note, "recovered; save to keep it");
                if let Some(recovery) = &mut self.recovery {
                    recovery.take_over(offer);
                }
            }
            Err(error) => session.tell(Severity::Error, format!("the copy cannot be recovered: {error}")),
        }
    }

    /// The user does not want the changes.
    pub fn forget(&mut self) {
        if let Some(recovery) = &mut self.recovery {
            recovery.forget();
        }
    }
}

fn sentence(offer: &Abandoned) -> String {
    let name = offer.original().and_then(Path::file_name).map(|name| name.to_string_lossy().into_owned());
    let name = name.unwrap_or_else(|| "a network without a file".into());
    format!("Rayloom ended with unsaved changes of {name}, {}.", ago(offer.age()))
}

/// A duration as people say it.
fn ago(age: Duration) -> String {
    let seconds = age.as_secs();
    let (count, unit) = match seconds {
        0..60 => return "just now".into(),
        60..3_600 => (seconds / 60, "minute"),
        3_600..86_400 => (seconds / 3_600, "hour"),
        _ => (seconds / 86_400, "day"),
    };
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {unit}{plural} ago")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ages_are_told_in_the_largest_unit() {
        let told = [5, 60, 7_199, 7_200, 200_000].map(|seconds| ago(Duration::from_secs(seconds)));
        assert_eq!(told, ["just now", "1 minute ago", "1 hour ago", "2 hours ago", "2 days ago"]);
    }
}

//! Progress on a terminal; nothing anywhere else.

use std::io::{IsTerminal, stderr};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use rayloom_processors::ProgressListener;
use rayloom_volume::Progress;

/// A line on the terminal that says what is going on; it vanishes at the end.
pub struct Line(Option<ProgressBar>);

impl Line {
    /// A line with this message, if the standard error is a terminal.
    pub fn new(message: &str) -> Self {
        let bar = stderr().is_terminal().then(|| {
            let bar = ProgressBar::new_spinner().with_message(message.to_owned());
            bar.enable_steady_tick(Duration::from_millis(100));
            bar
        });
        Self(bar)
    }

    /// Shows how far reading the volume of a file has come.
    pub fn reading(&self, file: &str, progress: Progress) {
        if let Some(bar) = &self.0 {
            show(bar, file, progress);
        }
    }

    /// Shows what is being done, and which share of it, 0 to 1, is finished. May be told from any thread.
    pub fn share(&self, what: &str, share: f64) {
        const PARTS: f64 = 1000.0;
        if let Some(bar) = &self.0 {
            if bar.length().is_none()
                && let Ok(style) = ProgressStyle::with_template("{spinner} [{bar:30}] {percent:>3} % {msg}")
            {
                bar.set_style(style);
            }
            bar.set_length(PARTS as u64);
            bar.set_position((PARTS * share) as u64);
            bar.set_message(what.to_owned());
        }
    }

    /// What a runner tells the progress of its processors to.
    pub fn listener(&self) -> Option<ProgressListener> {
        let bar = self.0.clone()?;
        Some(Box::new(move |processor, progress| show(&bar, processor, progress)))
    }
}

impl Drop for Line {
    fn drop(&mut self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}

fn show(bar: &ProgressBar, who: &str, Progress { done, total }: Progress) {
    bar.set_message(format!("reading {who}"));
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} [{bar:30}] {bytes} of {total_bytes}") {
        bar.set_style(style);
    }
    bar.set_length(total);
    bar.set_position(done);
    if done >= total {
        bar.set_style(ProgressStyle::default_spinner());
        bar.set_message("rendering");
    }
}

//! Progress bars, and stopping when asked to.

use std::sync::OnceLock;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::output;
use crate::error::{Error, Result};

/// When Ctrl-C was first pressed.
static INTERRUPTED: OnceLock<Instant> = OnceLock::new();

/// How long whoever presses Ctrl-C again and again is asked to wait.
const IMPATIENCE: Duration = Duration::from_secs(2);

/// From now on Ctrl-C lets the current step end and its temporary files vanish. Another one, seconds later, ends the process at once.
pub(super) fn listen_for_interrupts() {
    // Only fails if a handler is set already, and this runs once.
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTED.get_or_init(Instant::now).elapsed() > IMPATIENCE {
            output::say("error: interrupted at once; hidden temporary files may be left beside the outputs");
            std::process::exit(130);
        }
    });
}

/// Whether Ctrl-C was pressed, as an error.
pub(super) fn check_interrupt() -> Result<()> {
    if INTERRUPTED.get().is_some() { Err(Error::Interrupted) } else { Ok(()) }
}

/// A bar that shows how far a long run is and how much time is left. Hidden when quiet or when stderr is no terminal.
#[derive(Debug)]
pub(super) struct Bar {
    bar: ProgressBar,
    /// What is done before the current step, in the bar's units.
    base: u64,
}

impl Bar {
    /// `total` in samples a pixel, or any unit that grows with time.
    pub(super) fn new(total: u64, quiet: bool) -> Self {
        let bar = ProgressBar::with_draw_target(
            Some(total),
            if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr_with_hz(5) },
        );
        let template = "{msg:32!} {bar:24} {percent:>3}%  {elapsed} elapsed, {eta} left";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.enable_steady_tick(Duration::from_millis(500));
        Self { bar, base: 0 }
    }

    pub(super) fn say(&self, message: String) {
        self.bar.set_message(message);
    }

    /// The current step is over; it was worth so much.
    pub(super) fn advance(&mut self, amount: u64) {
        self.base += amount;
        self.bar.set_position(self.base);
    }

    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// For the verbs that draw.
#[cfg(feature = "workbench")]
impl Bar {
    /// Prints a line that stays, above the bar.
    pub(super) fn aside(&self, line: &str) {
        self.bar.suspend(|| output::say(line));
    }

    /// So much of the current step is done.
    pub(super) fn reach(&self, done: u64) {
        self.bar.set_position(self.base + done);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.finish();
    }
}

//! Time and memory of other processes.

use std::io;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use super::pictures::Pair;

/// Seconds of a run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Times {
    pub(crate) wall_s: f64,
    /// Of all its threads; NaN where the system does not tell.
    pub(crate) user_s: f64,
}

/// Runs it and says how long it took, and whether it ended well.
pub(crate) fn run(command: &mut Command) -> io::Result<(Times, bool)> {
    let (user, start) = (children_user_s(), Instant::now());
    let status = quiet(command).status()?;
    Ok((Times { wall_s: start.elapsed().as_secs_f64(), user_s: children_user_s() - user }, status.success()))
}

fn quiet(command: &mut Command) -> &mut Command {
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null())
}

/// Runs it once more under GNU time, and answers the most memory it had in bytes; none without GNU time.
///
/// A process inherits the peak of the one that starts it, and that of this bench is large: time's own is a MiB. Its seconds are
/// hundredths, too coarse, so times come from [`run`].
pub(crate) fn peak_bytes(command: &Command, scratch: &Path) -> io::Result<Option<u64>> {
    let file = scratch.join("peak");
    let mut time = Command::new("/usr/bin/time");
    time.args(["-f", "%M", "-o"]).arg(&file).arg(command.get_program()).args(command.get_args());
    if quiet(&mut time).status().is_err() {
        return Ok(None);
    }
    // A line about the exit code may stand before it.
    let text = std::fs::read_to_string(file)?;
    Ok(text.lines().last().and_then(|line| line.parse::<u64>().ok()).map(|kib| kib << 10))
}

/// Seconds until all pairs are done, as many at once as there are cores.
pub(crate) fn seconds_of_all(pairs: &[Pair], command: impl Fn(&Pair) -> Command + Sync) -> io::Result<f64> {
    let (start, next) = (Instant::now(), AtomicUsize::new(0));
    let work = || -> io::Result<()> {
        while let Some(pair) = pairs.get(next.fetch_add(1, Ordering::Relaxed)) {
            quiet(&mut command(pair)).status()?;
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..std::thread::available_parallelism()?.get()).map(|_| scope.spawn(work)).collect();
        threads.into_iter().try_for_each(|thread| thread.join().expect("no panic"))
    })?;
    Ok(start.elapsed().as_secs_f64())
}

/// Seconds that children which have ended spent in user mode; one at a time runs, so a difference is one child's.
#[cfg(unix)]
fn children_user_s() -> f64 {
    user_s(nix::sys::resource::UsageWho::RUSAGE_CHILDREN)
}

/// Seconds that this process spent in user mode.
#[cfg(unix)]
pub(crate) fn own_user_s() -> f64 {
    user_s(nix::sys::resource::UsageWho::RUSAGE_SELF)
}

#[cfg(unix)]
fn user_s(who: nix::sys::resource::UsageWho) -> f64 {
    let time = nix::sys::resource::getrusage(who).expect("a process may ask").user_time();
    time.tv_sec() as f64 + 1e-6 * time.tv_usec() as f64
}

#[cfg(not(unix))]
fn children_user_s() -> f64 {
    f64::NAN
}

#[cfg(not(unix))]
pub(crate) fn own_user_s() -> f64 {
    f64::NAN
}

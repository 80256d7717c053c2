//! What a point set is asked for: how many points, where, how densely.

use std::fmt;

use super::Density;

/// Where the points lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Domain {
    /// The unit square.
    #[default]
    Square,
    /// The disk that touches its sides: radius 1/2 about (1/2, 1/2).
    Disk,
}

/// What a set is asked for. `Request::new(n, seed)` is the unit square, uniform; the rest is set by name.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    /// Number of points, 1 to [`super::MAX_SET_POINTS`].
    pub n: u32,
    /// Chooses one of the sets of a pattern that uses chance.
    pub seed: u32,
    /// Where the points lie.
    pub domain: Domain,
    /// How densely they lie where, over the unit square; `None` is uniform.
    pub density: Option<&'a Density>,
    /// Is told the share that is done of what takes long.
    pub progress: Progress<'a>,
}

impl Request<'_> {
    /// `n` points spread uniformly over the unit square.
    #[must_use]
    pub fn new(n: u32, seed: u32) -> Self {
        Self { n, seed, domain: Domain::Square, density: None, progress: Progress::default() }
    }
}

/// Hears the share of the work that is done, 0 to 1, now and then; or nobody does.
#[derive(Clone, Copy, Default)]
pub struct Progress<'a>(Option<&'a (dyn Fn(f64) + Sync)>);

impl<'a> Progress<'a> {
    /// Calls `listener` on the thread that generates.
    #[must_use]
    pub fn new(listener: &'a (dyn Fn(f64) + Sync)) -> Self {
        Self(Some(listener))
    }

    pub(super) fn tell(&self, share: f64) {
        if let Some(listener) = self.0 {
            listener(share);
        }
    }
}

impl fmt::Debug for Progress<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "Progress(heard)" } else { "Progress(unheard)" })
    }
}

//! Bars that a scene file sets for the figures of its sequence.

use serde::Deserialize;

use super::place::Place;
use crate::error::Result;

macro_rules! thresholds {
    ($($(#[$doc:meta])* $name:ident: $range:expr,)+) => {
        /// Bars for a method's figures on a sequence of the scene, from the file's `[thresholds]`; what each is held against is
        /// in [`crate::bench::sequence`].
        #[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
        #[serde(deny_unknown_fields, expecting = "a table")]
        pub struct Thresholds {
            $($(#[$doc])* pub $name: Option<f64>,)+
        }

        impl Thresholds {
            /// These, and where there is none, another's.
            #[must_use]
            pub fn or(self, other: Self) -> Self {
                Self { $($name: self.$name.or(other.$name),)+ }
            }

            /// Every bar must be one that a figure can meet and miss.
            pub(super) fn check(&self, at: &Place<'_>) -> Result<()> {
                $(if let Some(bar) = self.$name {
                    at.key(stringify!($name)).within(bar, $range)?;
                })+
                Ok(())
            }
        }
    };
}

thresholds! {
    /// Least PSNR over all frames, in dB.
    min_psnr: 0.0..=200.0,
    /// Least PSNR of the worst frame, in dB.
    min_worst_psnr: 0.0..=200.0,
    /// Least PSNR of differences between frames, in dB.
    min_tpsnr: 0.0..=200.0,
    /// Largest mean FLIP over all frames.
    max_flip: 0.0..=1.0,
    /// Largest flicker beyond the reference's, either way, at any gap, in display values.
    max_flicker: 0.0..=1.0,
    /// Largest share that is left of a thing where it was 4 to 8 frames ago.
    max_ghost: 0.0..=10.0,
    /// For how many frames a ghost may be seen.
    max_trail: 0.0..=8.0,
    /// Least share of the reference's thin lines.
    min_continuity: 0.0..=1.0,
    /// Largest difference of the energy from the reference's, as a share of it.
    max_energy_error: 0.0..=1e6,
    /// Largest crawl of a still picture, mean, in display values.
    max_crawl: 0.0..=1.0,
    /// Most frames until a still picture is within half a dB of what it settles at.
    max_convergence: 1.0..=1e6,
    /// Most frames until nine tenths of a change of the light are seen.
    max_response: 1.0..=1e6,
    /// Largest RMS error of where straight edges are, in pixels.
    max_edge_error: 0.0..=1e3,
}

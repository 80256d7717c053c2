//! What draws: a device where the whole workbench is there, nothing where it is not.

#[cfg(feature = "workbench")]
pub(super) use with_gpu::{AnyDrawer, DrawOptions};
#[cfg(not(feature = "workbench"))]
pub(super) use without_gpu::{AnyDrawer, DrawOptions};

#[cfg(feature = "workbench")]
mod with_gpu {
    use clap::Args;

    use super::super::check_interrupt;
    use crate::bench::Darkroom;
    use crate::check::{Drawer, Entry, Manifest};
    use crate::error::{Error, Result};
    use crate::gpu::{AdapterChoice, Gpu};
    use crate::suite::Stamp;

    #[derive(Debug, Args)]
    pub(in super::super) struct DrawOptions {
        /// auto (discrete GPU, integrated, then software), software, or part of an adapter's name
        #[arg(long, value_name = "WHICH", default_value = "auto", env = "DEJAG_ADAPTER")]
        adapter: AdapterChoice,
    }

    /// A device, and what draws on it.
    #[derive(Debug)]
    pub(in super::super) struct AnyDrawer(Darkroom);

    impl DrawOptions {
        /// Nothing if nothing of what is selected is drawn; otherwise everything of one's own makes sense. All shards of a run open a
        /// device or none does, so that they agree on the environment.
        pub(in super::super) fn open(&self, manifest: &Manifest, selected: &[&Entry]) -> Result<Option<AnyDrawer>> {
            if selected.iter().all(|entry| entry.drawing().is_none()) {
                return Ok(None);
            }
            let mut darkroom = Darkroom::new(Gpu::open(&self.adapter)?, &manifest.root, check_interrupt)?;
            for entry in selected.iter().filter(|entry| entry.drawing().is_some()) {
                darkroom.source(&entry.subject).map_err(|error| match error {
                    Error::Request(why) => Error::Request(format!("{}: {why}", entry.id)),
                    other => other,
                })?;
            }
            Ok(Some(AnyDrawer(darkroom)))
        }

        pub(in super::super) fn words(&self) -> Vec<String> {
            vec!["--adapter".into(), self.adapter.to_string()]
        }
    }

    impl AnyDrawer {
        pub(in super::super) fn stamp(&self) -> Stamp {
            self.0.stamp()
        }

        pub(in super::super) fn as_dyn(&mut self) -> &mut dyn Drawer {
            &mut self.0
        }
    }
}

#[cfg(not(feature = "workbench"))]
mod without_gpu {
    use clap::Args;

    use crate::check::{Drawer, Entry, Manifest};
    use crate::error::{Error, Result};
    use crate::suite::Stamp;

    #[derive(Debug, Args)]
    pub(in super::super) struct DrawOptions {}

    /// There is none.
    #[derive(Debug)]
    pub(in super::super) enum AnyDrawer {}

    impl DrawOptions {
        /// Refuses what is to be drawn.
        pub(in super::super) fn open(&self, _: &Manifest, selected: &[&Entry]) -> Result<Option<AnyDrawer>> {
            match selected.iter().find(|entry| entry.drawing().is_some()) {
                None => Ok(None),
                Some(entry) => Err(Error::Request(format!(
                    "{} is to be drawn, and this build has no GPU stack; build with the default features, or name the cases that are files",
                    entry.id
                ))),
            }
        }

        pub(in super::super) fn words(&self) -> Vec<String> {
            Vec::new()
        }
    }

    impl AnyDrawer {
        pub(in super::super) fn stamp(&self) -> Stamp {
            match *self {}
        }

        pub(in super::super) fn as_dyn(&mut self) -> &mut dyn Drawer {
            match *self {}
        }
    }
}

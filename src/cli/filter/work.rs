//! Pictures on their way: several are decoded and encoded on all cores while one is on the GPU.
//!
//! This thread feeds the GPU and lets pictures in, in order, as long as those under way are few and small enough; so a folder of
//! any size needs bounded memory. Each picture is computed by itself: how many are under way changes no bits.

use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::mpsc::{self, Receiver, Sender};

use super::super::watch::check_interrupt;
use super::filters::Filters;
use super::plan::Job;
use crate::error::{Error, Result};
use crate::picture::{FileKind, PictureFile, measure};

/// Pixels under way, at some 50 bytes each: a larger picture goes alone.
const MAX_PIXELS_UNDER_WAY: u64 = 24 << 20;

/// What became of a picture.
#[derive(Debug)]
pub(super) struct Done {
    pub(super) size: [u32; 2],
    /// What the output's format could not keep.
    pub(super) losses: Vec<String>,
}

/// Called once for each picture, in the order they are finished.
pub(super) type Finished<'f> = &'f mut dyn FnMut(usize, Result<Done>);

pub(super) struct Work<'a> {
    pub(super) jobs: &'a [Job],
    pub(super) quality: u8,
}

/// A picture under way.
#[derive(Debug, Clone, Copy)]
struct Ticket {
    index: usize,
    pixels: u64,
}

enum Event {
    Read(Ticket, Result<PictureFile>),
    Written(Ticket, Result<Done>),
}

/// How much is under way.
#[derive(Debug, Default)]
struct Load {
    pictures: usize,
    pixels: u64,
}

impl Load {
    fn has_room(&self, ticket: Ticket) -> bool {
        let few = self.pictures < 2 * rayon::current_num_threads();
        self.pictures == 0 || few && self.pixels + ticket.pixels <= MAX_PIXELS_UNDER_WAY
    }
}

impl Work<'_> {
    /// Ends early only if interrupted or if the device is lost; whatever else fails is one picture's matter.
    pub(super) fn run(&self, filters: &mut Filters<'_>, finished: Finished<'_>) -> Result<()> {
        let (sender, events) = mpsc::channel();
        rayon::in_place_scope(|scope| self.drive(scope, &sender, &events, filters, finished))
    }

    fn drive<'s>(
        &'s self,
        scope: &rayon::Scope<'s>,
        sender: &Sender<Event>,
        events: &Receiver<Event>,
        filters: &mut Filters<'_>,
        finished: Finished<'_>,
    ) -> Result<()> {
        let mut load = Load::default();
        let mut waiting: VecDeque<usize> = (0..self.jobs.len()).collect();
        let mut next = None;
        loop {
            while let Some(ticket) = next.take().or_else(|| self.ticket(&mut waiting, finished)) {
                check_interrupt()?;
                if !load.has_room(ticket) {
                    next = Some(ticket);
                    break;
                }
                load.pictures += 1;
                load.pixels += ticket.pixels;
                self.read(scope, ticket, sender.clone());
            }
            if load.pictures == 0 {
                return Ok(());
            }
            // The sender is still here, so there will be an event for each picture under way.
            let Ok(event) = events.recv() else { return Ok(()) };
            check_interrupt()?;
            let (ticket, outcome) = match event {
                Event::Written(ticket, outcome) => (ticket, outcome),
                Event::Read(ticket, file) => match file.and_then(|file| filters.apply(file, self.jobs[ticket.index].kind)) {
                    Ok(file) => {
                        self.write(scope, ticket, file, sender.clone());
                        continue;
                    }
                    Err(lost @ Error::Gpu { kind: "device lost", .. }) => return Err(lost),
                    Err(error) => (ticket, Err(error)),
                },
            };
            load.pictures -= 1;
            load.pixels -= ticket.pixels;
            finished(ticket.index, outcome);
        }
    }

    /// The next picture whose header can be read.
    fn ticket(&self, waiting: &mut VecDeque<usize>, finished: Finished<'_>) -> Option<Ticket> {
        while let Some(index) = waiting.pop_front() {
            match guarded(&self.jobs[index].input, || measure(&self.jobs[index].input)) {
                Ok([width, height]) => return Some(Ticket { index, pixels: u64::from(width) * u64::from(height) }),
                Err(error) => finished(index, Err(error)),
            }
        }
        None
    }

    fn read<'s>(&'s self, scope: &rayon::Scope<'s>, ticket: Ticket, sender: Sender<Event>) {
        let job = &self.jobs[ticket.index];
        scope.spawn(move |_| {
            let file = check_interrupt().and_then(|()| guarded(&job.input, || prepare(job)));
            // Nobody listens only if the run has ended early.
            let _ = sender.send(Event::Read(ticket, file));
        });
    }

    fn write<'s>(&'s self, scope: &rayon::Scope<'s>, ticket: Ticket, file: PictureFile, sender: Sender<Event>) {
        let job = &self.jobs[ticket.index];
        scope.spawn(move |_| {
            let done = check_interrupt().and_then(|()| guarded(&job.output, || self.save(file, job)));
            let _ = sender.send(Event::Written(ticket, done));
        });
    }

    fn save(&self, file: PictureFile, job: &Job) -> Result<Done> {
        let losses = file.carried.losses(job.kind);
        let file = file.encoded_for(job.kind);
        if let Some(folder) = job.output.parent() {
            std::fs::create_dir_all(folder).map_err(Error::io("create the folder", folder))?;
        }
        file.save(&job.output, job.kind, self.quality)?;
        Ok(Done { size: file.picture.size(), losses })
    }
}

/// Linear light is filtered as it is only where it is written as it is: elsewhere what will be seen is.
fn prepare(job: &Job) -> Result<PictureFile> {
    let file = PictureFile::read(&job.input)?;
    Ok(if job.kind == FileKind::Exr { file } else { file.encoded_for(job.kind) })
}

/// A decoder that breaks down on one file must not take the others with it, nor leave this thread waiting.
fn guarded<T>(path: &Path, work: impl FnOnce() -> Result<T>) -> Result<T> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        let message = "the code for its format broke down, which is a bug: please report it with the file".into();
        Err(Error::Format { path: path.to_path_buf(), expected: "picture", message })
    })
}

//! What is said of each picture, in the order of the inputs whatever the order they are finished in, and the words at the end.

use super::super::watch::Bar;
use super::plan::Plan;
use super::work::Done;
use crate::error::{Error, Result};
use crate::methods::Spec;

pub(super) struct Tally<'a> {
    plan: &'a Plan,
    bar: &'a mut Bar,
    verbose: bool,
    outcomes: Vec<Option<Result<Done>>>,
    /// Those before this one have been told.
    told: usize,
    losses: Vec<Loss>,
    written: usize,
    last: Option<Done>,
    first_error: Option<Error>,
}

/// The same words of several pictures are said once.
struct Loss {
    what: String,
    first: usize,
    pictures: usize,
}

/// How it ended.
pub(super) struct Ended {
    /// For whoever did not ask for quiet.
    pub(super) words: Vec<String>,
    /// Whether a picture or a folder could not be done.
    pub(super) failed: bool,
}

impl<'a> Tally<'a> {
    pub(super) fn new(plan: &'a Plan, bar: &'a mut Bar, verbose: bool) -> Self {
        for failure in &plan.failures {
            bar.aside(&format!("error: {failure}"));
        }
        let outcomes = plan.jobs.iter().map(|_| None).collect();
        Self { plan, bar, verbose, outcomes, told: 0, losses: Vec::new(), written: 0, last: None, first_error: None }
    }

    pub(super) fn add(&mut self, index: usize, outcome: Result<Done>) {
        self.outcomes[index] = Some(outcome);
        self.bar.advance(1);
        while let Some(outcome) = self.outcomes.get_mut(self.told).and_then(Option::take) {
            self.tell(self.told, outcome);
            self.told += 1;
        }
    }

    fn tell(&mut self, index: usize, outcome: Result<Done>) {
        match outcome {
            Ok(done) => {
                if self.verbose {
                    let ([width, height], job) = (done.size, &self.plan.jobs[index]);
                    self.bar.aside(&format!("{}: {width}x{height}", job.output.display()));
                }
                done.losses.iter().for_each(|what| self.lose(what, index));
                self.written += 1;
                self.last = Some(done);
            }
            // A single picture's error is the command's.
            Err(error) if self.plan.folder.is_none() => self.first_error = Some(error),
            Err(error) => self.bar.aside(&format!("error: {error}")),
        }
    }

    fn lose(&mut self, what: &str, index: usize) {
        match self.losses.iter_mut().find(|loss| loss.what == what) {
            Some(loss) => loss.pictures += 1,
            None => self.losses.push(Loss { what: what.to_owned(), first: index, pictures: 1 }),
        }
    }

    /// # Errors
    /// The one of a picture that was asked for alone.
    pub(super) fn end(self, spec: &Spec) -> Result<Ended> {
        if let Some(error) = self.first_error {
            return Err(error);
        }
        let mut words: Vec<String> = self.losses.iter().map(|loss| self.words_of(loss)).collect();
        words.push(self.summary(spec));
        let failed = self.written < self.plan.jobs.len() || !self.plan.failures.is_empty();
        Ok(Ended { words, failed })
    }

    fn words_of(&self, loss: &Loss) -> String {
        let (first, what) = (self.plan.jobs[loss.first].output.display(), &loss.what);
        match loss.pictures {
            1 => format!("warning: {first}: {what}"),
            n => format!("warning: {first} and {} more: {what}", n - 1),
        }
    }

    fn summary(&self, spec: &Spec) -> String {
        if let (None, Some(done), [job]) = (&self.plan.folder, &self.last, &self.plan.jobs[..]) {
            let ([width, height], input, output) = (done.size, job.input.display(), job.output.display());
            return format!("{output}: {input} with {spec}, {width}x{height}");
        }
        let folder = self.plan.folder.as_deref().unwrap_or_else(|| "".as_ref()).display();
        let (all, written) = (self.plan.jobs.len(), self.written);
        let pictures = if all == 1 { "picture" } else { "pictures" };
        let mut words = match all - written {
            0 => format!("{folder}: {all} {pictures} with {spec}"),
            failed => format!("{folder}: {written} of {all} {pictures} with {spec}, {failed} failed"),
        };
        match self.plan.skipped {
            0 => {}
            1 => words.push_str("; 1 other file skipped"),
            n => words.push_str(&format!("; {n} other files skipped")),
        }
        words
    }
}

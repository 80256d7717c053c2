//! Short names of methods, unique within a report.

use super::words::{printable, shorten};
use crate::suite::Results;
use std::collections::BTreeMap;

/// Longest label in characters.
const LONGEST: usize = 32;

/// A method's specification to its label.
#[derive(Debug)]
pub(super) struct Labels(BTreeMap<String, String>);

impl Labels {
    /// Labels for all methods of a run: the specification itself where it is short, else without the options that it shares
    /// with all others of its name, else with its middle left out, and numbered where that is not unique.
    pub(super) fn of(results: &Results) -> Self {
        let specs = distinct(results);
        let mut labels: BTreeMap<String, String> = BTreeMap::new();
        for spec in &specs {
            let short = shorten(&printable(&candidate(spec, &specs)), LONGEST);
            let taken = |label: &String| labels.values().any(|other| other == label);
            let numbered = (2..).map(|n| format!("{} #{n}", shorten(&short, LONGEST - 4)));
            let label = std::iter::once(short.clone()).chain(numbered).find(|label| !taken(label));
            labels.insert(spec.clone(), label.unwrap_or(short));
        }
        Self(labels)
    }

    /// The label of a method.
    pub(super) fn get(&self, spec: &str) -> String {
        self.0.get(spec).cloned().unwrap_or_else(|| shorten(&printable(spec), LONGEST))
    }
}

/// Every specification once, in the order of first use.
pub(super) fn distinct(results: &Results) -> Vec<String> {
    let mut specs: Vec<String> = Vec::new();
    for method in results.scenes.iter().flat_map(|scene| &scene.methods) {
        if !specs.contains(&method.spec) {
            specs.push(method.spec.clone());
        }
    }
    specs
}

fn candidate(spec: &str, all: &[String]) -> String {
    if spec.chars().count() <= LONGEST {
        return spec.into();
    }
    let (name, options) = parts(spec);
    let family: Vec<Vec<&str>> =
        all.iter().map(|other| parts(other)).filter(|other| other.0 == name).map(|other| other.1).collect();
    let telling: Vec<&str> = options.into_iter().filter(|option| !family.iter().all(|other| other.contains(option))).collect();
    if telling.is_empty() { name.into() } else { format!("{name}:{}", telling.join(",")) }
}

/// Name and options of a method. A combination `a+b` keeps its second part among the options of the first.
fn parts(spec: &str) -> (&str, Vec<&str>) {
    let (name, options) = spec.split_once(':').unwrap_or((spec, ""));
    (name, options.split(',').filter(|option| !option.is_empty()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    fn labels(specs: &[&str]) -> Vec<String> {
        let mut results = sample::results(specs.len());
        for (method, spec) in results.scenes[0].methods.iter_mut().zip(specs) {
            method.spec = (*spec).into();
        }
        results.scenes.truncate(1);
        let labels = Labels::of(&results);
        specs.iter().map(|spec| labels.get(spec)).collect()
    }

    #[test]
    fn short_specifications_stay_and_long_ones_keep_what_tells_them_apart() {
        let found = labels(&[
            "none",
            "msaa:samples=4",
            "ssaa:spp=16,pattern=rotated-grid,filter=box",
            "ssaa:spp=64,pattern=rotated-grid,filter=box",
        ]);
        assert_eq!(found, ["none", "msaa:samples=4", "ssaa:spp=16", "ssaa:spp=64"]);
    }

    #[test]
    fn labels_are_short_and_unique() {
        let long = |end: &str| format!("method:{}{end}{}", "a=1,".repeat(10), ",z=9".repeat(10));
        let specs = [long("m"), long("n"), long("o")];
        let found = labels(&specs.each_ref().map(String::as_str));
        for (i, label) in found.iter().enumerate() {
            assert!(label.chars().count() <= LONGEST, "{label}");
            assert!(!found[..i].contains(label), "{found:?}");
        }
    }
}

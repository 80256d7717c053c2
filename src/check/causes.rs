//! What may explain a difference that nobody made.

use crate::suite::{Environment, Golden};

/// Ways in which what made the golden is not what made the candidate, in words.
pub(super) fn likely_causes(golden: &Golden, key: &str, environment: &Environment) -> Vec<String> {
    let mut causes = Vec::new();
    if golden.environment != key {
        causes.push(format!("{key} has no golden of its own; that of {} stands in", golden.environment));
    }
    let said = |name: &str| golden.provenance.get(name).map(String::as_str);
    if let Some(drawn_by) = said("environment").filter(|drawn_by| *drawn_by != key && key != super::ANY) {
        causes.push(format!("another driver: the golden was drawn by {drawn_by}, this picture by {key}"));
    }
    if let Some(platform) = said("platform").filter(|platform| *platform != environment.platform) {
        causes.push(format!("another platform: the golden is from {platform}, this picture from {}", environment.platform));
    }
    let version = concat!("dejag ", env!("CARGO_PKG_VERSION"));
    if let Some(software) = said("Software").filter(|software| software.starts_with("dejag ") && *software != version) {
        causes.push(format!("another version: the golden was made by {software}, this picture by {version}"));
    }
    causes
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    #[test]
    fn another_driver_is_named_and_the_same_is_not() {
        let words = |environment: &str| {
            let pairs = [("environment", environment), ("platform", "linux-x86_64"), ("Software", "dejag 0.0.1")];
            pairs.map(|(key, value)| (key.to_owned(), value.to_owned())).into_iter().collect::<BTreeMap<_, _>>()
        };
        let here = Environment { key: "llvmpipe-mesa-25.0.7".into(), platform: "linux-x86_64".into(), stamp: None };
        let golden = |level: &str, by: &str| Golden { environment: level.into(), hash: None, provenance: words(by) };
        let causes = likely_causes(&golden("llvmpipe-mesa-22.3.6", "llvmpipe-mesa-22.3.6"), &here.key, &here);
        assert_eq!(causes.len(), 3, "{causes:?}");
        assert!(causes[1].contains("drawn by llvmpipe-mesa-22.3.6"), "{causes:?}");
        let mut same = golden(&here.key, &here.key);
        same.provenance.remove("Software");
        assert_eq!(likely_causes(&same, &here.key, &here), Vec::<String>::new());
    }
}

//! A pattern with the values of its parameters, as a user writes it.

use std::fmt;
use std::str::FromStr;

use super::{Distribution, Pattern, Request, pattern};
use crate::error::{Error, Result, unknown};

/// The most points a set is made of.
pub const MAX_SET_POINTS: u32 = 65_536;

/// A pattern and the values of all its parameters: `lloyd`, `lloyd:generations=400,raster=512`.
#[derive(Debug, Clone)]
pub struct PatternSpec {
    pattern: &'static Pattern,
    values: Vec<f64>,
}

impl PatternSpec {
    /// Reads `NAME` or `NAME:PARAMETER=VALUE,...`; what is not given has its default.
    ///
    /// # Errors
    /// [`Error::Request`] for an unknown name or parameter (it lists what exists), one given twice, or a value out of range.
    pub fn parse(text: &str) -> Result<Self> {
        let (name, assignments) = text.split_once(':').map_or((text, None), |(name, rest)| (name, Some(rest)));
        let mut spec = Self::from(pattern(name.trim())?);
        let mut given = Vec::new();
        for assignment in assignments.map(|a| a.split(',')).into_iter().flatten() {
            let (key, value) = assignment.split_once('=').map(|(key, value)| (key.trim(), value.trim())).ok_or_else(|| {
                Error::Request(format!("{}: '{assignment}' is no parameter; write it as NAME=VALUE", spec.pattern.name))
            })?;
            if given.contains(&key) {
                return Err(Error::Request(format!("{}: {key} is given twice; give it once", spec.pattern.name)));
            }
            // What is no number is out of every range.
            spec = spec.set(key, value.parse().unwrap_or(f64::NAN), value)?;
            given.push(key);
        }
        Ok(spec)
    }

    /// The same with one parameter set.
    ///
    /// # Errors
    /// [`Error::Request`] if the pattern does not have it or the value is out of range.
    pub fn with(self, parameter: &str, value: f64) -> Result<Self> {
        self.set(parameter, value, &value.to_string())
    }

    fn set(mut self, parameter: &str, value: f64, written: &str) -> Result<Self> {
        let Pattern { name, parameters, .. } = self.pattern;
        let Some(index) = parameters.iter().position(|p| p.name == parameter) else {
            if parameters.is_empty() {
                return Err(Error::Request(format!("{name} has no parameters; write just '{name}'")));
            }
            let names: Vec<_> = parameters.iter().map(|p| p.name).collect();
            return Err(unknown(&format!("{name} parameter"), parameter, &names));
        };
        parameters[index].check(name, value, written)?;
        self.values[index] = value;
        Ok(self)
    }

    /// The pattern itself.
    #[must_use]
    pub fn pattern(&self) -> &'static Pattern {
        self.pattern
    }

    /// `n` points in the unit square.
    ///
    /// # Errors
    /// As [`Self::generate`].
    pub fn points(&self, n: u32, seed: u32) -> Result<Vec<[f64; 2]>> {
        self.generate(&Request::new(n, seed))
    }

    /// The points asked for, in [0, 1)^2.
    ///
    /// # Errors
    /// [`Error::Request`] if `n` is not from 1 to [`MAX_SET_POINTS`], or the density is 0 all over the domain.
    pub fn generate(&self, request: &Request<'_>) -> Result<Vec<[f64; 2]>> {
        if !(1..=MAX_SET_POINTS).contains(&request.n) {
            return Err(Error::Request(format!(
                "{}: {} points are out of range; a set has 1 to {MAX_SET_POINTS}",
                self.pattern.name, request.n
            )));
        }
        Ok(self.pattern.run(&self.values, request, &Distribution::new(request)?))
    }
}

impl From<&'static Pattern> for PatternSpec {
    fn from(pattern: &'static Pattern) -> Self {
        Self { pattern, values: pattern.defaults() }
    }
}

impl FromStr for PatternSpec {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        Self::parse(text)
    }
}

impl fmt::Display for PatternSpec {
    /// The canonical spelling: the pattern's own name, then what differs from the defaults, in the pattern's order.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.pattern.name)?;
        let set = self.pattern.parameters.iter().zip(&self.values).filter(|(parameter, value)| parameter.default != **value);
        for (index, (parameter, value)) in set.enumerate() {
            write!(f, "{}{}={value}", if index == 0 { ':' } else { ',' }, parameter.name)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(text: &str) -> String {
        PatternSpec::parse(text).expect_err(text).to_string()
    }

    #[test]
    fn specs_are_read_and_written_back() {
        for (text, canonical) in [
            ("lloyd", "lloyd"),
            ("lloyd:generations=400,raster=512", "lloyd:generations=400,raster=512"),
            ("lloyd:raster=512,generations=40", "lloyd:raster=512"),
            ("larcher: centred = 0", "larcher-pillichshammer:centred=0"),
            ("semi-jittered:amplitude=.25", "semi-jittered:amplitude=0.25"),
        ] {
            let spec: PatternSpec = text.parse().expect(text);
            assert_eq!(spec.to_string(), canonical);
            assert_eq!(PatternSpec::parse(canonical).expect(canonical).points(20, 1).ok(), spec.points(20, 1).ok());
        }
        let spec = PatternSpec::parse("lloyd").and_then(|spec| spec.with("generations", 3.0)).expect("in range");
        assert_eq!(spec.to_string(), "lloyd:generations=3");
    }

    #[test]
    fn refusals_say_what_there_is() {
        assert!(refusal("loyd").contains("did you mean 'lloyd'"));
        assert!(refusal("lloyd:generation=3").contains("'generations'"));
        assert!(refusal("lloyd:generations").contains("NAME=VALUE"));
        assert!(refusal("lloyd:generations=many").contains("generations=many is out of range; generations takes a whole number"));
        assert!(refusal("lloyd:generations=2.5").contains("0 to 10000"));
        assert!(refusal("lloyd:torus=1,torus=1").contains("twice"));
        assert!(refusal("poisson-disk:radius=nan").contains("radius=nan"));
        assert!(refusal("r2:centred=1").contains("no parameters"));
    }

    #[test]
    fn counts_beyond_the_limits_are_refused() {
        let spec = PatternSpec::parse("random").expect("exists");
        for n in [0, MAX_SET_POINTS + 1, 1_000_000_000] {
            let error = spec.points(n, 0).expect_err("out of range").to_string();
            assert!(error.contains("1 to 65536"), "{error}");
        }
        assert_eq!(spec.points(MAX_SET_POINTS, 0).expect("in range").len(), MAX_SET_POINTS as usize);
    }

    #[test]
    fn a_density_that_is_dark_all_over_the_disk_is_refused() {
        let corner = crate::sampling::Density::new(8, 8, (0..64).map(|i| f64::from(i == 0)).collect()).expect("not all dark");
        let request = Request { domain: crate::sampling::Domain::Disk, density: Some(&corner), ..Request::new(4, 0) };
        let spec = PatternSpec::parse("random").expect("exists");
        assert!(spec.generate(&request).expect_err("dark").to_string().contains("all values are 0"));
    }
}

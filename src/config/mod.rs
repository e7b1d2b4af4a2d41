//! A configuration: an algorithm, its parameters and those of the handle, all by string keys.

#[cfg(feature = "toml")]
mod from_toml;

use std::fmt::Write;

use crate::error::Error;
use crate::faults::{self, Stage};
use crate::parameters::{CommonParameters, ParameterSet, ParameterSpec, Value};
use crate::trackers::{Algorithm, AlgorithmParameters};

/// An algorithm with all its parameters, seeded with the defaults.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    algorithm: Algorithm,
    /// Parameters of the handle.
    pub common: CommonParameters,
    /// Parameters of the algorithm.
    pub parameters: AlgorithmParameters,
}

impl Config {
    /// The defaults of the algorithm of that name.
    pub fn new(algorithm: &str) -> Result<Self, Error> {
        Ok(Self::of(Algorithm::from_name(algorithm)?))
    }

    /// The defaults of an algorithm.
    pub fn of(algorithm: Algorithm) -> Self {
        Self { algorithm, common: CommonParameters::default(), parameters: AlgorithmParameters::defaults(algorithm) }
    }

    /// The algorithm.
    pub fn algorithm(&self) -> Algorithm {
        self.algorithm
    }

    /// The description of every parameter: the algorithm's, then the handle's.
    pub fn specs(&self) -> impl Iterator<Item = &'static ParameterSpec> {
        self.parameters.as_set().specs().iter().chain(self.common.specs())
    }

    /// The value of a parameter.
    pub fn get(&self, key: &str) -> Result<Value, Error> {
        let specific = self.parameters.as_set();
        match specific.find(key) {
            Some(index) => Ok(specific.value(index)),
            None => self.common.find(key).map(|index| self.common.value(index)).ok_or_else(|| self.unknown(key)),
        }
    }

    /// Sets a parameter; on an error nothing changes.
    pub fn set(&mut self, key: &str, value: &Value) -> Result<(), Error> {
        configuring(key)?;
        let (set, index) = self.locate(key)?;
        set.set(index, value)
    }

    /// Sets a parameter from text, as on a command line. The key `preset` loads a named set of values.
    pub fn set_text(&mut self, key: &str, text: &str) -> Result<(), Error> {
        configuring(key)?;
        if key == "preset" {
            return self.load_preset(text);
        }
        let (set, index) = self.locate(key)?;
        let value = set.specs()[index].parse(text)?;
        set.set(index, &value)
    }

    /// Replaces the algorithm's parameters by a named set of values.
    pub fn load_preset(&mut self, name: &str) -> Result<(), Error> {
        self.parameters = AlgorithmParameters::preset(self.algorithm, name).ok_or_else(|| Error::ParameterValue {
            key: "preset".to_string(),
            reason: format!("\"{name}\" is not one of {}", self.algorithm.presets().join(", ")),
        })?;
        Ok(())
    }

    /// Writes every parameter as commented TOML that `Config::load_toml` reads back to the same values.
    pub fn to_toml(&self) -> String {
        let mut text = format!("algorithm = \"{}\"\n", self.algorithm.name());
        for spec in self.specs() {
            let value = self.get(spec.key).expect("a listed parameter exists");
            let written = match &value {
                Value::Choice(name) => format!("\"{name}\""),
                Value::Areas(areas) => {
                    let rows: Vec<String> = areas
                        .iter()
                        .map(|a| format!("[{:?}, {:?}, {:?}, {:?}]", a.left, a.top, a.width, a.height))
                        .collect();
                    format!("[{}]", rows.join(", "))
                }
                other => other.to_string(),
            };
            write!(text, "\n# {}\n{} = {}\n", spec.documentation, spec.key, written).expect("a string takes all");
        }
        text
    }

    fn unknown(&self, key: &str) -> Error {
        Error::UnknownParameter { key: key.to_string(), algorithm: self.algorithm.name() }
    }

    pub(super) fn locate(&mut self, key: &str) -> Result<(&mut dyn ParameterSet, usize), Error> {
        if let Some(index) = self.parameters.as_set().find(key) {
            return Ok((self.parameters.as_set_mut(), index));
        }
        let Some(index) = self.common.find(key) else { return Err(self.unknown(key)) };
        Ok((&mut self.common, index))
    }
}

fn configuring(key: &str) -> Result<(), Error> {
    faults::fallible(Stage::Configuration, |reason| Error::ParameterValue { key: key.to_string(), reason })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_algorithms_name_the_known_ones() {
        let error = Config::new("magic").unwrap_err().to_string();
        assert!(error.contains("\"magic\"") && error.contains("gentrack2"), "{error}");
    }
}

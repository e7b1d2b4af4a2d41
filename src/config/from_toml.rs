//! Reading a configuration from TOML text.

use super::Config;
use crate::error::Error;
use crate::geometry::Rect;
use crate::parameters::{Kind, ParameterSpec, Value};
use crate::trackers::Algorithm;

impl Config {
    /// Reads settings from TOML text: `key = value` lines, keys as in [`Config::specs`], `preset` first if present,
    /// `algorithm` to choose the algorithm. On an error nothing changes.
    pub fn load_toml(&mut self, text: &str) -> Result<(), Error> {
        let table: toml::Table = text.parse().map_err(|e: toml::de::Error| {
            // The library's message spans lines with a drawing; one line is what a log wants.
            let line = e.span().map(|s| text[..s.start.min(text.len())].matches('\n').count() + 1);
            let place = line.map(|l| format!("line {l}: ")).unwrap_or_default();
            Error::ConfigSyntax(format!("{place}{}", e.message()))
        })?;
        let mut next = self.clone();
        if let Some(name) = table.get("algorithm") {
            let name = name.as_str().ok_or_else(|| Error::ConfigSyntax("algorithm must be a string".to_string()))?;
            let algorithm = Algorithm::from_name(name)?;
            if algorithm != next.algorithm {
                next = Config { common: next.common, ..Config::of(algorithm) };
            }
        }
        if let Some(name) = table.get("preset") {
            let name = name.as_str().ok_or_else(|| Error::ConfigSyntax("preset must be a string".to_string()))?;
            next.load_preset(name)?;
        }
        for (key, value) in table.iter().filter(|(k, _)| *k != "algorithm" && *k != "preset") {
            let (set, index) = next.locate(key)?;
            let value = from_toml(&set.specs()[index], value)?;
            set.set(index, &value)?;
        }
        *self = next;
        Ok(())
    }
}

fn from_toml(spec: &ParameterSpec, value: &toml::Value) -> Result<Value, Error> {
    let wrong = || Error::ParameterValue {
        key: spec.key.to_string(),
        reason: format!("a {} is not a valid {}", value.type_str(), spec.expectation()),
    };
    Ok(match (spec.kind, value) {
        (_, toml::Value::Float(x)) => Value::Float(*x),
        (_, toml::Value::Integer(i)) => Value::Integer(*i),
        (_, toml::Value::Boolean(b)) => Value::Boolean(*b),
        (Kind::Choice(_), toml::Value::String(text)) => spec.parse(text)?,
        (Kind::Areas, toml::Value::Array(rows)) => {
            Value::Areas(rows.iter().map(|row| area_from_toml(row).ok_or_else(wrong)).collect::<Result<_, _>>()?)
        }
        _ => return Err(wrong()),
    })
}

fn area_from_toml(row: &toml::Value) -> Option<Rect> {
    let number = |v: &toml::Value| v.as_float().or_else(|| v.as_integer().map(|i| i as f64)).filter(|x| x.is_finite());
    let numbers: Vec<f64> = row.as_array()?.iter().map(number).collect::<Option<_>>()?;
    let [left, top, width, height] = numbers[..] else { return None };
    (width >= 0.0 && height >= 0.0).then(|| Rect::new(left, top, width, height))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn toml_round_trips_every_value() {
        let mut config = Config::new("gentrack2").unwrap();
        config.set_text("particles", "12").unwrap();
        config.set_text("lambda_p", "0.123456789012345").unwrap();
        config.set_text("resampling", "discard").unwrap();
        config.set_text("entrance_areas", "0,0,10.5,20;5,6,7,8").unwrap();
        config.set_text("seed", "77").unwrap();
        let mut read = Config::new("gentrack2").unwrap();
        read.load_toml(&config.to_toml()).unwrap();
        assert_eq!(read, config);
    }

    #[test]
    fn a_bad_file_changes_nothing_and_says_where() {
        let mut config = Config::new("gentrack2").unwrap();
        let before = config.clone();
        let error = config.load_toml("particles = 4\n\nlambda_p = = 2\n").unwrap_err().to_string();
        assert!(error.starts_with("configuration: line 3: "), "{error}");
        let error = config.load_toml("particles = 4\nlambda_p = 20.0\n").unwrap_err().to_string();
        assert!(error.contains("lambda_p") && error.contains("outside"), "{error}");
        let error = config.load_toml("particles = 4\nno_such = 1\n").unwrap_err().to_string();
        assert_eq!(error, "unknown parameter \"no_such\" of gentrack2");
        assert_eq!(config, before);
    }
}

//! Saving a running tracker and loading it again, in another process or on another machine.
//!
//! ```text
//! "GT2SNAP\0"   8 bytes
//! format        u32, little-endian: FORMAT
//! length        u64, little-endian: bytes of the payload
//! payload       the state, in postcard's encoding, which does not depend on the machine
//! checksum      u32, little-endian: CRC-32 of all bytes before it
//! ```
//!
//! The payload is not self-describing: whoever changes what a tracker keeps raises `FORMAT`, keeps reading the formats
//! before it, and adds a fixture of the new one (see CONTRIBUTING).

mod codec;
pub(crate) mod numbers;

pub use codec::{Decoder, Encoder};

use serde::{Deserialize, Serialize};

use crate::config::Config;
use crate::error::Error;

const MAGIC: &[u8; 8] = b"GT2SNAP\0";
/// The format that is written. Of all before it none has been published.
const FORMAT: u32 = 1;
const HEADER: usize = MAGIC.len() + 4 + 8;
const CHECKSUM: usize = 4;

/// Puts a payload between header and checksum.
pub(crate) fn seal(payload: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEADER + payload.len() + CHECKSUM);
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&FORMAT.to_le_bytes());
    bytes.extend_from_slice(&(payload.len() as u64).to_le_bytes());
    bytes.extend_from_slice(payload);
    let checksum = crc32fast::hash(&bytes);
    bytes.extend_from_slice(&checksum.to_le_bytes());
    bytes
}

/// The payload of a snapshot whose header and checksum are right.
pub(crate) fn open(bytes: &[u8]) -> Result<&[u8], Error> {
    let refuse = |reason: String| Err(Error::Snapshot(reason));
    if bytes.len() < HEADER + CHECKSUM {
        return refuse(format!("of {} bytes is too short to be one", bytes.len()));
    }
    let (head, rest) = bytes.split_at(HEADER);
    let (magic, numbers) = head.split_at(MAGIC.len());
    if magic != MAGIC {
        return refuse("does not begin as one".to_string());
    }
    let (format, length) = numbers.split_at(4);
    let format = u32::from_le_bytes(format.try_into().expect("four bytes"));
    if format == 0 || format > FORMAT {
        return refuse(format!("is of format {format}, this library reads formats up to {FORMAT}"));
    }
    let length = u64::from_le_bytes(length.try_into().expect("eight bytes"));
    let (payload, checksum) = rest.split_at(rest.len() - CHECKSUM);
    if length != payload.len() as u64 {
        return refuse(format!("has {} bytes of {length}", payload.len()));
    }
    let found = crc32fast::hash(&bytes[..bytes.len() - CHECKSUM]);
    if found.to_le_bytes() != checksum {
        return refuse("is damaged: its checksum does not fit".to_string());
    }
    Ok(payload)
}

/// A configuration as text, the way that command lines set it: readable by any later version.
#[derive(Serialize, Deserialize)]
pub(crate) struct SavedConfig {
    algorithm: String,
    settings: Vec<(String, String)>,
}

impl SavedConfig {
    pub fn of(config: &Config) -> Self {
        let setting = |key: &str| {
            let value = config.get(key).expect("a listed parameter exists");
            (key.to_string(), value.to_string())
        };
        Self {
            algorithm: config.algorithm().name().to_string(),
            settings: config.specs().map(|spec| setting(spec.key)).collect(),
        }
    }

    pub fn restore(&self) -> Result<Config, Error> {
        let mut config = Config::new(&self.algorithm).map_err(refused_config)?;
        for (key, value) in &self.settings {
            config.set_text(key, value).map_err(refused_config)?;
        }
        Ok(config)
    }
}

/// What is wrong with a configuration is wrong with the snapshot that has it.
pub(crate) fn refused_config(error: Error) -> Error {
    Error::Snapshot(format!("has a configuration that this library refuses: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Rect;
    use crate::parameters::Value;

    #[test]
    fn what_is_sealed_opens() {
        for payload in [&b""[..], b"x", b"something longer"] {
            assert_eq!(open(&seal(payload)).unwrap(), payload);
        }
    }

    #[test]
    fn refusals_say_why() {
        let sealed = seal(b"payload");
        let reason = |bytes: &[u8]| open(bytes).unwrap_err().to_string();
        assert_eq!(reason(&[]), "snapshot of 0 bytes is too short to be one");
        assert_eq!(reason(&[b'x'; 64]), "snapshot does not begin as one");
        assert_eq!(reason(&sealed[..sealed.len() - 1]), "snapshot has 6 bytes of 7");
        let mut newer = sealed.clone();
        newer[8] = 2;
        assert_eq!(reason(&newer), "snapshot is of format 2, this library reads formats up to 1");
        for at in HEADER..sealed.len() {
            let mut damaged = sealed.clone();
            damaged[at] ^= 0x10;
            assert_eq!(reason(&damaged), "snapshot is damaged: its checksum does not fit");
        }
    }

    #[test]
    fn a_configuration_comes_back_to_the_last_bit() {
        let mut config = Config::new("gentrack2").unwrap();
        config.set("lambda_p", &Value::Float(0.1 + 0.2)).unwrap();
        config.set("entrance_areas", &Value::Areas(vec![Rect::new(0.1, -2.5, 1.0 / 3.0, 4e9)])).unwrap();
        config.set_text("weak_motion", "own").unwrap();
        config.set_text("class_policy", "separate").unwrap();
        assert_eq!(SavedConfig::of(&config).restore().unwrap(), config);
    }

    #[test]
    fn a_parameter_that_nobody_knows_is_refused_by_name() {
        let mut saved = SavedConfig::of(&Config::new("sort").unwrap());
        saved.settings.push(("of_tomorrow".to_string(), "1".to_string()));
        let message = saved.restore().unwrap_err().to_string();
        assert!(message.contains("of_tomorrow"), "{message}");
    }
}

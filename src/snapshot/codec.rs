//! Values to bytes and back.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::Error;

/// Collects values.
#[derive(Default)]
pub struct Encoder(Vec<u8>);

impl Encoder {
    /// Appends a value.
    pub fn put<T: Serialize + ?Sized>(&mut self, value: &T) {
        let bytes = std::mem::take(&mut self.0);
        self.0 =
            postcard::to_extend(value, bytes).expect("a vector takes everything, and what trackers keep has lengths");
    }

    /// All that was put.
    pub fn into_bytes(self) -> Vec<u8> {
        self.0
    }
}

/// Hands values out in the order in which they were put.
pub struct Decoder<'a>(&'a [u8]);

impl<'a> Decoder<'a> {
    /// Reads from these bytes.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self(bytes)
    }

    /// The next value.
    pub fn take<T: DeserializeOwned>(&mut self) -> Result<T, Error> {
        let (value, rest) = postcard::take_from_bytes(self.0)
            .map_err(|_| Error::Snapshot("is not what this library writes".to_string()))?;
        self.0 = rest;
        Ok(value)
    }

    /// Refuses bytes that nobody took.
    pub fn finish(self) -> Result<(), Error> {
        match self.0.len() {
            0 => Ok(()),
            n => Err(Error::Snapshot(format!("has {n} bytes too many"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_come_back_in_their_order() {
        let mut encoder = Encoder::default();
        encoder.put(&(7u64, -0.0f64));
        encoder.put("text");
        let bytes = encoder.into_bytes();
        let mut decoder = Decoder::new(&bytes);
        let (seven, zero): (u64, f64) = decoder.take().unwrap();
        assert_eq!((seven, zero.to_bits()), (7, (-0.0f64).to_bits()));
        assert_eq!(decoder.take::<String>().unwrap(), "text");
        assert!(decoder.take::<u64>().is_err());
        assert!(decoder.finish().is_ok());
        assert!(Decoder::new(&bytes).finish().is_err());
    }
}

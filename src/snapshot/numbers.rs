//! Arrays of numbers that are longer than serde knows by itself.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

/// Writes an array as a list.
pub fn serialize<S: Serializer, const N: usize>(array: &[f32; N], serializer: S) -> Result<S::Ok, S::Error> {
    array[..].serialize(serializer)
}

/// Reads a list that must be as long as the array.
pub fn deserialize<'de, D: Deserializer<'de>, const N: usize>(deserializer: D) -> Result<[f32; N], D::Error> {
    let list: Vec<f32> = Vec::deserialize(deserializer)?;
    let length = list.len();
    list.try_into().map_err(|_| de::Error::invalid_length(length, &"the array's length"))
}

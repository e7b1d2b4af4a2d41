//! Arrays of numbers that are longer than serde knows by itself.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

/// Writes an array as a list.
pub fn serialize<S: Serializer, T: Serialize, const N: usize>(
    array: &[T; N],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    array[..].serialize(serializer)
}

/// Reads a list that must be as long as the array.
pub fn deserialize<'de, D: Deserializer<'de>, T: Deserialize<'de>, const N: usize>(
    deserializer: D,
) -> Result<[T; N], D::Error> {
    let list: Vec<T> = Vec::deserialize(deserializer)?;
    let length = list.len();
    list.try_into().map_err(|_| de::Error::invalid_length(length, &"the array's length"))
}

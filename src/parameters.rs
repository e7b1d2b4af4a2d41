//! Self-describing parameters: each algorithm declares its knobs once, with the `parameters!` macro, and the typed
//! struct, the defaults, the range checks, the introspection of the C ABI and the documentation all come from there.

use crate::classes::ClassPolicy;
use crate::error::{Error, Number};
use crate::geometry::Rect;
use crate::image::MAX_IMAGE_SIDE;

/// A parameter's value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A real number.
    Float(f64),
    /// A whole number.
    Integer(i64),
    /// True or false.
    Boolean(bool),
    /// One of a list of names.
    Choice(&'static str),
    /// Rectangles of the image, in pixels.
    Areas(Vec<Rect>),
}

/// What values a parameter takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A real number.
    Float,
    /// A whole number.
    Integer,
    /// True or false.
    Boolean,
    /// One of these names.
    Choice(&'static [&'static str]),
    /// A list of rectangles.
    Areas,
}

impl Kind {
    /// Name of the kind as used in messages and tables.
    pub const fn name(self) -> &'static str {
        match self {
            Kind::Float => "number",
            Kind::Integer => "integer",
            Kind::Boolean => "boolean",
            Kind::Choice(_) => "choice",
            Kind::Areas => "areas",
        }
    }
}

/// Everything there is to know about a parameter.
#[derive(Clone, Debug)]
pub struct ParameterSpec {
    /// Name by which it is set.
    pub key: &'static str,
    /// What values it takes.
    pub kind: Kind,
    /// Value of a new configuration.
    pub default: Value,
    /// Smallest value, for numbers.
    pub minimum: f64,
    /// Largest value, for numbers.
    pub maximum: f64,
    /// Unit; empty for pure numbers.
    pub unit: &'static str,
    /// The paper's symbol; empty if it has none.
    pub symbol: &'static str,
    /// One paragraph of documentation.
    pub documentation: String,
}

/// Rectangles in a list: every weak track is looked for in all of them.
const MOST_AREAS: usize = 1000;

impl ParameterSpec {
    fn refuse(&self, reason: String) -> Error {
        Error::ParameterValue { key: self.key.to_string(), reason }
    }

    /// Checks a value against kind and range.
    pub fn check(&self, value: &Value) -> Result<(), Error> {
        let number = match value {
            Value::Float(x) => *x,
            Value::Integer(i) => *i as f64,
            Value::Areas(areas) if areas.len() > MOST_AREAS => {
                return Err(self.refuse(format!("{} areas are more than {MOST_AREAS}", areas.len())));
            }
            _ => return Ok(()),
        };
        if number.is_finite() && number >= self.minimum && number <= self.maximum {
            return Ok(());
        }
        Err(self.refuse(match value {
            Value::Integer(i) => format!("{i} is outside {}..={}", self.minimum as i64, self.maximum as i64),
            _ => format!("{} is outside {}..={}", Number(number), Number(self.minimum), Number(self.maximum)),
        }))
    }

    /// Reads a value of this parameter's kind from text, as on a command line.
    pub fn parse(&self, text: &str) -> Result<Value, Error> {
        let text = text.trim();
        let wrong = || self.refuse(format!("\"{text}\" is not a valid {}", self.expectation()));
        let value = match self.kind {
            Kind::Float => Value::Float(text.parse().map_err(|_| wrong())?),
            Kind::Integer => Value::Integer(text.parse().map_err(|_| wrong())?),
            Kind::Boolean => match text {
                "true" | "1" => Value::Boolean(true),
                "false" | "0" => Value::Boolean(false),
                _ => return Err(wrong()),
            },
            Kind::Choice(names) => Value::Choice(names.iter().find(|n| **n == text).ok_or_else(wrong)?),
            Kind::Areas => Value::Areas(parse_areas(text).ok_or_else(wrong)?),
        };
        self.check(&value)?;
        Ok(value)
    }

    /// What a value must look like, for messages.
    pub fn expectation(&self) -> String {
        match self.kind {
            Kind::Choice(names) => format!("choice (one of {})", names.join(", ")),
            Kind::Areas => "list of areas (left,top,width,height; ...)".to_string(),
            kind => kind.name().to_string(),
        }
    }
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            // Debug keeps a fraction digit and the shortest text that reads back to the same bits.
            Value::Float(x) => write!(f, "{x:?}"),
            Value::Integer(i) => write!(f, "{i}"),
            Value::Boolean(b) => write!(f, "{b}"),
            Value::Choice(s) => f.write_str(s),
            Value::Areas(areas) => {
                for (i, a) in areas.iter().enumerate() {
                    let separator = if i == 0 { "" } else { ";" };
                    write!(f, "{separator}{:?},{:?},{:?},{:?}", a.left, a.top, a.width, a.height)?;
                }
                Ok(())
            }
        }
    }
}

fn parse_areas(text: &str) -> Option<Vec<Rect>> {
    text.split(';').filter(|part| !part.trim().is_empty()).map(parse_area).collect()
}

fn parse_area(text: &str) -> Option<Rect> {
    let numbers: Vec<f64> = text.split(',').map(|n| n.trim().parse().ok()).collect::<Option<_>>()?;
    let [left, top, width, height] = numbers[..] else { return None };
    let usable = numbers.iter().all(|n| n.is_finite()) && width >= 0.0 && height >= 0.0;
    usable.then(|| Rect::new(left, top, width, height))
}

/// A Rust type that can be a parameter.
pub trait ParameterType: Clone + Sized {
    /// The kind of its values.
    const KIND: Kind;
    /// As a value.
    fn to_value(&self) -> Value;
    /// From a value of the same kind.
    fn from_value(value: &Value) -> Option<Self>;
}

impl ParameterType for f64 {
    const KIND: Kind = Kind::Float;
    fn to_value(&self) -> Value {
        Value::Float(*self)
    }
    fn from_value(value: &Value) -> Option<Self> {
        match value {
            Value::Float(x) => Some(*x),
            // A whole number is a number.
            Value::Integer(i) => Some(*i as f64),
            _ => None,
        }
    }
}

impl ParameterType for i64 {
    const KIND: Kind = Kind::Integer;
    fn to_value(&self) -> Value {
        Value::Integer(*self)
    }
    fn from_value(value: &Value) -> Option<Self> {
        match value {
            Value::Integer(i) => Some(*i),
            Value::Float(x) if x.fract() == 0.0 && x.abs() < 9.0e15 => Some(*x as i64),
            _ => None,
        }
    }
}

impl ParameterType for bool {
    const KIND: Kind = Kind::Boolean;
    fn to_value(&self) -> Value {
        Value::Boolean(*self)
    }
    fn from_value(value: &Value) -> Option<Self> {
        match value {
            Value::Boolean(b) => Some(*b),
            _ => None,
        }
    }
}

impl ParameterType for Vec<Rect> {
    const KIND: Kind = Kind::Areas;
    fn to_value(&self) -> Value {
        Value::Areas(self.clone())
    }
    fn from_value(value: &Value) -> Option<Self> {
        match value {
            Value::Areas(a) => Some(a.clone()),
            _ => None,
        }
    }
}

/// A struct of parameters seen as a table.
pub trait ParameterSet {
    /// The table, in declaration order.
    fn specs(&self) -> &'static [ParameterSpec];
    /// The value of row `index`.
    fn value(&self, index: usize) -> Value;
    /// Sets row `index` after checking kind and range; on an error nothing changes.
    fn set(&mut self, index: usize, value: &Value) -> Result<(), Error>;

    /// The row of a key.
    fn find(&self, key: &str) -> Option<usize> {
        self.specs().iter().position(|s| s.key == key)
    }
}

/// Declares an enum whose variants are the names of a choice parameter.
macro_rules! choice {
    ($(#[$meta:meta])* pub enum $name:ident { $($(#[$vmeta:meta])* $variant:ident = $text:literal),+ $(,)? }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $($(#[$vmeta])* $variant),+ }

        impl $crate::parameters::ParameterType for $name {
            const KIND: $crate::parameters::Kind = $crate::parameters::Kind::Choice(&[$($text),+]);
            fn to_value(&self) -> $crate::parameters::Value {
                $crate::parameters::Value::Choice(match self { $($name::$variant => $text),+ })
            }
            fn from_value(value: &$crate::parameters::Value) -> Option<Self> {
                match value {
                    $($crate::parameters::Value::Choice($text) => Some($name::$variant),)+
                    _ => None,
                }
            }
        }
    };
}
pub(crate) use choice;

/// Declares a parameter struct: per row its documentation, key, type, default, range (empty for what has none),
/// unit and the paper's symbol.
macro_rules! parameters {
    (
        $(#[$meta:meta])*
        pub struct $name:ident {
            $(
                $(#[doc = $doc:literal])+
                $key:ident : $ty:ty = $default:expr, [$($min:expr, $max:expr)?], $unit:literal, $symbol:literal;
            )+
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        pub struct $name { $($(#[doc = $doc])+ pub $key: $ty,)+ }

        impl Default for $name {
            fn default() -> Self {
                Self { $($key: $default,)+ }
            }
        }

        impl $crate::parameters::ParameterSet for $name {
            fn specs(&self) -> &'static [$crate::parameters::ParameterSpec] {
                static SPECS: std::sync::LazyLock<Vec<$crate::parameters::ParameterSpec>> =
                    std::sync::LazyLock::new(|| {
                        let defaults = $name::default();
                        vec![$({
                            #[allow(unused_mut, unused_assignments)]
                            let mut range = (0.0, 0.0);
                            $(range = ($min as f64, $max as f64);)?
                            $crate::parameters::ParameterSpec {
                                key: stringify!($key),
                                kind: <$ty as $crate::parameters::ParameterType>::KIND,
                                default: $crate::parameters::ParameterType::to_value(&defaults.$key),
                                minimum: range.0,
                                maximum: range.1,
                                unit: $unit,
                                symbol: $symbol,
                                documentation: [$($doc),+].map(str::trim).join(" "),
                            }
                        }),+]
                    });
                &SPECS
            }

            fn value(&self, index: usize) -> $crate::parameters::Value {
                let getters: &[fn(&Self) -> $crate::parameters::Value] =
                    &[$(|s| $crate::parameters::ParameterType::to_value(&s.$key)),+];
                getters[index](self)
            }

            fn set(
                &mut self,
                index: usize,
                value: &$crate::parameters::Value,
            ) -> Result<(), $crate::error::Error> {
                use $crate::parameters::ParameterType;
                let spec = &self.specs()[index];
                spec.check(value)?;
                let setters: &[fn(&mut Self, &$crate::parameters::Value) -> Option<()>] =
                    &[$(|s, v| { s.$key = ParameterType::from_value(v)?; Some(()) }),+];
                setters[index](self, value).ok_or_else(|| $crate::error::Error::ParameterValue {
                    key: spec.key.to_string(),
                    reason: format!("{value} is not a valid {}", spec.expectation()),
                })
            }
        }
    };
}
pub(crate) use parameters;

/// For an algorithm whose only preset is its defaults.
macro_rules! only_default_preset {
    ($name:ident) => {
        impl $name {
            /// Names of the presets, the default first.
            pub const PRESETS: &'static [&'static str] = &["default"];

            /// The values of a preset.
            pub fn preset(name: &str) -> Option<Self> {
                (name == "default").then(Self::default)
            }
        }
    };
}
pub(crate) use only_default_preset;

/// Pixels of the largest image that can be described at all.
const LARGEST_IMAGE: i64 = (MAX_IMAGE_SIDE as i64) * (MAX_IMAGE_SIDE as i64);

parameters! {
    /// Parameters of the handle, the same for every algorithm.
    pub struct CommonParameters {
        /// Nominal frame rate. Without timestamps a step is one frame interval; with them it says how many frames
        /// the elapsed time is worth. Set it to the rate at which `step` is called: speeds are per second. What is in
        /// ticks, and the track_buffer of bytetrack, botsort and smiletrack, is then kept in real time; what is in
        /// frames counts frames at this rate.
        frame_rate: f64 = 30.0, [0.1, 1000.0], "frames/s", "";
        /// Seed of the random numbers. The same input, configuration and seed give bit-identical output.
        seed: i64 = 0, [0, i64::MAX], "", "";
        /// First identity given out, also after a reset.
        first_id: i64 = 1, [1, i64::MAX], "", "";
        /// What class ids mean.
        class_policy: ClassPolicy = ClassPolicy::Ignore, [], "", "";
        /// Most detections accepted in one frame; more is an error.
        max_detections: i64 = 32_768, [1, 1_000_000], "detections", "";
        /// Most live tracks; while there are that many, no new ones are started.
        max_tracks: i64 = 32_768, [1, 1_000_000], "tracks", "";
        /// Most numbers in an embedding; longer ones are an error.
        max_embedding_dimension: i64 = 16_384, [1, 1_000_000], "numbers", "";
        /// Most pixels of an image, width times height; a larger one is an error. No side may exceed 65535 in any
        /// case.
        max_image_pixels: i64 = LARGEST_IMAGE, [1, LARGEST_IMAGE], "px", "";
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    choice! {
        pub enum Colour { Red = "red", Blue = "blue" }
    }

    parameters! {
        pub struct Sample {
            /// A
            /// real.
            real: f64 = 0.5, [0.0, 1.0], "px", "x";
            /// A count.
            count: i64 = 3, [1, 10], "", "";
            /// A switch.
            switch: bool = true, [], "", "";
            /// A colour.
            colour: Colour = Colour::Red, [], "", "";
            /// Places.
            places: Vec<Rect> = Vec::new(), [], "px", "";
        }
    }

    #[test]
    fn the_table_describes_the_struct() {
        let sample = Sample::default();
        let spec = &sample.specs()[0];
        assert_eq!((spec.key, spec.unit, spec.symbol), ("real", "px", "x"));
        assert_eq!(spec.documentation, "A real.");
        assert_eq!(spec.default, Value::Float(0.5));
        assert_eq!(sample.specs()[3].kind, Kind::Choice(&["red", "blue"]));
    }

    #[test]
    fn values_out_of_range_or_of_another_kind_change_nothing() {
        let mut sample = Sample::default();
        for (index, value) in [
            (0, Value::Float(1.5)),
            (0, Value::Float(f64::NAN)),
            (1, Value::Float(2.5)),
            (2, Value::Integer(1)),
            (3, Value::Choice("green")),
            (4, Value::Boolean(true)),
        ] {
            assert!(sample.set(index, &value).is_err(), "{value:?}");
        }
        assert_eq!(sample, Sample::default());
        let message = sample.set(0, &Value::Float(1.5)).unwrap_err().to_string();
        assert_eq!(message, "parameter real: 1.5 is outside 0..=1");
    }

    #[test]
    fn text_round_trips() {
        let mut sample = Sample::default();
        for (key, text) in [
            ("real", "0.25"),
            ("count", "7"),
            ("switch", "false"),
            ("colour", "blue"),
            ("places", "0.0,1.0,2.0,3.0;4.0,5.0,6.0,7.0"),
        ] {
            let index = sample.find(key).unwrap();
            let value = sample.specs()[index].parse(text).unwrap();
            sample.set(index, &value).unwrap();
            assert_eq!(sample.value(index).to_string(), text);
        }
        assert_eq!(sample.places[1], Rect::new(4.0, 5.0, 6.0, 7.0));
    }
}

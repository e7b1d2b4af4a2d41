//! Names and descriptions of algorithms, presets and parameters as C strings. Made once, never changed, so that
//! callers may keep the pointers.

use std::ffi::{CString, c_char};
use std::sync::LazyLock;

use super::parameter_info::*;
use super::text::c_string;
use crate::config::Config;
use crate::parameters::{Kind, ParameterSpec};
use crate::trackers::Algorithm;

pub(super) struct AlgorithmTable {
    pub name: CString,
    pub description: CString,
    pub presets: Vec<CString>,
    pub parameters: Vec<ParameterTable>,
}

pub(super) struct ParameterTable {
    info: gt2_parameter_info,
    /// What `info` points to.
    _texts: Vec<CString>,
    _choices: Vec<*const c_char>,
}

// SAFETY: the pointers lead to memory that the table owns and never changes.
unsafe impl Send for ParameterTable {}
// SAFETY: as above.
unsafe impl Sync for ParameterTable {}

static TABLES: LazyLock<Vec<AlgorithmTable>> =
    LazyLock::new(|| Algorithm::ALL.iter().copied().map(AlgorithmTable::new).collect());

/// The tables, in the order of [`Algorithm::ALL`].
pub(super) fn all() -> &'static [AlgorithmTable] {
    &TABLES
}

/// The table of one algorithm.
pub(super) fn of(algorithm: Algorithm) -> &'static AlgorithmTable {
    let index = Algorithm::ALL.iter().position(|a| *a == algorithm).expect("every algorithm is listed");
    &TABLES[index]
}

impl AlgorithmTable {
    fn new(algorithm: Algorithm) -> Self {
        Self {
            name: c_string(algorithm.name()),
            description: c_string(algorithm.description()),
            presets: algorithm.presets().iter().map(|p| c_string(p)).collect(),
            parameters: Config::of(algorithm).specs().map(ParameterTable::new).collect(),
        }
    }
}

impl ParameterTable {
    fn new(spec: &ParameterSpec) -> Self {
        let (kind, names): (i32, &[&str]) = match spec.kind {
            Kind::Float => (GT2_PARAMETER_NUMBER, &[]),
            Kind::Integer => (GT2_PARAMETER_INTEGER, &[]),
            Kind::Boolean => (GT2_PARAMETER_BOOLEAN, &[]),
            Kind::Choice(names) => (GT2_PARAMETER_CHOICE, names),
            Kind::Areas => (GT2_PARAMETER_AREAS, &[]),
        };
        let default_text = spec.default.to_string();
        let own = [spec.key, &default_text, spec.unit, spec.symbol, &spec.documentation];
        let texts: Vec<CString> = own.iter().chain(names).map(|t| c_string(t)).collect();
        // A CString's text is on the heap and stays where it is when the CString moves.
        let pointers: Vec<*const c_char> = texts.iter().map(|t| t.as_ptr()).collect();
        let choices = pointers[own.len()..].to_vec();
        let info = gt2_parameter_info {
            struct_size: size_of::<gt2_parameter_info>(),
            key: pointers[0],
            kind,
            reserved: 0,
            default_text: pointers[1],
            minimum: spec.minimum,
            maximum: spec.maximum,
            unit: pointers[2],
            symbol: pointers[3],
            documentation: pointers[4],
            choices: super::pointer::start(&choices),
            choice_count: choices.len(),
        };
        Self { info, _texts: texts, _choices: choices }
    }

    pub fn info(&self) -> &gt2_parameter_info {
        &self.info
    }
}

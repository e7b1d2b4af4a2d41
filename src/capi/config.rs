//! The configuration handle.

use std::ffi::c_char;
use std::ptr::null;

use super::guard::{find_in, guard, guard_exclusive, guard_shared};
use super::handle::{Handle, Header, give, take};
use super::parameter_info::gt2_parameter_info;
use super::pointer::{require, slice, store};
use super::status::*;
use super::tables::{self, AlgorithmTable};
use super::{structs, text};
use crate::config::Config;
use crate::error::Error;
use crate::parameters::Value;

/// An algorithm with all its parameters, chosen and set by name. Made by `gt2_config_new` or `gt2_config_clone`,
/// released by `gt2_config_free`. A tracker copies its config, so one config can serve many trackers.
// C order, so that the header comes first; cbindgen takes types of stated alignment as opaque.
#[repr(C, align(8))]
pub struct gt2_config {
    header: Header,
    config: Config,
}

// SAFETY: repr(C), header first, and `new` makes it with this tag.
unsafe impl Handle for gt2_config {
    const TAG: u64 = 0x6774_3263_6f6e_6667;
    const NAME: &'static str = "config";
    fn header(&self) -> &Header {
        &self.header
    }
}

impl gt2_config {
    fn new(config: Config) -> Self {
        Self { header: Header::new(Self::TAG), config }
    }

    pub(super) fn config(&self) -> &Config {
        &self.config
    }

    fn table(&self) -> &'static AlgorithmTable {
        tables::of(self.config.algorithm())
    }
}

/// Makes a config with the defaults of `algorithm` (see `gt2_algorithm_name`), such as "gentrack2", and stores it in
/// `*out`.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_TEXT`, `GT2_ERR_UNKNOWN_ALGORITHM`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_new(algorithm: *const c_char, out: *mut *mut gt2_config) -> gt2_status {
    guard(|| {
        require(out, "out")?;
        // SAFETY: a C string by the contract of the header.
        let name = unsafe { text::read(algorithm, "algorithm") }?;
        let config = Config::new(name)?;
        // SAFETY: `out` is not NULL.
        unsafe { store(out, give(gt2_config::new(config))) };
        Ok(())
    })
}

/// Releases a config; NULL is ignored. Trackers made from it live on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_free(config: *mut gt2_config) {
    // SAFETY: the handle is given up by the caller.
    guard(|| unsafe { take(config) }.map(drop));
}

/// Makes a copy of a config and stores it in `*out`.
///
/// Errors: `GT2_ERR_NULL_POINTER`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_clone(config: *const gt2_config, out: *mut *mut gt2_config) -> gt2_status {
    // SAFETY: a handle by the contract of the header.
    unsafe {
        guard_shared(config, |c| {
            require(out, "out")?;
            store(out, give(gt2_config::new(c.config.clone())));
            Ok(())
        })
    }
}

/// Name of the config's algorithm. Static. NULL if `config` is not a config.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_algorithm(config: *const gt2_config) -> *const c_char {
    // SAFETY: a handle by the contract of the header.
    unsafe { find_in(config, null(), |c| Ok(c.table().name.as_ptr())) }
}

/// Sets a parameter of any kind from text, as on a command line: "0.25", "12", "true" or "false", the name of a
/// choice, or areas "left,top,width,height;...". The key "preset" replaces all the algorithm's parameters by a named
/// set (see `gt2_config_preset_name`), so set it first. On an error nothing changes.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_TEXT`, `GT2_ERR_UNKNOWN_PARAMETER`, `GT2_ERR_PARAMETER_VALUE` (the
/// message names the range).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_set(
    config: *mut gt2_config,
    key: *const c_char,
    value: *const c_char,
) -> gt2_status {
    // SAFETY: a handle and C strings by the contract of the header.
    unsafe {
        guard_exclusive(config, |c| {
            let (key, value) = (text::read(key, "key")?, text::read(value, "value")?);
            Ok(c.config.set_text(key, value)?)
        })
    }
}

/// Sets a number; an integer too if `value` is whole. Errors as for `gt2_config_set`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_set_number(config: *mut gt2_config, key: *const c_char, value: f64) -> gt2_status {
    // SAFETY: a handle and a C string by the contract of the header.
    unsafe { set(config, key, Value::Float(value)) }
}

/// Sets an integer or a number. Errors as for `gt2_config_set`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_set_integer(config: *mut gt2_config, key: *const c_char, value: i64) -> gt2_status {
    // SAFETY: a handle and a C string by the contract of the header.
    unsafe { set(config, key, Value::Integer(value)) }
}

/// Sets a boolean: `value` 0 is false, 1 is true. Errors as for `gt2_config_set`; another `value` is
/// `GT2_ERR_INVALID_ARGUMENT`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_set_boolean(config: *mut gt2_config, key: *const c_char, value: i32) -> gt2_status {
    let value = match value {
        0 | 1 => value == 1,
        _ => return report(Failure::argument(format!("value: is {value}, must be 0 or 1"))),
    };
    // SAFETY: a handle and a C string by the contract of the header.
    unsafe { set(config, key, Value::Boolean(value)) }
}

unsafe fn set(config: *mut gt2_config, key: *const c_char, value: Value) -> gt2_status {
    // SAFETY: passed on to the caller.
    unsafe { guard_exclusive(config, |c| Ok(c.config.set(text::read(key, "key")?, &value)?)) }
}

/// Copies a parameter's value as text, with its terminating NUL, to `buffer` of `capacity` bytes, in the form that
/// `gt2_config_set` reads back to the same value. Stores the number of bytes needed, NUL included, in `*needed`,
/// which may be NULL; with a `capacity` of 0 that is all it does. If the buffer is too small it stays as it is and
/// `*needed` is stored all the same.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_TEXT`, `GT2_ERR_UNKNOWN_PARAMETER`, `GT2_ERR_BUFFER_TOO_SMALL`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_get(
    config: *const gt2_config,
    key: *const c_char,
    buffer: *mut c_char,
    capacity: usize,
    needed: *mut usize,
) -> gt2_status {
    // SAFETY: a handle, a C string and a buffer by the contract of the header.
    unsafe {
        guard_shared(config, |c| {
            let value = c.config.get(text::read(key, "key")?)?;
            text::copy_out(&value.to_string(), buffer, capacity, needed)
        })
    }
}

/// Stores the value of a number, integer or boolean (0 or 1) in `*out`. Integers beyond 2^53 lose digits; use
/// `gt2_config_get_integer`.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_TEXT`, `GT2_ERR_UNKNOWN_PARAMETER`, `GT2_ERR_PARAMETER_VALUE` if the
/// parameter is of another kind.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_get_number(
    config: *const gt2_config,
    key: *const c_char,
    out: *mut f64,
) -> gt2_status {
    // SAFETY: a handle, a C string and an output by the contract of the header.
    unsafe {
        get(config, key, out, "a number", |value| match value {
            Value::Float(x) => Some(*x),
            Value::Integer(i) => Some(*i as f64),
            Value::Boolean(b) => Some(f64::from(*b)),
            _ => None,
        })
    }
}

/// Stores the value of an integer or boolean (0 or 1) in `*out`. Errors as for `gt2_config_get_number`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_get_integer(
    config: *const gt2_config,
    key: *const c_char,
    out: *mut i64,
) -> gt2_status {
    // SAFETY: a handle, a C string and an output by the contract of the header.
    unsafe {
        get(config, key, out, "an integer", |value| match value {
            Value::Integer(i) => Some(*i),
            Value::Boolean(b) => Some(i64::from(*b)),
            _ => None,
        })
    }
}

unsafe fn get<T>(
    config: *const gt2_config,
    key: *const c_char,
    out: *mut T,
    wanted: &str,
    convert: fn(&Value) -> Option<T>,
) -> gt2_status {
    // SAFETY: passed on to the caller.
    unsafe {
        guard_shared(config, |c| {
            require(out, "out")?;
            let key = text::read(key, "key")?;
            let value = c.config.get(key)?;
            let refuse = || Error::ParameterValue { key: key.to_string(), reason: format!("{value} is not {wanted}") };
            store(out, convert(&value).ok_or_else(refuse)?);
            Ok(())
        })
    }
}

/// Reads settings from `length` bytes of TOML, which need no NUL: lines `key = value` with keys as in
/// `gt2_config_parameter_info`, besides `algorithm = "name"`, which turns the config into one of that algorithm, and
/// `preset = "name"`, which is loaded before the other keys. What is not named stays. On an error nothing changes.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_TEXT`, `GT2_ERR_CONFIG_SYNTAX` (the message names the line),
/// `GT2_ERR_UNKNOWN_ALGORITHM`, `GT2_ERR_UNKNOWN_PARAMETER`, `GT2_ERR_PARAMETER_VALUE`, `GT2_ERR_UNSUPPORTED`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_load_toml(
    config: *mut gt2_config,
    text: *const c_char,
    length: usize,
) -> gt2_status {
    // SAFETY: a handle and an array by the contract of the header.
    unsafe {
        guard_exclusive(config, |c| {
            let bytes = slice(text.cast::<u8>(), length, "text")?;
            load_toml(&mut c.config, text::utf8(bytes, "text")?)
        })
    }
}

#[cfg(feature = "toml")]
fn load_toml(config: &mut Config, text: &str) -> Result<(), Failure> {
    Ok(config.load_toml(text)?)
}

/// The function is there all the same: every build has the same ABI.
#[cfg(not(feature = "toml"))]
fn load_toml(_config: &mut Config, _text: &str) -> Result<(), Failure> {
    Err(Failure::new(GT2_ERR_UNSUPPORTED, "text: this library was built without the feature toml"))
}

/// Copies the whole config, every parameter with its documentation, as TOML that `gt2_config_load_toml` reads back to
/// the same values. `buffer`, `capacity`, `needed` and errors as for `gt2_config_get`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_to_toml(
    config: *const gt2_config,
    buffer: *mut c_char,
    capacity: usize,
    needed: *mut usize,
) -> gt2_status {
    // SAFETY: a handle and a buffer by the contract of the header.
    unsafe { guard_shared(config, |c| text::copy_out(&c.config.to_toml(), buffer, capacity, needed)) }
}

/// Number of parameters. 0 if `config` is not a config.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_parameter_count(config: *const gt2_config) -> usize {
    // SAFETY: a handle by the contract of the header.
    unsafe { find_in(config, 0, |c| Ok(c.table().parameters.len())) }
}

/// Describes parameter `index`, from 0 to `gt2_config_parameter_count() - 1`, in `*info`, whose `struct_size` the
/// caller has set. Its texts are static.
///
/// Errors: `GT2_ERR_NULL_POINTER`, `GT2_ERR_INVALID_ARGUMENT`, `GT2_ERR_STRUCT_SIZE`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_parameter_info(
    config: *const gt2_config,
    index: usize,
    info: *mut gt2_parameter_info,
) -> gt2_status {
    // SAFETY: a handle and an output by the contract of the header.
    unsafe {
        guard_shared(config, |c| {
            let all = &c.table().parameters;
            let found = all.get(index).ok_or_else(|| out_of_range(index, all.len(), "parameters"))?;
            structs::write(info, found.info())
        })
    }
}

/// Number of presets of the config's algorithm. 0 if `config` is not a config.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_preset_count(config: *const gt2_config) -> usize {
    // SAFETY: a handle by the contract of the header.
    unsafe { find_in(config, 0, |c| Ok(c.table().presets.len())) }
}

/// Name of preset `index`, from 0, the default, to `gt2_config_preset_count() - 1`. Static. NULL if there is no such
/// preset.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gt2_config_preset_name(config: *const gt2_config, index: usize) -> *const c_char {
    // SAFETY: a handle by the contract of the header.
    unsafe {
        find_in(config, null(), |c| {
            let all = &c.table().presets;
            Ok(all.get(index).ok_or_else(|| out_of_range(index, all.len(), "presets"))?.as_ptr())
        })
    }
}

fn out_of_range(index: usize, count: usize, what: &str) -> Failure {
    Failure::argument(format!("index: is {index}, there are {count} {what}"))
}

//! The algorithms that exist.

use std::ffi::c_char;
use std::ptr::null;

use super::guard::find;
use super::status::Failure;
use super::tables;

/// Number of algorithms in this library.
#[unsafe(no_mangle)]
pub extern "C" fn gt2_algorithm_count() -> usize {
    find(0, || Ok(tables::all().len()))
}

/// Name of algorithm `index`, from 0 to `gt2_algorithm_count() - 1`, as `gt2_config_new` takes it. Static. NULL if
/// there is no such algorithm.
#[unsafe(no_mangle)]
pub extern "C" fn gt2_algorithm_name(index: usize) -> *const c_char {
    find(null(), || Ok(entry(index)?.name.as_ptr()))
}

/// What algorithm `index` is, in one line of English. Static. NULL if there is no such algorithm.
#[unsafe(no_mangle)]
pub extern "C" fn gt2_algorithm_description(index: usize) -> *const c_char {
    find(null(), || Ok(entry(index)?.description.as_ptr()))
}

fn entry(index: usize) -> Result<&'static tables::AlgorithmTable, Failure> {
    let all = tables::all();
    all.get(index).ok_or_else(|| Failure::argument(format!("index: is {index}, there are {} algorithms", all.len())))
}

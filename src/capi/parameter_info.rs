//! The description of a parameter.

use std::ffi::c_char;

use super::structs::SizedStruct;

/// A parameter that is a real number.
pub const GT2_PARAMETER_NUMBER: i32 = 1;
/// A parameter that is a whole number.
pub const GT2_PARAMETER_INTEGER: i32 = 2;
/// A parameter that is true or false.
pub const GT2_PARAMETER_BOOLEAN: i32 = 3;
/// A parameter that is one of a list of names.
pub const GT2_PARAMETER_CHOICE: i32 = 4;
/// A parameter that is a list of rectangles in pixels; as text "left,top,width,height;left,top,width,height;...".
pub const GT2_PARAMETER_AREAS: i32 = 5;

/// Description of one parameter, filled by `gt2_config_parameter_info`. Start from `GT2_PARAMETER_INFO_INIT`. All
/// texts are static.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct gt2_parameter_info {
    /// `sizeof(gt2_parameter_info)`, set by the caller.
    pub struct_size: usize,
    /// Name by which it is set.
    pub key: *const c_char,
    /// One of `GT2_PARAMETER_...`.
    pub kind: i32,
    /// 0.
    pub reserved: i32,
    /// Value in a new config, as text.
    pub default_text: *const c_char,
    /// Smallest value of a number or integer, otherwise 0.
    pub minimum: f64,
    /// Largest value of a number or integer, otherwise 0.
    pub maximum: f64,
    /// Unit; "" for pure numbers. A tick is 1/30 s.
    pub unit: *const c_char,
    /// The symbol of the paper that the parameter comes from; "" if it has none.
    pub symbol: *const c_char,
    /// One paragraph of English.
    pub documentation: *const c_char,
    /// The names of a choice, `choice_count` of them; NULL for other kinds.
    pub choices: *const *const c_char,
    /// How many `choices` there are.
    pub choice_count: usize,
}

// SAFETY: repr(C), size first, raw pointers and numbers only.
unsafe impl SizedStruct for gt2_parameter_info {
    const NAME: &'static str = "info";
    const FIRST_SIZE: usize = size_of::<gt2_parameter_info>();
}

//! Tests that hold for every algorithm.

/// What class ids can mean.
pub const CLASS_POLICIES: [&str; 3] = ["ignore", "same_class", "separate"];

/// Makes of each `fn test(algorithm)` one test per algorithm, so that a failure has the algorithm's name.
#[macro_export]
macro_rules! for_every_algorithm {
    ($($(#[$meta:meta])* fn $test:ident($algorithm:ident: Algorithm) $body:block)+) => {$(
        $(#[$meta])*
        mod $test {
            use super::*;

            fn check($algorithm: Algorithm) $body

            $crate::for_every_algorithm!(@names tests);
        }
    )+};
    (@names $use:ident) => {
        $crate::for_every_algorithm! { @$use gentrack2 sort deepsort bytetrack ocsort botsort smiletrack conftrack }
    };
    (@tests $($name:ident)+) => {
        $(
            #[test]
            fn $name() {
                check(Algorithm::from_name(stringify!($name)).unwrap());
            }
        )+
    };
    (@list $($name:ident)+) => {
        [$(stringify!($name)),+]
    };
}

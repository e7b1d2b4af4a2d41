#![no_main]

#[path = "../drive/mod.rs"]
mod drive;

libfuzzer_sys::fuzz_target!(
    // The fuzzer ends the process at any panic; here some are caught, as the C ABI does. Others still end it.
    init: std::panic::set_hook(Box::new(|_| ())),
    |data: &[u8]| drive::snapshot::run(data)
);

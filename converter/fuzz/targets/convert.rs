#![no_main]

libfuzzer_sys::fuzz_target!(
    init: groma_fuzz::abort_on_panic(),
    |data: &[u8]| groma_fuzz::convert(data)
);

#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| mean_information_test_support::properties::bag_folder(bytes));

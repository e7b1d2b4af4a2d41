//! The reader of configurations.

use gentrack2::Config;

/// Whatever the text is, it is read or refused; what was read can be written and read again to the same.
pub fn run(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let mut config = Config::new("gentrack2").expect("it exists");
    let before = config.clone();
    match config.load_toml(text) {
        Err(error) => {
            assert!(!error.to_string().is_empty());
            assert_eq!(config, before, "a refused text changes nothing");
        }
        Ok(()) => {
            let mut again = Config::new("sort").expect("it exists");
            again.load_toml(&config.to_toml()).expect("what was written can be read");
            assert_eq!(again, config);
        }
    }
}

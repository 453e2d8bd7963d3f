//! Brings the page for browsers into the command: that which `MEANINFO_PAGE` names, built by `bindings/web/build.sh`; none if it
//! is not set, as the page takes a compiler for WebAssembly.

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-env-changed=MEANINFO_PAGE");
    let page = env::var_os("MEANINFO_PAGE").filter(|path| !path.is_empty()).map(PathBuf::from);
    let bytes = page.map_or_else(Vec::new, |path| {
        println!("cargo::rerun-if-changed={}", path.display());
        fs::read(&path).unwrap_or_else(|error| panic!("MEANINFO_PAGE is {}: {error}", path.display()))
    });
    let folder = env::var_os("OUT_DIR").map(PathBuf::from).expect("cargo names a folder");
    fs::write(folder.join("page.html"), bytes).expect("cargo's folder can be written to");
}

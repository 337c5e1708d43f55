//! Tells the linker that Python, which loads the module, brings the symbols of its own.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    pyo3_build_config::add_extension_module_link_args();
}

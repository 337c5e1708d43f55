//! Files of the page are part of the program: a new one is a change.

fn main() {
    println!("cargo:rerun-if-changed=assets");
}

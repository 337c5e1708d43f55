//! The page's files, embedded in the program.

use rust_embed::RustEmbed;

/// The page and all that it is made of, within the program.
#[derive(RustEmbed)]
#[folder = "assets/"]
struct Assets;

/// A file of the page by its name: its bytes, media type and ETag; `None` if no such file was embedded.
pub fn file(name: &str) -> Option<(Vec<u8>, &'static str, String)> {
    let found = Assets::get(name)?;
    let kind = match name.rsplit_once('.').map(|(_, extension)| extension) {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("svg") => "image/svg+xml",
        _ => "application/octet-stream",
    };
    let print: String =
        found.metadata.sha256_hash().iter().take(8).map(|byte| format!("{byte:02x}")).collect();
    Some((found.data.into_owned(), kind, format!("\"{print}\"")))
}

//! The functions that JavaScript calls, and the two of its own that are called here. Bytes cross in a buffer of this module: who calls writes
//! what it has to say where [`room`] tells, and reads what it is told at [`said`].
//!
//! What is unsafe is sound because the two imports take numbers alone and keep no pointer, and because names of exported functions are
//! those of no other symbol.
#![allow(unsafe_code)]

use crate::{Message, Page};
use std::cell::RefCell;
use unripple::core::clock;
use unripple_store::load_surface;

#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Seconds since the beginning of 1970, UTC.
    safe fn now_s() -> f64;
    /// Tells why the program fails, as UTF-8 at an address.
    safe fn fail(at: *const u8, length: usize);
}

thread_local! {
    static PAGE: RefCell<Option<Page>> = const { RefCell::new(None) };
    /// What the page has to say, or what it is told.
    static BUFFER: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// Kinds of what [`next`] gives.
const NOTHING: u32 = 0;
const TEXT: u32 = 1;
const FRAME: u32 = 2;

/// Makes room for bytes from the page, and returns the address at which they are to be written.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    BUFFER.with_borrow_mut(|buffer| {
        buffer.clear();
        buffer.resize(length, 0);
        buffer.as_mut_ptr()
    })
}

/// Address of the bytes that the page is told.
#[unsafe(no_mangle)]
pub extern "C" fn said() -> *const u8 {
    BUFFER.with_borrow(|buffer| buffer.as_ptr())
}

/// Number of the bytes that the page is told.
#[unsafe(no_mangle)]
pub extern "C" fn said_length() -> usize {
    BUFFER.with_borrow(Vec::len)
}

/// Opens a session with the built-in surface whose name was written. Returns 1, or 0 with the reason told.
#[unsafe(no_mangle)]
pub extern "C" fn open() -> u32 {
    std::panic::set_hook(Box::new(|panic| {
        let text = panic.to_string();
        fail(text.as_ptr(), text.len());
    }));
    clock::provide(|| now_s());
    let name = heard();
    let opened = load_surface(&name)
        .map_err(|error| error.to_string())
        .and_then(|surface| Page::open(surface, name).map_err(|error| error.to_string()));
    answer(opened.map(|page| PAGE.set(Some(page))))
}

/// Carries out the message of the page that was written.
#[unsafe(no_mangle)]
pub extern "C" fn hear() {
    let text = heard();
    with(|page| page.hear(&text));
}

/// Replaces the surface by that of the file whose text was written. Returns 1, or 0 with its faults told.
#[unsafe(no_mangle)]
pub extern "C" fn load() -> u32 {
    let text = heard();
    answer(with(|page| page.load(&text)).unwrap_or_else(|| Err("no surface is open yet".into())))
}

/// Tells the bytes of the file whose name was written, of the measurement of a number, or of the newest for a negative one. Returns 1, or
/// 0 if there is no such file.
#[unsafe(no_mangle)]
pub extern "C" fn file(id: f64) -> u32 {
    let name = heard();
    let id = (id >= 0.0).then_some(id as u64);
    let found = with(|page| page.file(&name, id)).flatten();
    let is = u32::from(found.is_some());
    tell(found.unwrap_or_default());
    is
}

/// Lets time pass.
#[unsafe(no_mangle)]
pub extern "C" fn tick() {
    with(Page::tick);
}

/// Does one piece of long work; returns 1 if there was one, else 0.
#[unsafe(no_mangle)]
pub extern "C" fn work() -> u32 {
    u32::from(with(Page::work).unwrap_or(false))
}

/// Tells the next message to the page, and returns its kind: 1 for text, 2 for a picture, 0 if there is none.
#[unsafe(no_mangle)]
pub extern "C" fn next() -> u32 {
    match with(Page::take).flatten() {
        None => NOTHING,
        Some(Message::Text(text)) => {
            tell(text.into_bytes());
            TEXT
        }
        Some(Message::Frame(bytes)) => {
            tell(bytes);
            FRAME
        }
    }
}

fn with<R>(act: impl FnOnce(&mut Page) -> R) -> Option<R> {
    PAGE.with_borrow_mut(|page| page.as_mut().map(act))
}

/// The text that was written; what is no UTF-8 in it is replaced.
fn heard() -> String {
    BUFFER.with_borrow(|buffer| String::from_utf8_lossy(buffer).into_owned())
}

fn tell(bytes: Vec<u8>) {
    BUFFER.set(bytes);
}

fn answer(done: Result<(), String>) -> u32 {
    let is = u32::from(done.is_ok());
    tell(done.err().unwrap_or_default().into_bytes());
    is
}

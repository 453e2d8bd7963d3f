//! What JavaScript calls, and the function of the page that is called: all `unsafe` there is.
//!
//! | exported | what it does |
//! |---|---|
//! | `request(length)` | makes room for a request of so many bytes, and returns where it is to be written |
//! | `ask()` | answers the request: 0 if it was done, 1 if it was refused |
//! | `answer()`, `answer_length()` | where the answer lies until the next request, and how long it is |
//!
//! Imported from the module `page`: `read(file, at, into, length)` copies up to `length` bytes of a file from byte `at` to `into`
//! and returns their number, negative if the file cannot be read; `fault(text, length)` takes the message of a fault of this
//! program before it stops.
#![expect(unsafe_code, reason = "names that are not mangled, and calls of the page's functions")]

use crate::session::Session;
use std::cell::RefCell;
use std::panic;
use std::sync::Once;

/// What lies between the calls.
struct Exchange {
    request: Vec<u8>,
    answer: Vec<u8>,
    session: Session,
}

thread_local! {
    static EXCHANGE: RefCell<Exchange> =
        RefCell::new(Exchange { request: Vec::new(), answer: Vec::new(), session: Session::new(read) });
}

#[cfg(target_arch = "wasm32")]
mod page {
    // The page keeps to these signatures; a length tells how much of this memory it may touch, and it touches no more.
    #[link(wasm_import_module = "page")]
    unsafe extern "C" {
        pub(super) fn read(file: u32, at: f64, into: *mut u8, length: usize) -> i32;
        pub(super) fn fault(text: *const u8, length: usize);
    }
}

/// Reads a piece of a file of the page; `None` if it cannot be read.
#[cfg(target_arch = "wasm32")]
fn read(file: u32, at: u64, into: &mut [u8]) -> Option<usize> {
    let length = into.len().min(i32::MAX as usize);
    // SAFETY: the page writes at most `length` bytes from `into` on, all of which this slice holds, and keeps no pointer.
    let read = unsafe { page::read(file, at as f64, into.as_mut_ptr(), length) };
    usize::try_from(read).ok().filter(|&read| read <= length)
}

/// Reads nothing: there is a page only in WebAssembly.
#[cfg(not(target_arch = "wasm32"))]
fn read(_: u32, _: u64, _: &mut [u8]) -> Option<usize> {
    None
}

/// Tells the page of a fault before the program stops.
fn tell(fault: &str) {
    #[cfg(target_arch = "wasm32")]
    // SAFETY: the page reads the `length` bytes of this text and keeps no pointer.
    unsafe {
        page::fault(fault.as_ptr(), fault.len());
    }
    #[cfg(not(target_arch = "wasm32"))]
    let _ = fault;
}

// SAFETY of the names below: nothing else in the module is called so.

/// Makes room for a request, and returns where it is to be written.
#[unsafe(no_mangle)]
extern "C" fn request(length: usize) -> *mut u8 {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| panic::set_hook(Box::new(|fault| tell(&fault.to_string()))));
    EXCHANGE.with_borrow_mut(|exchange| {
        exchange.request.clear();
        exchange.request.resize(length, 0);
        exchange.request.as_mut_ptr()
    })
}

/// Answers the request: 0 if it was done, 1 if it was refused.
#[unsafe(no_mangle)]
extern "C" fn ask() -> u32 {
    EXCHANGE.with_borrow_mut(|exchange| {
        exchange.answer = Vec::new();
        let answered = exchange.session.ask(&exchange.request);
        let refused = u32::from(answered.is_err());
        exchange.answer = answered.unwrap_or_else(String::into_bytes);
        refused
    })
}

/// Returns where the answer lies.
#[unsafe(no_mangle)]
extern "C" fn answer() -> *const u8 {
    EXCHANGE.with_borrow(|exchange| exchange.answer.as_ptr())
}

/// Returns the number of bytes of the answer.
#[unsafe(no_mangle)]
extern "C" fn answer_length() -> usize {
    EXCHANGE.with_borrow(|exchange| exchange.answer.len())
}

//! Tests of `meaninfo port` and `meaninfo check`, in a program of their own that is also the ports it tests.

mod check;
mod common;

fn main() -> std::process::ExitCode {
    check::main()
}

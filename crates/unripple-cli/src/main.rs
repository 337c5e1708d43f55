//! `unripple`: time-reversed focusing of touch, from the command line.

use std::process::ExitCode;

fn main() -> ExitCode {
    unripple_cli::command_line(std::env::args_os()).into()
}

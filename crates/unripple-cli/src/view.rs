//! `unripple view`: shows a surface in a browser.

use crate::args::ViewOptions;
use crate::common::Common;
use crate::error::CliError;
use crate::interrupt;
use crate::output;
use crate::progress::Terminal;
use std::net::{IpAddr, Ipv4Addr};
use std::process::{Command, Stdio};
use unripple_tasks::TaskError;
use unripple_viewer::task::{self, Ask};

/// Serves the page for a surface, and opens a browser if asked to.
pub fn run(options: &ViewOptions, common: &Common) -> Result<(), CliError> {
    let ask = Ask {
        surface: common.surface(&options.surface),
        device: options.device.ask(),
        method: options.method.into(),
        follow_tension: options.follow_tension,
        listen: options.listen.unwrap_or(IpAddr::V4(Ipv4Addr::LOCALHOST)),
        port: options.port,
        token: options.token.clone(),
        framed_by: options.framed_by.clone(),
        folder: options.folder.clone(),
        seconds: options.seconds,
    };
    let record = output::record(common.json, &ask)?;
    if options.until_input_ends {
        interrupt::wish_when_input_ends()?;
    }
    task::run(&ask, &mut Terminal::that_stops(), &mut |report| {
        output::recorded(report, record.as_ref()).map_err(TaskError::work)?;
        eprintln!("open the address in a browser; Ctrl+C ends");
        if !options.no_browser {
            browse(&report.url);
        }
        Ok(())
    })?;
    Ok(())
}

/// Opens an address in the browser of whoever sits here; that there is none is no fault.
fn browse(url: &str) {
    let opener = if cfg!(target_os = "macos") { "open" } else { "xdg-open" };
    let _ = Command::new(opener)
        .arg(url)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
}

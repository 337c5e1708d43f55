//! Report of the task `view`: the addresses of the page.

use serde::Serialize;

/// Addresses at which a surface is shown, once pages can be opened.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Report {
    /// URL to open in a browser on this machine, including the token.
    pub url: String,
    /// URL for other machines of the network; `None` if only this machine can connect.
    pub elsewhere: Option<String>,
    /// Origins whose pages may show this page in a frame.
    pub framed_by: Vec<String>,
}

impl unripple_tasks::Report for Report {
    fn text(&self) -> String {
        let line = |there: &String| format!("{there}  from elsewhere on this network\n");
        format!("{}\n{}", self.url, self.elsewhere.as_ref().map_or(String::new(), line))
    }
}

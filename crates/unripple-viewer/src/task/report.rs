//! Where a surface is shown.

use serde::Serialize;

/// Where a surface is shown, from when it can be.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Report {
    /// The address to open in a browser of this machine, the token in it.
    pub url: String,
    /// The address for other machines of the network, where such are listened to.
    pub elsewhere: Option<String>,
}

impl unripple_tasks::Report for Report {
    fn text(&self) -> String {
        let line = |there: &String| format!("{there}  from elsewhere on this network\n");
        format!("{}\n{}", self.url, self.elsewhere.as_ref().map_or(String::new(), line))
    }
}

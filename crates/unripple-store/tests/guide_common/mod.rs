//! Guides as their tests read them.

/// Text of the fenced blocks that begin with this line.
pub fn blocks(guide: &str, fence: &str) -> Vec<String> {
    let mut blocks: Vec<String> = Vec::new();
    let mut inside = false;
    for line in guide.lines() {
        if line.starts_with("```") {
            inside = !inside && line == fence;
            if inside {
                blocks.push(String::new());
            }
        } else if let (true, Some(block)) = (inside, blocks.last_mut()) {
            block.push_str(line);
            block.push('\n');
        }
    }
    blocks
}

/// The cells of every table row whose first is code, with the `## [section]` that it stands in.
pub fn rows(guide: &str) -> Vec<(&str, Vec<&str>)> {
    let mut section = "";
    let mut rows = Vec::new();
    for line in guide.lines() {
        if let Some(heading) = line.strip_prefix("## ") {
            section = heading.trim_matches(['[', ']']);
        } else if line.starts_with("| `") {
            rows.push((section, line.trim_matches('|').split('|').map(str::trim).collect()));
        }
    }
    rows
}

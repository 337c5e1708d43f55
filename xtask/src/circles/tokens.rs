//! Rust text as names and signs, without comments, strings and attributes' text.

/// Names, `::` and single signs, in order.
pub fn tokens(text: &str) -> Vec<String> {
    let chars: Vec<char> = text.chars().collect();
    let mut found = Vec::new();
    let mut i = 0;
    while i < chars.len() {
        let rest = &chars[i..];
        if let Some(length) = skipped(rest) {
            i += length;
        } else if rest[0].is_alphanumeric() || rest[0] == '_' {
            let length = rest.iter().position(|c| !(c.is_alphanumeric() || *c == '_')).unwrap_or(rest.len());
            found.push(rest[..length].iter().collect());
            i += length;
        } else if rest.starts_with(&[':', ':']) {
            found.push("::".into());
            i += 2;
        } else {
            if !rest[0].is_whitespace() {
                found.push(rest[0].to_string());
            }
            i += 1;
        }
    }
    found
}

/// Length of a comment, string, character or lifetime that begins here.
fn skipped(rest: &[char]) -> Option<usize> {
    let end_of = |i: usize| Some(i.min(rest.len()));
    match rest {
        ['/', '/', ..] => end_of(rest.iter().position(|c| *c == '\n').unwrap_or(rest.len())),
        ['/', '*', ..] => {
            let end = rest.windows(2).skip(2).position(|pair| pair == ['*', '/']);
            end_of(end.map_or(rest.len(), |end| end + 4))
        }
        ['"', ..] => end_of(quoted(rest, '"')),
        ['b', '"', ..] => end_of(1 + quoted(&rest[1..], '"')),
        ['r', '"' | '#', ..] => raw(&rest[1..]).map(|length| length + 1),
        ['b', 'r', '"' | '#', ..] => raw(&rest[2..]).map(|length| length + 2),
        ['\'', '\\', ..] => end_of(quoted(rest, '\'')),
        ['\'', _, '\'', ..] => Some(3),
        ['\'', ..] => Some(1),
        _ => None,
    }
}

/// Length of a literal with its quotation marks, in which a backslash takes away the next character's meaning.
fn quoted(rest: &[char], mark: char) -> usize {
    let mut i = 1;
    while i < rest.len() && rest[i] != mark {
        i += if rest[i] == '\\' { 2 } else { 1 };
    }
    i + 1
}

/// Length of a raw string after its `r`; nothing if it is a raw name.
fn raw(rest: &[char]) -> Option<usize> {
    let hashes = rest.iter().take_while(|c| **c == '#').count();
    if rest.get(hashes) != Some(&'"') {
        return None;
    }
    let mut close = vec!['"'];
    close.resize(1 + hashes, '#');
    let body = &rest[hashes + 1..];
    let end = body.windows(close.len()).position(|part| part == close).unwrap_or(body.len());
    Some((hashes + 1 + end + close.len()).min(rest.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_code_is_left() {
        let text = "a::b /* c */ // d\n r#\"e\"# \"f\\\"g\" 'h' &'i j b\"k\" '\\'' r\"l\"";
        assert_eq!(tokens(text), ["a", "::", "b", "&", "i", "j"]);
    }
}

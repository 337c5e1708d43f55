//! The known name nearest to a misspelt one: edit distance.

/// Longest name compared, in characters; what is longer was not meant as any known name.
const LONGEST: usize = 64;

/// The known name nearest to `found`, ignoring letter case; `None` if no name is near enough to have been
/// meant.
pub fn nearest<'k>(found: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    let found = found.trim().to_lowercase();
    if found.chars().count() > LONGEST {
        return None;
    }
    known
        .into_iter()
        .map(|name| (cost(&found, &name.to_lowercase()), name))
        .min_by_key(|(cost, _)| *cost)
        .filter(|(cost, name)| *cost <= 1 + name.chars().count().max(found.chars().count()) / 3)
        .map(|(_, name)| name)
}

/// Edit distance, except that a name with its unit left off or its end cut counts as one edit away.
fn cost(found: &str, name: &str) -> usize {
    let cut = found.len() >= 3 && (name.starts_with(found) || found.starts_with(name));
    let distance = edit_distance(found, name);
    if cut { distance.min(1) } else { distance }
}

/// Insertions, deletions, replacements and swaps of neighbours between two words (Damerau-Levenshtein distance, as
/// optimal string alignment).
fn edit_distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut before = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let replaced = last[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            row[j] = replaced.min(last[j] + 1).min(row[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before[j - 2] + 1);
            }
        }
        before = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_edits() {
        for (a, b, distance) in
            [("", "", 0), ("", "abc", 3), ("kitten", "sitting", 3), ("edge", "egde", 1), ("ab", "ba", 1)]
        {
            assert_eq!(edit_distance(a, b), distance, "{a} {b}");
            assert_eq!(edit_distance(b, a), distance, "{b} {a}");
        }
    }

    #[test]
    fn finds_what_was_meant() {
        let keys = ["thickness_mm", "tension_n_per_m", "material"];
        assert_eq!(nearest("thicknes_mm", keys), Some("thickness_mm"));
        assert_eq!(nearest("thickness", keys), Some("thickness_mm"));
        assert_eq!(nearest("Material", keys), Some("material"));
        assert_eq!(nearest("colour", keys), None);
        assert_eq!(nearest(&"x".repeat(100_000), keys), None);
    }
}

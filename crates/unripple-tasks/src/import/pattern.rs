//! Patterns of names that say actuator and place, such as `{actuator}_{x_mm}_{y_mm}.wav`.

use crate::TaskError;

/// A part of a pattern.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Part {
    Literal(String),
    /// A field by its name.
    Field(String),
}

/// A pattern of names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Pattern {
    parts: Vec<Part>,
}

/// Fields that a pattern may have; `any` stands for what says nothing.
const FIELDS: [&str; 8] = ["actuator", "x", "y", "x_m", "y_m", "x_mm", "y_mm", "any"];

impl Pattern {
    /// Reads a pattern: fields in braces, with other letters between them.
    ///
    /// # Errors
    /// [`TaskError::Ask`] of a field that is not known, of two fields with nothing between them, and of braces that do not match.
    pub fn of(text: &str) -> Result<Self, TaskError> {
        let refused = |expected: String| TaskError::ask("pattern", expected, format!("`{text}`"));
        let mut parts = Vec::new();
        let mut rest = text;
        while let Some(open) = rest.find('{') {
            let (literal, after) = rest.split_at(open);
            if !literal.is_empty() {
                parts.push(Part::Literal(literal.to_owned()));
            } else if matches!(parts.last(), Some(Part::Field(_))) {
                return Err(refused("something between two fields".into()));
            }
            let (name, after) = after[1..]
                .split_once('}')
                .ok_or_else(|| refused("a brace at the end of each field".into()))?;
            if !FIELDS.contains(&name) {
                return Err(refused(format!("fields among {}", FIELDS.join(", "))));
            }
            parts.push(Part::Field(name.to_owned()));
            rest = after;
        }
        if !rest.is_empty() {
            parts.push(Part::Literal(rest.to_owned()));
        }
        Ok(Self { parts })
    }

    /// The fields of a name with their texts; `None` if the name is not of this pattern.
    pub fn fields<'n>(&self, name: &'n str) -> Option<Vec<(&str, &'n str)>> {
        let mut fields = Vec::new();
        let mut rest = name;
        let mut parts = self.parts.iter().peekable();
        while let Some(part) = parts.next() {
            match (part, parts.peek()) {
                (Part::Literal(literal), _) => rest = rest.strip_prefix(literal.as_str())?,
                (Part::Field(field), Some(Part::Literal(literal))) => {
                    // The last literal is the end of the name, so that a point may be in a number before it.
                    let last = self.parts.last() == Some(&Part::Literal(literal.clone()))
                        && fields.len() + 1 == self.count();
                    let end = if last {
                        rest.len().checked_sub(literal.len())?
                    } else {
                        rest.find(literal.as_str())?
                    };
                    fields.push((field.as_str(), rest.get(..end)?));
                    rest = &rest[end..];
                }
                (Part::Field(field), _) => {
                    fields.push((field.as_str(), rest));
                    rest = "";
                }
            }
        }
        (rest.is_empty() && fields.iter().all(|(_, text)| !text.is_empty())).then_some(fields)
    }

    /// Number of fields.
    fn count(&self) -> usize {
        self.parts.iter().filter(|part| matches!(part, Part::Field(_))).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_taken_apart() {
        let pattern = Pattern::of("{actuator}_{x_mm}_{y_mm}.wav").unwrap();
        assert_eq!(
            pattern.fields("a1_62.5_-90.wav").unwrap(),
            [("actuator", "a1"), ("x_mm", "62.5"), ("y_mm", "-90")]
        );
        for other in ["a1_62.wav", "a1_62_90.csv", "_62_90.wav", "", "a1_62_90.wav.bak"] {
            assert_eq!(pattern.fields(other), None, "{other}");
        }
        let pattern = Pattern::of("run {any}, {actuator}").unwrap();
        assert_eq!(pattern.fields("run 3, 17").unwrap(), [("any", "3"), ("actuator", "17")]);
        assert_eq!(
            Pattern::of("{x}{y}").unwrap_err().to_string(),
            "pattern: expected something between two fields, found `{x}{y}`"
        );
        assert!(Pattern::of("{z}").is_err() && Pattern::of("{x").is_err());
    }
}

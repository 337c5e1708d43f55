//! Keys of a surface file set to other values before it is read.

use crate::StoreError;
use toml_edit::{DocumentMut, Item, Table, TableLike, Value};

/// Sets keys of the text of a surface file to other values, and returns the new text. `keys` has pairs of a key's
/// path, as messages write it (`sheet.tension_n_per_m`, `actuator[3].at_mm`), and of a value as the file would write
/// it. The quotes of a text may be left out; an empty value removes the key. A text that is not TOML is returned
/// unchanged, for its reader to refuse. `file` is the file's name in messages.
///
/// # Errors
/// [`StoreError::Content`] for a path that is invalid, passes through a value without keys, or has an index beyond
/// the end of a list.
///
/// ```
/// let text = "[sheet]\nmaterial = \"glass\"\nloss_factor = 0.01\n";
/// let keys = [("sheet.material", "steel"), ("sheet.thickness_mm", "0.5"), ("sheet.loss_factor", "")];
/// let keys = keys.map(|(key, value)| (key.to_owned(), value.to_owned()));
/// let set = unripple_store::set_keys(text, "plate.toml", &keys)?;
/// assert_eq!(set, "[sheet]\nmaterial = \"steel\"\nthickness_mm = 0.5\n");
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
pub fn set_keys(text: &str, file: &str, keys: &[(String, String)]) -> Result<String, StoreError> {
    if keys.is_empty() {
        return Ok(text.to_owned());
    }
    let Ok(mut document) = text.parse::<DocumentMut>() else { return Ok(text.to_owned()) };
    for (key, value) in keys {
        let refused = |found: String| StoreError::content(file, "a key of a surface file to set", found);
        let path = steps(key).ok_or_else(|| refused(format!("`{key}`")))?;
        let value = match value.trim() {
            "" => None,
            text => Some(text.parse::<Value>().unwrap_or_else(|_| text.into())),
        };
        in_table(document.as_table_mut(), &path, value).map_err(|why| refused(format!("`{key}`, {why}")))?;
    }
    Ok(document.to_string())
}

/// One step along a key's path.
enum Step<'k> {
    Key(&'k str),
    Index(usize),
}

/// The steps of a path such as `actuator[3].at_mm`; nothing if it is none.
fn steps(path: &str) -> Option<Vec<Step<'_>>> {
    let mut steps = Vec::new();
    for part in path.split('.') {
        let (name, mut rest) = part.split_at(part.find('[').unwrap_or(part.len()));
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if name.is_empty() || !name.chars().all(plain) {
            return None;
        }
        steps.push(Step::Key(name));
        while let Some(index) = rest.strip_prefix('[') {
            let (number, after) = index.split_once(']')?;
            steps.push(Step::Index(number.parse().ok()?));
            rest = after;
        }
        if !rest.is_empty() {
            return None;
        }
    }
    Some(steps)
}

/// Sets or removes the value at a path that begins in a table; the error says why there is no such place.
fn in_table(table: &mut dyn TableLike, path: &[Step<'_>], value: Option<Value>) -> Result<(), String> {
    let [Step::Key(key), rest @ ..] = path else { return Err("which is a table: name a key in it".into()) };
    match (rest, value) {
        ([], Some(value)) => drop(table.insert(key, Item::Value(value))),
        ([], None) => drop(table.remove(key)),
        (rest, value) => {
            let missing = || Item::Table(Table::new());
            return in_item(table.entry(key).or_insert_with(missing), rest, value);
        }
    }
    Ok(())
}

/// As [`in_table`], for a path that begins at any item.
fn in_item(item: &mut Item, path: &[Step<'_>], value: Option<Value>) -> Result<(), String> {
    let [Step::Index(index), rest @ ..] = path else {
        let table = item.as_table_like_mut().ok_or("but a value has no keys")?;
        return in_table(table, path, value);
    };
    let beyond = |count: usize| format!("but there are only {count}, counted from 0");
    match item {
        Item::ArrayOfTables(tables) => {
            let count = tables.len();
            in_table(tables.get_mut(*index).ok_or_else(|| beyond(count))?, rest, value)
        }
        Item::Value(Value::Array(list)) => {
            let count = list.len();
            let here = list.get_mut(*index).ok_or_else(|| beyond(count))?;
            match (rest, value) {
                ([], Some(value)) => *here = value,
                ([], None) => drop(list.remove(*index)),
                (rest, value) => {
                    let table = here.as_inline_table_mut().ok_or("but a value has no keys")?;
                    return in_table(table, rest, value);
                }
            }
            Ok(())
        }
        _ => Err("but only a list has numbered items".into()),
    }
}

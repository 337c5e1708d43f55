//! SVG files bounded before they are read: depth, size, copies.

use crate::StoreError;
use std::collections::HashMap;
use usvg::roxmltree::{Document, Node, NodeId, ParsingOptions};

/// Deepest nesting of elements: the reader calls itself for each level, and its stack is bounded.
const DEEPEST: usize = 64;
/// Largest number of elements and other nodes, copies made by `use` included. Drawings of rims have tens; the work of conversion
/// grows with their number.
const MOST_NODES: u32 = 20_000;
/// Largest number of attributes of one element, counted before anything is parsed; drawings have tens.
const MOST_ATTRIBUTES: usize = 200;
/// Largest number of bytes of style sheets: each holds rules that are tried on every element.
const MOST_STYLE: usize = 16 << 10;
/// Largest number of bytes of style sheets times nodes: each rule is tried on each element.
const MOST_MATCHES: usize = 40_000_000;

/// The XML of a document that is safe to convert: bounded in depth, size and copies, and without what would change
/// shapes in ways that are not followed.
pub(super) fn document<'t>(text: &'t str, name: &str) -> Result<Document<'t>, StoreError> {
    let refuse = |expected: &str, found: String| StoreError::content(name, expected, found);
    if text.contains("<!ENTITY") {
        return Err(refuse("a drawing without entities", "<!ENTITY".into()));
    }
    if let Some(attributes) = crowded(text) {
        return Err(refuse(
            &format!("at most {MOST_ATTRIBUTES} attributes to an element"),
            attributes.to_string(),
        ));
    }
    let options = ParsingOptions { allow_dtd: true, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options)
        .map_err(|error| refuse("an SVG document", error.to_string()))?;
    let depth = depth(document.root());
    if depth > DEEPEST {
        return Err(refuse(&format!("elements nested at most {DEEPEST} deep"), format!("{depth}")));
    }
    let style: usize = elements(&document, "style").filter_map(|n| n.text()).map(str::len).sum();
    let most = MOST_STYLE.min(MOST_MATCHES / document.descendants().count().max(1));
    if style > most {
        return Err(refuse(
            &format!("at most {most} bytes of style sheets, given the number of elements"),
            style.to_string(),
        ));
    }
    let ids = ids(&document);
    for node in document.descendants() {
        effects(node, &ids).map_err(|found| {
            refuse("plain shapes (apply clipping, masks, patterns, markers and filters first)", found)
        })?;
    }
    copies(&document, &ids).map_err(|found| refuse("a drawing with few and simple copies", found))?;
    Ok(document)
}

/// A count of equals signs between two angle brackets past the limit, which bounds the attributes of any element.
fn crowded(text: &str) -> Option<usize> {
    let mut within = text.split('<').map(|tag| tag.matches(['=']).count());
    within.find(|count| *count > MOST_ATTRIBUTES)
}

fn depth(root: Node) -> usize {
    let (mut node, mut depth, mut deepest) = (root, 0, 0);
    loop {
        if let Some(child) = node.first_child() {
            (node, depth) = (child, depth + 1);
            deepest = deepest.max(depth);
            continue;
        }
        while node.next_sibling().is_none() {
            match node.parent() {
                Some(parent) => (node, depth) = (parent, depth - 1),
                None => return deepest,
            }
        }
        let Some(sibling) = node.next_sibling() else { return deepest };
        node = sibling;
    }
}

fn elements<'d>(document: &'d Document<'d>, name: &'d str) -> impl Iterator<Item = Node<'d, 'd>> {
    document.descendants().filter(move |n| n.is_element() && n.tag_name().name() == name)
}

type Ids<'d> = HashMap<&'d str, Vec<Node<'d, 'd>>>;

fn ids<'d>(document: &'d Document<'d>) -> Ids<'d> {
    let mut ids: Ids = HashMap::new();
    for node in document.descendants() {
        for attribute in node.attributes().filter(|a| a.name() == "id") {
            ids.entry(attribute.value()).or_default().push(node);
        }
    }
    ids
}

/// Refuses a reference to anything but a gradient from an attribute or a style sheet.
fn effects(node: Node, ids: &Ids) -> Result<(), String> {
    let style = (node.is_element() && node.tag_name().name() == "style").then(|| node.text()).flatten();
    for text in node.attributes().map(|a| a.value()).chain(style) {
        let lower = text.to_ascii_lowercase();
        for (start, _) in lower.match_indices("url") {
            let rest = &text[start..];
            let inside = rest.split_once('(').and_then(|(_, r)| r.split_once(')')).map(|(inside, _)| inside);
            let id = inside.unwrap_or(rest).trim_matches(|c: char| c.is_whitespace() || "'\"#".contains(c));
            let paint = |n: &Node| matches!(n.tag_name().name(), "linearGradient" | "radialGradient");
            if let Some(other) = ids.get(id).and_then(|nodes| nodes.iter().find(|n| !paint(n))) {
                return Err(format!("a reference to <{} id=\"{id}\">", other.tag_name().name()));
            }
        }
    }
    Ok(())
}

/// Refuses copies of copies, and more copies than the limit on nodes.
fn copies<'d>(document: &'d Document<'d>, ids: &Ids<'d>) -> Result<(), String> {
    let mut sizes: HashMap<NodeId, usize> = HashMap::new();
    let mut total = 0;
    for copy in elements(document, "use") {
        for href in copy.attributes().filter(|a| a.name() == "href") {
            for target in ids.get(href.value().trim().trim_start_matches('#')).into_iter().flatten() {
                total += *sizes.entry(target.id()).or_insert_with(|| target.descendants().count());
                if total > MOST_NODES as usize {
                    return Err(format!("more than {MOST_NODES} elements made by <use>"));
                }
                if target.descendants().any(|n| n.is_element() && n.tag_name().name() == "use") {
                    return Err(format!("a copy of a copy, <use href=\"{}\">", href.value()));
                }
            }
        }
    }
    Ok(())
}

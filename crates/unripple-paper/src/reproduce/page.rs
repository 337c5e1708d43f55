//! The page of `reproduce`, as Markdown and HTML.

use super::{Compared, Picture, Predicted, Section};
use std::fmt::Write;

/// Style of the page, its title, the paper's own reference, and the headings of its comparisons and predictions.
const STYLE: &str = include_str!("page.css");
const TITLE: &str = "Time-reversed touch, reproduced";
const PAPER: &str = "C. Hudin, J. Lozada, M. Wiertlewski and V. Hayward, “Tradeoffs in the application of time-reversed \
                     acoustics to tactile stimulation”, EuroHaptics 2012";
const COMPARED: (&str, [&str; 4]) = ("Beside the paper", ["Quantity", "Paper", "Here", "Why they differ"]);
const PREDICTED: (&str, [&str; 3]) =
    ("Predictions, for which the paper has no figure", ["Quantity", "Here", "How it comes about"]);

/// Least and greatest width on a screen that represents one millimetre of a figure, in rem. Below the
/// least, letters are too small for a screen; above the greatest, figures do not fit one.
const LEAST: f64 = 0.2;
const MOST: f64 = 0.31;

fn opening() -> String {
    format!(
        "The table and figures of {PAPER}, computed again on the built-in surface hudin-2012: the paper's film, clamped, \
         in vacuum, with ideal force actuators. What is under “Here” was computed for this page from the data of that surface. \
         Where the paper has no figure, what is computed is a prediction, in a table of its own."
    )
}

/// The page as Markdown.
pub fn markdown(sections: &[Section]) -> String {
    let mut text = format!("# {TITLE}\n\n{}\n", opening());
    for section in sections {
        let _ = write!(text, "\n## {}\n", section.title);
        for paragraph in &section.text {
            let _ = write!(text, "\n{paragraph}\n");
        }
        for picture in &section.figures {
            let file = picture.files().pop().unwrap_or_default();
            let _ = write!(text, "\n![{}]({file})\n\n*{}*\n", cell(picture.alternative()), picture.caption);
        }
        markdown_table(&mut text, &section.table);
        for (heading, _, rows) in facing(section) {
            let _ = write!(text, "\n### {heading}\n");
            markdown_table(&mut text, &rows);
        }
    }
    text
}

fn markdown_table(text: &mut String, rows: &[Vec<String>]) {
    let Some((headings, rows)) = rows.split_first() else { return };
    let line =
        |row: &[String]| format!("| {} |\n", row.iter().map(|c| cell(c)).collect::<Vec<_>>().join(" | "));
    *text += "\n";
    *text += &line(headings);
    *text += &format!("|{}\n", "---|".repeat(headings.len()));
    for row in rows {
        *text += &line(row);
    }
}

/// Text that cannot end a cell of a Markdown table, or a link's text.
fn cell(text: &str) -> String {
    text.replace('|', "\\|").replace('[', "\\[").replace(']', "\\]").replace('\n', " ")
}

/// The page as HTML; its figures are files beside it.
pub fn html(sections: &[Section]) -> String {
    let mut body = format!("<header><h1>{TITLE}</h1><p>{}</p></header>\n<nav>", escaped(&opening()));
    for section in sections {
        let _ = write!(body, "<a href=\"#{}\">{}</a> ", anchor(&section.title), escaped(&section.title));
    }
    body += "</nav>\n<main>\n";
    for section in sections {
        let _ =
            writeln!(body, "<section id=\"{}\"><h2>{}</h2>", anchor(&section.title), escaped(&section.title));
        for paragraph in &section.text {
            let _ = writeln!(body, "<p>{}</p>", escaped(paragraph));
        }
        section.figures.iter().for_each(|picture| body += &figure(picture));
        html_table(&mut body, "", &section.table);
        for (heading, class, rows) in facing(section) {
            let _ = writeln!(body, "<h3>{}</h3>", escaped(heading));
            html_table(&mut body, class, &rows);
        }
        body += "</section>\n";
    }
    body += "</main>\n";
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{TITLE}</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n{body}</body>\n</html>\n"
    )
}

fn figure(picture: &Picture) -> String {
    let files = picture.files();
    let shown = files.first().map_or("", String::as_str);
    let links: Vec<String> = files
        .iter()
        .map(|f| format!("<a href=\"{f}\">{}</a>", f.rsplit('.').next().unwrap_or(f).to_uppercase()))
        .collect();
    // Text in figures keeps one size on a screen that has room, and stays readable on one that has not.
    let [least, most] = [LEAST, MOST].map(|rem| rem * picture.figure.width_mm);
    format!(
        "<figure><div class=\"wide\"><img src=\"{shown}\" alt=\"{}\" style=\"min-width: {least:.1}rem; max-width: {most:.1}rem\" \
         loading=\"lazy\"></div>\n<figcaption>{} <small>{}</small></figcaption></figure>\n",
        escaped(picture.alternative()),
        escaped(&picture.caption),
        links.join(" ")
    )
}

fn html_table(body: &mut String, class: &str, rows: &[Vec<String>]) {
    let Some((headings, rows)) = rows.split_first() else { return };
    let _ = write!(body, "<div class=\"wide\"><table class=\"{class}\"><thead><tr>");
    for heading in headings {
        let _ = write!(body, "<th scope=\"col\">{}</th>", escaped(heading));
    }
    *body += "</tr></thead>\n<tbody>\n";
    for row in rows {
        *body += "<tr>";
        for (heading, cell) in headings.iter().zip(row) {
            let _ = write!(body, "<td data-heading=\"{}\">{}</td>", escaped(heading), escaped(cell));
        }
        *body += "</tr>\n";
    }
    *body += "</tbody></table></div>\n";
}

/// Tables of a section's comparisons and predictions, if it has any: heading, class and rows, the first of
/// which has the column headings.
fn facing(section: &Section) -> Vec<(&'static str, &'static str, Vec<Vec<String>>)> {
    let table = |columns: &[&str], rows: Vec<Vec<String>>| {
        let columns: Vec<String> = columns.iter().map(|column| (*column).to_owned()).collect();
        std::iter::once(columns).chain(rows).collect::<Vec<Vec<String>>>()
    };
    let compared = |r: &Compared| vec![r.what.clone(), r.paper.clone(), r.here.clone(), r.why.clone()];
    let predicted = |r: &Predicted| vec![r.what.clone(), r.here.clone(), r.why.clone()];
    let compared: Vec<_> = section.compared.iter().map(compared).collect();
    let predicted: Vec<_> = section.predicted.iter().map(predicted).collect();
    let mut tables = Vec::new();
    if !compared.is_empty() {
        tables.push((COMPARED.0, "compared", table(&COMPARED.1, compared)));
    }
    if !predicted.is_empty() {
        tables.push((PREDICTED.0, "predicted", table(&PREDICTED.1, predicted)));
    }
    tables
}

/// A title as an anchor in the page.
fn anchor(title: &str) -> String {
    let words = title.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("-")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn section() -> Section {
        Section {
            title: "Fig. 9: a | b".into(),
            compared: vec![Compared::new("|A|", "< 1", "0.5", "\"so\" & [so]")],
            predicted: vec![Predicted::new("B", "0.7", "so")],
            ..Section::default()
        }
    }

    #[test]
    fn what_is_marked_up_elsewhere_is_text_here() {
        let page = html(&[section()]);
        assert!(
            page.contains("<td data-heading=\"Paper\">&lt; 1</td>")
                && page.contains("&quot;so&quot; &amp; [so]")
        );
        assert!(page.contains("href=\"#fig-9-a-b\"") && page.contains("id=\"fig-9-a-b\""));
        let text = markdown(&[section()]);
        assert!(text.contains("| \\|A\\| | < 1 | 0.5 | \"so\" & \\[so\\] |"), "{text}");
    }

    #[test]
    fn predictions_are_apart_from_comparisons() {
        let (page, text) = (html(&[section()]), markdown(&[section()]));
        let parts = |page: &str, between: &str| page.split(between).map(str::to_owned).collect::<Vec<_>>();
        for (found, row) in [
            (parts(&text, "\n### "), "| B | 0.7 | so |"),
            (parts(&page, "<h3>"), "data-heading=\"Here\">0.7</td>"),
        ] {
            let [_, compared, predicted] = &found[..] else { panic!("{found:?}") };
            assert!(compared.starts_with(COMPARED.0) && compared.contains("0.5"), "{compared}");
            assert!(predicted.starts_with(PREDICTED.0) && predicted.contains(row), "{predicted}");
            assert!(!compared.contains("0.7") && !predicted.contains("Paper"), "{found:?}");
        }
        let bare = Section { predicted: Vec::new(), ..section() };
        assert!(!markdown(&[bare]).contains(PREDICTED.0));
    }
}

//! Searches: asks for the designs of one generation after the other, computes them, and says what was found.

use super::asker::{Answer, Asker, ByPython};
use super::{Ask, Crew, Report, Stepped};
use crate::{Progress, TaskError, go_on, source};

/// Searches by a plan, in this process, and asks the Python package for designs. What is in the folder already is neither asked for nor
/// computed again, so that a search goes on after any kill; a design that fails is a row with its error, and counts as worse than all
/// others.
///
/// ```
/// use unripple_tasks::{Silent, optimise};
///
/// let folder = std::env::temp_dir().join(format!("unripple-doc-optimise-{}", std::process::id()));
/// std::fs::create_dir_all(&folder)?;
/// let text = r#"
///     format = 1
///     task = "modes"
///     surface = "hudin-2012"
///     ask = { top_hz = 200 }
///     optimise = { generations = 1 }
///     [[objective]]
///     figure = "/frequencies_hz/0"
///     want = "least"
///     [[axis]]
///     key = "sheet.tension_n_per_m"
///     from = 100
///     to = 400
/// "#;
/// std::fs::write(folder.join("plan.toml"), text)?;
/// // What an optimiser is told is in asked/0.json; these designs are somebody's own.
/// let own = |folder: &std::path::Path, generation: usize| {
///     let asked = folder.join(format!("asked/{generation}"));
///     let question = std::fs::read_to_string(asked.with_extension("json")).unwrap();
///     let question: serde_json::Value = serde_json::from_str(&question).unwrap();
///     let designs = [150, 250].map(|tension| format!("[[design]]\n\"surface:sheet.tension_n_per_m\" = {tension}\n"));
///     let text = format!("{}{}", question["head"].as_str().unwrap(), designs.concat());
///     std::fs::write(asked.with_extension("toml"), text).map_err(unripple_tasks::TaskError::work)
/// };
/// let ask = optimise::Ask { plan: folder.join("plan.toml"), output: Some(folder.join("out")), ..optimise::Ask::default() };
/// let report = optimise::run_with(&ask, &own, None, &mut Silent)?;
/// assert_eq!((report.designs, report.best.map(|best| best.index)), (2, Some(0)));
/// assert!(report.best_surface.is_some_and(|text| text.contains("tension_n_per_m = 150")));
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`Search::open`](super::Search::open) and of [`ByPython`]; [`TaskError::Ask`] of options that make no sense; [`TaskError::Input`] of a folder with
/// designs of another plan; [`TaskError::Work`] of one with other things in it, and of what cannot be written; [`TaskError::Cancelled`].
pub fn run(ask: &Ask, progress: &mut dyn Progress) -> Result<Report, TaskError> {
    run_with(ask, &ByPython::default(), None, progress)
}

/// As [`run`], with another optimiser, and with processes that compute the designs.
///
/// # Errors
/// Those of [`run`] and of `asker`; [`TaskError::Work`] of a process that cannot be started, or that ends with an error of its own.
pub fn run_with(
    ask: &Ask,
    asker: &dyn Asker,
    crew: Option<&Crew<'_>>,
    progress: &mut dyn Progress,
) -> Result<Report, TaskError> {
    go_on(progress)?;
    let mut stepped = Stepped::open(ask)?;
    let asker = (!ask.no_ask).then_some(asker);
    let gone = source::keeping(|| go(&mut stepped, asker, crew, progress));
    if gone.is_err() {
        stepped.keep()?;
    }
    gone?;
    stepped.finish(progress)
}

/// Goes through the generations: asks for those that have not been asked for, and computes what is missing.
fn go(
    stepped: &mut Stepped,
    asker: Option<&dyn Asker>,
    crew: Option<&Crew<'_>>,
    progress: &mut dyn Progress,
) -> Result<(), TaskError> {
    while let Some(generation) = stepped.go(crew, progress)? {
        let Some(asker) = asker else { return stepped.question().put() };
        progress.stage(&format!("asking for generation {generation}"));
        // Bound first, since the question borrows what is ended by the answer.
        let answer = asker.ask(&stepped.question())?;
        if let Answer::Over(why) = answer {
            stepped.over(why);
        }
    }
    Ok(())
}

//! Plans of sweeps: how long they may be, which values are one, and which keys overlap.

use serde_json::json;
use unripple_store::{AxisValues, Designs, PlanFile, PlanTask, load_plan, parse_plan};

/// The head of a plan.
const HEAD: &str = "format = 1\ntask = \"modes\"\nsurface = \"hudin-2012\"\n";

fn tasks() -> [PlanTask; 1] {
    [("modes", vec!["top_hz".into(), "accuracy".into(), "level".into(), "points".into()])]
}

fn plan(rest: &str) -> PlanFile {
    parse_plan(&format!("{HEAD}{rest}"), "plan.toml", &tasks()).unwrap()
}

#[test]
fn a_list_may_have_ten_thousand_designs_and_no_plan_is_without_limit() {
    let design = |i: usize| {
        let number = 100.0 + i as f64 / 64.0;
        format!(
            "[[design]]\n\"surface:sheet.tension_n_per_m\" = {number}\n\"surface:sheet.thickness_mm\" = 0.125\n\
             \"surface:sheet.material\" = \"glass\"\n\"ask:top_hz\" = {number}\n"
        )
    };
    let list: String = (0..10_000).map(design).collect();
    assert!(list.len() > 1 << 20);
    assert_eq!(plan(&list).designs.len(), 10_000);
    let file = std::env::temp_dir().join(format!("unripple-long-plan-{}.toml", std::process::id()));
    std::fs::write(&file, format!("{HEAD}{list}")).unwrap();
    let read = load_plan(&file, &tasks());
    std::fs::remove_file(&file).unwrap();
    assert_eq!(read.unwrap().designs.len(), 10_000);
    let long = format!("{HEAD}#{}\n{list}", "x".repeat(1 << 25));
    let refused = parse_plan(&long, "plan.toml", &tasks()).unwrap_err();
    assert_eq!(refused.faults()[0].expected, "a file of at most 33554432 bytes");
}

#[test]
fn a_whole_number_is_one_value_however_it_is_written() {
    let values = |text: &str| {
        let axis = format!(
            "ask = {{ top_hz = {text}, points = [{{ at_m = [{text}, 0.5] }}] }}\n[[axis]]\nkey = \"a\"\nvalues = [{text}]\n"
        );
        let plan = plan(&axis);
        let Designs::Grid(axes) = &plan.designs else { panic!("{:?}", plan.designs) };
        (plan.ask["top_hz"].clone(), plan.ask["points"].clone(), axes[0].values.clone())
    };
    let expected = (json!(150), json!([{ "at_m": [150, 0.5] }]), AxisValues::List(vec![json!(150)]));
    for text in ["150", "150.0", "1.5e2", "0x96", "+150.000"] {
        assert_eq!(values(text), expected, "{text}");
    }
    let others = ["150.5", "1e300", "-0.25"].map(|text| values(text).0);
    assert_eq!(others, [json!(150.5), json!(1e300), json!(-0.25)]);
}

/// An axis over the numbers 1 and 2.
fn axis(named: &str) -> String {
    format!("[[axis]]\n{named}\nvalues = [1, 2]\n")
}

#[test]
fn keys_that_overlap_are_refused_at_the_later_one() {
    let key = |path: &str| format!("key = \"{path}\"");
    let ask = |path: &str| format!("ask = \"{path}\"");
    let cases = [
        (key("sheet.tension_n_per_m"), key("sheet.tension_n_per_m"), "surface:sheet.tension_n_per_m again"),
        (key("sheet"), key("sheet.tension_n_per_m"), "surface:sheet.tension_n_per_m beside surface:sheet"),
        (
            key("actuator[0].at_mm[1]"),
            key("actuator[0]"),
            "surface:actuator[0] beside surface:actuator[0].at_mm[1]",
        ),
        (
            key("actuator[1].at_mm"),
            key("actuator[01].at_mm"),
            "surface:actuator[01].at_mm beside surface:actuator[1].at_mm",
        ),
        (ask("points"), ask("points.0.at_m.0"), "ask:points.0.at_m.0 beside ask:points"),
        (ask("top_hz"), ask("top_hz"), "ask:top_hz again"),
    ];
    for (first, second, found) in cases {
        // One axis between the two, which has nothing to do with them.
        let text = format!("{HEAD}{}{}{}", axis(&first), axis(&key("sheet_of_another")), axis(&second));
        let refused = parse_plan(&text, "plan.toml", &tasks()).unwrap_err();
        let [fault] = refused.faults() else { panic!("{refused:#}") };
        assert_eq!((fault.found.as_str(), fault.line, fault.column), (found, 11, 7), "{refused:#}");
    }
    let apart = ["actuator[1].at_mm", "actuator[10].at_mm", "actuator[1].name", "sheet.a", "sheet.ab"];
    let apart: String = apart.iter().map(|path| axis(&key(path))).collect();
    assert_eq!(plan(&format!("{apart}{}", axis(&ask("level.peak_m")))).designs.len(), 64);
}

#[test]
fn a_design_sets_nothing_twice() {
    let text = format!(
        "{HEAD}[[design]]\n\"ask:top_hz\" = 300\n[[design]]\n\"surface:sheet.thickness_mm\" = 1\n\"surface:sheet\" = {{}}\n"
    );
    let refused = parse_plan(&text, "plan.toml", &tasks()).unwrap_err();
    let [fault] = refused.faults() else { panic!("{refused:#}") };
    assert_eq!((fault.key.as_str(), fault.line, fault.column), ("design[1].surface:sheet", 8, 1));
    assert_eq!(fault.found, "surface:sheet beside surface:sheet.thickness_mm");
}

#[test]
fn a_plan_says_from_where_it_names_files() {
    let designs = axis("ask = \"top_hz\"");
    assert_eq!(plan(&designs).folder, None);
    assert_eq!(plan(&format!("folder = \"../..\"\n{designs}")).folder.as_deref(), Some("../.."));
    let refused = parse_plan(&format!("{HEAD}folder = 2\n{designs}"), "plan.toml", &tasks()).unwrap_err();
    assert_eq!(refused.faults()[0].key, "folder");
}

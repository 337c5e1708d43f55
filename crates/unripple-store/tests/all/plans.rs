//! Plans of sweeps: how long they may be.

use unripple_store::{PlanFile, PlanTask, load_plan, parse_plan};

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

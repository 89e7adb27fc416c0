//! exploration
use coact_reaches::*;
use std::path::Path;
fn main() -> anyhow::Result<()> {
    let a: Vec<String> = std::env::args().collect();
    let reaches = coact_recordings::read_folder(Path::new(&a[1]))?;
    if a[2] == "train" {
        let task = coact_joint_task::Task::load(Path::new("rt-config/tasks/three-objects.toml"))?;
        let m = train(&task, &reaches, Order::Trial { seed: 1 })?;
        std::fs::create_dir_all("rt-config/perception")?;
        std::fs::write(
            "rt-config/perception/preshape.toml",
            model_file(&m, &reaches, "github.com/nsoul97/object_size_prediction at 976a346")?,
        )?;
        return Ok(());
    }
    let order = if a.get(3).is_some_and(|x| x == "file") {
        Order::File
    } else {
        Order::Trial { seed: a.get(3).and_then(|x| x.parse().ok()).unwrap_or(1) }
    };
    let (task, plan) = coact_joint_task::NetworkPlan::load(Path::new(&a[2]))?;
    let out = evaluate(Evaluation { task: &task, plan: &plan, model: None, order }, &reaches)?;
    let r = Report::new(&task.name, task.kinds.len(), out);
    println!("{:?}", r.overall);
    for (p, t) in &r.people {
        println!(
            "{p} right {:.3} wrong {} und {} stand {:.2?} lead {:?} onset {:?} {}",
            t.right_share, t.wrong, t.undecided, t.standing_right, t.lead_ms, t.onset_ms, t.onset_missed
        );
    }
    Ok(())
}

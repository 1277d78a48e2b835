//! Plans all lights of a scene, prints the plan with its reasons, draws it and compares the image with the truth.

mod args;
mod report;

use anyhow::{Result, ensure};
use shadowfit::{
    Light,
    plan::{Objects, plan as make_plan},
};

pub(crate) use args::HELP;
pub use args::{BudgetArgs, PlanArgs};
pub use report::{DrawnReport, LightReport, PlanReport};

use report::overview;

use crate::cli::{choose_lights, open, output_directory, place_camera, sort};
use crate::gpu::Gpu;
use crate::output::{say, write_json};
use crate::run::{CameraReport, median_time, planned};
use crate::stage::{Stage, StageLight};

/// Plans the lights of a scene, draws the plan and checks it.
///
/// # Errors
///
/// When nothing can be drawn, with a hint; and when a caster is missing from a map.
pub fn plan(args: &PlanArgs) -> Result<()> {
    let scene = open(&args.view)?;
    let out = output_directory(&args.view, &scene)?;
    let tracer = sort(&scene.mesh)?;
    let (_, view) = place_camera(&args.view, &scene, &tracer)?;
    let gpu = Gpu::new()?;
    say(&format!("drawn by {}", gpu.name()));

    let stage = Stage::new(&gpu, &tracer, &view, [args.view.width, args.view.height])?;
    let stage = stage.with_lamp_near(args.view.lamp_near);
    let specs = choose_lights(&args.view, &scene);
    let lights = specs.iter().map(|&spec| stage.light(spec)).collect::<Result<Vec<_>>>()?;
    let objects = planned::objects(&scene.mesh)?;
    let report = planned(&stage, &lights, &objects, args, scene.name)?;

    for (i, light) in report.lights.iter().enumerate() {
        say(&format!("\nlight {}: {}: {}", i + 1, light.light, light.kind));
        light.reasons.iter().for_each(|reason| say(&format!("  {reason}")));
    }
    say(&format!("\n{}", overview(&report)));
    say(&format!(
        "planned in {:.0} µs: {} passes, {} texels, {} triangles",
        report.plan_us, report.passes, report.texels, report.triangles
    ));
    write_json(&report, &out.join("plan.json"))?;
    say(&format!("wrote plan.json to {}", out.display()));
    let missing: usize = report.lights.iter().map(|light| light.drawn.verdict.counts.missing).sum();
    ensure!(
        missing == 0,
        "{missing} pixels are lit because a caster is missing from a map, or a map from the plan"
    );
    Ok(())
}

/// Plans lights on a stage and draws the plan.
fn planned(
    stage: &Stage<'_>,
    lights: &[StageLight],
    objects: &Objects,
    args: &PlanArgs,
    scene: String,
) -> Result<PlanReport> {
    let budget = args.budget.budget(stage.size[1])?;
    let fitted: Vec<Light> = lights.iter().map(|light| light.light).collect();
    let plan = make_plan(&stage.view, &fitted, objects, &budget);
    let plan_time = median_time(100, || make_plan(&stage.view, &fitted, objects, &budget));
    let of = |(light, of_light)| LightReport::new(stage, light, &plan, of_light, args);
    Ok(PlanReport {
        scene,
        adapter: stage.gpu.name().to_owned(),
        image: stage.size,
        camera: CameraReport::from(&stage.view),
        narrowed: CameraReport::from(plan.view()),
        plan_us: plan_time.as_secs_f64() * 1e6,
        passes: plan.passes(),
        texels: plan.texels(),
        triangles: plan.triangles(),
        lights: lights.iter().zip(plan.lights()).map(of).collect::<Result<_>>()?,
    })
}

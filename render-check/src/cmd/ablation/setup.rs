//! The plan of one light, and variants of its maps with one effect changed.

use std::time::Duration;

use anyhow::{Context, Result, bail};
use shadowfit::{
    Aabb, Focus, FocusForm, Light, Origin, Outcome, Scene, Settings, View, Warp,
    depth::DepthTest,
    omni::CubeFace,
    plan::{Budget, Kind, LightPlan, Objects, Plan, plan},
    warp::Shift,
};

use crate::gpu::{Filter, Points};
use crate::maps::{Layout, Split, Technique};
use crate::run::{Cutting, FittedMap, FittedMaps, MapRun, Options, planned, run_fitted};
use crate::stage::{Stage, StageLight};

/// A light's maps, and how they are drawn and filtered.
#[derive(Clone, Debug)]
pub(super) struct Maps {
    pub(super) fitted: FittedMaps,
    pub(super) options: Options,
}

/// A light and its plan.
pub(super) struct Setup<'a> {
    pub(super) stage: &'a Stage<'a>,
    pub(super) light: &'a StageLight,
    budget: Budget,
    plan: Plan,
    boxes: Vec<Aabb>,
    frames: u32,
}

impl<'a> Setup<'a> {
    /// Plans the light.
    pub(super) fn new(
        stage: &'a Stage<'a>,
        light: &'a StageLight,
        objects: &Objects,
        budget: Budget,
        frames: u32,
    ) -> Self {
        let plan = plan(&stage.view, &[light.light], objects, &budget);
        let boxes = stage.tracer.mesh().objects.iter().map(planned::bounds).collect();
        Self { stage, light, budget, plan, boxes, frames }
    }

    /// The plan of the light.
    pub(super) fn of_light(&self) -> &LightPlan {
        &self.plan.lights()[0]
    }

    /// The view that the plan fits maps to.
    pub(super) fn narrowed(&self) -> &View {
        self.plan.view()
    }

    /// The budget's largest map size, in texels.
    pub(super) fn largest(&self) -> u32 {
        self.budget.settings().map_size()
    }

    /// The budget's widest filter.
    pub(super) fn widest(&self) -> shadowfit::Filter {
        self.budget.filter()
    }

    /// The planned maps; `None` where the plan has none.
    pub(super) fn planned(&self) -> Result<Option<Maps>> {
        let of_light = self.of_light();
        let options = planned::options(of_light, self.budget.format(), Points::Discs, self.frames);
        let fitted = FittedMaps::planned(self.stage, &self.plan, &self.light.light, of_light, &options)?;
        Ok(fitted.map(|fitted| Maps { fitted, options }))
    }

    /// The same maps, each fitted again to another view and with other settings.
    pub(super) fn refitted(
        &self,
        maps: &Maps,
        view: &View,
        change: impl Fn(Settings) -> Result<Settings>,
    ) -> Result<Maps> {
        let mut changed = maps.clone();
        for (light, fitted) in maps.fitted.lights.iter().zip(&mut changed.fitted.maps) {
            if let Some(fitted) = fitted {
                let settings = change(*fitted.map.settings())?;
                changed.options.map_size = settings.map_size();
                let options = changed.options;
                *fitted = self.fit(view, light, &settings, &options)?.context("what had a map has none")?;
            }
        }
        Ok(changed)
    }

    /// The same maps, each fitted again to the camera as it is and one box around the scene: nothing tells them where receivers
    /// begin.
    pub(super) fn unnarrowed(&self, maps: &Maps) -> Result<Maps> {
        let mut changed = maps.clone();
        for (light, fitted) in maps.fitted.lights.iter().zip(&mut changed.fitted.maps) {
            if let Some(fitted) = fitted {
                let focus = Focus::new(&self.stage.view, light, &self.stage.bounds);
                let map = self.fit_focus(&focus, fitted.map.settings(), &maps.options)?;
                *fitted = map.context("what had a map has none")?;
            }
        }
        Ok(changed)
    }

    /// The same maps with another depth test (second depth without a bias, or first depth with one) and another
    /// filter.
    pub(super) fn read_by(&self, maps: &Maps, test: DepthTest, filter: Filter) -> Result<Maps> {
        let mut changed = maps.clone();
        (changed.options.faces, changed.options.filter) = (planned::faces(test), filter);
        for fitted in changed.fitted.maps.iter_mut().flatten() {
            fitted.pass = changed.options.pass(&fitted.map)?;
        }
        Ok(changed)
    }

    /// The same maps without culling: every object is drawn into each.
    pub(super) fn undiscerning(&self, maps: &Maps) -> Maps {
        let mut changed = maps.clone();
        for fitted in changed.fitted.maps.iter_mut().flatten() {
            fitted.objects = (0..self.boxes.len()).collect();
        }
        changed
    }

    /// All six cube faces: those that the plan dropped are fitted to everything inside them.
    pub(super) fn all_faces(&self, maps: &Maps) -> Result<Maps> {
        let mut changed = maps.clone();
        let settings = self.settings(maps.options.map_size)?.with_warp(Warp::Uniform);
        let everywhere = self.everywhere()?;
        for (light, fitted) in maps.fitted.lights.iter().zip(&mut changed.fitted.maps) {
            if fitted.is_none() {
                *fitted = self.fit(&everywhere, light, &settings, &maps.options)?;
            }
        }
        Ok(changed)
    }

    /// Only the cube face that most of the compared pixels are in.
    pub(super) fn best_face(&self, maps: &Maps) -> Maps {
        let mut pixels = vec![0; maps.fitted.split.parts()];
        for (surface, _) in self.light.truth.pixels().iter().filter_map(|pixel| pixel.compared()) {
            pixels[maps.fitted.split.part_of(surface.point)] += 1;
        }
        let best =
            (0..pixels.len()).filter(|&part| maps.fitted.maps[part].is_some()).max_by_key(|&part| pixels[part]);
        let mut changed = maps.clone();
        for (part, fitted) in changed.fitted.maps.iter_mut().enumerate() {
            if Some(part) != best {
                *fitted = None;
            }
        }
        changed
    }

    /// Cube faces in place of the single planned map, with its size and warp; faces without receivers are dropped.
    pub(super) fn faces_instead(&self, maps: &Maps) -> Result<Maps> {
        let settings = maps.fitted.maps.iter().flatten().next().map(|fitted| *fitted.map.settings());
        let settings = settings.context("there is no map to replace")?;
        self.cube(self.narrowed(), &settings, &maps.options)
    }

    /// The maps of a renderer without a plan: one for a sun, or all cube faces of a point light, with every object
    /// in them.
    pub(super) fn naive(&self) -> Result<Option<Maps>> {
        let settings = self.settings(self.largest())?.with_warp(Warp::Uniform);
        let filter = planned::filter(self.widest(), false);
        let options = Options { filter, frames: self.frames, ..Options::new(Technique::Uniform, self.largest()) };
        let everywhere = self.everywhere()?;
        let light = self.light.light;
        if light.cube_face(CubeFace::PositiveX, 0.0).is_ok() {
            return Ok(Some(self.undiscerning(&self.cube(&everywhere, &settings, &options)?)));
        }
        let fitted = self.fit(&everywhere, &light, &settings, &options)?;
        let Some(fitted) = fitted else { return Ok(None) };
        let fitted = self.of(Split::whole(), vec![light], vec![Some(fitted)])?;
        Ok(Some(self.undiscerning(&Maps { fitted, options })))
    }

    fn cube(&self, view: &View, settings: &Settings, options: &Options) -> Result<Maps> {
        let light = self.light.light;
        let position = light.position().context("a sun has no cube around it")?;
        let lights = planned::cube_faces(&light, options.filter, settings.map_size(), settings.border())?;
        let maps = lights.iter().map(|light| self.fit(view, light, settings, options)).collect::<Result<_>>()?;
        Ok(Maps { fitted: self.of(Split::cube(position), lights, maps)?, options: *options })
    }

    fn of(&self, split: Split, lights: Vec<Light>, maps: Vec<Option<FittedMap>>) -> Result<FittedMaps> {
        FittedMaps::of(self.stage, split, lights, maps, Cutting::None)
    }

    /// A map and the casters left by culling against H; `None` where no map is needed.
    fn fit(&self, view: &View, light: &Light, settings: &Settings, options: &Options) -> Result<Option<FittedMap>> {
        let scene = Scene::new(&self.boxes, &self.boxes)?;
        self.fit_focus(&Focus::new(view, light, &scene), settings, options)
    }

    fn fit_focus(&self, focus: &Focus<'_>, settings: &Settings, options: &Options) -> Result<Option<FittedMap>> {
        let map = match focus.fit(settings) {
            Outcome::Map(map) => Layout::Frustum(map),
            Outcome::Empty(_) => return Ok(None),
            Outcome::Surrounded(_) => bail!("no single frustum serves {}", self.light.spec),
        };
        let body = focus.caster_volume(FocusForm::ReceiverHull);
        let boxes = self.boxes.iter().enumerate();
        let meets = boxes.filter(|(_, one)| body.intersects_aabb(one.min.as_dvec3(), one.max.as_dvec3()));
        let objects = meets.map(|(object, _)| object).collect();
        Ok(Some(FittedMap::of(map, options, objects)?))
    }

    fn settings(&self, size: u32) -> Result<Settings> {
        let border = self.widest().border();
        Ok(Settings::new(size, self.stage.size[1])?.with_border(border)?.with_origin(Origin::Eye))
    }

    /// A view of the whole scene from the same eye, as positions on the GPU are relative to it.
    fn everywhere(&self) -> Result<View> {
        let (min, max) = self.stage.tracer.bounds();
        let eye = self.stage.view.eye();
        let reach = 2.0 * ((min - eye).abs().max((max - eye).abs())).length();
        let (forward, up) = (self.stage.view.forward(), self.stage.view.up());
        View::orthographic(eye, forward, up, reach, 1.0, -reach, reach).context("the scene is too large")
    }

    /// Draws maps and judges them.
    pub(super) fn draw(&self, maps: Maps) -> Result<MapRun> {
        run_fitted(self.stage, self.light, &maps.options, maps.fitted, Duration::ZERO)
    }

    /// Whether the plan's maps are of this kind.
    pub(super) fn is(&self, kind: Kind) -> bool {
        self.of_light().kind() == kind
    }

    /// The opposite back-shift setting.
    pub(super) fn other_shift(shift: Shift) -> Shift {
        if shift == Shift::None { Shift::Back(FocusForm::ViewHull) } else { Shift::None }
    }
}

//! Distributing: every record, in the output's form, comes to a cell of the octree. Held in memory while there is
//! room, spilled else; either way the points of a cell keep the order of the input, whatever the threads did.

pub mod cells;
mod divide;
mod ordered_parts;
pub mod pass;
pub mod sort;

use crate::error::Result;
use crate::input::Source;
use crate::octree::cube::{Bounds, Cube};
use crate::octree::limits::Limits;
use crate::octree::place::{Extent, Frame};
use crate::progress::{Meter, Progress, Stage};
use crate::record::Target;
use crate::record::fields::Field;
use crate::statistics::Tally;
use crate::temporary::store::Store;
use cells::Cells;
use pass::Plan;

/// The share by which a cube may be longer than the points need before they are distributed again.
const LOOSE: f64 = 1.0 / 64.0;

/// What there is to distribute: inputs that are unified.
pub struct Inputs {
    pub sources: Vec<Source>,
    /// Points that the headers announce, which is what is there, or an error.
    pub points: u64,
    /// Bytes of a record of the output.
    pub length: usize,
    /// Form of a record of the output.
    pub target: Target,
    pub frame: Frame,
    /// Attributes to be summed up.
    pub fields: Vec<Field>,
}

/// The points in cells, and what is known of them all.
pub struct Distribution {
    pub cells: Cells,
    pub cube: Cube,
    pub bounds: Bounds,
    pub tally: Tally,
}

/// The bounds that a header declares.
fn declared(source: &Source) -> Bounds {
    let h = &source.scan.header;
    Bounds { min: [h.min_x, h.min_y, h.min_z], max: [h.max_x, h.max_y, h.max_z] }
}

impl Inputs {
    /// The extent that the headers declare, if they declare one.
    fn declared(&self) -> Option<Extent> {
        let mut extent = Extent::EMPTY;
        for source in &self.sources {
            extent.join(&self.frame.nearest(&declared(source))?);
        }
        Some(extent)
    }

    /// Why points of a source may not go into the output's scale and offset (`INPUT_MIXED`), which they alone decide.
    pub fn doubt(&self, source: &Source) -> Option<&'static str> {
        let change = source.change.as_ref()?;
        if self.frame.nearest(&declared(source)).is_none() {
            return Some("its coordinates may be out of reach of the first input's scale and offset");
        }
        (!change.is_total()).then_some("its coordinates may lie between the steps of the first input's scale")
    }

    /// Where the points go to if they lie in an extent.
    pub fn plan(&self, extent: Extent) -> Plan {
        let bounds = self.frame.bounds(&extent);
        let cube = Cube::around(&bounds, self.frame.scale);
        let level = Limits::of(self.length).first_level(self.points, &bounds);
        Plan { extent, cube, level }
    }

    /// Where the points go to if the headers tell the truth.
    pub fn first_plan(&self) -> Option<Plan> {
        self.declared().map(|extent| self.plan(extent))
    }
}

/// Reads all inputs once, and once more where their headers' bounds turn out wrong.
pub fn distribute(
    inputs: &Inputs,
    workers: usize,
    store: &Store,
    progress: &dyn Progress,
) -> Result<Distribution> {
    let read = |plan: Option<&Plan>| {
        let meter = Meter::start(progress, Stage::Read, inputs.points);
        let found = pass::read(inputs, plan, workers, store, &meter)?;
        meter.finish();
        Ok(found)
    };
    let mut plan = inputs.first_plan();
    let mut found = read(plan.as_ref())?;
    let needed = inputs.plan(found.extent);
    let fits = |plan: &Plan| found.placed && plan.cube.side() <= needed.cube.side() * (1.0 + LOOSE);
    if !plan.as_ref().is_some_and(fits) {
        progress.warn("the bounds in the headers are not those of the points, which are read again");
        found.cells.clear(store);
        plan = Some(needed);
        found = read(plan.as_ref())?;
    }
    let cube = plan.map_or(needed.cube, |plan| plan.cube);
    divide::divide(&mut found.cells, inputs, &cube, &Limits::of(inputs.length), workers, store)?;
    let bounds = inputs.frame.bounds(&found.extent);
    Ok(Distribution { cells: found.cells, cube, bounds, tally: found.tally })
}

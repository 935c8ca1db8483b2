//! Water in force from step to step.

use std::sync::Arc;

use super::flow::BoundFlow;
use super::flow_lines::StatedFlow;
use super::pressures::Stated;
use super::water::{Imposed, StepWater, WaterSource};
use crate::assembly::Model;
use crate::error::Result;
use crate::scene::{Scene, Variable};

/// A question to parts by their numbers.
type AskParts<'p> = &'p dyn Fn(&[usize]) -> bool;

/// Water in force from step to step.
pub(super) struct WaterInForce<'a> {
    sources: Vec<WaterSource>,
    flows: Vec<StatedFlow<'a>>,
    /// Flow of the step before.
    flow: Option<Arc<BoundFlow>>,
}

impl<'a> WaterInForce<'a> {
    pub(super) fn new(model: &Model) -> WaterInForce<'a> {
        WaterInForce {
            sources: vec![WaterSource::Dry; model.interfaces.len()],
            flows: Vec::new(),
            flow: None,
        }
    }

    /// Water of a step that states pressures; none where there is none before or in it. `there`: whether parts stay through the
    /// start of the step, and are there in it.
    pub(super) fn step(
        &mut self,
        scene: &Scene,
        model: &Model,
        number: usize,
        stated: &[Option<Stated<'a>>],
        [stay, are_there]: [AskParts; 2],
    ) -> Result<Option<StepWater>> {
        let before = self.sources.clone();
        for (k, stated) in stated.iter().enumerate() {
            let Some(stated) = stated else { continue };
            self.flows.retain(|flow| flow.interface != k);
            self.sources[k] = match stated {
                Stated::Imposed(quantity) => {
                    let follows = quantity.uses(Variable::LoadFactor);
                    WaterSource::Imposed(Arc::new(Imposed { quantity: quantity.clone(), follows }))
                }
                Stated::Flow(flow, key) => {
                    self.flows.push(StatedFlow { interface: k, flow, step: number, key: key.clone() });
                    WaterSource::Flow
                }
            };
        }
        self.flows.sort_by_key(|flow| flow.interface);
        let parts = |k: usize| &model.interfaces[k].subdomains[..];
        let flows: Vec<StatedFlow> =
            self.flows.iter().filter(|flow| are_there(parts(flow.interface))).cloned().collect();
        let flow = match flows.is_empty() {
            true => None,
            false => Some(Arc::new(BoundFlow::new(scene, model, number, &flows)?)),
        };
        let present = |source: &WaterSource, is: bool| if is { source.clone() } else { WaterSource::Dry };
        let both =
            |k: usize| [present(&before[k], stay(parts(k))), present(&self.sources[k], are_there(parts(k)))];
        let sources = (0..before.len()).map(both).collect();
        let water = StepWater::new(sources, [self.flow.take(), flow.clone()]);
        // what goes on stays as it is at load factor 1
        for source in &mut self.sources {
            if let WaterSource::Imposed(own) = source
                && own.follows
            {
                *source = WaterSource::Imposed(Arc::new(Imposed {
                    quantity: own.quantity.clone(),
                    follows: false,
                }));
            }
        }
        self.flow = flow;
        Ok(water)
    }
}

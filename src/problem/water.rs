//! Water in the interfaces during a step: imposed pressures and flow, from those before to those of the step.
//!
//! ```text
//! p(λ) = (1 − λ) p₀ + λ p₁        p₀ as at the end of the step before; where load_factor occurs, p₁(λ) alone
//! ```
//!
//! Both are taken at the jumps of the moment. Flow between the same ends with the same aperture and viscosity goes over with the
//! pressures of its ends, which is the same.

use std::sync::Arc;

use super::flow::BoundFlow;
use super::point_laws::place;
use super::quantity::Quantity;
use super::water_answer::{EndRates, FlowAlong, WaterAnswer, WaterFields, WaterPoint};
use crate::assembly::{InterfaceOperator, Model};
use crate::error::Result;
use crate::law::{Local, N};
use crate::scene::{FormulaPlace, Variable};

/// An imposed pressure in force.
#[derive(Debug, Clone)]
pub(super) struct Imposed {
    pub(super) quantity: Quantity,
    /// It is of this step and follows its load factor.
    pub(super) follows: bool,
}

/// WaterSource of the pressure in an interface.
#[derive(Debug, Clone)]
pub(super) enum WaterSource {
    /// None.
    Dry,
    /// An imposed pressure.
    Imposed(Arc<Imposed>),
    /// Flow.
    Flow,
}

/// Water during a step.
#[derive(Debug, Clone)]
pub struct StepWater {
    /// Sources of every interface, before and in the step.
    sources: Vec<[WaterSource; 2]>,
    /// Flows before and in the step.
    flows: [Option<Arc<BoundFlow>>; 2],
}

impl StepWater {
    /// None without any water.
    pub(super) fn new(
        sources: Vec<[WaterSource; 2]>,
        flows: [Option<Arc<BoundFlow>>; 2],
    ) -> Option<StepWater> {
        let dry = |source: &WaterSource| matches!(source, WaterSource::Dry);
        let none = sources.iter().flatten().all(dry);
        (!none).then_some(StepWater { sources, flows })
    }

    /// True if a formula in load_factor gives a pressure.
    pub(super) fn follows_load_factor(&self) -> bool {
        let imposed = |source: &WaterSource| matches!(source, WaterSource::Imposed(own) if own.follows);
        self.sources.iter().any(|own| imposed(&own[1]))
            || self.flows[1].as_ref().is_some_and(|flow| flow.follows)
    }

    /// True if there is water in an interface before or in the step.
    pub fn is_in(&self, interface: usize) -> bool {
        self.sources[interface].iter().any(|source| !matches!(source, WaterSource::Dry))
    }

    /// True if water flows along an interface in the step.
    pub fn flows_in(&self, interface: usize) -> bool {
        matches!(self.sources[interface][1], WaterSource::Flow)
    }

    /// Weights of what was before and of what is in the step.
    fn weights(&self, interface: usize, load_factor: f64) -> [f64; 2] {
        let at_once = match &self.sources[interface] {
            [WaterSource::Imposed(before), WaterSource::Imposed(now)] => {
                Arc::ptr_eq(before, now) || now.follows
            }
            [WaterSource::Dry, WaterSource::Dry] => true,
            [_, WaterSource::Imposed(now)] => now.follows,
            [before, WaterSource::Flow] => {
                let own = self.flows[1].as_ref();
                let same = matches!(before, WaterSource::Flow) && self.goes_on();
                own.is_some_and(|flow| flow.follows) || same
            }
            _ => false,
        };
        if at_once { [0.0, 1.0] } else { [1.0 - load_factor, load_factor] }
    }

    /// True if the flow is that before but for the pressures of its ends.
    fn goes_on(&self) -> bool {
        match &self.flows {
            [Some(before), Some(now)] => before.network == now.network,
            _ => false,
        }
    }

    /// Pressures at a load factor for the jumps and damages of the law points; a formula without a value is refused in words.
    pub fn answer(
        &self,
        model: &Model,
        load_factor: f64,
        point: &dyn Fn(usize, usize) -> WaterPoint,
        with_slopes: bool,
    ) -> std::result::Result<WaterAnswer, String> {
        let count = model.interfaces.len();
        let empty = || vec![Vec::new(); count];
        let ends = vec![EndRates::default(); count];
        let fields = WaterFields { pressures: empty(), rates: empty(), apertures: empty(), ends };
        let mut answer = WaterAnswer { fields, slopes: vec![Vec::new(); count], flow_slopes: Vec::new() };
        for (k, operator) in model.interfaces.iter().enumerate().filter(|(k, _)| self.is_in(*k)) {
            let points = operator.coupling.points.len();
            answer.fields.pressures[k] = vec![0.0; points];
            answer.slopes[k] = vec![Local::zeros(); points];
            let weights = self.weights(k, load_factor);
            for (end, source) in self.sources[k].iter().enumerate().filter(|(end, _)| weights[*end] != 0.0) {
                let WaterSource::Imposed(own) = source else { continue };
                let at = if own.follows && end == 1 { load_factor } else { 1.0 };
                for p in 0..points {
                    let (pressure, slope) = own.at(operator, p, at, &point(k, p))?;
                    answer.fields.pressures[k][p] += weights[end] * pressure;
                    answer.slopes[k][p] += slope * weights[end];
                }
            }
        }
        for (end, flow) in self.flows.iter().enumerate() {
            let Some(flow) = flow else { continue };
            let weight = |k: usize| match self.sources[k][end] {
                WaterSource::Flow => self.weights(k, load_factor)[end],
                _ => 0.0,
            };
            if flow.network.lines.iter().all(|line| weight(line.interface) == 0.0) {
                continue;
            }
            let before = if end == 1 && self.goes_on() { self.flows[0].as_deref() } else { None };
            let given = flow
                .given(before, if end == 1 { load_factor } else { 1.0 })
                .map_err(|why| why.to_string())?;
            flow.add(model, &given, &weight, point, with_slopes, &mut answer);
        }
        Ok(answer)
    }

    /// The lines along which water flows in the step, as `midplane check` tells them.
    pub fn lines(&self, model: &Model) -> Vec<FlowAlong> {
        self.flows[1].as_ref().map_or_else(Vec::new, |flow| flow.lines(model))
    }

    /// Asks every formula in load_factor for the touching faces, so that none fails half-way.
    pub(super) fn check(&self, model: &Model, increments: usize) -> Result<()> {
        let load_factors = if self.follows_load_factor() { 1..=increments } else { increments..=increments };
        for number in load_factors {
            let load_factor = number as f64 / increments as f64;
            for (operator, sources) in model.interfaces.iter().zip(&self.sources) {
                let WaterSource::Imposed(own) = &sources[1] else { continue };
                for p in 0..operator.coupling.points.len() {
                    own.quantity.at(&FormulaPlace { load_factor, ..place(operator, p) })?;
                }
            }
            if let Some(flow) = &self.flows[1] {
                flow.given(None, load_factor)?;
            }
        }
        Ok(())
    }
}

impl Imposed {
    /// Pressure at a law point, and its derivative by the jump there.
    fn at(
        &self,
        operator: &InterfaceOperator,
        p: usize,
        load_factor: f64,
        point: &WaterPoint,
    ) -> std::result::Result<(f64, Local), String> {
        let opening = point.jump[N].max(0.0);
        let place = FormulaPlace { load_factor, opening, damage: point.damage, ..place(operator, p) };
        let pressure = self.quantity.at(&place).map_err(|why| why.to_string())?;
        let mut slope = Local::zeros();
        if opening > 0.0 && self.quantity.uses(Variable::Opening) {
            slope[N] = self.quantity.derivative(&place, Variable::Opening);
        }
        if self.quantity.uses(Variable::Damage) && point.damage_gradient != Local::zeros() {
            slope += point.damage_gradient * self.quantity.derivative(&place, Variable::Damage);
        }
        Ok((pressure, slope))
    }
}

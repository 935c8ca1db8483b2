//! The laws of an interface, point by point: one for all, or as many as its formulas have values.

use std::collections::HashMap;

use rayon::prelude::*;

use crate::assembly::InterfaceOperator;
use crate::coupling::Coupling;
use crate::error::Result;
use crate::law::{Inadmissible, Law, diagonal_rows};
use crate::scene::{self, FormulaPlace, Scene};

/// The laws of an interface.
#[derive(Debug, Clone)]
pub struct PointLaws {
    /// Those that differ.
    laws: Vec<Law>,
    /// The one of every law point; none where there is one for all.
    of: Vec<u32>,
}

impl PointLaws {
    /// One for all.
    pub fn uniform(law: Law) -> PointLaws {
        PointLaws { laws: vec![law], of: Vec::new() }
    }

    /// The law of a point.
    #[inline]
    pub fn at(&self, point: usize) -> &Law {
        &self.laws[self.of.get(point).map_or(0, |&k| k as usize)]
    }

    /// Those that differ.
    pub fn all(&self) -> &[Law] {
        &self.laws
    }

    /// The first of them: all are of one kind.
    pub fn kind(&self) -> &Law {
        &self.laws[0]
    }

    /// Largest elastic stiffness of every component [stress / length].
    pub fn stiffest(&self) -> [f64; 3] {
        let larger = |most: [f64; 3], k: [f64; 3]| std::array::from_fn(|i| most[i].max(k[i]));
        self.laws.iter().map(|law| law.elastic_stiffness()).fold([0.0; 3], larger)
    }

    /// Elastic stiffnesses of the law points of a coupling, by rows, each at most so large.
    pub fn diagonals(&self, coupling: &Coupling, most: f64) -> Vec<f64> {
        let rows =
            |law: &Law| diagonal_rows(&law.elastic_stiffness().map(|k| k.min(most))[..coupling.components]);
        let own: Vec<Vec<f64>> = self.laws.iter().map(rows).collect();
        match self.of.is_empty() {
            true => own[0].repeat(coupling.points.len()),
            false => self.of.iter().flat_map(|&k| &own[k as usize]).copied().collect(),
        }
    }

    /// Evaluates the formulas of a stated law at the law points and checks every law that they make.
    pub(super) fn bind(
        scene: &Scene,
        name: &str,
        stated: &scene::Interface,
        interface: &InterfaceOperator,
    ) -> Result<PointLaws> {
        let law = &stated.law;
        if law.is_uniform() {
            return Ok(PointLaws::uniform(law.kind().clone()));
        }
        let error_at = |key: &str, what: String, help: &str| {
            let path: Vec<&str> = ["interfaces", name, "law"].into_iter().chain(key.split('.')).collect();
            scene.source.error_at(&path, what, help)
        };
        let mut known: HashMap<Vec<u64>, u32> = HashMap::new();
        let (mut numbers, mut first, mut of) = (Vec::new(), Vec::new(), Vec::new());
        for point in 0..interface.coupling.points.len() {
            let place = place(interface, point);
            let own = law.numbers(&place).map_err(|(key, text)| {
                let what = format!("{text} has no value at {}", shown(&place));
                error_at(&key, what, "give a formula that has one all along the interface")
            })?;
            let bits = own.iter().map(|number| number.to_bits()).collect();
            let k = *known.entry(bits).or_insert_with(|| {
                numbers.push(own);
                first.push(place);
                (numbers.len() - 1) as u32
            });
            of.push(k);
        }
        let made = numbers.par_iter().zip(&first).map(|(numbers, place)| {
            let made = law.with(numbers).map_err(|what| error_at("", what, "give numbers"))?;
            made.check().map_err(|Inadmissible { key, what, help }| {
                error_at(key, format!("{what} at {}", shown(place)), &help)
            })?;
            Ok(made)
        });
        Ok(PointLaws { laws: made.collect::<Result<_>>()?, of })
    }
}

/// The place of a law point: s runs along C from the start of chain A.
pub(super) fn place(interface: &InterfaceOperator, point: usize) -> FormulaPlace {
    let point = &interface.coupling.points[point];
    let [x, y, z] = point.position;
    FormulaPlace { x, y, z, s: point.s / interface.coupling.midplane.length, ..FormulaPlace::default() }
}

/// A place for a message.
pub(super) fn shown(place: &FormulaPlace) -> String {
    format!("({:.6}, {:.6})", place.x, place.y)
}

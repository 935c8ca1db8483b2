//! Forms of the equilibrium, made anew for every set of supports.

use std::sync::Arc;

use super::Make;
use super::newton::NewtonEngine;
use crate::assembly::{Pattern, Symmetric};
use crate::problem::Problem;
use crate::solver::{Base, Condensation, Condensed, Continuum, FloatingSubdomains, NewtonSettings, Primal};

/// Makes the base system of a set of supports; one condensation serves all sets that differ on joints only.
pub(super) fn bases<'a>(
    problem: &'a Problem,
    continuum: &'a Continuum,
    stiffness: &'a [Vec<f64>],
) -> Make<'a, Base<'a>> {
    let mut condense = condensations(continuum);
    Box::new(move |held: &[bool]| {
        let (condensation, anew) = condense(held)?;
        Ok((Base::new(continuum, condensation, &problem.model.joints, stiffness, held)?, anew))
    })
}

/// Makes the condensation of a set of supports, which serves all sets that differ on joints only.
pub(super) fn condensations<'a>(continuum: &'a Continuum) -> Make<'a, Arc<Condensation>> {
    let mut condensed: Option<Arc<Condensation>> = None;
    Box::new(move |held: &[bool]| {
        let reused = condensed.take().filter(|condensation| continuum.serves(condensation, held));
        let anew = reused.is_none();
        let condensation = match reused {
            Some(condensation) => condensation,
            None => Arc::new(continuum.condense(held)?),
        };
        condensed = Some(condensation.clone());
        Ok((condensation, anew))
    })
}

/// On the jump coefficients of the joints in `asked`.
pub(super) fn condensed<'a>(
    problem: &'a Problem,
    continuum: &'a Continuum,
    asked: &'a [usize],
    stiffness: &'a [Vec<f64>],
    settings: NewtonSettings,
) -> NewtonEngine<'a, Condensed<'a>> {
    let size: usize = asked.iter().map(|&k| problem.model.joints[k].size()).sum();
    let sound: Vec<Vec<f64>> = (problem.laws.iter().zip(&problem.model.joints))
        .map(|((law, _), joint)| {
            let [kn, kt] = law.elastic_stiffness();
            [kn, 0.0, 0.0, kt].repeat(joint.coupling.points.len())
        })
        .collect();
    let mut base = bases(problem, continuum, stiffness);
    let make = move |held: &[bool]| {
        let (base, anew) = base(held)?;
        Ok((Condensed::new(base, asked, stiffness, &sound), anew))
    };
    NewtonEngine::new(problem, settings, Box::new(make), size)
}

/// On the jump coefficients of all joints and the rigid motions of floating bodies.
pub(super) fn blocks<'a>(
    problem: &'a Problem,
    continuum: &'a Continuum,
    stiffness: &'a [Vec<f64>],
    settings: NewtonSettings,
) -> NewtonEngine<'a, FloatingSubdomains<'a>> {
    let joints = &problem.model.joints;
    let mut condense = condensations(continuum);
    let make = move |held: &[bool]| {
        let (condensation, anew) = condense(held)?;
        Ok((FloatingSubdomains::new(continuum, condensation, joints, stiffness, held)?, anew))
    };
    NewtonEngine::new(problem, settings, Box::new(make), FloatingSubdomains::unknowns(continuum, joints))
}

/// On all displacements.
pub(super) fn plain<'a>(
    problem: &'a Problem,
    pattern: &'a Pattern,
    k: &'a Symmetric,
    asked: &'a [usize],
    stiffness: &'a [Vec<f64>],
    settings: NewtonSettings,
) -> NewtonEngine<'a, Primal<'a>> {
    let make = move |held: &[bool]| {
        Ok((Primal::new(&problem.model.joints, asked, stiffness, pattern, k, held), true))
    };
    NewtonEngine::new(problem, settings, Box::new(make), problem.model.dofs())
}

//! Forms of the equilibrium, made anew for every set of supports.

use std::sync::Arc;

use super::Make;
use super::newton::NewtonEngine;
use crate::assembly::{Pattern, Symmetric};
use crate::problem::Problem;
use crate::solver::{
    Base, Condensation, Condensed, Continuum, FloatingSubdomains, JoinedSubdomains, NewtonSettings, Primal,
};

/// Makes the base system of a set of supports; one condensation serves all sets that differ on interfaces only.
pub(super) fn bases<'a>(
    problem: &'a Problem,
    continuum: &'a Continuum,
    stiffness: &'a [Vec<f64>],
) -> Make<'a, Base<'a>> {
    let mut condense = condensations(continuum);
    Box::new(move |constrained: &[bool]| {
        let (condensation, anew) = condense(constrained)?;
        Ok((Base::new(continuum, condensation, &problem.model.interfaces, stiffness, constrained)?, anew))
    })
}

/// Makes the condensation of a set of supports, which serves all sets that differ on interfaces only.
pub(super) fn condensations<'a>(continuum: &'a Continuum) -> Make<'a, Arc<Condensation>> {
    let mut condensed: Option<Arc<Condensation>> = None;
    Box::new(move |constrained: &[bool]| {
        let reused = condensed.take().filter(|condensation| continuum.serves(condensation, constrained));
        let anew = reused.is_none();
        let condensation = match reused {
            Some(condensation) => condensation,
            None => Arc::new(continuum.condense(constrained)?),
        };
        condensed = Some(condensation.clone());
        Ok((condensation, anew))
    })
}

/// On the jump coefficients of the interfaces in `condensed_interfaces`.
pub(super) fn condensed<'a>(
    problem: &'a Problem,
    continuum: &'a Continuum,
    condensed_interfaces: &'a [usize],
    stiffness: &'a [Vec<f64>],
    settings: NewtonSettings,
) -> NewtonEngine<'a, Condensed<'a>> {
    let size: usize = condensed_interfaces.iter().map(|&k| problem.model.interfaces[k].size()).sum();
    let intact: Vec<Vec<f64>> = (problem.interfaces.iter().zip(&problem.model.interfaces))
        .map(|(bound, interface)| bound.laws.diagonals(&interface.coupling, f64::INFINITY))
        .collect();
    let mut base = bases(problem, continuum, stiffness);
    let make = move |constrained: &[bool]| {
        let (base, anew) = base(constrained)?;
        Ok((Condensed::new(base, condensed_interfaces, stiffness, &intact), anew))
    };
    NewtonEngine::new(problem, settings, Box::new(make), size)
}

/// On the jump coefficients of all interfaces and the rigid motions of floating bodies.
pub(super) fn blocks<'a>(
    problem: &'a Problem,
    continuum: &'a Continuum,
    stiffness: &'a [Vec<f64>],
    settings: NewtonSettings,
) -> NewtonEngine<'a, FloatingSubdomains<'a>> {
    let interfaces = &problem.model.interfaces;
    let mut condense = condensations(continuum);
    let make = move |constrained: &[bool]| {
        let (condensation, anew) = condense(constrained)?;
        Ok((FloatingSubdomains::new(continuum, condensation, interfaces, stiffness, constrained)?, anew))
    };
    NewtonEngine::new(problem, settings, Box::new(make), FloatingSubdomains::unknowns(continuum, interfaces))
}

/// On the displacements of the bodies' nodes on interfaces.
pub(super) fn joined<'a>(
    problem: &'a Problem,
    continuum: &'a Continuum,
    settings: NewtonSettings,
) -> NewtonEngine<'a, JoinedSubdomains<'a>> {
    let interfaces = &problem.model.interfaces;
    let mut condense = condensations(continuum);
    let make = move |constrained: &[bool]| {
        let (condensation, anew) = condense(constrained)?;
        Ok((JoinedSubdomains::new(continuum, condensation, interfaces, constrained), anew))
    };
    NewtonEngine::new(problem, settings, Box::new(make), JoinedSubdomains::unknowns(continuum))
}

/// On all displacements.
pub(super) fn plain<'a>(
    problem: &'a Problem,
    pattern: &'a Pattern,
    k: &'a Symmetric,
    condensed_interfaces: &'a [usize],
    stiffness: &'a [Vec<f64>],
    settings: NewtonSettings,
) -> NewtonEngine<'a, Primal<'a>> {
    let make = move |constrained: &[bool]| {
        Ok((
            Primal::new(
                &problem.model.interfaces,
                condensed_interfaces,
                stiffness,
                (pattern, problem.model.coordinates()),
                k,
                constrained,
            ),
            true,
        ))
    };
    NewtonEngine::new(problem, settings, Box::new(make), problem.model.dofs())
}

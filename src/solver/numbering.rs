//! Unknowns of floating bodies: jumps of all interfaces, then rigid motions of all bodies.

use super::Continuum;
use super::fronts::Layout;
use super::graph::NONE;
use super::rigid_modes::most;
use crate::assembly::InterfaceOperator;

/// Numbers of the unknowns.
pub(super) struct Numbering {
    /// First unknown of every interface, and of the motions.
    pub(super) first: Vec<usize>,
    /// Interfaces of every body.
    pub(super) of: Vec<Vec<usize>>,
    /// First motion of every body, and how many there could be.
    pub(super) starts: Vec<(usize, usize)>,
    pub(super) unknowns: usize,
}

impl Numbering {
    pub(super) fn new(continuum: &Continuum, interfaces: &[InterfaceOperator]) -> Numbering {
        let mut first = vec![0];
        interfaces.iter().for_each(|interface| first.push(first[first.len() - 1] + interface.size()));
        let mut unknowns = first[interfaces.len()];
        let mut starts = Vec::new();
        for b in 0..continuum.subdomains() {
            starts.push((unknowns, most(continuum.components(), continuum.pieces_of(b))));
            unknowns += starts[b].1;
        }
        let mut of: Vec<Vec<usize>> = vec![Vec::new(); continuum.subdomains()];
        for (k, interface) in interfaces.iter().enumerate() {
            interface.subdomains.iter().for_each(|&b| of[b].push(k));
        }
        of.iter_mut().for_each(|of| of.dedup());
        Numbering { first, of, starts, unknowns }
    }
}

/// Places of the Jacobian's entries: an element of every body, and the diagonal of the jumps. The motions of a body come
/// with the last of its interfaces.
pub(super) fn layout(continuum: &Continuum, interfaces: &[InterfaceOperator]) -> Layout {
    let Numbering { first, of, starts, unknowns } = Numbering::new(continuum, interfaces);
    let mut layout = Layout { node_of: vec![NONE; unknowns], ..Layout::default() };
    let (c, x) = (continuum.components(), continuum.coordinates());
    for (k, interface) in interfaces.iter().enumerate() {
        layout.node_of[first[k]..first[k + 1]].fill(k as u32);
        let dofs = || (0..interface.size()).flat_map(|i| interface.row(i).0).copied();
        for component in 0..c {
            let (sum, count) = dofs()
                .fold((0.0, 0.0), |(sum, count), dof| (sum + x[dof - dof % c + component], count + 1.0));
            layout.coordinates.push(if count > 0.0 { sum / count } else { 0.0 });
        }
    }
    layout.nodes = interfaces.len();
    for (of, &(start, most)) in of.iter().zip(&starts) {
        let motions = start..start + most;
        if of.is_empty() && !motions.is_empty() {
            layout.node_of[motions.clone()].fill(layout.nodes as u32);
            layout.nodes += 1;
            layout.coordinates.extend(std::iter::repeat_n(0.0, c));
        }
        let touched = of.iter().flat_map(|&k| first[k]..first[k + 1]);
        layout.elements.push(touched.chain(motions).map(|k| k as u32).collect());
    }
    layout.entries = (0..first[interfaces.len()] as u32).map(|k| (k, k)).collect();
    layout
}

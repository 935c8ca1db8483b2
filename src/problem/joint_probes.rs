//! Quantities of whole interfaces, of one or of several together.

use super::probe_input::ProbeInput;
use crate::assembly::Model;
use crate::coupling::LawPoint;
use crate::law::N;
use crate::scene::probe::{JointField, JointQuantity, RatePlace, Statistic};

/// A quantity of some interfaces together.
pub(super) fn joint_value(
    model: &Model,
    input: &ProbeInput,
    interfaces: &[usize],
    quantity: JointQuantity,
) -> f64 {
    let points = || {
        let of = |&k: &usize| {
            model.interfaces[k].coupling.points.iter().enumerate().map(move |(p, at)| (k, p, at))
        };
        interfaces.iter().flat_map(of)
    };
    let over = |value: &dyn Fn(usize, usize) -> f64| -> f64 {
        points().map(|(k, p, at)| at.weight * value(k, p)).sum()
    };
    let force = |field: JointField| model.thickness * over(&|k, p| input.field(k, p, field));
    match quantity {
        JointQuantity::Resultant(c) => force(JointField::Traction(c)),
        JointQuantity::TotalResultant => force(JointField::TotalTraction(N)),
        JointQuantity::Uplift => force(JointField::Pressure),
        JointQuantity::Moment => moment(model, input, &points().collect::<Vec<_>>()),
        JointQuantity::Rate(place) => {
            let rate = |&k: &usize| {
                let rates = input.water.ends.get(k).copied().unwrap_or_default();
                match place {
                    RatePlace::Start => rates.start,
                    RatePlace::End => rates.end,
                    RatePlace::Drains => rates.drains,
                }
            };
            interfaces.iter().map(rate).sum()
        }
        JointQuantity::Statistic(statistic, field) => {
            let values = points().map(|(k, p, _)| input.field(k, p, field));
            match statistic {
                Statistic::Max => values.fold(f64::NEG_INFINITY, f64::max),
                Statistic::Min => values.fold(f64::INFINITY, f64::min),
                Statistic::Mean => over(&|k, p| input.field(k, p, field)) / over(&|_, _| 1.0),
            }
        }
        JointQuantity::OpenLength => over(&|k, p| f64::from(u8::from(input.is_open(k, p)))),
        JointQuantity::CrackedLength => over(&|k, p| f64::from(u8::from(input.is_cracked(k, p)))),
    }
}

/// Moment of tractions about the middle of all their points.
fn moment(model: &Model, input: &ProbeInput, points: &[(usize, usize, &LawPoint)]) -> f64 {
    let length: f64 = points.iter().map(|(.., point)| point.weight).sum();
    let mean = |d: usize| points.iter().map(|(.., p)| p.weight * p.position[d]).sum::<f64>() / length;
    let middle = [mean(0), mean(1)];
    let turns = |&(k, p, point): &(usize, usize, &LawPoint)| {
        let t = &input.tractions[k][p];
        let [x, y] = [0, 1].map(|d| point.position[d] - middle[d]);
        let [fx, fy] = [0, 1].map(|d| t[0] * point.rotation[0][d] + t[1] * point.rotation[1][d]);
        model.thickness * point.weight * (x * fy - y * fx)
    };
    points.iter().map(turns).sum()
}

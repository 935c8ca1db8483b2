//! Rigid motions of what hangs together: translations, then turns about a centre in every plane of axes, over its size.

/// The rigid motions about a centre.
#[derive(Debug, Clone)]
pub struct RigidMotions {
    /// The centre, as many coordinates as displacements have [length].
    pub centre: Vec<f64>,
    /// The size that turns are divided by [length].
    pub size: f64,
    planes: Vec<(usize, usize)>,
}

impl RigidMotions {
    /// Motions about a centre.
    pub fn new(centre: Vec<f64>, size: f64) -> RigidMotions {
        let c = centre.len();
        let planes = (0..c).flat_map(|p| (p + 1..c).map(move |q| (p, q))).collect();
        RigidMotions { centre, size, planes }
    }

    /// Motions about the mean of points with so many coordinates, which reach as far as its size.
    pub fn of<'a>(components: usize, points: impl Iterator<Item = &'a [f64]> + Clone) -> RigidMotions {
        let count = points.clone().count() as f64;
        let mean = |d: usize| points.clone().map(|x| x[d]).sum::<f64>() / count;
        let centre: Vec<f64> = (0..components).map(mean).collect();
        let reach = |x: &[f64]| (0..components).map(|d| (x[d] - centre[d]).powi(2)).sum::<f64>().sqrt();
        let size = points.map(reach).fold(f64::MIN_POSITIVE, f64::max);
        RigidMotions::new(centre, size)
    }

    /// Number of motions with so many components of the displacement.
    pub fn most(components: usize) -> usize {
        components + components * (components - 1) / 2
    }

    /// Number of motions.
    pub fn count(&self) -> usize {
        self.centre.len() + self.planes.len()
    }

    /// A component of a motion at a place.
    pub fn value(&self, motion: usize, x: &[f64], d: usize) -> f64 {
        let from = |d: usize| (x[d] - self.centre[d]) / self.size;
        match motion.checked_sub(self.centre.len()).map(|k| self.planes[k]) {
            None => f64::from(u8::from(motion == d)),
            Some((p, q)) if p == d => -from(q),
            Some((p, q)) if q == d => from(p),
            Some(_) => 0.0,
        }
    }
}

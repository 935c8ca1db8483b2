//! The place of a peak between rows: the vertex of the parabola through the highest row and those beside it.

/// The rows around the largest |y| so far, each (x, y).
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Summit {
    last: Option<(f64, f64)>,
    before: Option<(f64, f64)>,
    top: Option<(f64, f64)>,
    after: Option<(f64, f64)>,
}

impl Summit {
    /// Takes the next row.
    pub(super) fn take(&mut self, x: f64, y: f64) {
        let y = y.abs();
        match self.top {
            Some((_, top)) if y <= top || y.is_nan() => {
                if self.last == self.top && self.after.is_none() {
                    self.after = Some((x, y));
                }
            }
            _ => (self.before, self.top, self.after) = (self.last, Some((x, y)), None),
        }
        self.last = Some((x, y));
    }

    /// x of the peak; that of its row where nothing lies on both sides of it.
    pub(super) fn place(&self) -> f64 {
        let Some((x, y)) = self.top else { return f64::NAN };
        let (Some((x0, y0)), Some((x1, y1))) = (self.before, self.after) else { return x };
        if (x - x0) * (x1 - x) <= 0.0 {
            return x; // the curve turns back there
        }
        let [rise, fall] = [(y - y0) / (x - x0), (y1 - y) / (x1 - x)];
        let curvature = (fall - rise) / (x1 - x0);
        let vertex = 0.5 * (x0 + x) - 0.5 * rise / curvature;
        let [low, high] = [0.5 * (x0 + x), 0.5 * (x + x1)];
        if (low..=high).contains(&vertex) || (high..=low).contains(&vertex) { vertex } else { x }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(rows: &[(f64, f64)]) -> f64 {
        let mut summit = Summit::default();
        rows.iter().for_each(|&(x, y)| summit.take(x, y));
        summit.place()
    }

    #[test]
    fn a_parabola_has_its_vertex_wherever_the_rows_are() {
        let curve = |x: f64| (x, -3.0 + 2.0 * (x - 0.37).powi(2)); // negative: its magnitude has the peak
        let at = [0.0, 0.2, 0.3, 0.55, 0.6, 0.9];
        let rows = at.map(curve);
        assert!((place(&rows) - 0.37).abs() < 1e-14);
        assert_eq!(place(&rows[..2]), 0.2, "it goes on rising");
        assert_eq!(place(&rows[3..]), 0.55, "it falls from the start");
        assert!(place(&[]).is_nan());
    }

    #[test]
    fn a_drop_and_a_way_back_leave_the_row() {
        assert_eq!(place(&[(0.0, 1.0), (1.0, 2.0), (1.0, 0.0)]), 1.0, "it drops");
        let corner = place(&[(0.0, 0.0), (1.0, 2.0), (0.5, 1.5), (0.0, 1.0)]);
        assert!((0.5..=1.0).contains(&corner), "{corner}");
    }
}

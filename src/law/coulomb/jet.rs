//! A number with its gradient with respect to the jump at the end of the way: forward differentiation, first order.

use std::ops::{Add, Div, Mul, Sub};

use nalgebra::Vector2;

/// A number that depends on the end of the way, or a constant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jet {
    /// The number itself.
    pub(super) value: f64,
    /// Its derivatives with respect to the end jump (n, t).
    pub(super) gradient: Vector2<f64>,
}

impl Jet {
    /// Both components of the end jump.
    pub(super) fn variables(jump: Vector2<f64>) -> [Jet; 2] {
        [Jet { value: jump.x, gradient: Vector2::x() }, Jet { value: jump.y, gradient: Vector2::y() }]
    }

    /// A function of it, by its value and its slope.
    pub(super) fn map(self, value: f64, slope: f64) -> Jet {
        Jet { value, gradient: self.gradient * slope }
    }

    pub(super) fn sqrt(self) -> Jet {
        let root = self.value.sqrt();
        self.map(root, 0.5 / root)
    }

    pub(super) fn min(self, other: Jet) -> Jet {
        if other.value < self.value { other } else { self }
    }

    pub(super) fn max(self, other: Jet) -> Jet {
        if other.value > self.value { other } else { self }
    }
}

impl From<f64> for Jet {
    fn from(value: f64) -> Jet {
        Jet { value, gradient: Vector2::zeros() }
    }
}

impl<J: Into<Jet>> Add<J> for Jet {
    type Output = Jet;

    fn add(self, other: J) -> Jet {
        let other = other.into();
        Jet { value: self.value + other.value, gradient: self.gradient + other.gradient }
    }
}

impl<J: Into<Jet>> Sub<J> for Jet {
    type Output = Jet;

    fn sub(self, other: J) -> Jet {
        let other = other.into();
        Jet { value: self.value - other.value, gradient: self.gradient - other.gradient }
    }
}

impl Mul for Jet {
    type Output = Jet;

    fn mul(self, other: Jet) -> Jet {
        let gradient = self.gradient * other.value + other.gradient * self.value;
        Jet { value: self.value * other.value, gradient }
    }
}

impl Mul<Jet> for f64 {
    type Output = Jet;

    fn mul(self, jet: Jet) -> Jet {
        Jet { value: self * jet.value, gradient: jet.gradient * self }
    }
}

impl Div for Jet {
    type Output = Jet;

    fn div(self, other: Jet) -> Jet {
        let value = self.value / other.value;
        Jet { value, gradient: (self.gradient - other.gradient * value) / other.value }
    }
}

//! Gradients of a field by finite differences.

use crate::field::Field;
use glam::DVec3;

/// A finite difference along each voxel axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum GradientOperator {
    /// `(f(p+1) - f(p-1)) / 2`, second order.
    #[default]
    Central,
    /// `f(p+1) - f(p)`, first order; backward where less than half a voxel remains ahead.
    Forward,
    /// `f(p) - f(p-1)`, first order; forward where less than half a voxel lies behind.
    Backward,
    /// `(8 (f(p+1) - f(p-1)) - (f(p+2) - f(p-2))) / 12`, fourth order; [`GradientOperator::Central`] where a tap would leave
    /// the voxel centres.
    CentralFourth,
    /// [`GradientOperator::Central`] smoothed across the other two axes with the weights 1-2-1 of taps a voxel apart.
    Sobel,
}

impl GradientOperator {
    /// The gradient at index coordinates `p`, in data units per voxel along each voxel axis.
    ///
    /// The place and the taps are held within the box of the voxel centres, and differences divided by the distance that is
    /// left: a linear field has one gradient everywhere. An axis of a single voxel contributes nothing.
    pub fn gradient(self, field: &Field, p: DVec3) -> DVec3 {
        let p = p.clamp(DVec3::ZERO, field.last_center());
        if self == Self::Sobel {
            return sobel(field, p);
        }
        DVec3::from_array([0, 1, 2].map(|axis| self.derivative(field, p, axis)))
    }

    fn derivative(self, field: &Field, p: DVec3, axis: usize) -> f64 {
        let last = field.last_center()[axis];
        let at = |x: f64| {
            let mut tap = p;
            tap[axis] = x;
            field.at_index(tap)
        };
        let difference = |from: f64, to: f64| {
            let (from, to) = (from.clamp(0.0, last), to.clamp(0.0, last));
            if to > from { (at(to) - at(from)) / (to - from) } else { 0.0 }
        };
        let x = p[axis];
        match self {
            Self::Forward if x <= last - 0.5 => difference(x, x + 1.0),
            Self::Forward => difference(x - 1.0, x),
            Self::Backward if x >= 0.5 => difference(x - 1.0, x),
            Self::Backward => difference(x, x + 1.0),
            Self::CentralFourth if x >= 2.0 && x <= last - 2.0 => {
                (8.0 * (at(x + 1.0) - at(x - 1.0)) - (at(x + 2.0) - at(x - 2.0))) / 12.0
            }
            Self::Central | Self::CentralFourth | Self::Sobel => difference(x - 1.0, x + 1.0),
        }
    }
}

/// From the 27 values at and around `p`, which lies within the voxel centres.
fn sobel(field: &Field, p: DVec3) -> DVec3 {
    const ACROSS: [f64; 3] = [0.25, 0.5, 0.25];
    const ALONG: [f64; 3] = [-1.0, 0.0, 1.0];
    let taps = [-1.0, 0.0, 1.0].map(|step| (p + step).clamp(DVec3::ZERO, field.last_center()));
    let mut sum = DVec3::ZERO;
    for n in 0..27 {
        let [i, j, k] = [n % 3, n / 3 % 3, n / 9];
        let weights = DVec3::new(
            ALONG[i] * ACROSS[j] * ACROSS[k],
            ACROSS[i] * ALONG[j] * ACROSS[k],
            ACROSS[i] * ACROSS[j] * ALONG[k],
        );
        sum += weights * field.at_index(DVec3::new(taps[i].x, taps[j].y, taps[k].z));
    }
    let span = taps[2] - taps[0];
    DVec3::select(span.cmpgt(DVec3::ZERO), sum / span, DVec3::ZERO)
}

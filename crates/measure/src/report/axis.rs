//! Logarithmic axes of plots.

/// A logarithmic axis.
#[derive(Clone, Copy)]
pub(crate) struct Axis {
    low: f64,
    high: f64,
    /// Where it starts, pixels.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
}

impl Axis {
    /// Over the positive of some values with a little air, at least `decades` wide.
    pub fn over(values: impl Iterator<Item = f64>, decades: f64, from: f64, to: f64) -> Self {
        let positive = values.filter(|x| *x > 0.0 && x.is_finite()).map(f64::log10);
        let (low, high) = positive.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let (low, high) = if low <= high { (low, high) } else { (-1.0, 0.0) };
        let air = (0.07 * (high - low)).max(0.5 * (decades - (high - low)));
        Self { low: low - air, high: high + air, from, to }
    }

    /// Where a value lies, pixels; what is below the axis, at its end.
    pub fn at(&self, value: f64) -> f64 {
        let log = if value > 0.0 { value.log10() } else { self.low };
        self.from + (log.clamp(self.low, self.high) - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Powers of ten; 1, 2 and 5 of each where there is room.
    pub fn ticks(&self) -> Vec<f64> {
        const ROOM: f64 = 170.0;
        let wide = (self.to - self.from).abs() / (self.high - self.low) < ROOM;
        let steps: &[f64] = if wide { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let decades = self.low.floor() as i32..=self.high.ceil() as i32;
        let ticks = decades.flat_map(|decade| steps.iter().map(move |step| step * 10f64.powi(decade)));
        ticks.filter(|tick| (self.low..=self.high).contains(&tick.log10())).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_logarithmic_and_hold_their_values() {
        let axis = Axis::over([1.0, 100.0, 0.0, f64::INFINITY].into_iter(), 1.0, 0.0, 100.0);
        assert!((axis.at(10.0) - 50.0).abs() < 1e-9);
        assert!(axis.at(1.0) > 0.0 && axis.at(100.0) < 100.0 && axis.at(0.0) == 0.0);
        assert_eq!(axis.ticks(), [1.0, 10.0, 100.0]);
        assert!(Axis::over([3.0].into_iter(), 1.0, 0.0, 400.0).ticks().contains(&2.0));
    }
}

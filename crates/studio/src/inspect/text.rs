//! Numbers as text.

/// A number with about four significant digits.
pub(crate) fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".into()
    } else if !(1e-3..1e6).contains(&size) {
        format!("{value:.3e}")
    } else {
        let digits = (3.0 - size.log10().floor()).clamp(0.0, 6.0) as usize;
        let text = format!("{value:.digits$}");
        match text.contains('.') {
            true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
            false => text,
        }
    }
}

/// An amount of memory.
pub(crate) fn bytes(count: u64) -> String {
    let units = ["bytes", "KiB", "MiB", "GiB", "TiB"];
    let step = (0..units.len() - 1).find(|&step| count < 1 << (10 * (step + 1))).unwrap_or(units.len() - 1);
    format!(
        "{} {}",
        number(count as f64 / f64::from(1u32 << (10 * step.min(3))) / if step > 3 { 1024.0 } else { 1.0 }),
        units[step]
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_memory_has_units() {
        let shown = [0.0, 1.0, 0.5, 1.0 / 3.0, -12.34567, 123456.7, 1e-9, 3e38].map(number);
        assert_eq!(shown, ["0", "1", "0.5", "0.3333", "-12.35", "123457", "1.000e-9", "3.000e38"]);
        assert_eq!([0, 1023, 1024, 3 << 20, 1 << 40].map(bytes), ["0 bytes", "1023 bytes", "1 KiB", "3 MiB", "1 TiB"]);
    }
}

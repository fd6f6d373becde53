//! Numbers and words as a reader likes them.

/// A number with two or three significant digits: 0.0042, 3.1, 12 000 as "12,000", 2.5 million.
pub(crate) fn number(x: f64) -> String {
    let size = x.abs();
    match size {
        _ if x == 0.0 => "0".into(),
        _ if !x.is_finite() => "\u{221e}".into(),
        _ if size < 1e-4 => scientific(x),
        _ if size < 100.0 => {
            let digits = (1 - size.log10().floor() as i32).clamp(0, 6) as usize;
            trimmed(format!("{x:.digits$}"))
        }
        _ if size < 1e6 => grouped(x),
        _ if size < 1e9 => format!("{} million", trimmed(format!("{:.1}", x / 1e6))),
        _ => format!("{} billion", trimmed(format!("{:.1}", x / 1e9))),
    }
}

/// "1.2 ms", with three digits.
pub(crate) fn milliseconds(ms: f64) -> String {
    let digits = if ms < 1.0 {
        3
    } else if ms < 10.0 {
        2
    } else if ms < 100.0 {
        1
    } else {
        0
    };
    format!("{ms:.digits$} ms")
}

/// "43.2 dB", and a word for no difference.
pub(crate) fn decibels(db: f64) -> String {
    if db == f64::INFINITY { "equal".into() } else { format!("{db:.1} dB") }
}

/// "1.2 %", and never "0 %" or "100 %" for what is not quite that.
pub(crate) fn percent(share: f64) -> String {
    match 100.0 * share {
        0.0 => "0 %".into(),
        small if small < 0.01 => "< 0.01 %".into(),
        few if few < 10.0 => format!("{} %", trimmed(format!("{few:.2}"))),
        much if share < 1.0 => format!("{:.1} %", much.min(99.9)),
        _ => "100 %".into(),
    }
}

/// "3.1e-7".
fn scientific(x: f64) -> String {
    let text = format!("{x:.1e}");
    text.replace(".0e", "e")
}

fn grouped(x: f64) -> String {
    let digits = format!("{x:.0}");
    match digits.len() > 3 {
        true => format!("{},{}", &digits[..digits.len() - 3], &digits[digits.len() - 3..]),
        false => digits,
    }
}

fn trimmed(text: String) -> String {
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

/// Text for HTML and SVG, in elements and quoted attributes.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_right() {
        let texts = [0.0, 3.14e-7, 0.00421, 0.5, 3.21, 42.0, 123.4, 12_345.0, 2.5e6, 7.0e9].map(number);
        assert_eq!(texts, ["0", "3.1e-7", "0.0042", "0.5", "3.2", "42", "123", "12,345", "2.5 million", "7 billion"]);
        assert_eq!(
            [0.0, 1e-6, 0.0123, 0.5, 0.9999, 1.0].map(percent),
            ["0 %", "< 0.01 %", "1.23 %", "50.0 %", "99.9 %", "100 %"]
        );
        assert_eq!([0.1234, 1.234, 12.34, 123.4].map(milliseconds), ["0.123 ms", "1.23 ms", "12.3 ms", "123 ms"]);
    }
}

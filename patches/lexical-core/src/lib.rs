//! Decimals at the beginning of a text, read by the standard library: the part of lexical-core that nom calls.

/// No number stands at the beginning of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NoNumber;

/// A number that the standard library reads.
pub trait Number: std::str::FromStr {}

impl Number for f32 {}
impl Number for f64 {}

/// The number at the beginning of a text, and how many bytes it takes: a sign, digits with a point among them or at their ends,
/// an exponent.
pub fn parse_partial<N: Number>(bytes: &[u8]) -> Result<(N, usize), NoNumber> {
    let digits = |from: usize| bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let sign = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let mut end = sign(0);
    let whole = digits(end);
    end += whole;
    let mut fraction = 0;
    if bytes.get(end) == Some(&b'.') {
        fraction = digits(end + 1);
        if whole + fraction > 0 {
            end += 1 + fraction;
        }
    }
    if whole + fraction == 0 {
        return Err(NoNumber);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let start = end + 1 + sign(end + 1);
        let exponent = if start <= bytes.len() { digits(start) } else { 0 };
        if exponent > 0 {
            end = start + exponent;
        }
    }
    let text = std::str::from_utf8(&bytes[..end]).map_err(|_| NoNumber)?;
    text.parse().map(|number| (number, end)).map_err(|_| NoNumber)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_ends_where_it_ends() {
        for (text, value, length) in [
            ("1", 1.0, 1),
            ("-0.5 2", -0.5, 4),
            ("+1.e3,", 1000.0, 5),
            (".25x", 0.25, 3),
            ("1e", 1.0, 1),
            ("1e+", 1.0, 1),
            ("1e-7 ", 1e-7, 4),
            ("4.9406564584124654e-324\n", 5e-324, 23),
            ("0.1000000000000000055511151231257827", 0.1, 36),
        ] {
            assert_eq!(parse_partial(text.as_bytes()), Ok((value, length)), "{text}");
        }
        for text in ["", "-", ".", "e5", "nan", "x", "-.e1"] {
            assert_eq!(parse_partial::<f64>(text.as_bytes()), Err(NoNumber), "{text}");
        }
    }
}

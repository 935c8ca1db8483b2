//! A position in the bytes of an MSH file: reads and skips numbers, text or binary, never past the end.

/// Encoding of the numbers of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    /// Decimal, separated by white space.
    Text,
    /// Binary, least significant byte first.
    Little,
    /// Binary, most significant byte first.
    Big,
}

/// Bytes of a count, tag or coordinate in a binary file; the header is checked to say so.
const NUMBER: usize = 8;

/// The reading position.
#[derive(Debug, Clone)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    encoding: Encoding,
}

impl<'a> Cursor<'a> {
    /// Starts at byte `at`.
    pub(super) fn new(bytes: &'a [u8], at: usize, encoding: Encoding) -> Cursor<'a> {
        Cursor { bytes, at, encoding }
    }

    /// Bytes not yet read.
    pub(super) fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// Passes over white space.
    pub(super) fn skip_space(&mut self) {
        while self.at < self.bytes.len() && is_space(self.bytes[self.at]) {
            self.at += 1;
        }
    }

    /// A line `$Name`: the name, with the position on the next line.
    pub(super) fn section(&mut self) -> Option<&'a [u8]> {
        self.skip_space();
        let rest = self.bytes[self.at..].strip_prefix(b"$")?;
        let letters = rest.iter().take_while(|b| b.is_ascii_alphabetic()).count();
        let newline = if rest[letters..].starts_with(b"\r\n") { 2 } else { 1 };
        if !rest[letters..].starts_with(b"\n") && newline == 1 {
            return None;
        }
        self.at += 1 + letters + newline;
        Some(&rest[..letters])
    }

    /// The bytes up to the marker `$EndName`, with the position behind it.
    pub(super) fn until_end(&mut self, name: &[u8]) -> Option<&'a [u8]> {
        let marker = [b"$End", name].concat();
        let rest = &self.bytes[self.at..];
        let mut from = 0;
        loop {
            let dollar = from + rest[from..].iter().position(|&b| b == b'$')?;
            if rest[dollar..].starts_with(&marker) {
                self.at += dollar + marker.len();
                return Some(&rest[..dollar]);
            }
            from = dollar + 1;
        }
    }

    /// True if the marker `$EndName` comes next; the position is then behind it.
    pub(super) fn at_end(&mut self, name: &[u8]) -> bool {
        self.skip_space();
        let marker = [b"$End", name].concat();
        let found = self.bytes[self.at..].starts_with(&marker);
        if found {
            self.at += marker.len();
        }
        found
    }

    /// An unsigned integer.
    pub(super) fn size(&mut self) -> Option<u64> {
        match self.encoding {
            Encoding::Text => digits(self.token()?),
            Encoding::Little => Some(u64::from_le_bytes(self.array()?)),
            Encoding::Big => Some(u64::from_be_bytes(self.array()?)),
        }
    }

    /// A signed integer.
    pub(super) fn int(&mut self) -> Option<i32> {
        match self.encoding {
            Encoding::Text => {
                let token = self.token()?;
                let value = match token.strip_prefix(b"-") {
                    Some(positive) => -i128::from(digits(positive)?),
                    None => i128::from(digits(token)?),
                };
                i32::try_from(value).ok()
            }
            Encoding::Little => Some(i32::from_le_bytes(self.array()?)),
            Encoding::Big => Some(i32::from_be_bytes(self.array()?)),
        }
    }

    /// The bytes of the next `count` counts, tags or coordinates.
    pub(super) fn skip(&mut self, count: usize) -> Option<&'a [u8]> {
        let start = self.at;
        match self.encoding {
            Encoding::Text => {
                for _ in 0..count {
                    self.token()?;
                }
            }
            Encoding::Little | Encoding::Big => {
                let length = count.checked_mul(NUMBER).filter(|&length| length <= self.left())?;
                self.at += length;
            }
        }
        Some(&self.bytes[start..self.at])
    }

    /// True if `count` counts, tags or coordinates can stand in the bytes that are left: the guard against claimed counts.
    pub(super) fn holds(&self, count: u64) -> bool {
        let width = match self.encoding {
            Encoding::Text => 2, // a digit and a separator
            Encoding::Little | Encoding::Big => NUMBER as u64,
        };
        count.checked_mul(width).is_some_and(|bytes| bytes <= self.left() as u64)
    }

    fn token(&mut self) -> Option<&'a [u8]> {
        self.skip_space();
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|&b| is_space(b)).unwrap_or(rest.len());
        if length == 0 || rest[0] == b'$' {
            return None;
        }
        self.at += length;
        Some(&rest[..length])
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (array, _) = self.bytes[self.at..].split_first_chunk::<N>()?;
        self.at += N;
        Some(*array)
    }
}

fn is_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r' | b'\n')
}

fn digits(token: &[u8]) -> Option<u64> {
    if token.is_empty() {
        return None;
    }
    token.iter().try_fold(0_u64, |value, &b| {
        let digit = b.is_ascii_digit().then(|| u64::from(b - b'0'))?;
        value.checked_mul(10)?.checked_add(digit)
    })
}

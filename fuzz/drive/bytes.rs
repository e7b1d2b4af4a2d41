//! Bytes as a stream of decisions. At its end everything is 0.

/// Numbers at which programs break.
const SPECIAL: [f64; 24] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    0.6,
    1e-3,
    1e-9,
    1e-300,
    f64::MIN_POSITIVE,
    f64::EPSILON,
    1e3,
    1e6,
    1e11,
    1e12,
    1.000001e12,
    1e30,
    1e154,
    1e300,
    f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    -1e12,
];

pub struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    pub fn new(data: &'a [u8]) -> Self {
        Self(data)
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn byte(&mut self) -> u8 {
        match self.0.split_first() {
            Some((first, rest)) => {
                self.0 = rest;
                *first
            }
            None => 0,
        }
    }

    /// Below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        self.byte() as usize % n
    }

    /// One time in so many.
    pub fn rarely(&mut self, n: usize) -> bool {
        self.below(n) == n - 1
    }

    pub fn pick<'l, T>(&mut self, list: &'l [T]) -> &'l T {
        &list[self.below(list.len())]
    }

    pub fn take(&mut self, n: usize) -> &'a [u8] {
        let (taken, rest) = self.0.split_at(n.min(self.0.len()));
        self.0 = rest;
        taken
    }

    pub fn word(&mut self) -> u64 {
        let mut word = [0; 8];
        let taken = self.take(8);
        word[..taken.len()].copy_from_slice(taken);
        u64::from_le_bytes(word)
    }

    /// In `[0, 1]`, in steps of 1/255.
    pub fn share(&mut self) -> f64 {
        self.byte() as f64 / 255.0
    }

    /// Mostly a plain number of the given size, now and then a special one or any bits at all.
    pub fn number(&mut self, scale: f64) -> f64 {
        match self.byte() {
            0 => *self.pick(&SPECIAL),
            1 => f64::from_bits(self.word()),
            b => (b as f64 + self.share()) / 255.0 * scale,
        }
    }

    /// A text: some of the bytes.
    pub fn text(&mut self) -> Vec<u8> {
        let length = self.byte() as usize;
        self.take(length).to_vec()
    }
}

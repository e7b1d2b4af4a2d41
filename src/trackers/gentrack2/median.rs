//! Medians: of a list, and of one whose median is about known.

/// A number as an integer of the same order: comparing integers is what makes selection fast.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct OrderKey(i64);

impl From<f64> for OrderKey {
    fn from(x: f64) -> Self {
        let bits = x.to_bits() as i64;
        Self(bits ^ ((bits >> 63) as u64 >> 1) as i64)
    }
}

impl From<OrderKey> for f64 {
    fn from(OrderKey(key): OrderKey) -> f64 {
        // The transformation is its own inverse: it leaves the sign bit alone.
        f64::from_bits((key ^ ((key >> 63) as u64 >> 1) as i64) as u64)
    }
}

/// The median, the mean of the middle two for an even number, 0 for none. Reorders the values.
pub fn median(values: &mut [OrderKey]) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    let even = values.len().is_multiple_of(2);
    let (lower, upper, _) = values.select_nth_unstable(middle);
    let upper = f64::from(*upper);
    match lower.iter().max().filter(|_| even) {
        Some(lower) => 0.5 * (f64::from(*lower) + upper),
        None => upper,
    }
}

/// Steps from a guess to the median after which selection is quicker.
const MOST_STEPS: usize = 4;

/// The median as by [`median`], sought from a guess: the values on either side of it are counted, and if the middle is
/// not there, it goes on to the next value.
pub fn median_near(values: &[f32], guess: f32, keys: &mut Vec<OrderKey>) -> f32 {
    if values.is_empty() {
        return 0.0;
    }
    let (upper, even) = (values.len() / 2, values.len().is_multiple_of(2));
    // A guess of -0 would pass for a slope of 0.
    let mut at = guess + 0.0;
    for _ in 0..MOST_STEPS {
        let (less, not_more) = ranks(values, at);
        if upper < less {
            at = below(values, at);
        } else if upper > not_more {
            at = above(values, at);
        } else if upper == not_more {
            // The next value has this rank; the one before it may be here, or further down.
            let next = above(values, at);
            return match even {
                false => next,
                true if less < not_more => 0.5 * (at + next),
                true => 0.5 * (below(values, at) + next),
            };
        } else if even && upper == less {
            return 0.5 * (below(values, at) + at);
        } else {
            return at;
        }
    }
    keys.clear();
    keys.extend(values.iter().map(|x| OrderKey::from(f64::from(*x))));
    median(keys) as f32
}

/// Loops in lanes are what a compiler vectorises.
const LANES: usize = 8;

/// How many values are less than one, and how many are not more.
fn ranks(values: &[f32], at: f32) -> (usize, usize) {
    let (mut less, mut not_more) = ([0u32; LANES], [0u32; LANES]);
    let (chunks, rest) = values.as_chunks::<LANES>();
    for chunk in chunks {
        for lane in 0..LANES {
            less[lane] += u32::from(chunk[lane] < at);
            not_more[lane] += u32::from(chunk[lane] <= at);
        }
    }
    for x in rest {
        less[0] += u32::from(*x < at);
        not_more[0] += u32::from(*x <= at);
    }
    (less.iter().sum::<u32>() as usize, not_more.iter().sum::<u32>() as usize)
}

/// The largest value that is less.
fn below(values: &[f32], at: f32) -> f32 {
    nearest(values, f32::NEG_INFINITY, |best, x| if x < at && x > best { x } else { best })
}

/// The smallest value that is more.
fn above(values: &[f32], at: f32) -> f32 {
    nearest(values, f32::INFINITY, |best, x| if x > at && x < best { x } else { best })
}

fn nearest(values: &[f32], none: f32, better: impl Fn(f32, f32) -> f32) -> f32 {
    let mut best = [none; LANES];
    let (chunks, rest) = values.as_chunks::<LANES>();
    for chunk in chunks {
        for lane in 0..LANES {
            best[lane] = better(best[lane], chunk[lane]);
        }
    }
    rest.iter().chain(&best).fold(none, |best, x| better(best, *x))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn order_keys_order_like_their_numbers_and_give_them_back() {
        let sorted = [f64::NEG_INFINITY, -2.5, -1e-300, 0.0, 1e-300, 1.0, 3.75];
        for pair in sorted.windows(2) {
            assert!(OrderKey::from(pair[0]) < OrderKey::from(pair[1]));
            assert_eq!(f64::from(OrderKey::from(pair[0])), pair[0]);
        }
    }

    proptest! {
        #[test]
        fn the_median_is_the_same_from_any_guess(
            tenths in proptest::collection::vec(-20i32..20, 0..70),
            guess in -30i32..30,
        ) {
            let values: Vec<f32> = tenths.iter().map(|x| *x as f32 / 10.0).collect();
            let mut keys: Vec<OrderKey> = values.iter().map(|x| OrderKey::from(f64::from(*x))).collect();
            let found = median_near(&values, guess as f32 / 10.0, &mut Vec::new());
            prop_assert_eq!(found.to_bits(), (median(&mut keys) as f32).to_bits());
        }
    }
}

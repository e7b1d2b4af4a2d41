//! Which columns are still to be had, and their numbers among these.

use crate::assignment::UNMATCHED;
use crate::buffers::refill;

/// What a column has for a number that is another row's.
pub const TAKEN: u32 = UNMATCHED - 1;

/// Numbers for so many columns: none yet but for those that rows have for partners.
pub fn begin(number_of: &mut Vec<u32>, columns: usize, partners: &[u32]) {
    refill(number_of, columns, UNMATCHED);
    partners.iter().filter(|c| **c != UNMATCHED).for_each(|c| number_of[*c as usize] = TAKEN);
}

/// How many plain columns have no number: they overlap nobody, and are as good for one row as for another.
pub fn spare(number_of: &[u32], is_plain: impl Fn(u32) -> bool) -> usize {
    (0..).zip(number_of).filter(|(column, number)| **number == UNMATCHED && is_plain(*column)).count()
}

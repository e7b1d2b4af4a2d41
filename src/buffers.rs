//! Lists that serve again from step to step, as long as the tracks are many. `Vec` by itself grows to twice its size; these
//! grow by a thirty-second, so that a crowd of any number has hardly more memory than it fills.

/// Makes room for so many items in all.
pub(crate) fn make_room<T>(buffer: &mut Vec<T>, length: usize) {
    if length > buffer.capacity() {
        // Of few items some more: they cost little, and a list of ten would move with each new one.
        let spare = (length / 32).max(8);
        buffer.reserve_exact(length + spare - buffer.len());
    }
}

/// Sets a buffer to so many equal values.
pub(crate) fn refill<T: Copy>(buffer: &mut Vec<T>, length: usize, value: T) {
    buffer.clear();
    make_room(buffer, length);
    buffer.resize(length, value);
}

/// Sets a buffer to what comes, of which it has to be known how many there are.
pub(crate) fn collect<T>(buffer: &mut Vec<T>, items: impl Iterator<Item = T>) {
    buffer.clear();
    append(buffer, items);
}

/// Adds what comes, of which it has to be known how many there are.
pub(crate) fn append<T>(buffer: &mut Vec<T>, items: impl Iterator<Item = T>) {
    make_room(buffer, buffer.len() + items.size_hint().0);
    buffer.extend(items);
}

/// Adds an item.
pub(crate) fn push<T>(buffer: &mut Vec<T>, item: T) {
    make_room(buffer, buffer.len() + 1);
    buffer.push(item);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_filled_is_a_thirty_second_at_most() {
        let mut pushed = Vec::new();
        let mut moves = 0;
        for n in 0..10_000u64 {
            let before = pushed.capacity();
            push(&mut pushed, n);
            moves += usize::from(pushed.capacity() != before);
            let most = pushed.len() + (pushed.len() / 32).max(8);
            assert!(pushed.capacity() <= most, "room for {} of {}", pushed.capacity(), pushed.len());
        }
        // By eights up to 256, and then 32/33 of the rest each time: 1.03125^120 is 40.
        assert!(moves < 32 + 120 + 8, "moved {moves} times");
        assert!(pushed.iter().copied().eq(0..10_000));

        let mut filled = Vec::new();
        for length in [1, 100, 3000, 3001, 3187, 3188, 20] {
            refill(&mut filled, length, 7);
            assert_eq!(filled, vec![7; length]);
        }
        assert_eq!(filled.capacity(), 3187 + 99);
        collect(&mut filled, [1, 2, 3].into_iter());
        assert_eq!((&filled[..], filled.capacity()), (&[1, 2, 3][..], 3187 + 99));
        collect(&mut filled, std::iter::repeat_n(4, 3400));
        assert_eq!((filled.len(), filled.capacity()), (3400, 3400 + 106));
    }
}

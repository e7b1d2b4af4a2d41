// What is fuzzed of gt2_mot's reader of MOTChallenge files, as a function of bytes: libfuzzer.cpp runs it under a
// coverage-guided fuzzer, and examples_cpp/tests/mot_reader_test.cpp on the committed seeds and on random children of
// them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mot_reader {

/// Reads what the bytes hold as files: up to three of them, with the byte 0x1e between, after a first part of options.
/// Ends the process, with a message, if the reader breaks a promise. True if all files were accepted.
///
/// | part | what |
/// |---|---|
/// | 1 | letters: `n` normalises scores, `s` and `h` filter, `c` reads classes, `e` embeddings of a digit's length |
/// | 2 | detections, which are also read as ground truth |
/// | 3 | camera motion |
/// | 4 | embeddings; short of the dimension times the rows it is repeated if the options have an `r` |
bool run(const std::uint8_t *data, std::size_t size);

}  // namespace mot_reader

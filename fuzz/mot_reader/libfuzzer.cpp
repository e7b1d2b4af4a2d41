#include "drive.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    mot_reader::run(data, size);
    return 0;
}

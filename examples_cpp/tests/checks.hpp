// What the tests of the programs' parts share.
#pragma once

#include <cstdio>
#include <cstdlib>

inline void check(bool holds, const char *what, const char *file, int line) {
    if (holds) return;
    std::fprintf(stderr, "%s:%d: %s\n", file, line, what);
    std::exit(1);
}
#define CHECK(what) check((what), #what, __FILE__, __LINE__)

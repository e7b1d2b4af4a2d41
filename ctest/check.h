/* A check that keeps working with NDEBUG, tells where it failed and lets the test go on. */
#ifndef CHECK_H
#define CHECK_H

#include <stdio.h>
#include <string.h>

#include "gentrack2.h"

static int check_failures = 0;

static inline int check_that(int holds, const char *what, const char *file, int line) {
    if (!holds) {
        check_failures++;
        fprintf(stderr, "%s:%d: does not hold: %s\n", file, line, what);
    }
    return holds;
}

static inline void check_status(gt2_status status, gt2_status expected, const char *what, const char *file, int line) {
    if (status != expected) {
        check_failures++;
        fprintf(stderr, "%s:%d: %s gave %d (%s), not %d (%s); last error: %s\n", file, line, what, (int)status,
                gt2_status_str(status), (int)expected, gt2_status_str(expected), gt2_last_error_message());
    }
}

static inline void check_message(const char *part, const char *file, int line) {
    if (strstr(gt2_last_error_message(), part) == NULL) {
        check_failures++;
        fprintf(stderr, "%s:%d: \"%s\" is not in \"%s\"\n", file, line, part, gt2_last_error_message());
    }
}

#define CHECK(condition) check_that((condition) != 0, #condition, __FILE__, __LINE__)
#define CHECK_STATUS(call, expected) check_status((call), (expected), #call, __FILE__, __LINE__)
#define CHECK_OK(call) CHECK_STATUS(call, GT2_OK)
#define CHECK_MESSAGE(part) check_message((part), __FILE__, __LINE__)

/* What main returns. */
static inline int check_result(void) {
    if (check_failures > 0) {
        fprintf(stderr, "%d checks failed\n", check_failures);
    }
    return check_failures > 0;
}

#endif

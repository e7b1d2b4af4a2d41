// What every program's main does around its work.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace examples {

/// Runs `work` with the arguments; an exception becomes one line on stderr, "NAME: why", and a failing status.
int run_program(const std::string &name, int argc, char **argv,
                const std::function<void(const std::vector<std::string> &)> &work);

}  // namespace examples

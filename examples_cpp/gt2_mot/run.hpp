// A whole run: every frame read, detected, tracked, drawn and written.
#pragma once

#include "options.hpp"

namespace gt2_mot {

/// Does what the options say. Throws `UserError`.
void run(const Options &options);

}  // namespace gt2_mot

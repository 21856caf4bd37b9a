// SPDX-License-Identifier: MIT
// Runs one test from its options to its results.
#pragma once

#include "options.hpp"

namespace triaxial {

/// Runs (or resumes) a test; 0, or 128 + signal where one stopped it after a checkpoint. Throws clast::input_error and
/// clast::run_error.
int run_test(const options& o);

} // namespace triaxial

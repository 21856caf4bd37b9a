// SPDX-License-Identifier: MIT
// The two ways in which a clast program ends early: wrong input (exit code 2) and a run that failed (exit code 3).
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace clast {

/// Wrong input: names the option, the value, the allowed range and a way out. Programs end with exit code 2.
class input_error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;

    /// "--confining: -2 MPa is not allowed; allowed: ...; try ..."
    input_error(const std::string& option, const std::string& value, const std::string& allowed,
                const std::string& way_out)
        : std::runtime_error(
              fmt::format("{}: '{}' is not accepted. Allowed: {}. {}", option, value, allowed, way_out)) {}
};

/// What a failed run has to say (design invariant 5: no silent failure). All texts are whole sentences or phrases.
struct failure {
    std::string what;   ///< what happened, e.g. "a grain escaped through the membrane"
    std::string where;  ///< stage and place
    std::string when;   ///< step, time (s), axial strain
    std::string why;    ///< the likely cause
    std::string advice; ///< what to change
};

/// A run that had to stop. Programs save nothing over the last good checkpoint and end with exit code 3.
class run_error : public std::runtime_error {
  public:
    explicit run_error(failure f)
        : std::runtime_error(fmt::format("{}\n  where: {}\n  when: {}\n  why: {}\n  what to change: {}", f.what,
                                         f.where, f.when, f.why, f.advice)),
          details(std::move(f)) {}

    failure details;
};

inline constexpr int exit_input_error = 2;
inline constexpr int exit_run_error = 3;

} // namespace clast

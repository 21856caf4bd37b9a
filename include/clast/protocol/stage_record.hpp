// SPDX-License-Identifier: MIT
// What has become of a stage: how it ended, and in what state it left the specimen.
#pragma once

#include <cstdint>
#include <string>

namespace clast {

/// One stage that has ended. SI units; stress positive in compression.
struct stage_record {
    std::string name;
    std::string end;               ///< what ended it, in words
    bool reached = true;           ///< whether that was the condition of the stage
    double largest_p = 0.0;        ///< largest mean stress of the walls (Pa), as seen every few steps
    double p = 0.0;                ///< mean stress of the walls at its end (Pa)
    double friction = 0.0;         ///< least friction between pebbles that it used
    double coordination = 0.0;     ///< touching neighbours per body at its end
    double porosity = 0.0;         ///< 1 - V_s / V at its end
    double unbalanced_ratio = 0.0; ///< at its end
    std::int64_t steps = 0;        ///< that it took

    template <class A> void archive(A& a) {
        a(name, end, reached, largest_p, p, friction, coordination, porosity, unbalanced_ratio, steps);
    }
};

} // namespace clast

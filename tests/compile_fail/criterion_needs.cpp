// SPDX-License-Identifier: MIT
// A criterion that needs what no engine fills is refused, not given zeros.
// expect: the breakage criterion `needs` something of a grain_load that an engine does not fill
#include <clast/engine/engine.hpp>

struct curious {
    static constexpr bool evaluated = true;
#ifdef CLAST_BREAK
    static constexpr auto needs = static_cast<clast::criteria::needs>(1U << 20U);
#else
    static constexpr auto needs = clast::criteria::everything;
#endif
    double utilisation(const clast::criteria::grain_load&) const { return 0.0; }
};
struct policies : clast::triaxial_policies_default {
    using breakage = curious;
};
static_assert(sizeof(clast::engine<policies>) > 0);

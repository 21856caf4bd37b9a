// SPDX-License-Identifier: MIT
// A condition that keeps state of its own would lose it at a checkpoint.
// expect: a condition keeps no state of its own \(a mutable lambda\).*stage_view::memory
#include <clast/protocol/stage.hpp>

clast::condition own();
clast::condition own() {
#ifdef CLAST_BREAK
    const auto met = [peak = 0.0](const clast::stage_view& v) mutable {
        return v.q < 0.9 * (peak = v.q > peak ? v.q : peak);
    };
    return {"q below its peak", met, [](const clast::stage_view&) { return 0.0; }};
#else
    const auto met = [](const clast::stage_view& v) {
        double& peak = v.memory[0];
        return v.q < 0.9 * (peak = v.q > peak ? v.q : peak);
    };
    return {"q below its peak", met, [](const clast::stage_view&) { return 0.0; }, 1};
#endif
}

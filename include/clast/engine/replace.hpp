// SPDX-License-Identifier: MIT
// When the replacement policy is asked: in the sweep, about every clump whose loads are complete; at the end of a step,
// so that the next evaluation of forces already sees what has become of those that it wanted, and no ball is integrated
// without its bonds. What it may do is in surgery.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <clast/core/errors.hpp>
#include <clast/engine/grain_view.hpp>
#include <clast/engine/scene.hpp>
#include <clast/engine/step_limit.hpp>
#include <clast/engine/surgery.hpp>

namespace clast::rooms {

/// Throws input_error where pebbles of a grain overlap: as balls or in parts they would have another mass, and push.
template <class Body> void refuse_overlapping(const Body& bodies) {
    for (const shape& s : bodies.shapes)
        if (s.overlapping)
            throw input_error(fmt::format("shape '{}'", s.name), "pebbles that overlap",
                              "pebbles that touch, where grains may be replaced",
                              "Take replacements::none, or pebbles that touch.");
}
/// Asks a policy that has a member check(shape, scale, stiffness) about every grain: stiffness is that of a typical
/// contact between pebbles (N/m).
template <class S> void check_replacement(const S& s) {
    const auto& policy = s.settings.replacement;
    if constexpr (requires { policy.check(s.grains.shapes[0], 1.0, 1.0); }) {
        const double contact = s.settings.grain_contact.normal_stiffness(s.typical_overlap(expected_overlap(s)));
        for (const grain& g : s.grains.grains) policy.check(s.grains.shape_of(g), g.scale, contact);
    }
}
/// Whether clumps are looked at in this step.
template <class S> bool looks_at_clumps(const S& s) {
    if constexpr (S::replaces && S::has_criterion)
        return s.breakage_on && s.totals.steps % s.settings.replacement.looks_every() == 0;
    return false;
}
/// What a sweep does with a body whose load is complete, in a step that looks at clumps or not.
template <class S> auto marks_critical([[maybe_unused]] const S& s, [[maybe_unused]] bool looks) {
    if constexpr (S::replaces && S::has_criterion)
        return [&s, looks](std::size_t body, typename S::work& work) {
            if (!looks) return;
            if (auto plan = s.settings.replacement.wants(grain_view<S>(s, body)))
                work.marked.push_back({static_cast<std::int32_t>(body), *std::move(plan)});
        };
    else
        return [](std::size_t, range_work&) {};
}

/// Lets the policy act on those that it has marked, then asks it about those that it wanted to be asked about again.
template <class S> void replace_marked(S& s) {
    if constexpr (S::replaces) {
        const auto& policy = s.settings.replacement;
        auto& marked = s.replacing.marked;
        for (auto& r : s.sweeping) {
            std::move(r.marked.begin(), r.marked.end(), std::back_inserter(marked));
            r.marked.clear();
        }
        surgery<S> room(s);
        // by number: a grain that is split moves those behind it up
        for (std::size_t k = 0; k < marked.size(); ++k) {
            const auto one = marked[k];
            policy.act(one.grain, one.plan, room);
        }
        marked.clear();
        if constexpr (surgery<S>::may_be_asked_again) {
            std::vector<std::int32_t> due = s.replacing.take_due(s.totals.steps);
            for (std::size_t k = due.size(); k > 0; --k)
                policy.again(due[k - 1], room); // from the last one: places hold
        }
        room.finish();
    }
}

} // namespace clast::rooms

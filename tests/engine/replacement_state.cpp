// SPDX-License-Identifier: MIT
#include <clast/engine/replacement_state.hpp>

#include <optional>
#include <type_traits>
#include <vector>

#include <clast/io/archive.hpp>

#include <catch.hpp>

using namespace clast;

namespace {
struct forgetful {
    static constexpr bool replaces = true, makes_bonds = false;
    int looks_every() const { return 1; }
    template <class View> std::optional<replacements::nothing> wants(const View&) const { return std::nullopt; }
    template <class Surgery> void act(std::int32_t, replacements::nothing, Surgery&) const {}
};
struct with_memory : forgetful {
    struct grain_state {
        double age = 0.5;
    };
};
using state = replacement_state<with_memory>;
} // namespace

TEST_CASE("nothing is held where nothing is replaced, and per grain only if there is something to remember") {
    static_assert(std::is_empty_v<nothing_replaced>);
    static_assert(!replacement_state<forgetful>::remembers && state::remembers);
    replacement_state<forgetful> none;
    none.begin(100);
    CHECK(none.of_grain.empty());
    state some;
    some.begin(3);
    REQUIRE(some.of_grain.size() == 3);
    CHECK(some.of_grain[2].age == 0.5);
}

TEST_CASE("appointments come at their step, ascending, and follow grains that move up") {
    state s;
    s.begin(10);
    s.ask_again(7, 5), s.ask_again(4, 9), s.ask_again(7, 2), s.ask_again(5, 3);
    CHECK(s.take_due(3).empty());
    CHECK(s.take_due(4) == std::vector<std::int32_t>{9});
    CHECK(s.take_due(4).empty());
    s.marked.push_back({1, {}}), s.marked.push_back({2, {}}), s.marked.push_back({6, {}});
    s.of_grain[2].age = 3.0;
    s.grain_was_split(2, 3);
    CHECK((s.marked[0].grain == 1 && s.marked[1].grain == 2 && s.marked[2].grain == 8));
    REQUIRE(s.of_grain.size() == 12);
    for (std::size_t g = 0; g < 12; ++g) CHECK(s.of_grain[g].age == (g >= 2 && g <= 4 ? 3.0 : 0.5));
    CHECK(s.take_due(9) == std::vector<std::int32_t>{2, 5, 7}); // two steps' worth
}

TEST_CASE("what is remembered, appointments and shapes of parts come back from an archive") {
    state s, copy;
    s.begin(4);
    s.of_grain[1].age = 2.0;
    s.ask_again(12, 3);
    s.parts.push_back({0, 2, 2, 1});
    from_bytes(to_bytes(s), copy);
    CHECK(to_bytes(copy) == to_bytes(s));
    CHECK(copy.of_grain[1].age == 2.0);
    CHECK(copy.take_due(12) == std::vector<std::int32_t>{3});
    CHECK(copy.parts[0].first == 2);
}

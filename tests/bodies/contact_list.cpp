// SPDX-License-Identifier: MIT
#include <clast/bodies/contact_list.hpp>

#include <functional>
#include <utility>

#include <clast/contacts/linear.hpp>
#include <clast/io/archive.hpp>

#include <catch.hpp>

using namespace clast;

namespace {
struct nothing {};
/// Calls f for the numbers of all contacts of a list, as it stands.
auto each_of(const pair_list& list) {
    return [&list](auto&& f) {
        for (std::size_t k = 0; k < list.size(); ++k) f(k);
    };
}
} // namespace

TEST_CASE("a law without history costs no memory per contact") {
    contact_list<nothing> list;
    list.pairs = {{0, 1}, {1, 2}};
    list.resize();
    CHECK(list.rows.empty());
    CHECK(list.history.empty());
    static_assert(!contact_list<nothing>::remembers && contact_list<contacts::linear::history>::remembers);
}

TEST_CASE("a pair is found by its pebbles, and one that is not listed is not") {
    contact_list<contacts::linear::history> list;
    list.pairs = {{0, 1}, {0, 7}, {2, 3}, {2, 9}, {5, 6}};
    const std::less<pebble_pair> before;
    for (std::size_t k = 0; k < list.size(); ++k) CHECK(find_pair(list.pairs, list.pairs[k], before) == k);
    for (const pebble_pair missing : {pebble_pair{0, 0}, {0, 2}, {1, 7}, {2, 4}, {5, 7}, {9, 9}})
        CHECK(find_pair(list.pairs, missing, before) == list.size());
    CHECK(find_pair({}, {0, 1}, before) == 0);
}

TEST_CASE("histories move to the pairs that both lists have, in any order they share") {
    using list_type = contact_list<contacts::linear::history>;
    const auto by_second = [](const pebble_pair& a, const pebble_pair& b) {
        return a.j != b.j ? a.j < b.j : a.i < b.i;
    };
    list_type old, list;
    old.pairs = {{0, 1}, {0, 2}, {1, 2}, {3, 5}, {0, 9}};
    list.pairs = {{0, 2}, {1, 2}, {2, 4}, {4, 5}, {0, 9}, {1, 9}};
    old.resize(), list.resize();
    for (std::size_t k = 0; k < old.size(); ++k) old.history[k].x = static_cast<double>(k + 1);
    const auto taken = [&] {
        std::vector<double> x;
        for (const auto& h : list.history) x.push_back(h.x);
        return x;
    };
    list.take_histories(list.behind(), old, old.behind(), by_second);
    CHECK(taken() == std::vector<double>{2, 3, 0, 0, 5, 0});

    // by stretches: what one leaves out another may bring
    list.resize();
    list.take_histories({1, 6}, old, {0, 3}, by_second);
    CHECK(taken() == std::vector<double>{0, 3, 0, 0, 0, 0});
    list.take_histories({3, 6}, old, {2, 5}, by_second);
    CHECK(taken() == std::vector<double>{0, 3, 0, 0, 5, 0});
    list.take_histories({2, 2}, old, old.behind(), by_second);
    list.take_histories({0, 6}, old, {2, 2}, by_second);
    CHECK(taken() == std::vector<double>{0, 3, 0, 0, 5, 0});
}

TEST_CASE("pairs between two ranges stand in front, and are told in the order of one list") {
    contact_list<contacts::linear::history> list;
    const std::less<pebble_pair> before;
    const std::vector<pebble_pair> sorted = {{0, 1}, {0, 7}, {2, 3}, {2, 9}, {5, 6}};
    list.pairs = sorted;
    list.image = {0, 1, 2, 3, 4};
    list.resize();
    for (std::size_t k = 0; k < list.size(); ++k) list.history[k].x = static_cast<double>(k);
    bring_shared_forward(list, [](const pebble_pair& p) { return p.i < 4 && p.j >= 4; });
    CHECK(list.shared == 2);
    CHECK(list.pairs == std::vector<pebble_pair>{{0, 7}, {2, 9}, {0, 1}, {2, 3}, {5, 6}});
    CHECK(list.image == std::vector<std::uint8_t>{1, 3, 0, 2, 4});
    CHECK((list.history[1].x == 3.0 && list.history[2].x == 0.0));
    CHECK((list.in_front().end == 2 && list.behind().begin == 2 && list.behind().end == 5));
    std::vector<pebble_pair> told;
    list.each_in_order(before, [&](std::size_t k) { told.push_back(list.pairs[k]); });
    CHECK(told == sorted);
    join_shared(list, before);
    CHECK((list.shared == 0 && list.pairs == sorted && list.image[3] == 3 && list.history[3].x == 3.0));
}

TEST_CASE("a pair that wakes up stands in its place, with nothing remembered") {
    contact_list<contacts::linear::history> list;
    const std::less<pebble_pair> before;
    list.pairs = {{0, 1}, {3, 4}};
    list.resize();
    list.rows.resize(2);
    list.history[1].x = 7.0, list.rows[1].depth = 3.0;
    list.insert({1, 2}, before);
    list.insert({5, 6}, before);
    CHECK(list.pairs == std::vector<pebble_pair>{{0, 1}, {1, 2}, {3, 4}, {5, 6}});
    CHECK((list.history[1].x == 0.0 && list.history[2].x == 7.0 && list.history[3].x == 0.0));
    CHECK((list.rows.size() == 4 && list.rows[1].depth == 0.0 && list.rows[2].depth == 3.0));
    contact_list<nothing> first;
    first.insert({0, 1}, before);
    CHECK((first.size() == 1 && first.rows.size() == 1));
}

TEST_CASE("a list comes back from an archive with its histories, and without rows") {
    contact_list<contacts::linear::history> list;
    list.pairs = {{0, 1}, {3, 4}};
    list.resize();
    list.history[1] = {1.5, -2.5, 3.5};
    contact_list<contacts::linear::history> copy;
    from_bytes(to_bytes(list), copy);
    CHECK(copy.pairs == list.pairs);
    CHECK(copy.history[1].y == -2.5);
    CHECK(copy.rows.empty());
    CHECK(checksum(copy) == checksum(list));
}

TEST_CASE("a list of a law without history goes into an archive as well") {
    contact_list<nothing> list, copy;
    list.pairs = {{0, 1}, {3, 4}};
    list.resize();
    from_bytes(to_bytes(list), copy);
    CHECK(copy.pairs == list.pairs);
    CHECK(copy.history.empty());
}

TEST_CASE("every body is given its rows in the order of the list, with pebble and sign") {
    contact_list<nothing> list;
    list.pairs = {{0, 1}, {0, 2}, {1, 2}, {2, 5}};
    list.resize();
    struct wall_contact {
        std::int32_t pebble;
    };
    const std::vector<wall_contact> wall = {{5}, {0}};
    const std::vector<std::size_t> owner = {0, 1, 2, 3, 4, 4}; // pebbles 4 and 5 are one body
    const auto body_of = [&](std::int32_t p) { return owner[static_cast<std::size_t>(p)]; };
    incidence of_body(5, list, each_of(list), wall, body_of);
    struct expected {
        std::size_t row;
        std::int32_t pebble;
        double side;
        bool operator==(const expected&) const = default;
    };
    const auto rows = [&](std::size_t body) {
        std::vector<expected> out;
        for (const incidence::entry& e : of_body.of(body)) out.push_back({e.row(), e.pebble, e.side()});
        return out;
    };
    CHECK((rows(0) == std::vector<expected>{{0, 0, 1.0}, {1, 0, 1.0}, {5, 0, 1.0}}));
    CHECK((rows(1) == std::vector<expected>{{0, 1, -1.0}, {2, 1, 1.0}}));
    CHECK((rows(2) == std::vector<expected>{{1, 2, -1.0}, {2, 2, -1.0}, {3, 2, 1.0}}));
    CHECK(rows(3).empty());
    CHECK((rows(4) == std::vector<expected>{{3, 5, -1.0}, {4, 5, 1.0}}));
    incidence copy;
    from_bytes(to_bytes(of_body), copy);
    CHECK(checksum(copy) == checksum(of_body));

    // the list is put in another order: sums keep theirs
    const std::vector<std::uint32_t> order = {2, 0, 1, 3};
    list.reorder(order);
    of_body = incidence(
        5, list,
        [](auto&& f) {
            for (std::size_t k : {1U, 2U, 0U, 3U}) f(k);
        },
        wall, body_of);
    CHECK(list.pairs == std::vector<pebble_pair>{{1, 2}, {0, 1}, {0, 2}, {2, 5}});
    CHECK((rows(0) == std::vector<expected>{{1, 0, 1.0}, {2, 0, 1.0}, {5, 0, 1.0}}));
    CHECK((rows(2) == std::vector<expected>{{2, 2, -1.0}, {0, 2, -1.0}, {3, 2, 1.0}}));
}

TEST_CASE("a list is sorted again after its order has changed: in front and behind each for itself, rows and all") {
    struct remembers {
        double what;
    };
    contact_list<remembers> list;
    list.pairs = {{0, 9}, {4, 8}, {0, 5}, {1, 5}, {2, 6}};
    list.resize();
    list.shared = 2;
    list.rows.resize(5);
    for (std::size_t k = 0; k < 5; ++k) list.history[k].what = list.rows[k].depth = static_cast<double>(k);
    sort_by(list, [](const pebble_pair& a, const pebble_pair& b) { return a.i > b.i; });
    CHECK(list.pairs == std::vector<pebble_pair>{{4, 8}, {0, 9}, {2, 6}, {1, 5}, {0, 5}});
    CHECK(list.shared == 2);
    const double was[] = {1, 0, 4, 3, 2};
    for (std::size_t k = 0; k < 5; ++k) CHECK((list.history[k].what == was[k] && list.rows[k].depth == was[k]));
}

TEST_CASE("contacts that are taken off a list take their histories and rows with them") {
    struct remembers {
        double what;
    };
    contact_list<remembers> list;
    list.pairs = {{0, 1}, {0, 2}, {1, 2}, {2, 3}};
    list.resize();
    list.rows.resize(4);
    for (std::size_t k = 0; k < 4; ++k) list.history[k].what = list.rows[k].depth = static_cast<double>(k);
    erase_contacts(list, [](const pebble_pair& p) { return p.j == 2; });
    CHECK(list.pairs == std::vector<pebble_pair>{{0, 1}, {2, 3}});
    REQUIRE((list.history.size() == 2 && list.rows.size() == 2));
    CHECK((list.history[1].what == 3.0 && list.rows[1].depth == 3.0));
}

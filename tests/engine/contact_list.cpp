// SPDX-License-Identifier: MIT
#include <clast/engine/contact_list.hpp>

#include <utility>

#include <clast/contacts/linear.hpp>
#include <clast/io/archive.hpp>

#include <catch.hpp>

using namespace clast;

namespace {
struct nothing {};
} // namespace

TEST_CASE("a law without history costs no memory per contact") {
    contact_list<nothing> list;
    list.pairs = {{0, 1}, {1, 2}};
    list.resize_rows();
    CHECK(list.rows.size() == 2);
    CHECK(list.history.empty());
    static_assert(!contact_list<nothing>::remembers && contact_list<contacts::linear::history>::remembers);
}

TEST_CASE("a pair is found by its pebbles, and one that is not listed is not") {
    contact_list<contacts::linear::history> list;
    list.pairs = {{0, 1}, {0, 7}, {2, 3}, {2, 9}, {5, 6}};
    for (std::size_t k = 0; k < list.size(); ++k) CHECK(list.find(list.pairs[k]) == k);
    for (const pebble_pair missing : {pebble_pair{0, 0}, {0, 2}, {1, 7}, {2, 4}, {5, 7}, {9, 9}})
        CHECK(list.find(missing) == list.size());
    CHECK(contact_list<nothing>{}.find({0, 1}) == 0);
}

TEST_CASE("a list comes back from an archive with its histories and with rows of the right number") {
    contact_list<contacts::linear::history> list;
    list.pairs = {{0, 1}, {3, 4}};
    list.resize_rows();
    list.history[1] = {1.5, -2.5, 3.5};
    list.bonded[0] = 1;
    contact_list<contacts::linear::history> copy;
    from_bytes(to_bytes(list), copy);
    CHECK(copy.pairs == list.pairs);
    CHECK(copy.history[1].y == -2.5);
    CHECK(copy.bonded == list.bonded);
    CHECK(copy.rows.size() == 2);
    CHECK(checksum(copy) == checksum(list));
}

TEST_CASE("a list of a law without history goes into an archive as well") {
    contact_list<nothing> list, copy;
    list.pairs = {{0, 1}, {3, 4}};
    list.resize_rows();
    from_bytes(to_bytes(list), copy);
    CHECK(copy.pairs == list.pairs);
    CHECK(copy.bonded.size() == 2);
    CHECK(copy.history.empty());
}

TEST_CASE("every body is given its rows in the order of the list, with the side that it is on") {
    const std::vector<pebble_pair> pairs = {{0, 1}, {0, 2}, {1, 2}, {2, 4}};
    incidence of_body;
    of_body.build(5, [&](auto&& f) {
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            f(k, 0u, pairs[k].i);
            f(k, 1u, pairs[k].j);
        }
    });
    const auto rows = [&](std::size_t body) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> out;
        for (const std::uint32_t r : of_body.of(body)) out.emplace_back(r >> 1, r & 1u);
        return out;
    };
    using expected = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
    CHECK(rows(0) == expected{{0, 0}, {1, 0}});
    CHECK(rows(1) == expected{{0, 1}, {2, 0}});
    CHECK(rows(2) == expected{{1, 1}, {2, 1}, {3, 0}});
    CHECK(rows(3).empty());
    CHECK(rows(4) == expected{{3, 1}});
    incidence copy;
    from_bytes(to_bytes(of_body), copy);
    CHECK(copy.start == of_body.start);
    CHECK(copy.row == of_body.row);
}

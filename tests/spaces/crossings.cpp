// SPDX-License-Identifier: MIT
#include <clast/spaces/crossings.hpp>

#include <cstddef>
#include <functional>
#include <vector>

#include <catch.hpp>

using namespace clast;

namespace {
struct strip {
    double dx[8] = {}, dy[8] = {}, dz[8] = {}, vx[8] = {}, vy[8] = {}, vz[8] = {};
    double fx[8] = {}, fy[8] = {}, fz[8] = {};
};
struct block {
    std::size_t at, row, size;
};
} // namespace

TEST_CASE("contacts across faces are met block after block, shifted, and their work is that of the moving images") {
    pair_list list;
    list.pairs = {{0, 9}, {0, 1}, {1, 2}, {2, 3}, {3, 4}};
    list.shared = 1; // the first is between two ranges
    list.image = {no_shift + 1, no_shift, no_shift - 1, no_shift, no_shift + 9};
    spaces::crossings c;
    c.index(list, execution(1), std::less<pebble_pair>{});
    c.set({2.0, 3.0, 4.0}, {0.2, 0.3, 0.4});
    CHECK((c.from(0) == 0 && c.from(1) == 1 && c.from(3) == 2 && c.from(5) == 3));
    std::size_t cursor = c.from(0), taken = cursor;
    strip s;
    for (const block b : {block{0, 0, 2}, block{4, 2, 3}}) { // rows 0 and 1 in lanes 0 and 1, 2 to 4 in 4 to 6
        c.adjust(cursor, s, b);
        for (std::size_t k = 0; k < 8; ++k) s.fx[k] = 1.0, s.fy[k] = 10.0, s.fz[k] = 100.0;
        c.take(taken, s, b);
    }
    CHECK((cursor == 3 && taken == 3));
    CHECK((s.dx[0] == 2.0 && s.vx[0] == 0.2 && s.dx[1] == 0.0 && s.dx[4] == -2.0 && s.dx[5] == 0.0));
    CHECK((s.dz[6] == 4.0 && s.vz[6] == 0.4 && s.dy[6] == 0.0));
    CHECK(c.power(execution(1)) == Approx(0.2 - 0.2 + 40.0));
}

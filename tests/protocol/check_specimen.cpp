// SPDX-License-Identifier: MIT
#include <clast/protocol/check_specimen.hpp>

#include <limits>

#include <catch.hpp>

#include "small_test.hpp"

using namespace clast;
using namespace small_test;

TEST_CASE("a NaN, an escaped grain and pebbles pressed into each other stop the run with an explanation") {
    {
        test_type test(setup(), {rest(2000)});
        test.sim().grains.motion[5].v.x = std::numeric_limits<double>::quiet_NaN();
        recorder watch;
        const failure f = failure_of(test, watch);
        check_complete(f);
        CHECK(f.where == "grain 5");
    }
    {
        test_type test(setup(), {rest(2000)});
        test.protocol().plan.look_every = 1; // the wall would throw it back
        test.sim().grains.motion[7].x = {0.3, 0.0, 0.0};
        recorder watch;
        const failure f = failure_of(test, watch);
        check_complete(f);
        CHECK(f.what.find("grain 7 escaped") != std::string::npos);
        CHECK(f.where.find("rest") != std::string::npos);
    }
    {
        test_type test(setup(), {rest(2000)});
        test.protocol().plan.look_every = 1;
        bodies::clumps& s = test.sim().grains;
        s.turning[1].q = s.turning[0].q;
        s.motion[1].x = s.motion[0].x + vec3{0.002, 0.0, 0.0};
        for (body_motion& m : s.motion) m.v = {};
        recorder watch;
        int step = 0;
        watch.pause = [&] { // held in place until the lists have seen it
            if (++step < 3) s.motion[1].x = s.motion[0].x + vec3{0.002, 0.0, 0.0};
        };
        const failure f = failure_of(test, watch);
        check_complete(f);
        CHECK(f.what.find("overlap") != std::string::npos);
    }
}

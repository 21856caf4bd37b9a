// SPDX-License-Identifier: MIT
// What examples/triaxial makes of --shape, --grading and --packing, compiled into this test.
#include "../../examples/triaxial/grains.cpp"

#include <catch.hpp>

#include "text_file.hpp"

using namespace triaxial;
using clast::text_file;

namespace {
options read(std::vector<std::string> arguments) { return parse_options(std::move(arguments)).values; }
std::string refusal(std::vector<std::string> arguments) {
    try {
        (void)read(std::move(arguments));
    } catch (const input_error& e) {
        return e.what();
    }
    return "accepted";
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
} // namespace

TEST_CASE("one shape by name: no file, no grading, grains of 2 cm") {
    const options o = read({});
    CHECK(input_files(o).empty());
    CHECK(grains_title(o) == "4B");
    CHECK(grains_text(o) == "shape = 4B\n");
    const clast::mixture grains = grains_of(o);
    REQUIRE(grains.parts().size() == 1);
    CHECK(grains.d50() == Approx(0.02));
    CHECK(grains.largest_circumscribed() == Approx(0.0280).epsilon(2e-3)); // equal in volume to a ball of 2 cm
    CHECK(grains_of(read({"--grain-size", "circumscribed"})).largest_circumscribed() == Approx(0.02));
    CHECK(grains.sizes().empty());
    CHECK(packing_of(o, grains).empty());
}

TEST_CASE("shapes with shares, from names and files, with a grading: what the mixture says, and what is stored") {
    const text_file pair("0 0 0 1\n2 0 0 1\n"), curve("8 0\n16 60\n24 100\n");
    const options o = read({"--shape", "14b:0.7," + pair.path + ":0.1,4B:0.2", "--grading", curve.path});
    const clast::mixture grains = grains_of(o);
    REQUIRE(grains.parts().size() == 3);
    CHECK(grains.parts()[0].form.name == "14B");
    CHECK(grains.parts()[0].share == Approx(0.7));
    CHECK(grains.parts()[1].form.pebbles.size() == 2);
    CHECK(grains.parts()[2].share == Approx(0.2));
    CHECK(grains.largest_diameter() == Approx(0.024));
    REQUIRE(input_files(o).size() == 2);
    REQUIRE(o.checksums.size() == 2);
    const options stored = with_files_in(o, "elsewhere");
    CHECK(stored.shape == "14B:0.7,elsewhere/" + fs::path(pair.path).filename().string() + ":0.1,4B:0.2");
    CHECK(stored.grading == "elsewhere/" + fs::path(curve.path).filename().string());
    CHECK(has(grains_title(o), "14B+"));
    // names and contents of the files decide, not where they are
    CHECK(grains_text(stored) == grains_text(o));
    CHECK(has(grains_text(o), "14B 0.7, "));
    CHECK(has(grains_text(o), "grading = "));
    std::ofstream(curve.path) << "8 0\n16 61\n24 100\n";
    options changed = o;
    check_grains(changed);
    CHECK(changed.checksums[0] == o.checksums[0]);
    CHECK(changed.checksums[1] != o.checksums[1]);
    CHECK(grains_text(changed) != grains_text(o));
}

TEST_CASE("pebbles that overlap are one solid where grains never break, and refused where they do") {
    const text_file file("0 0 0 1\n1 0 0 1\n");
    CHECK(has(refusal({"--shape", file.path}), "overlap by"));
    const options o = read({"--shape", file.path, "--replacement", "none"});
    CHECK(grains_of(o).parts()[0].form.overlapping);
    CHECK(refusal({"--shape", file.path, "--criterion", "none"}) == "accepted");
}

TEST_CASE("a packing is read with the shapes of the run") {
    const text_file balls("0 0 0 0.02\n0 0 0.03 0.03\n");
    const options o = read({"--shape", "sphere", "--packing", balls.path, "--tiles-per-ring", "8"});
    const auto grains = packing_of(o, grains_of(o)).grains();
    REQUIRE(grains.size() == 2);
    CHECK(grains[1].scale == Approx(1.5));
    CHECK(has(grains_text(o), "packing = "));
    CHECK(has(refusal({"--packing", balls.path}), "--packing: "));
}

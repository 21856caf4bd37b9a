// SPDX-License-Identifier: MIT
#include <clast/core/errors.hpp>

#include <stdexcept>
#include <string>
#include <type_traits>

#include <catch.hpp>

using namespace clast;

TEST_CASE("wrong input names the option, the value, the allowed range and a way out") {
    const std::string said = input_error("--confining", "-2 MPa", "0 to 10 MPa", "Give a positive stress.").what();
    for (const char* part : {"--confining", "-2 MPa", "0 to 10 MPa", "Give a positive stress."})
        CHECK(said.find(part) != std::string::npos);
    CHECK(std::string(input_error("plain text").what()) == "plain text");
}

TEST_CASE("a failed run says what, where, when, why and what to change") {
    const run_error error(failure{"a grain escaped", "shear, ring 3", "step 12", "the step is too long", "halve it"});
    const std::string said = error.what();
    for (const char* part : {"a grain escaped", "shear, ring 3", "step 12", "the step is too long", "halve it"})
        CHECK(said.find(part) != std::string::npos);
    CHECK(error.details.what == "a grain escaped");
    CHECK(error.details.advice == "halve it");
}

TEST_CASE("the two kinds of error are told apart by type and by exit code") {
    static_assert(std::is_base_of_v<std::runtime_error, input_error>);
    static_assert(std::is_base_of_v<std::runtime_error, run_error>);
    static_assert(!std::is_base_of_v<input_error, run_error> && !std::is_base_of_v<run_error, input_error>);
    CHECK(exit_input_error == 2);
    CHECK(exit_run_error == 3);
}

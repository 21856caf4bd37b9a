// SPDX-License-Identifier: MIT
// The main program: a triaxial test on breakable rockfill, from the command line to the figures.
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <clast/core/errors.hpp>

#include "options.hpp"
#include "run.hpp"
#include "signals.hpp"

int main(int argc, char** argv) {
    try {
        const triaxial::parsed command = triaxial::parse_options({argv + 1, argv + argc});
        if (command.done) return 0;
        triaxial::catch_stop_signals();
        return triaxial::run_test(command.values);
    } catch (const clast::input_error& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return clast::exit_input_error;
    } catch (const clast::run_error& e) {
        fmt::print(stderr, "\nthe run stopped: {}\n", e.what());
        return clast::exit_run_error;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "\nthe run stopped: there is not enough memory\n  what to change: use a smaller --scale\n");
        return clast::exit_run_error;
    } catch (const std::exception& e) {
        fmt::print(stderr, "\nthe run stopped by an error that should not happen: {}\n", e.what());
        return clast::exit_run_error;
    }
}

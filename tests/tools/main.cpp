// SPDX-License-Identifier: MIT
// The main function of every test program where Catch2 does not bring one (2.13).
#if !__has_include(<catch2/catch_all.hpp>)
#define CATCH_CONFIG_MAIN
#endif
#include <catch.hpp>

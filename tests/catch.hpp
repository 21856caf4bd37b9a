// SPDX-License-Identifier: MIT
// One include for Catch2 3 and 2.13, so that no test depends on which of them a distribution ships.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif

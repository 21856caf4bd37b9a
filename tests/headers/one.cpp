// SPDX-License-Identifier: MIT
#include "all_headers.hpp"

const void* address_in_one();
const void* address_in_two();

/// Where this translation unit finds an inline constant of the library.
const void* address_in_one() { return &clast::version_major; }

int main() { return address_in_one() == address_in_two() ? 0 : 1; }

// SPDX-License-Identifier: MIT
#include "all_headers_reversed.hpp"

const void* address_in_two();

/// Where this translation unit finds the same constant: one definition has one address.
const void* address_in_two() { return &clast::version_major; }

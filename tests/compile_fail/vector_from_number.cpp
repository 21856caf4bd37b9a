// SPDX-License-Identifier: MIT
// A bare number is not a vector: which component would it be?
// expect: vec3
#include <clast/core/vector.hpp>

double length(const clast::vec3& a);
double length(const clast::vec3& a) { return clast::norm(a); }

#ifdef CLAST_BREAK
double wrong() { return length(2.0); }
#else
double right();
double right() { return length({2.0, 0.0, 0.0}); }
#endif

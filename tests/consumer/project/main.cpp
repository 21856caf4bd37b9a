// SPDX-License-Identifier: MIT
#include <clast/core/vector.hpp>
#include <clast/version.hpp>

#include <cstdio>

int main() {
    const clast::vec3 a{3.0, 4.0, 0.0};
    std::printf("clast %s: |a| = %g\n", clast::version().c_str(), clast::norm(a));
    return clast::norm(a) == 5.0 ? 0 : 1;
}

// SPDX-License-Identifier: MIT
// Loops whose result does not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace clast {

/// Number of threads that this machine offers (1 without OpenMP).
inline int available_threads() {
#ifdef _OPENMP
    return omp_get_num_procs();
#else
    return 1;
#endif
}

/// How loops are run: `threads` >= 1. Every loop below gives the same bits for any value.
struct execution {
    int threads = 1;

    /// body(i) for i in [0, n). Iterations must not depend on each other. Loops shorter than `serial_below` stay on
    /// the calling thread, because waking the others costs more than the loop.
    template <class F>
    void for_each(std::size_t n, F&& body, std::size_t serial_below = 256) const {
#ifdef _OPENMP
        if (threads > 1 && n >= serial_below) {
            const auto count = static_cast<std::ptrdiff_t>(n);
#pragma omp parallel for schedule(static) num_threads(threads)
            for (std::ptrdiff_t i = 0; i < count; ++i) body(static_cast<std::size_t>(i));
            return;
        }
#endif
        (void)serial_below;
        for (std::size_t i = 0; i < n; ++i) body(i);
    }

    /// Sum of value(i) over [0, n) in a fixed order: chunks of 256 are summed one by one, then the partial sums.
    template <class T, class F>
    T sum(std::size_t n, T zero, F&& value) const {
        constexpr std::size_t chunk = 256;
        const std::size_t chunks = (n + chunk - 1) / chunk;
        std::vector<T> partial(chunks, zero);
        for_each(
            chunks,
            [&](std::size_t c) {
                T s = zero;
                for (std::size_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i) s += value(i);
                partial[c] = s;
            },
            4);
        T total = zero;
        for (const T& s : partial) total += s;
        return total;
    }

    /// Largest value(i) over [0, n), at least `floor`. Order does not matter to a maximum, so neither do threads.
    template <class F>
    double max(std::size_t n, double floor, F&& value) const {
        double largest = floor;
#ifdef _OPENMP
        if (threads > 1 && n >= 256) {
            const auto count = static_cast<std::ptrdiff_t>(n);
#pragma omp parallel for schedule(static) num_threads(threads) reduction(max : largest)
            for (std::ptrdiff_t i = 0; i < count; ++i) largest = std::max(largest, value(static_cast<std::size_t>(i)));
            return largest;
        }
#endif
        for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, value(i));
        return largest;
    }
};

} // namespace clast

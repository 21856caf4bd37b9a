// SPDX-License-Identifier: MIT
// Weibull statistics of measured strengths.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace crush {

/// Mean, median, scatter and Weibull fit of positive numbers.
struct statistics {
    std::size_t n = 0;
    double mean = 0.0, median = 0.0;
    double cv = 0.0;             ///< standard deviation over the mean
    double standard_error = 0.0; ///< of the mean
    double modulus = 0.0;        ///< Weibull m, maximum likelihood; 0 for fewer than two different values
    double characteristic = 0.0; ///< value that 37 % survive by the fit
};

inline statistics statistics_of(std::vector<double> x) {
    statistics s;
    s.n = x.size();
    if (x.empty()) return s;
    std::sort(x.begin(), x.end());
    const auto n = static_cast<double>(x.size());
    s.mean = std::accumulate(x.begin(), x.end(), 0.0) / n;
    s.median = 0.5 * (x[(x.size() - 1) / 2] + x[x.size() / 2]);
    double squares = 0.0, logs = 0.0;
    for (const double v : x) squares += (v - s.mean) * (v - s.mean), logs += std::log(v) / n;
    if (x.size() < 2 || !(x.back() > x.front())) return s;
    const double deviation = std::sqrt(squares / (n - 1.0));
    s.cv = deviation / s.mean, s.standard_error = deviation / std::sqrt(n);
    // sum x^m ln x / sum x^m - 1/m - mean ln x rises with m; x over the largest, so that powers stay finite
    const auto excess = [&](double m) {
        double powers = 0.0, weighted = 0.0;
        for (const double v : x) {
            const double p = std::pow(v / x.back(), m);
            powers += p, weighted += p * std::log(v);
        }
        return weighted / powers - 1.0 / m - logs;
    };
    double low = 1e-2, high = 1e4;
    for (int k = 0; k < 200; ++k) {
        const double middle = std::sqrt(low * high);
        (excess(middle) < 0.0 ? low : high) = middle;
    }
    s.modulus = low;
    double powers = 0.0;
    for (const double v : x) powers += std::pow(v / x.back(), s.modulus) / n;
    s.characteristic = x.back() * std::pow(powers, 1.0 / s.modulus);
    return s;
}

} // namespace crush

// SPDX-License-Identifier: MIT
#include <clast/core/lanes.hpp>

#include <array>
#include <cstddef>

#include <catch.hpp>

using namespace clast;

TEMPLATE_TEST_CASE("lanes: several numbers at once give what one number gives, memory of any alignment included", "",
                   lane8, lane4, lane2) {
    constexpr std::size_t width = lanes_in<TestType>;
    std::array<double, 19> memory{};
    const std::array<double, 8> a = {-2.0, -0.5, 0.0, 1e-300, 0.5, 1.0, 3.0, -1e9};
    const std::array<double, 8> b = {-3.0, 0.5, -0.0, 0.0, 0.5, 2.0, -3.0, 1e9};
    for (std::size_t shift = 0; shift < 3; ++shift) {
        for (std::size_t l = 0; l < lanes; ++l) memory[shift + l] = a[l];
        const TestType x = load<TestType>(memory.data() + shift), y = load<TestType>(b.data());
        store(memory.data() + 11, larger(x, y));
        for (std::size_t l = 0; l < width; ++l) CHECK(memory[11 + l] == larger(a[l], b[l]));
        store(memory.data() + 11, magnitude(x));
        for (std::size_t l = 0; l < width; ++l) CHECK(memory[11 + l] == magnitude(a[l]));
        store(memory.data() + 11, sign_of(x));
        for (std::size_t l = 0; l < width; ++l) CHECK(memory[11 + l] == sign_of(a[l]));
    }
    CHECK(sign_of(0.0) == 0.0);
    CHECK(sign_of(-0.0) == 0.0);
    CHECK(sign_of(-1e-300) == -1.0);
    CHECK(magnitude(-2.0) == 2.0);
    CHECK(larger(-3.0, -2.0) == -2.0);
}

TEMPLATE_TEST_CASE("lanes: several vectors at once give what one vector gives", "", lane8, lane4, lane2) {
    constexpr std::size_t width = lanes_in<TestType>;
    std::array<double, 24> a{}, b{}, out{};
    const auto at = [](const std::array<double, 24>& m, std::size_t l) {
        return vec3{m[l], m[lanes + l], m[2 * lanes + l]};
    };
    for (std::size_t k = 0; k < 24; ++k) {
        a[k] = 0.3 * static_cast<double>(k) - 2.0;
        b[k] = 1.0 / (static_cast<double>(k) + 1.0);
    }
    const vec3_of<TestType> x = load3<TestType>(a.data()), y = load3<TestType>(b.data());
    const auto same = [&](const vec3_of<TestType>& v, auto&& one) {
        store3(out.data(), v);
        for (std::size_t l = 0; l < width; ++l) CHECK(norm(at(out, l) - one(at(a, l), at(b, l))) <= 1e-16);
    };
    same(x + y, [](vec3 p, vec3 q) { return p + q; });
    same(x - y, [](vec3 p, vec3 q) { return p - q; });
    same(2.5 * x, [](vec3 p, vec3) { return 2.5 * p; });
    same(dot(x, y) * y, [](vec3 p, vec3 q) { return dot(p, q) * q; });
    same(cross(x, y), [](vec3 p, vec3 q) { return cross(p, q); });
    same(norm2(x) * y, [](vec3 p, vec3 q) { return norm2(p) * q; });
    vec3_of<TestType> sum = x;
    sum += y;
    same(sum, [](vec3 p, vec3 q) { return p + q; });
}

TEST_CASE("lanes: eight zeros are told from anything else") {
    std::array<double, 9> a{};
    CHECK(all_zero8(a.data() + 1));
    for (std::size_t l = 0; l < lanes; ++l) {
        a[l + 1] = l % 2 == 0 ? 1e-300 : -1.0;
        CHECK_FALSE(all_zero8(a.data() + 1));
        a[l + 1] = 0.0;
    }
}

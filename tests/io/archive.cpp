// SPDX-License-Identifier: MIT
#include <clast/io/archive.hpp>

#include <clast/core/vector.hpp>

#include <limits>

#include <catch.hpp>

using namespace clast;

namespace {

enum class colour : std::uint8_t { red, green };

struct part {
    std::vector<double> values;
    std::string name;
    template <class A> void archive(A& a) { a(values, name); }
    bool operator==(const part&) const = default;
};

struct padded {
    char c = 'a';
    double d = 1.0;
};

struct whole {
    bool flag = true;
    std::int32_t count = -7;
    colour shade = colour::green;
    vec3 position{1.0, -0.0, 3.0};
    std::vector<vec3> trail{{1, 2, 3}, {4, 5, 6}};
    std::vector<part> parts{{{1.5, 2.5}, "one"}, {{}, ""}};
    std::vector<std::vector<std::int32_t>> lists{{1, 2}, {}, {3}};
    std::array<part, 2> pair{};
    std::optional<double> hint = 4.5;
    std::optional<part> nothing;
    std::pair<std::int32_t, std::string> label{3, "three"};
    std::vector<quaternion> empty;

    template <class A> void archive(A& a) {
        a(flag, count, shade, position, trail, parts, lists, pair, hint, nothing, label, empty);
    }
    bool operator==(const whole&) const = default;
};

} // namespace

TEST_CASE("a state comes back from its bytes unchanged") {
    whole original;
    original.trail.push_back({std::numeric_limits<double>::infinity(), 5e-324, -0.0});
    const auto bytes = to_bytes(original);
    whole copy;
    copy.flag = false;
    copy.position = {};
    copy.parts.clear();
    copy.trail.resize(99);
    copy.hint.reset();
    copy.nothing.emplace();
    copy.label = {};
    from_bytes(bytes, copy);
    REQUIRE(copy == original);
    REQUIRE(to_bytes(copy) == bytes); // also the sign of zero
}

TEST_CASE("the checksum is that of the written bytes and sees every bit") {
    whole state;
    const auto bytes = to_bytes(state);
    hash_archive h;
    h.bytes(bytes.data(), bytes.size());
    REQUIRE(checksum(state) == h.value);
    const auto before = checksum(state);
    state.trail[1].y = std::nextafter(state.trail[1].y, 9.0);
    REQUIRE(checksum(state) != before);
    state.trail[1].y = 5;
    REQUIRE(checksum(state) == before);
    state.position.y = 0.0; // was -0.0: equal in value, not in bits
    REQUIRE(checksum(state) != before);
}

TEST_CASE("the checksum is FNV-1a") {
    const auto fnv = [](const char* text) {
        hash_archive h;
        h.bytes(text, std::strlen(text));
        return h.value;
    };
    // published test vectors of the FNV-1a 64 bit hash
    REQUIRE(fnv("") == 0xcbf29ce484222325ULL);
    REQUIRE(fnv("a") == 0xaf63dc4c8601ec8cULL);
    REQUIRE(fnv("foobar") == 0x85944171f73967e8ULL);
}

TEST_CASE("bytes that end too early or too late are refused at every length") {
    const whole state;
    const auto bytes = to_bytes(state);
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        whole copy;
        REQUIRE_THROWS_AS(from_bytes(std::span(bytes).first(n), copy), input_error);
    }
    auto longer = bytes;
    longer.push_back(std::byte{0});
    whole copy;
    REQUIRE_THROWS_AS(from_bytes(longer, copy), input_error);
}

TEST_CASE("a damaged length does not ask for more memory than there are bytes") {
    std::vector<double> v{1, 2, 3};
    auto bytes = to_bytes(v);
    for (std::size_t i = 0; i < 8; ++i) bytes[i] = std::byte{0x7f};
    REQUIRE_THROWS_AS(from_bytes(bytes, v), input_error);
    bytes = to_bytes(v);
    bytes[0] = std::byte{4};
    REQUIRE_THROWS_AS(from_bytes(bytes, v), input_error);
}

TEST_CASE("a struct with padding has to list its members") {
    STATIC_REQUIRE(detail::plain_bytes<vec3>);
    STATIC_REQUIRE(detail::plain_bytes<double>);
    STATIC_REQUIRE(detail::plain_bytes<bool>);
    STATIC_REQUIRE(detail::plain_bytes<colour>);
    STATIC_REQUIRE(detail::plain_bytes<std::array<vec3, 3>>);
    STATIC_REQUIRE(!detail::plain_bytes<padded>);
    STATIC_REQUIRE(!detail::plain_bytes<double*>);
    STATIC_REQUIRE(!detail::plain_bytes<long double>);
    STATIC_REQUIRE(!detail::plain_bytes<std::optional<double>>);
}

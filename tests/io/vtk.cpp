// SPDX-License-Identifier: MIT
#include <clast/io/vtk.hpp>

#include <cstring>

#include <catch.hpp>

using namespace clast;
namespace fs = std::filesystem;

namespace {

std::string decode(std::string_view text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int have = 0;
    for (const char c : text) {
        if (c == '=') break;
        bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
        have += 6;
        if (have >= 8) {
            have -= 8;
            bytes += static_cast<char>(bits >> have & 255);
        }
    }
    return bytes;
}

// the values of a named array
template <class T> std::vector<T> values(const std::string& xml, const std::string& name) {
    const auto at = xml.find("Name=\"" + name + "\"");
    REQUIRE(at != std::string::npos);
    const auto begin = xml.find('>', at) + 1;
    const std::string bytes = decode(std::string_view(xml).substr(begin, xml.find('<', begin) - begin));
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data(), 4);
    REQUIRE(length + 4 == bytes.size());
    std::vector<T> v(length / sizeof(T));
    std::memcpy(v.data(), bytes.data() + 4, length);
    return v;
}

std::vector<pebble_view> some_pebbles(int n) {
    std::vector<pebble_view> v;
    for (int i = 0; i < n; ++i)
        v.push_back({{0.1 * i, 0.2 * i, 0.3 * i},
                     0.004 + 0.001 * i,
                     i / 2,
                     i,
                     static_cast<pebble_state>(i % 3),
                     {1.0 * i, 2, 3},
                     {4, 5.5, 6}});
    return v;
}
std::vector<facet_view> some_facets(int n) {
    std::vector<facet_view> v;
    for (int i = 0; i < n; ++i) {
        const double z = i;
        v.push_back({{{{1, 0, z}, {0, 1, z}, {0, 1, z + 1}, {1, 0, z + 1}}}, 2e6 + i, 0.5, i, i % 4});
    }
    return v;
}

int count(const std::string& text, const std::string& part) {
    int n = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
    return n;
}

} // namespace

TEST_CASE("base64 follows the examples of RFC 4648") {
    REQUIRE(detail::base64("").empty());
    REQUIRE(detail::base64("f") == "Zg==");
    REQUIRE(detail::base64("fo") == "Zm8=");
    REQUIRE(detail::base64("foo") == "Zm9v");
    REQUIRE(detail::base64("foobar") == "Zm9vYmFy");
    REQUIRE(detail::base64(std::string_view("\xff\x00\xfe", 3)) == "/wD+");
}

TEST_CASE("pebbles keep position, radius, grain and state in the file") {
    const auto pebbles = some_pebbles(5);
    const std::string xml = pebbles_vtp(1.25, pebbles);
    REQUIRE(xml.find("NumberOfPoints=\"5\" NumberOfVerts=\"5\"") != std::string::npos);
    REQUIRE(xml.find(">1.25<") != std::string::npos);
    const auto position = values<double>(xml, "position");
    const auto radius = values<float>(xml, "radius");
    const auto displacement = values<float>(xml, "displacement");
    REQUIRE(position.size() == 15);
    for (std::size_t i = 0; i < 5; ++i) {
        REQUIRE(position[3 * i + 1] == pebbles[i].position.y);
        REQUIRE(radius[i] == static_cast<float>(pebbles[i].radius));
        REQUIRE(displacement[3 * i] == static_cast<float>(pebbles[i].displacement.x));
    }
    REQUIRE(values<std::int32_t>(xml, "grain") == std::vector<std::int32_t>{0, 0, 1, 1, 2});
    REQUIRE(values<std::uint8_t>(xml, "state") == std::vector<std::uint8_t>{0, 1, 2, 0, 1});
    REQUIRE(values<std::int32_t>(xml, "offsets") == std::vector<std::int32_t>{1, 2, 3, 4, 5});
}

TEST_CASE("facets are quadrilaterals with their pressure") {
    const std::string xml = facets_vtp(0.0, some_facets(3));
    REQUIRE(xml.find("NumberOfPoints=\"12\" NumberOfPolys=\"3\"") != std::string::npos);
    REQUIRE(values<std::int32_t>(xml, "offsets") == std::vector<std::int32_t>{4, 8, 12});
    REQUIRE(values<float>(xml, "pressure") == std::vector<float>{2e6f, 2e6f + 1, 2e6f + 2});
    REQUIRE(values<double>(xml, "corner")[14] == 1.0); // z of the first corner of facet 1
    REQUIRE(values<std::int32_t>(xml, "ring") == std::vector<std::int32_t>{0, 1, 2});
}

TEST_CASE("an empty specimen is still a valid file") {
    REQUIRE(pebbles_vtp(0.0, {}).find("NumberOfPoints=\"0\"") != std::string::npos);
    REQUIRE(values<double>(pebbles_vtp(0.0, {}), "position").empty());
}

TEST_CASE("the collection grows with the snapshots and a resumed one goes on where the checkpoint was") {
    const fs::path folder = fs::temp_directory_path() / fmt::format("clast_vtk_test_{}", ::getpid());
    fs::create_directories(folder);
    {
        vtk_series series(folder);
        for (int i = 0; i < 4; ++i) series.write(0.5 * i, some_pebbles(3), some_facets(2));
        REQUIRE(series.size() == 4);
    }
    std::string pvd = detail::read_whole(folder / "boundary.pvd");
    REQUIRE(count(pvd, "<DataSet") == 4);
    REQUIRE(pvd.find("timestep=\"1.5\" group=\"\" part=\"0\" file=\"boundary_0003.vtp\"") != std::string::npos);
    const std::string uninterrupted = detail::read_whole(folder / "pebbles.pvd");

    REQUIRE_THROWS_AS(vtk_series(folder, 5), input_error);
    vtk_series resumed(folder, 2);
    REQUIRE(resumed.size() == 2);
    resumed.write(1.0, some_pebbles(3), some_facets(2));
    REQUIRE(count(detail::read_whole(folder / "pebbles.pvd"), "<DataSet") == 3);
    resumed.write(1.5, some_pebbles(3), some_facets(2));
    REQUIRE(detail::read_whole(folder / "pebbles.pvd") == uninterrupted);
    fs::remove_all(folder);
    REQUIRE_THROWS_AS(resumed.write(2.0, some_pebbles(1), {}), run_error);
}

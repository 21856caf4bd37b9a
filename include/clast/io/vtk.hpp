// SPDX-License-Identifier: MIT
// ParaView files: pebbles as points, boundary facets as quadrilaterals (XML PolyData, base64), time series as .pvd.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <clast/core/errors.hpp>
#include <clast/io/detail/atomic_file.hpp>
#include <clast/measure/sample.hpp>

namespace clast {

namespace detail {

/// Base64 (RFC 4648) of some bytes.
inline std::string base64(std::string_view bytes) {
    constexpr char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    const auto byte = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::uint32_t three = (byte(i) << 16) | (byte(i + 1) << 8) | byte(i + 2);
        text += digit[three >> 18 & 63];
        text += digit[three >> 12 & 63];
        text += i + 1 < bytes.size() ? digit[three >> 6 & 63] : '=';
        text += i + 2 < bytes.size() ? digit[three & 63] : '=';
    }
    return text;
}

template <class T> constexpr std::string_view vtk_type() {
    if constexpr (std::is_same_v<T, float>)
        return "Float32";
    else if constexpr (std::is_same_v<T, double>)
        return "Float64";
    else if constexpr (std::is_same_v<T, std::int32_t>)
        return "Int32";
    else
        return "UInt8";
}

/// One <DataArray>: n rows of `components` values; value(i, component) gives them.
template <class T, class Value>
void vtk_array(std::string& xml, std::string_view name, std::size_t n, int components, Value&& value) {
    std::string bytes;
    const auto length = static_cast<std::uint32_t>(n * static_cast<std::size_t>(components) * sizeof(T));
    bytes.reserve(length + sizeof length);
    bytes.append(reinterpret_cast<const char*>(&length), sizeof length); // VTK wants the byte count in front
    for (std::size_t i = 0; i < n; ++i)
        for (int c = 0; c < components; ++c) {
            const T v = static_cast<T>(value(i, c));
            bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
        }
    fmt::format_to(std::back_inserter(xml),
                   "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
                   vtk_type<T>(), name, components, base64(bytes));
}

inline std::string vtk_head(double time, std::size_t points, std::string_view cell_kind, std::size_t cells) {
    std::string xml =
        fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" "
                    "header_type=\"UInt32\">\n<PolyData>\n<FieldData>\n",
                    std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
    fmt::format_to(
        std::back_inserter(xml),
        "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n"
        "</FieldData>\n<Piece NumberOfPoints=\"{}\" {}=\"{}\">\n",
        time, points, cell_kind, cells);
    return xml;
}

inline constexpr std::string_view vtk_tail = "</Piece>\n</PolyData>\n</VTKFile>\n";

} // namespace detail

/// Text of a .vtp file with one point per pebble. Lengths in m, velocity in m/s; state: 0 clump, 1 bonded, 2 fragment.
/// Show it in ParaView as "Point Gaussian" or "3D Glyphs" scaled by radius.
inline std::string pebbles_vtp(double time, std::span<const pebble_view> pebbles) {
    const std::size_t n = pebbles.size();
    std::string xml = detail::vtk_head(time, n, "NumberOfVerts", n);
    xml += "<PointData Scalars=\"radius\">\n";
    detail::vtk_array<float>(xml, "radius", n, 1, [&](std::size_t i, int) { return pebbles[i].radius; });
    detail::vtk_array<std::int32_t>(xml, "grain", n, 1, [&](std::size_t i, int) { return pebbles[i].grain; });
    detail::vtk_array<std::int32_t>(xml, "fragment", n, 1, [&](std::size_t i, int) { return pebbles[i].fragment; });
    detail::vtk_array<std::uint8_t>(xml, "state", n, 1, [&](std::size_t i, int) { return pebbles[i].state; });
    detail::vtk_array<float>(xml, "displacement", n, 3,
                             [&](std::size_t i, int c) { return pebbles[i].displacement[c]; });
    detail::vtk_array<float>(xml, "velocity", n, 3, [&](std::size_t i, int c) { return pebbles[i].velocity[c]; });
    xml += "</PointData>\n<Points>\n";
    detail::vtk_array<double>(xml, "position", n, 3, [&](std::size_t i, int c) { return pebbles[i].position[c]; });
    xml += "</Points>\n<Verts>\n";
    detail::vtk_array<std::int32_t>(xml, "connectivity", n, 1, [](std::size_t i, int) { return i; });
    detail::vtk_array<std::int32_t>(xml, "offsets", n, 1, [](std::size_t i, int) { return i + 1; });
    xml += "</Verts>\n";
    xml += detail::vtk_tail;
    return xml;
}

/// Text of a .vtp file with one quadrilateral per active facet: pressure (Pa), area (m^2), ring and tile (-1: platen).
inline std::string facets_vtp(double time, std::span<const facet_view> facets) {
    const std::size_t n = facets.size();
    std::string xml = detail::vtk_head(time, 4 * n, "NumberOfPolys", n);
    xml += "<CellData Scalars=\"pressure\">\n";
    detail::vtk_array<float>(xml, "pressure", n, 1, [&](std::size_t i, int) { return facets[i].pressure; });
    detail::vtk_array<float>(xml, "area", n, 1, [&](std::size_t i, int) { return facets[i].area; });
    detail::vtk_array<std::int32_t>(xml, "ring", n, 1, [&](std::size_t i, int) { return facets[i].ring; });
    detail::vtk_array<std::int32_t>(xml, "tile", n, 1, [&](std::size_t i, int) { return facets[i].tile; });
    xml += "</CellData>\n<Points>\n";
    detail::vtk_array<double>(xml, "corner", 4 * n, 3,
                              [&](std::size_t i, int c) { return facets[i / 4].corner[i % 4][c]; });
    xml += "</Points>\n<Polys>\n";
    detail::vtk_array<std::int32_t>(xml, "connectivity", 4 * n, 1, [](std::size_t i, int) { return i; });
    detail::vtk_array<std::int32_t>(xml, "offsets", n, 1, [](std::size_t i, int) { return 4 * (i + 1); });
    xml += "</Polys>\n";
    xml += detail::vtk_tail;
    return xml;
}

/// A growing time series in a folder: pebbles_0000.vtp, boundary_0000.vtp, ... and the two collections pebbles.pvd and
/// boundary.pvd, rewritten as a whole after each snapshot, so that ParaView can open them while the run goes on.
class vtk_series {
  public:
    /// Uses an existing folder; starts an empty series.
    explicit vtk_series(std::filesystem::path folder) : folder_(std::move(folder)) {}

    /// Goes on with the series of an earlier run after its first `keep` snapshots; the run will write the later ones
    /// again. Throws input_error where pebbles.pvd has fewer.
    vtk_series(std::filesystem::path folder, std::size_t keep) : folder_(std::move(folder)) {
        if (keep == 0) return;
        const std::string text = detail::read_whole(folder_ / "pebbles.pvd");
        constexpr std::string_view mark = "timestep=\"";
        for (std::size_t at = 0; times_.size() < keep && (at = text.find(mark, at)) != std::string::npos;) {
            at += mark.size();
            times_.push_back(std::strtod(text.c_str() + at, nullptr));
        }
        if (times_.size() < keep)
            throw input_error(fmt::format("'{}' has lost snapshots: it lists {}, the checkpoint says {}",
                                          (folder_ / "pebbles.pvd").string(), times_.size(), keep));
    }

    /// Writes one snapshot at model time `time` (s). Throws run_error.
    void write(double time, std::span<const pebble_view> pebbles, std::span<const facet_view> facets) {
        const std::size_t index = times_.size();
        detail::replace_file(folder_ / file_name("pebbles", index), {pebbles_vtp(time, pebbles)});
        detail::replace_file(folder_ / file_name("boundary", index), {facets_vtp(time, facets)});
        times_.push_back(time);
        for (const char* kind : {"pebbles", "boundary"})
            detail::replace_file(folder_ / (std::string(kind) + ".pvd"), {collection(kind)});
    }

    /// Number of snapshots in the series.
    [[nodiscard]] std::size_t size() const { return times_.size(); }

  private:
    static std::string file_name(std::string_view kind, std::size_t index) {
        return fmt::format("{}_{:04}.vtp", kind, index);
    }
    [[nodiscard]] std::string collection(std::string_view kind) const {
        std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
        for (std::size_t i = 0; i < times_.size(); ++i)
            fmt::format_to(std::back_inserter(xml), "<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n",
                           times_[i], file_name(kind, i));
        return xml + "</Collection>\n</VTKFile>\n";
    }

    std::filesystem::path folder_;
    std::vector<double> times_;
};

} // namespace clast

// SPDX-License-Identifier: MIT
#include "grains.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include <clast/core/errors.hpp>
#include <clast/io/archive.hpp>
#include <clast/io/detail/atomic_file.hpp>
#include <clast/io/grading.hpp>
#include <clast/io/packing.hpp>
#include <clast/io/shapes.hpp>

namespace triaxial {

using clast::input_error;
namespace fs = std::filesystem;

namespace {

/// One shape of --shape: its name or file, and its share as typed.
struct named_shape {
    std::string name;
    std::string share; ///< empty: an equal one

    [[nodiscard]] bool is_file() const { return name != "4B" && name != "14B" && name != "sphere"; }
    [[nodiscard]] std::string title() const { return is_file() ? fs::path(name).stem().string() : name; }
};

/// "14B:0.7,rock.txt:0.3" in its parts; a file that has commas or colons in its name is one.
std::vector<named_shape> shapes_of(const options& o) {
    std::error_code none;
    if (fs::exists(o.shape, none)) return {{o.shape, ""}};
    std::vector<named_shape> all;
    std::string_view rest = o.shape;
    while (true) {
        const std::size_t comma = rest.find(',');
        std::string one(rest.substr(0, comma)), share;
        if (const std::size_t colon = one.rfind(':'); colon != std::string::npos)
            share = one.substr(colon + 1), one.resize(colon);
        if (one == "4b" || one == "14b") one.back() = 'B';
        all.push_back({one, share});
        if (comma == std::string_view::npos) return all;
        rest.remove_prefix(comma + 1);
    }
}

double share_of(const named_shape& s, const options& o) {
    if (s.share.empty()) return 1.0;
    double share = 0.0;
    const char *first = s.share.data(), *last = first + s.share.size();
    const auto [end, error] = std::from_chars(first, last, share);
    if (error != std::errc{} || end != last || !(share > 0.0 && std::isfinite(share)))
        throw input_error("--shape", o.shape, "names or files, each with its share of the mass behind a colon",
                          "Write for example --shape 14B:0.7,4B:0.3.");
    return share;
}

std::string joined_shapes(const std::vector<named_shape>& shapes) {
    std::string text;
    for (const named_shape& s : shapes)
        text += (text.empty() ? "" : ",") + s.name + (s.share.empty() ? "" : ":" + s.share);
    return text;
}

std::uint64_t checksum_of(const fs::path& file) { return clast::checksum(clast::detail::read_whole(file)); }

/// The message of an error about a file or a value, by the name of the option.
input_error by_option(const char* option, const input_error& e) {
    return input_error(fmt::format("{}: {}", option, e.what()));
}

} // namespace

std::vector<fs::path> input_files(const options& o) {
    std::vector<fs::path> files;
    for (const named_shape& s : shapes_of(o))
        if (s.is_file()) files.emplace_back(s.name);
    if (!o.grading.empty()) files.emplace_back(o.grading);
    if (!o.packing.empty()) files.emplace_back(o.packing);
    if (!o.from.empty()) files.emplace_back(o.from);
    return files;
}

options with_files_in(options o, const fs::path& folder) {
    const auto there = [&](const std::string& path) { return (folder / fs::path(path).filename()).string(); };
    std::vector<named_shape> shapes = shapes_of(o);
    for (named_shape& s : shapes)
        if (s.is_file()) s.name = there(s.name);
    o.shape = joined_shapes(shapes);
    if (!o.grading.empty()) o.grading = there(o.grading);
    if (!o.packing.empty()) o.packing = there(o.packing);
    if (!o.from.empty()) o.from = there(o.from);
    return o;
}

clast::mixture grains_of(const options& o) {
    const clast::overlaps how = o.breakable() ? clast::overlaps::refuse : clast::overlaps::as_union;
    const clast::grain_size size = {grain_diameter, o.grain_size == "circumscribed" ? clast::size_reading::circumscribed
                                                                                    : clast::size_reading::equivalent};
    std::vector<clast::mixture_part> parts;
    for (const named_shape& s : shapes_of(o)) {
        try {
            parts.push_back({clast::shapes::by_name(s.name, size, how), share_of(s, o)});
        } catch (const input_error& e) {
            const std::string text = e.what();
            if (text.starts_with("--")) throw;
            throw input_error((text.starts_with("shape: ") ? "--" : "--shape: ") + text);
        }
    }
    if (o.grading.empty()) return clast::mixture(std::move(parts));
    try {
        return clast::mixture(std::move(parts), clast::read_grading(o.grading));
    } catch (const input_error& e) {
        throw by_option("--grading", e);
    }
}

clast::protocol::packing packing_of(const options& o, const clast::mixture& grains) {
    if (o.packing.empty()) return {};
    try {
        return clast::read_packing(o.packing, grains);
    } catch (const input_error& e) {
        throw by_option("--packing", e);
    }
}

clast::grain_sizes sizes_of(const options& o) {
    const clast::mixture grains = grains_of(o);
    const clast::protocol::packing packing = packing_of(o, grains);
    return packing.empty() ? clast::sizes_of(grains) : packing.sizes();
}

void check_grains(options& o) {
    const clast::grain_sizes grains = sizes_of(o);
    const std::vector<fs::path> files = input_files(o);
    for (std::size_t a = 0; a < files.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (files[a].filename() == files[b].filename() && files[a] != files[b])
                throw input_error(fmt::format("'{}' and '{}': files of one run need different names, because copies of "
                                              "them are kept together with its results. Rename one.",
                                              files[b].string(), files[a].string()));
    o.checksums.clear();
    for (const fs::path& f : files) o.checksums.push_back(checksum_of(f));

    const double widest = 2.2 * grains.largest_circumscribed;
    if (o.diameter() < widest)
        throw input_error(
            !o.packing.empty()  ? "--packing"
            : o.grading.empty() ? "--scale"
                                : "--grading",
            fmt::format("grains that are {:.0f} mm wide", 1e3 * grains.largest_circumscribed),
            fmt::format("a sphere around a grain of up to {:.0f} mm at scale {}", 1e3 * o.diameter() / 2.2, o.scale),
            fmt::format("Use --scale {:.2f} or more.", std::ceil(100.0 * widest / full_diameter) / 100));
    // tiles and strips have to be wider than a pebble, or one could slip through a corner
    const double largest = 2.0 * grains.largest_radius, width = tile_width(o.diameter(), o.tiles_per_ring);
    if (width < largest * (1.0 - 1e-9)) {
        const int most = static_cast<int>(std::numbers::pi / std::atan(largest / o.diameter()));
        const double enough = largest / std::tan(std::numbers::pi / o.tiles_per_ring) / full_diameter;
        throw input_error("--tiles-per-ring", fmt::format("{}", o.tiles_per_ring),
                          fmt::format("{} to {} at scale {} (a tile would be {:.1f} mm wide, a pebble is {:.1f} mm)",
                                      fewest_tiles, most, o.scale, 1e3 * width, 1e3 * largest),
                          fmt::format("Use fewer tiles, or --scale {:.2f} or more.", std::ceil(100 * enough) / 100));
    }
    if (const double tall = o.height() / o.rings; tall < largest * (1.0 - 1e-9))
        throw input_error("--rings", fmt::format("{}", o.rings),
                          fmt::format("1 to {} at scale {} (a tile would be {:.1f} mm high, a pebble is {:.1f} mm)",
                                      static_cast<int>(o.height() / largest), o.scale, 1e3 * tall, 1e3 * largest),
                          fmt::format("Use fewer rings, or --scale {:.2f} or more.",
                                      std::ceil(100 * largest * o.rings / full_height) / 100));
}

std::string grains_title(const options& o) {
    std::string text;
    for (const named_shape& s : shapes_of(o)) text += (text.empty() ? "" : "+") + s.title();
    return o.grading.empty() ? text : text + "-" + fs::path(o.grading).stem().string();
}

std::string grains_text(const options& o) {
    std::size_t file = 0;
    const auto known = [&](const std::string& title) {
        return fmt::format("{} (checksum {:016x})", title, file < o.checksums.size() ? o.checksums[file++] : 0);
    };
    std::string shapes;
    for (const named_shape& s : shapes_of(o))
        shapes += (shapes.empty() ? "" : ", ") + (s.is_file() ? known(s.title()) : s.name) +
                  (s.share.empty() ? "" : " " + s.share);
    std::string text = fmt::format("shape = {}\n", shapes);
    if (!o.grading.empty()) text += fmt::format("grading = {}\n", known(fs::path(o.grading).stem().string()));
    if (!o.packing.empty()) text += fmt::format("packing = {}\n", known(fs::path(o.packing).stem().string()));
    if (!o.from.empty()) text += fmt::format("prepared specimen = {}\n", known(fs::path(o.from).stem().string()));
    return text;
}

} // namespace triaxial

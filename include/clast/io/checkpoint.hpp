// SPDX-License-Identifier: MIT
// A run on disk: everything that is needed to go on as if it had never stopped (design invariant 1).
//
// File: magic, byte order mark, format version, lengths of fingerprint and state, FNV-1a of both, fingerprint, state.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <clast/io/archive.hpp>
#include <clast/io/detail/atomic_file.hpp>

namespace clast {

namespace detail {

struct checkpoint_header {
    static constexpr std::uint32_t native_order = 0x01020304;
    static constexpr std::uint32_t foreign_order = 0x04030201;
    static constexpr std::uint32_t current_version = 5; ///< raised whenever what a state archives changes

    char magic[8] = {'c', 'l', 'a', 's', 't', 'c', 'p', '\n'};
    std::uint32_t byte_order = native_order;
    std::uint32_t version = current_version;
    std::uint64_t fingerprint_length = 0;
    std::uint64_t state_length = 0;
    std::uint64_t checksum = 0;
};
static_assert(sizeof(checkpoint_header) == 40);

inline std::uint64_t checkpoint_checksum(std::string_view fingerprint, std::span<const std::byte> state) {
    hash_archive hash;
    hash.bytes(fingerprint.data(), fingerprint.size());
    hash.bytes(state.data(), state.size());
    return hash.value;
}

/// The first line in which two texts differ, for "was made with ... but this run has ...".
inline std::pair<std::string, std::string> first_difference(std::string_view a, std::string_view b) {
    const auto next_line = [](std::string_view& text) {
        const auto end = text.find('\n');
        const std::string_view line = text.substr(0, end);
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
        return line.empty() ? std::string("(nothing)") : std::string(line);
    };
    while (!a.empty() || !b.empty()) {
        auto pair = std::pair(next_line(a), next_line(b));
        if (pair.first != pair.second) return pair;
    }
    return {};
}

} // namespace detail

/// Writes `state` to `path`, atomically. `fingerprint` says what run it belongs to (bundle type, shape, options: one
/// "name = value" per line). On failure the previous checkpoint stays and run_error says why.
template <class State>
void save_checkpoint(const std::filesystem::path& path, const std::string& fingerprint, const State& state) {
    const std::vector<std::byte> bytes = to_bytes(state);
    detail::checkpoint_header header;
    header.fingerprint_length = fingerprint.size();
    header.state_length = bytes.size();
    header.checksum = detail::checkpoint_checksum(fingerprint, bytes);
    detail::replace_file(path, {std::string_view(reinterpret_cast<const char*>(&header), sizeof header), fingerprint,
                                std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size())});
}

/// Reads a state that save_checkpoint wrote. Throws input_error with a different text for: no such file, not a
/// checkpoint, other byte order, other format version, truncated, other run, damaged. `state` is touched only after
/// all of these were checked.
template <class State>
void load_checkpoint(const std::filesystem::path& path, const std::string& fingerprint, State& state) {
    const std::string name = "checkpoint '" + path.string() + "'";
    const auto wrong = [&name](const std::string& text) { return input_error(name + " " + text); };

    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file)
        throw wrong(
            fmt::format("cannot be opened: {}. Give --resume the folder of an earlier run.", std::strerror(errno)));
    std::vector<std::byte> content;
    std::byte block[1 << 16];
    while (const std::size_t n = std::fread(block, 1, sizeof block, file.get()))
        content.insert(content.end(), block, block + n);
    if (std::ferror(file.get())) throw wrong(fmt::format("cannot be read: {}.", std::strerror(errno)));

    detail::checkpoint_header header;
    const detail::checkpoint_header expected;
    if (content.size() < sizeof header.magic || std::memcmp(content.data(), expected.magic, sizeof header.magic) != 0)
        throw wrong("is not a clast checkpoint: it does not start with the mark of one.");
    if (content.size() < sizeof header)
        throw wrong(
            fmt::format("is truncated: it has {} bytes, not even a complete header. Use an older copy or start again.",
                        content.size()));
    std::memcpy(&header, content.data(), sizeof header);
    if (header.byte_order == expected.foreign_order)
        throw wrong("was written on a machine with another byte order: resume it there.");
    if (header.byte_order != expected.byte_order)
        throw wrong("is damaged: its byte order mark is wrong. Use an older copy or start again.");
    if (header.version != expected.version)
        throw wrong(fmt::format(
            "has format version {}, this program reads version {}: resume it with the program that wrote it.",
            header.version, expected.version));
    const std::uint64_t present = content.size() - sizeof header;
    if (header.fingerprint_length > present || header.state_length > present - header.fingerprint_length)
        throw wrong(
            fmt::format("is truncated: {} bytes are announced but it has only {}. Use an older copy or start again.",
                        fmt::group_digits(sizeof header + header.fingerprint_length + header.state_length),
                        fmt::group_digits(content.size())));
    if (header.fingerprint_length + header.state_length != present)
        throw wrong("is damaged: it is longer than it says. Use an older copy or start again.");

    const std::string_view stored(reinterpret_cast<const char*>(content.data() + sizeof header),
                                  static_cast<std::size_t>(header.fingerprint_length));
    const std::span<const std::byte> bytes(content.data() + sizeof header + stored.size(),
                                           static_cast<std::size_t>(header.state_length));
    if (detail::checkpoint_checksum(stored, bytes) != header.checksum)
        throw wrong("is damaged: its checksum does not match its content. Use an older copy or start again.");
    if (stored != fingerprint) {
        const auto [theirs, ours] = detail::first_difference(stored, fingerprint);
        throw wrong(fmt::format(
            "belongs to another run: it was made with\n  {}\nbut this run has\n  {}\nResume with the options "
            "(and the program) of that run, or start a new one with another --out.",
            theirs, ours));
    }
    try {
        from_bytes(bytes, state);
    } catch (const input_error& e) {
        throw wrong(fmt::format("does not fit this program ({}): resume it with the program that wrote it.", e.what()));
    }
}

} // namespace clast

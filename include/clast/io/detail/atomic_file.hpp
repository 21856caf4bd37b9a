// SPDX-License-Identifier: MIT
// Replaces a file as a whole: a reader, a crash or a full disk sees the old content or the new one, never a part.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

#include <clast/core/errors.hpp>

namespace clast::detail {

using file_handle = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// The whole content of a file. Throws input_error.
inline std::string read_whole(const std::filesystem::path& path) {
    const file_handle file(std::fopen(path.c_str(), "rb"), &std::fclose);
    if (!file) throw input_error(fmt::format("'{}' cannot be opened: {}", path.string(), std::strerror(errno)));
    std::string text;
    char block[1 << 14];
    while (const std::size_t n = std::fread(block, 1, sizeof block, file.get())) text.append(block, n);
    if (std::ferror(file.get()))
        throw input_error(fmt::format("'{}' cannot be read: {}", path.string(), std::strerror(errno)));
    return text;
}

inline run_error write_failed(const std::filesystem::path& path, int error, const std::string& kept) {
    const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
    return run_error(failure{
        .what = fmt::format("'{}' could not be written: {}", path.string(), std::strerror(error)),
        .where = path.parent_path().empty() ? "." : path.parent_path().string(),
        .when = kept,
        .why = full ? "the disk (or the quota) is full" : "the folder is missing, read-only, or the device failed",
        .advice = full ? "free some space and go on with --resume, or choose another folder with --out"
                       : "check the folder, then go on with --resume, or choose another folder with --out"});
}

/// Writes `parts` one after the other to a temporary file beside `path` and renames it over `path`.
/// On failure removes the temporary file, leaves `path` as it was and throws run_error.
inline void replace_file(const std::filesystem::path& path, std::initializer_list<std::string_view> parts) {
    namespace fs = std::filesystem;
    const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
    const fs::path temporary = folder / (path.filename().string() + ".tmp");
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    const std::string kept = fs::exists(path) ? "the previous file was kept unchanged" : "no earlier file existed";
    if (file < 0) throw write_failed(path, errno, kept);

    int error = 0;
    for (std::string_view part : parts) {
        while (!part.empty() && error == 0) {
            const ssize_t n = ::write(file, part.data(), part.size());
            if (n < 0 && errno != EINTR) error = errno;
            if (n == 0) error = ENOSPC;
            if (n > 0) part.remove_prefix(static_cast<std::size_t>(n));
        }
    }
    // a rename may reach the disk before the data does, so the data go first
    if (error == 0 && ::fsync(file) != 0 && errno != EINVAL) error = errno;
    if (::close(file) != 0 && error == 0) error = errno;
    if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) error = errno;
    if (error != 0) {
        ::unlink(temporary.c_str());
        throw write_failed(path, error, kept);
    }
    const int directory = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (directory >= 0) {
        ::fsync(directory); // makes the rename itself durable; some file systems refuse it, which does no harm
        ::close(directory);
    }
}

} // namespace clast::detail

// SPDX-License-Identifier: MIT
// A text file that is there as long as a test needs it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace clast {

struct text_file {
    std::string path;
    explicit text_file(const std::string& text)
        : path((std::filesystem::temp_directory_path() /
                ("clast_test_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)) + ".txt"))
                   .string()) {
        std::ofstream(path) << text;
    }
    ~text_file() {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
    }
    text_file(const text_file&) = delete;
    text_file& operator=(const text_file&) = delete;
};

} // namespace clast

// SPDX-License-Identifier: MIT
#include <clast/io/checkpoint.hpp>

#include <clast/core/vector.hpp>

#include <csignal>
#include <fstream>
#include <iterator>

#include <sys/resource.h>

#include <catch.hpp>

using namespace clast;
namespace fs = std::filesystem;

namespace {

struct state {
    std::vector<vec3> position;
    std::int64_t steps = 0;
    template <class A> void archive(A& a) { a(position, steps); }
    bool operator==(const state&) const = default;
};

const state example{{{1, 2, 3}, {4, 5, 6}, {7, 8, -0.0}}, 12345};
const std::string fingerprint = "clast checkpoint\nshape = 4B\nmembrane = tiles\nseed = 1";

struct folder {
    fs::path path = fs::temp_directory_path() / fmt::format("clast_checkpoint_test_{}", ::getpid());
    folder() { fs::create_directories(path); }
    ~folder() { fs::remove_all(path); }
    fs::path file() const { return path / "checkpoint.clast"; }
    std::size_t files() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
    }
};

std::string read(const fs::path& p) {
    std::ifstream in(p, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}
void write(const fs::path& p, const std::string& text) { std::ofstream(p, std::ios::binary) << text; }

std::string refusal(const fs::path& p, const std::string& print = fingerprint) {
    state s;
    try {
        load_checkpoint(p, print, s);
    } catch (const input_error& e) {
        REQUIRE(s == state{}); // nothing was touched
        return e.what();
    }
    return "accepted";
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_CASE("a saved state is loaded bit for bit and no temporary file stays") {
    const folder f;
    save_checkpoint(f.file(), fingerprint, state{});
    save_checkpoint(f.file(), fingerprint, example); // over an older one
    state s;
    load_checkpoint(f.file(), fingerprint, s);
    REQUIRE(s == example);
    REQUIRE(checksum(s) == checksum(example));
    REQUIRE(f.files() == 1);
}

TEST_CASE("a missing checkpoint is refused") {
    const folder f;
    REQUIRE(has(refusal(f.file()), "cannot be opened"));
    REQUIRE(has(refusal(f.path), "cannot be read")); // a folder
}

TEST_CASE("a foreign file is refused") {
    const folder f;
    for (const char* text : {"", "x", "PK\x03\x04 something else entirely that is long enough for a header ......"}) {
        write(f.file(), text);
        REQUIRE(has(refusal(f.file()), "is not a clast checkpoint"));
    }
}

TEST_CASE("a checkpoint cut at any length is refused as truncated") {
    const folder f;
    save_checkpoint(f.file(), fingerprint, example);
    const std::string whole = read(f.file());
    for (std::size_t n = 8; n < whole.size(); ++n) {
        write(f.file(), whole.substr(0, n));
        REQUIRE(has(refusal(f.file()), "is truncated"));
    }
    write(f.file(), whole + "x");
    REQUIRE(has(refusal(f.file()), "longer than it says"));
}

TEST_CASE("a checkpoint with any flipped bit is refused") {
    const folder f;
    save_checkpoint(f.file(), fingerprint, example);
    const std::string whole = read(f.file());
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
        write(f.file(), damaged);
        REQUIRE(refusal(f.file()) != "accepted");
        if (i >= sizeof(detail::checkpoint_header)) REQUIRE(has(refusal(f.file()), "checksum does not match"));
    }
}

TEST_CASE("another format version and another byte order are told apart") {
    const folder f;
    save_checkpoint(f.file(), fingerprint, example);
    std::string whole = read(f.file());
    whole[12] = 77;
    write(f.file(), whole);
    REQUIRE(has(refusal(f.file()), "has format version 77, this program reads version 5"));
    std::swap(whole[8], whole[11]);
    std::swap(whole[9], whole[10]);
    write(f.file(), whole);
    REQUIRE(has(refusal(f.file()), "another byte order"));
}

TEST_CASE("the checkpoint of another run is refused and the difference is named") {
    const folder f;
    save_checkpoint(f.file(), fingerprint, example);
    const std::string message = refusal(f.file(), "clast checkpoint\nshape = 14B\nmembrane = tiles\nseed = 1");
    REQUIRE(has(message, "belongs to another run"));
    REQUIRE(has(message, "shape = 4B"));
    REQUIRE(has(message, "shape = 14B"));
    REQUIRE(!has(message, "seed"));
}

TEST_CASE("a state of another layout with the same fingerprint is refused") {
    const folder f;
    save_checkpoint(f.file(), fingerprint, std::vector<double>{1, 2, 3, 4});
    REQUIRE(has(refusal(f.file()), "does not fit this program"));
}

TEST_CASE("a full disk keeps the previous checkpoint and says so") {
    const folder f;
    save_checkpoint(f.file(), fingerprint, example);
    const std::string before = read(f.file());

    state large = example;
    large.position.resize(10000);
    rlimit old{};
    ::getrlimit(RLIMIT_FSIZE, &old);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{4096, old.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small); // the kernel now refuses to write more than 4 kB into one file
    std::string message = "accepted";
    try {
        save_checkpoint(f.file(), fingerprint, large);
    } catch (const run_error& e) {
        message = e.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &old);
    std::signal(SIGXFSZ, old_handler);

    REQUIRE(has(message, "could not be written"));
    REQUIRE(has(message, "full"));
    REQUIRE(has(message, "previous file was kept"));
    REQUIRE(read(f.file()) == before);
    REQUIRE(f.files() == 1);
}

TEST_CASE("a folder that is not there is a run error") {
    REQUIRE_THROWS_AS(save_checkpoint("/nonexistent/folder/checkpoint.clast", fingerprint, example), run_error);
}

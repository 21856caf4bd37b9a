// SPDX-License-Identifier: MIT
// Writes, reads and hashes the complete state of a run. A state struct lists its members once, in
// `template <class A> void archive(A& a) { a(member1, member2); }`, and every archive below visits the same bytes.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <clast/core/errors.hpp>

namespace clast {

class write_archive;

/// A struct that lists its members in archive().
template <class T>
concept archivable = requires(T& value, write_archive& a) {
    value.archive(a);
};

namespace detail {

// Reads every byte of a default value at compile time, which is only allowed when none of them is padding. Padding
// has no defined value, so a checksum over it would differ between two equal states.
template <class T> constexpr int sum_of_bytes() {
    struct bytes {
        unsigned char at[sizeof(T)];
    };
    const bytes b = std::bit_cast<bytes>(T{});
    int sum = 0;
    for (const unsigned char c : b.at) sum += c;
    return sum;
}

template <class T>
concept free_of_padding = std::is_arithmetic_v<T> || std::is_enum_v<T> || requires {
    typename std::bool_constant<(sum_of_bytes<T>(), true)>;
};

template <class T> struct is_vector : std::false_type {};
template <class T, class Allocator> struct is_vector<std::vector<T, Allocator>> : std::true_type {};
template <class T> struct is_array : std::false_type {};
template <class T, std::size_t N> struct is_array<std::array<T, N>> : std::true_type {};
template <class T> struct is_optional : std::false_type {};
template <class T> struct is_optional<std::optional<T>> : std::true_type {};
template <class T> struct is_pair : std::false_type {};
template <class A, class B> struct is_pair<std::pair<A, B>> : std::true_type {};

/// Values that go into an archive as the bytes they are.
template <class T>
concept plain_bytes =
    !archivable<T> && !is_optional<T>::value && !is_pair<T>::value && std::is_trivially_copyable_v<T> &&
    !std::is_pointer_v<T> && !std::is_same_v<T, long double> && free_of_padding<T>;

// The one description of how a value is laid out in an archive; Archive supplies bytes(pointer, count) and length(n).
template <class Archive, class T> void visit(Archive& a, T& value) {
    if constexpr (archivable<T>) {
        value.archive(a);
    } else if constexpr (plain_bytes<T>) {
        a.bytes(&value, sizeof(T));
    } else if constexpr (std::is_same_v<T, std::string>) {
        a.resize(value, 1);
        a.bytes(value.data(), value.size());
    } else if constexpr (is_vector<T>::value) {
        using element = typename T::value_type;
        static_assert(!std::is_same_v<element, bool>,
                      "std::vector<bool> has no bytes of its own: use std::vector<std::uint8_t>");
        if constexpr (plain_bytes<element>) {
            a.resize(value, sizeof(element));
            a.bytes(value.data(), value.size() * sizeof(element));
        } else {
            a.resize(value, 1);
            for (element& e : value) visit(a, e);
        }
    } else if constexpr (is_array<T>::value) {
        for (auto& e : value) visit(a, e);
    } else if constexpr (is_pair<T>::value) {
        visit(a, value.first);
        visit(a, value.second);
    } else if constexpr (is_optional<T>::value) {
        bool full = value.has_value();
        visit(a, full);
        if (full != value.has_value()) {
            if (full)
                value.emplace();
            else
                value.reset();
        }
        if (full) visit(a, *value);
    } else {
        static_assert(
            archivable<T>,
            "this type cannot go into a checkpoint: give it `template <class A> void archive(A& a)` that lists "
            "its members (needed for pointers, padding bytes and non-trivial members)");
    }
}

} // namespace detail

/// Appends values to a byte buffer.
class write_archive {
  public:
    static constexpr bool reading = false;

    /// Writes the values in this order. They are not changed.
    template <class... T> void operator()(const T&... values) {
        // archive() members are not const because the same function reads; writing does not modify
        (detail::visit(*this, const_cast<T&>(values)), ...);
    }

    void bytes(const void* data, std::size_t count) {
        const auto* first = static_cast<const std::byte*>(data);
        buffer.insert(buffer.end(), first, first + count);
    }
    template <class Container> void resize(Container& c, std::size_t) {
        const auto n = static_cast<std::uint64_t>(c.size());
        bytes(&n, sizeof n);
    }

    std::vector<std::byte> buffer; ///< what was written so far
};

/// Reads values back in the order in which they were written. Throws input_error where the bytes end too early.
class read_archive {
  public:
    static constexpr bool reading = true;

    explicit read_archive(std::span<const std::byte> bytes) : rest_(bytes) {}

    template <class... T> void operator()(T&... values) { (detail::visit(*this, values), ...); }

    void bytes(void* data, std::size_t count) {
        need(count, 1);
        if (count > 0) std::memcpy(data, rest_.data(), count);
        rest_ = rest_.subspan(count);
    }
    template <class Container> void resize(Container& c, std::size_t element_size) {
        std::uint64_t n = 0;
        bytes(&n, sizeof n);
        need(n, element_size); // before memory is asked for: a damaged length must not ask for terabytes
        c.resize(static_cast<std::size_t>(n));
    }

    /// Bytes that were not read yet; 0 after a complete state.
    [[nodiscard]] std::size_t remaining() const { return rest_.size(); }

  private:
    void need(std::uint64_t count, std::size_t element_size) const {
        if (count > rest_.size() / element_size)
            throw input_error(
                fmt::format("the stored state ends too early: {} items of {} bytes are announced, {} bytes are left",
                            count, element_size, rest_.size()));
    }

    std::span<const std::byte> rest_;
};

/// FNV-1a, 64 bit, over the bytes that write_archive would produce, without storing them.
class hash_archive {
  public:
    static constexpr bool reading = false;

    template <class... T> void operator()(const T&... values) { (detail::visit(*this, const_cast<T&>(values)), ...); }

    void bytes(const void* data, std::size_t count) {
        const auto* p = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < count; ++i) value = (value ^ p[i]) * 1099511628211ULL;
    }
    template <class Container> void resize(Container& c, std::size_t) {
        const auto n = static_cast<std::uint64_t>(c.size());
        bytes(&n, sizeof n);
    }

    std::uint64_t value = 14695981039346656037ULL; ///< hash of what was seen so far
};

/// The bytes of a state.
template <class State> std::vector<std::byte> to_bytes(const State& state) {
    write_archive a;
    a(state);
    return std::move(a.buffer);
}

/// Fills a state from all of `bytes`. Throws input_error when they are too few or too many.
template <class State> void from_bytes(std::span<const std::byte> bytes, State& state) {
    read_archive a(bytes);
    a(state);
    if (a.remaining() != 0)
        throw input_error(fmt::format("the stored state is {} bytes longer than this program's state", a.remaining()));
}

/// Checksum of a state: equal states have equal checksums (same binary, same inputs: design invariant 1).
template <class State> std::uint64_t checksum(const State& state) {
    hash_archive a;
    a(state);
    return a.value;
}

} // namespace clast

// SPDX-License-Identifier: MIT
// Vectors, matrices, quaternions and tables of clast for Eigen: as maps, which are no copies, where the layout allows.
//
// Needs Eigen 3.4. No other header includes this one, so that programs without Eigen neither need nor compile it.
#pragma once

#include <concepts>
#include <ranges>
#include <type_traits>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <clast/core/vector.hpp>

namespace clast {

namespace detail {

/// An expression of so many rows and columns of double, known as it is compiled.
template <class T, int rows, int columns>
concept eigen_size = std::same_as<Eigen::Matrix<typename T::Scalar, T::RowsAtCompileTime, T::ColsAtCompileTime>,
                                  Eigen::Matrix<double, rows, columns>>;
template <class T>
concept eigen_vector = eigen_size<T, 3, 1> || eigen_size<T, 1, 3>;
template <class T>
concept eigen_matrix = eigen_size<T, 3, 3>;

/// Records side by side in memory that the caller keeps: no temporary std::vector.
template <class T>
concept kept_table = std::ranges::contiguous_range<T> && std::ranges::sized_range<T> && std::ranges::borrowed_range<T>;

static_assert(std::is_standard_layout_v<mat3> && sizeof(vec3) == 3 * sizeof(double) && sizeof(mat3) == 3 * sizeof(vec3),
              "maps take the numbers of vec3 and mat3 to stand in a row");
template <class T> double* numbers_of(T& a) { return reinterpret_cast<double*>(&a); }
template <class T> const double* numbers_of(const T& a) { return reinterpret_cast<const double*>(&a); }

} // namespace detail

inline Eigen::Vector3d to_eigen(const vec3& a) { return {a.x, a.y, a.z}; }
inline Eigen::Matrix3d to_eigen(const mat3& m) {
    Eigen::Matrix3d out;
    for (int i = 0; i < 3; ++i) out.row(i) << m(i, 0), m(i, 1), m(i, 2);
    return out;
}
/// A copy, and no map, because Eigen stores w last.
inline Eigen::Quaterniond to_eigen(const quaternion& q) { return {q.w, q.x, q.y, q.z}; }

/// From three numbers in a column or a row, or an expression of them.
template <detail::eigen_vector Derived> vec3 from_eigen(const Eigen::MatrixBase<Derived>& a) {
    const typename Derived::PlainObject v = a;
    return {v(0), v(1), v(2)};
}
/// From 3 x 3 numbers, stored by rows or by columns, or an expression of them.
template <detail::eigen_matrix Derived> mat3 from_eigen(const Eigen::MatrixBase<Derived>& a) {
    const typename Derived::PlainObject m = a;
    return {{{m(0, 0), m(0, 1), m(0, 2)}, {m(1, 0), m(1, 1), m(1, 2)}, {m(2, 0), m(2, 1), m(2, 2)}}};
}
/// As it is: what has not length 1 is not scaled to it.
inline quaternion from_eigen(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

/// 3 x 3 numbers as mat3 stores them.
using eigen_mat3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
/// N x 3 numbers, a row per record.
using eigen_rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

// Maps read and write the numbers where they are. What they show must outlive them, so a temporary is refused.

inline Eigen::Map<Eigen::Vector3d> map(vec3& a) { return Eigen::Map<Eigen::Vector3d>(detail::numbers_of(a)); }
inline Eigen::Map<const Eigen::Vector3d> map(const vec3& a) {
    return Eigen::Map<const Eigen::Vector3d>(detail::numbers_of(a));
}
void map(const vec3&&) = delete;

inline Eigen::Map<eigen_mat3> map(mat3& m) { return Eigen::Map<eigen_mat3>(detail::numbers_of(m)); }
inline Eigen::Map<const eigen_mat3> map(const mat3& m) { return Eigen::Map<const eigen_mat3>(detail::numbers_of(m)); }
void map(const mat3&&) = delete;

/// One vector of every record of a table, a std::vector or std::span of them, as the rows of an N x 3 map in the unit
/// of the vector: rows_of(grains.motion, &body_motion::x) are the centres of all bodies (m). A table of constants gives
/// a map of constants. The map holds as long as pointers into the table do. An engine keeps the pebbles of clumps up to
/// date only where they may touch: call its place_all() before these are read.
template <detail::kept_table Table> auto rows_of(Table&& table, vec3 std::ranges::range_value_t<Table>::*member) {
    using record = std::ranges::range_value_t<Table>;
    constexpr bool constant = std::is_const_v<std::remove_reference_t<std::ranges::range_reference_t<Table>>>;
    using view =
        Eigen::Map<std::conditional_t<constant, const eigen_rows, eigen_rows>, Eigen::Unaligned, Eigen::OuterStride<>>;
    static_assert(sizeof(record) % sizeof(double) == 0, "rows must be a whole number of doubles apart");
    constexpr auto stride = static_cast<Eigen::Index>(sizeof(record) / sizeof(double));
    const auto rows = static_cast<Eigen::Index>(std::ranges::size(table));
    auto* const first = std::ranges::data(table);
    return view(rows > 0 ? detail::numbers_of(first->*member) : nullptr, rows, 3, Eigen::OuterStride<>(stride));
}

} // namespace clast

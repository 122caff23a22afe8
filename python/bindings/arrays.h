// NumPy arrays that are views of the library's own memory. They keep its owner alive and cannot be written.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <type_traits>
#include <vector>

#include "ripstop/core/members.h"
#include "ripstop/core/vec3.h"

namespace ripstop::python {

namespace py = pybind11;

/// `owner` lives as long as the array does.
template <class T>
py::array view_of(const T* data, std::vector<py::ssize_t> shape, const py::dtype& type, py::handle owner) {
  py::array array(type, std::move(shape), {}, data, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}
template <class T>
py::array view_of(const T* data, std::vector<py::ssize_t> shape, py::handle owner) {
  return view_of(data, std::move(shape), py::dtype::of<T>(), owner);
}
inline py::array view_of(const std::vector<Vec3>& points, py::handle owner) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const double* data = points.empty() ? nullptr : &points.front().x;
  return view_of(data, {static_cast<py::ssize_t>(points.size()), 3}, owner);
}
template <class Number>
requires std::is_arithmetic_v<Number> py::array view_of(const std::vector<Number>& values, py::handle owner) {
  return view_of(values.data(), {static_cast<py::ssize_t>(values.size())}, owner);
}

/// Whether every member of a listed struct is a number, a choice or a vector of three: rows of such a struct are a
/// table.
template <Listed Row>
bool is_table_row() {
  bool all = true;
  Row row;
  each_member(row, [&](const char*, const auto& member, auto&&...) {
    using Member = std::decay_t<decltype(member)>;
    all = all && (std::is_arithmetic_v<Member> || std::is_enum_v<Member> || std::is_same_v<Member, Vec3>);
  });
  return all;
}

/// A field for each member of the list where it lies in the struct.
template <Listed Row>
py::dtype row_type() {
  py::list names, formats, offsets;
  Row row;
  each_member(row, [&](const char* name, const auto& member, auto&&...) {
    using Member = std::decay_t<decltype(member)>;
    names.append(name);
    if constexpr (std::is_arithmetic_v<Member>)
      formats.append(py::dtype::of<Member>());
    else if constexpr (std::is_enum_v<Member>)
      formats.append(py::dtype::of<std::underlying_type_t<Member>>());
    else
      formats.append(py::make_tuple(py::dtype::of<double>(), 3));
    offsets.append(reinterpret_cast<const char*>(&member) - reinterpret_cast<const char*>(&row));
  });
  return py::dtype(names, formats, offsets, sizeof(Row));
}

/// Rows as a structured array: table["drag_n"] is a column. A notebook shows it as a table.
template <Listed Row>
py::array table_of(const std::vector<Row>& rows, py::handle owner) {
  const py::array array =
      view_of(rows.data(), {static_cast<py::ssize_t>(rows.size())}, row_type<Row>(), owner);
  return array.attr("view")(py::module_::import("ripstop._notebook").attr("Table"));
}

}  // namespace ripstop::python
